//! The settings of a campaign from the command line; options that would change nothing are refused.

use crate::args::CampaignArgs;
use crate::exit::Failure;
use cotama_campaign::requirement::Requirement;
use cotama_campaign::requirements::Requirements;
use cotama_campaign::run::{Campaign, MAX_RUNS, Settings};
use cotama_campaign::space::Rates;
use cotama_campaign::statistics::{Sprt, okamoto_runs};
use cotama_campaign::strategy::StrategyName;
use cotama_models::missions::Mission;
use cotama_models::robots::supervisors;

/// The kind of a campaign's subject.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Of {
    /// A mission that is run by its plans alone.
    Plain,
    /// A mission under supervisors.
    Supervised,
    Team,
}

impl Of {
    pub(super) fn mission(mission: &Mission) -> Self {
        if mission.is_supervised() { Self::Supervised } else { Self::Plain }
    }
}

/// Returns the settings of the campaign of a subject from this source.
pub(super) fn settings(
    args: &CampaignArgs,
    of: Of,
    source: &str,
    mission: Option<&Mission>,
) -> Result<Settings, Failure> {
    let supervised = of == Of::Supervised;
    let usual = Settings::new(supervised);
    let for_supervised = args.require.iter().find(|it| it.needs_supervisors() && !supervised);
    if let Some(it) = for_supervised {
        let message = match of {
            Of::Team => format!("`{it}` is about the supervisors of a mission, and this is a team"),
            _ => format!("`{it}` is about supervisors, and the mission has none"),
        };
        return Err(Failure::of(source, message).help("--require not-failed, say"));
    }
    if let Some(unknown) = args.require.iter().find(|it| !fires(it, mission)) {
        let message = format!("`{unknown}`: the supervisors have no such transition");
        return Err(Failure::new(message).help("cotama simulate delivery lists them"));
    }
    if args.rates == Some(Rates::Drift) && of != Of::Plain {
        let message = "--rates drift is for missions without supervisors";
        return Err(Failure::of(source, message).help("--rates fmeca draws by the FMECA"));
    }
    if args.rates == Some(Rates::Fmeca) && of == Of::Plain {
        let message = "--rates fmeca is for missions with supervisors: the FMECA is theirs";
        return Err(Failure::of(source, message));
    }
    let strategy = args.strategy.unwrap_or(usual.strategy);
    used(args, strategy)?;
    let asked: Requirements = args.require.iter().cloned().collect();
    let requirements = if asked.is_empty() { usual.requirements } else { asked };
    Ok(Settings {
        runs: runs(args, usual.runs)?,
        seed: args.seed.unwrap_or(usual.seed),
        strategy,
        rates: args.rates.unwrap_or(usual.rates),
        faults: args.per_run.unwrap_or(usual.faults),
        requirements,
    })
}

/// How many runs, whichever option says so.
fn runs(args: &CampaignArgs, usual: u64) -> Result<u64, Failure> {
    let wanted = args.within.map(|it| okamoto_runs(it, args.confidence()));
    let runs = wanted.or(args.runs).unwrap_or(usual);
    if runs > MAX_RUNS {
        let message = format!("that takes {runs} runs, and at most {MAX_RUNS} are run");
        return Err(Failure::new(message).help("a larger --within takes fewer"));
    }
    Ok(runs)
}

/// Refuses what a strategy does not look at, and guarantees that it cannot give.
fn used(args: &CampaignArgs, strategy: StrategyName) -> Result<(), Failure> {
    let name = strategy.name();
    let refused = |option: &str, why: &str, help: &str| {
        Err(Failure::new(format!("{option} with --strategy {name}: {why}")).help(help))
    };
    let every = strategy == StrategyName::Exhaustive;
    if let Some(why) = strategy.estimates_nothing() {
        let independent = "--strategy uniform and swarm draw each plan by itself";
        let why = format!("{why}, so how often runs fail estimates no probability");
        if args.within.is_some() {
            return refused("--within", &why, independent);
        }
        if args.at_most.is_some() && !every {
            return refused("--at-most", &why, independent);
        }
        if args.confidence.is_some() {
            return refused("--confidence", &why, independent);
        }
    }
    let enumerates = every || matches!(strategy, StrategyName::Pairwise | StrategyName::ThreeWay);
    if args.rates == Some(Rates::Fmeca) && (enumerates || strategy == StrategyName::Guided) {
        let help = "--strategy uniform, swarm and races draw by the FMECA";
        return refused("--rates fmeca", "it takes all kinds of faults alike", help);
    }
    if let Some((_, most)) = args.per_run.filter(|it| it.0 < it.1 && enumerates) {
        let why = "all of its plans have as many faults";
        return refused("--per-run", why, &format!("--per-run {most} says so"));
    }
    Ok(())
}

/// Refuses what `merge` does not look at.
pub(super) fn only_merged(args: &CampaignArgs) -> Result<(), Failure> {
    let given = [
        ("--runs", args.runs.is_some()),
        ("--jobs", args.jobs.is_some()),
        ("--seed", args.seed.is_some()),
        ("--strategy", args.strategy.is_some()),
        ("--rates", args.rates.is_some()),
        ("--per-run", args.per_run.is_some()),
        ("--require", !args.require.is_empty()),
        ("--policy", args.policy.is_some()),
        ("--compare", args.compare),
        ("--at-most", args.at_most.is_some()),
        ("--within", args.within.is_some()),
        ("--shard", args.shard.is_some()),
    ];
    match given.into_iter().find(|it| it.1) {
        Some((option, _)) => {
            let message = format!("{option} is not for `merge`: what was run is in the folders");
            Err(Failure::new(message)
                .help("merge takes --out, --shrink, --confidence, --junit and --json"))
        }
        None => Ok(()),
    }
}

/// Whether a transition that must not fire is one of the supervisors.
fn fires(requirement: &Requirement, mission: Option<&Mission>) -> bool {
    let Requirement::Never(name) = requirement else { return true };
    let Some((net, transition)) = name.split_once('.') else { return false };
    if let Some((mission, robot)) = mission.and_then(|it| Some((it, it.robot()?))) {
        let nets = supervisors::of_mission(robot.robot(), &mission.steps()).nets;
        let of = nets.iter().filter(|it| it.0 == net);
        return { of }.any(|it| it.1.transitions.iter().any(|it| it.name == transition));
    }
    true
}

/// Whether the probability of failure is at most so much.
#[derive(Clone, Copy, Debug)]
pub(super) enum Test {
    /// Asked of independent runs, one after the other.
    Sequential(Sprt),
    /// Counted when all plans were run.
    Counted(f64),
}

impl Test {
    /// The test that is asked for. From twice the probability on, but at most half way to 1, it
    /// says more.
    pub(super) fn of(
        args: &CampaignArgs,
        campaign: &Campaign<'_>,
    ) -> Result<Option<Self>, Failure> {
        let Some(low) = args.at_most else { return Ok(None) };
        let Some(plans) = campaign.plans() else {
            let test = Sprt::new(low, more_from(low), args.confidence());
            let test = test.map_err(|error| Failure::new(error.to_string()))?;
            return Ok(Some(Self::Sequential(test)));
        };
        if campaign.settings.runs < plans {
            let message = format!(
                "--at-most with --strategy exhaustive: {} of its {plans} plans say nothing of the \
                 others",
                campaign.settings.runs
            );
            let help = if plans <= MAX_RUNS {
                format!("--runs {plans} runs them all")
            } else {
                format!("at most {MAX_RUNS} are run: fewer --per-run make fewer plans")
            };
            return Err(Failure::new(message).help(help));
        }
        Ok(Some(Self::Counted(low)))
    }

    /// One more run.
    pub(super) fn add(&mut self, failed: bool) {
        if let Self::Sequential(test) = self {
            test.add(failed);
        }
    }

    /// Whether no more runs are needed.
    pub(super) const fn is_decided(&self) -> bool {
        matches!(self, Self::Sequential(it) if it.decision().is_some())
    }
}

fn more_from(low: f64) -> f64 {
    (2.0 * low).min(f64::midpoint(low, 1.0))
}
