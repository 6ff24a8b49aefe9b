//! `cotama campaign`: many missions under drawn faults, and what comes of them.

use crate::answers::campaign::{
    CampaignAnswer, DecisionRow, FailureRow, Measured, Outcomes, PolicyRow, RequirementRow,
};
use crate::args::{CampaignArgs, PolicyName};
use crate::exit::{Exit, Failure};
use crate::mission::{self, Loaded};
use crate::output::{self, Screen};
use crate::render;
use cotama_sim::campaign::compare::compare;
use cotama_sim::campaign::findings::Findings;
use cotama_sim::campaign::requirement::Requirement;
use cotama_sim::campaign::results::{Header, Tally};
use cotama_sim::campaign::run::{Campaign, Settings, Shard};
use cotama_sim::campaign::space::Rates;
use cotama_sim::campaign::statistics::{Decision, Interval, Sprt, okamoto_runs};
use cotama_sim::campaign::subject::Subject;
use cotama_sim::report;
use std::ops::ControlFlow;
use std::path::Path;
use store::Store;

mod merge;
#[cfg(any(test, feature = "fuzz"))]
pub(crate) mod mutants;
#[cfg(feature = "parquet")]
mod parquet;
mod progress;
mod store;

/// Runs a campaign, or puts the shards of one together.
pub(crate) fn campaign(args: &CampaignArgs, screen: &Screen) -> Result<Exit, Failure> {
    if args.scenario == "merge" {
        return merge::merge(args, screen);
    }
    if let Some(folder) = args.shards.first() {
        let message = format!("`{}`: folders are for `merge`", folder.display());
        return Err(Failure::new(message).help("cotama campaign merge DIR... --out DIR"));
    }
    let loaded = mission::load(&args.scenario)?;
    let settings = settings(args, &loaded)?;
    if args.compare {
        return compared(args, &loaded, &settings, screen);
    }
    let campaign = ready(&loaded, args.policy, settings)?;
    let shard = args.shard.unwrap_or(Shard::ALL);
    let texts = (loaded.source.as_str(), loaded.text.as_str());
    let header = Header::new(texts, &campaign.settings, args.policy.name(), shard);
    let mut test = sequential(args)?;
    let (mut tally, mut store) = (Tally::default(), None);
    let mut done = 0;
    if let Some(folder) = &args.out {
        let (opened, blocks) = Store::open(folder, &header, &mut |line, text| {
            tally.add(line, text);
            test.as_mut().is_some_and(|it| it.add(!line.violated.is_empty()).is_some())
        })?;
        (store, done) = (Some(opened), blocks);
    }
    let wanted = shard.blocks(campaign.settings.runs).count();
    let progress = progress::Progress::new(campaign.settings.runs / shard.of);
    let mut failure = None;
    let decided = |test: &Option<Sprt>| test.is_some_and(|it| it.decision().is_some());
    if done < wanted && !decided(&test) {
        campaign.run(shard, done, jobs(args), &mut |lines| {
            let mut text = String::new();
            for line in &lines {
                let Ok(json) = serde_json::to_string(line) else { continue };
                tally.add(line, &json);
                text.push_str(&json);
                text.push('\n');
                if test.as_mut().is_some_and(|it| it.add(!line.violated.is_empty()).is_some()) {
                    break;
                }
            }
            if let Some(Err(error)) = store.as_mut().map(|it| it.append(&text)) {
                failure = Some(error);
                return ControlFlow::Break(());
            }
            progress.show(tally.runs, tally.failing);
            if decided(&test) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
    }
    progress.clear();
    if let Some(failure) = failure {
        return Err(failure);
    }
    let decision = test.map(|it| decision(&it, args));
    let answer = finish(args, &header, &campaign, &tally, decision)?;
    ended(args, &answer, screen)
}

/// What is drawn and asked.
fn settings(args: &CampaignArgs, loaded: &Loaded) -> Result<Settings, Failure> {
    let supervised = loaded.mission.supervisor().is_some();
    let usual = Settings::new(supervised);
    let for_supervised = args.require.iter().find(|it| it.needs_supervisors() && !supervised);
    if let Some(it) = for_supervised {
        let message = format!("`{it}` is about supervisors, and the mission has none");
        return Err(Failure::of(&loaded.source, message).help("--require not-failed, say"));
    }
    if let Some(unknown) = args.require.iter().find(|it| !fires(it)) {
        let message = format!("`{unknown}`: the supervisors have no such transition");
        return Err(Failure::new(message).help("cotama simulate delivery lists them"));
    }
    if args.rates == Rates::Fmeca && !supervised {
        let message = "--rates fmeca is for missions with supervisors: the FMECA is theirs";
        return Err(Failure::of(&loaded.source, message));
    }
    let mut requirements = args.require.clone();
    if requirements.is_empty() {
        requirements = usual.requirements;
    }
    requirements.dedup();
    let runs = args.within.map_or(args.runs, |it| okamoto_runs(it, args.confidence));
    let (seed, strategy, rates, faults) = (args.seed, args.strategy, args.rates, args.per_run);
    Ok(Settings { runs, seed, strategy, rates, faults, requirements })
}

/// Whether a transition that must not fire is one of the supervisors.
fn fires(requirement: &Requirement) -> bool {
    let Requirement::Never(name) = requirement else { return true };
    let Some((net, transition)) = name.split_once('.') else { return false };
    let components = cotama_models::cotama::recovering::SYSTEM.components;
    // The global supervisor of a mission of one's own has transitions of its own.
    net == "gs"
        || components
            .iter()
            .any(|it| it.name == net && it.net.transitions.iter().any(|it| it.name == transition))
}

fn ready(loaded: &Loaded, policy: PolicyName, settings: Settings) -> Result<Campaign<'_>, Failure> {
    let policy = policy.policy(loaded.mission.supervisor().is_some());
    let subject = Subject::new(&loaded.mission, policy)
        .map_err(|error| Failure::of(&loaded.source, error.to_string()))?;
    Campaign::new(subject, settings).map_err(|error| Failure::of(&loaded.source, error.to_string()))
}

fn jobs(args: &CampaignArgs) -> usize {
    let processors = || std::thread::available_parallelism().map_or(1, usize::from);
    args.jobs.map_or_else(processors, |it| usize::try_from(it).unwrap_or(1))
}

/// From twice the probability on, but at most half way to 1.
fn sequential(args: &CampaignArgs) -> Result<Option<Sprt>, Failure> {
    let test = args.at_most.map(|low| Sprt::new(low, more_from(low), args.confidence));
    test.transpose().map_err(|error| Failure::new(error.to_string()))
}

fn more_from(low: f64) -> f64 {
    (2.0 * low).min(f64::midpoint(low, 1.0))
}

fn decision(test: &Sprt, args: &CampaignArgs) -> DecisionRow {
    let (at_most, more_from) = test.between();
    let verdict = match test.decision() {
        Some(Decision::Small) => "at_most",
        Some(Decision::Large) => "more",
        None => "undecided",
    };
    DecisionRow { verdict, at_most, more_from, confidence: args.confidence, runs: test.runs() }
}

/// Makes failures small, writes what is to be written, and answers.
fn finish(
    args: &CampaignArgs,
    header: &Header,
    campaign: &Campaign<'_>,
    tally: &Tally,
    decision: Option<DecisionRow>,
) -> Result<CampaignAnswer, Failure> {
    let whole = header.shard.of == 1;
    let most = if whole { usize::try_from(args.shrink).unwrap_or(0) } else { 0 };
    let requirements = &campaign.settings.requirements;
    let findings = Findings::of(&campaign.subject, requirements, tally, most);
    let estimates = campaign.estimates();
    let overall = cotama_sim::campaign::statistics::clopper_pearson;
    let estimate =
        |hits: u64| estimates.then(|| Measured::from(overall(hits, tally.runs, args.confidence)));
    let rows = requirements.iter().map(|it| {
        let violated = tally.violated.get(&it.to_string()).copied().unwrap_or(0);
        let (requirement, text) = (it.to_string(), it.words());
        RequirementRow { requirement, text, violated, probability: estimate(violated) }
    });
    let failures = findings.clusters.iter().map(|it| FailureRow {
        fault_file: None,
        requirement: it.requirement.to_string(),
        signature: it.signature.clone(),
        count: it.runs.len() as u64,
        run: it.runs.first().copied().unwrap_or(0),
        scenario: it.scenario.clone(),
    });
    let mut answer = CampaignAnswer {
        schema: "cotama/campaign/1",
        mission: campaign.subject.mission().name.clone(),
        runs: tally.runs,
        seed: header.seed,
        strategy: header.strategy.clone(),
        policy: header.policy.clone(),
        shard: (!whole).then(|| format!("{}/{}", header.shard.index, header.shard.of)),
        outcomes: Outcomes::from(tally.outcomes),
        failing: tally.failing,
        // After a test that stopped when it was decided the share is no estimate.
        failure_probability: estimate(tally.failing).filter(|_| decision.is_none()),
        requirements: rows.collect(),
        failures: failures.collect(),
        shrunk: findings.shrunk,
        shrinking_runs: findings.cost.0,
        decision,
        digest: tally.digest(),
        policies: Vec::new(),
        report: None,
    };
    if let Some(folder) = args.out.as_deref().filter(|_| whole) {
        write(folder, header, campaign, tally, &findings, &mut answer, args.confidence)?;
    }
    Ok(answer)
}

/// The failures, the page and the summary beside the results.
fn write(
    folder: &Path,
    header: &Header,
    campaign: &Campaign<'_>,
    tally: &Tally,
    findings: &Findings,
    answer: &mut CampaignAnswer,
    confidence: f64,
) -> Result<(), Failure> {
    let failures = folder.join("failures");
    if !answer.failures.is_empty() {
        output::make_folder(&failures)?;
    }
    for (number, row) in answer.failures.iter_mut().enumerate() {
        let path = failures.join(format!("{:03}.toml", number + 1));
        output::file(&path, row.scenario.as_bytes())?;
        row.fault_file = Some(path.display().to_string());
    }
    let page = report::campaign::html(header, campaign, tally, findings, confidence);
    #[cfg(feature = "parquet")]
    parquet::write(folder, tally.runs)?;
    let path = folder.join("index.html");
    output::file(&path, page.as_bytes())?;
    answer.report = Some(path.display().to_string());
    Ok(())
}

fn ended(args: &CampaignArgs, answer: &CampaignAnswer, screen: &Screen) -> Result<Exit, Failure> {
    if args.json.json {
        Screen::json(answer)?;
    } else {
        screen.print(&render::campaign::screen(answer))?;
    }
    Ok(match answer.decision.map(|it| it.verdict) {
        Some("at_most") => Exit::Success,
        Some("undecided") => Exit::Unknown,
        None if answer.failing == 0 => Exit::Success,
        _ => Exit::Violated,
    })
}

/// The same plans with each policy.
fn compared(
    args: &CampaignArgs,
    loaded: &Loaded,
    settings: &Settings,
    screen: &Screen,
) -> Result<Exit, Failure> {
    let supervised = loaded.mission.supervisor().is_some();
    let of_all =
        |it: &PolicyName| !supervised || matches!(it, PolicyName::Usual | PolicyName::Exact);
    let named: Vec<_> = if supervised {
        // A search for the most quality is usual there.
        vec![
            (
                "rule",
                cotama_sim::campaign::subject::Policy {
                    planner: Some(cotama_sim::options::Planner::Panorama),
                    ..Default::default()
                },
            ),
            (PolicyName::Exact.name(), PolicyName::Exact.policy(true)),
        ]
    } else {
        let all = PolicyName::ALL.into_iter().filter(of_all);
        all.map(|it| (it.name(), it.policy(false))).collect()
    };
    let policies: Vec<_> = named.iter().map(|(name, it)| ((*name).to_owned(), *it)).collect();
    let found = compare(&loaded.mission, &policies, settings, jobs(args))
        .map_err(|error| Failure::of(&loaded.source, error.to_string()))?;
    let rows: Vec<_> = found
        .iter()
        .zip(&named)
        .map(|(it, (name, _))| {
            let [duration_ms, energy_mj, operator_requests, replans] = it.means.map(Measured::from);
            PolicyRow {
                policy: name,
                outcomes: Outcomes::from(it.outcomes),
                success: it.success.into(),
                success_difference: it.against.as_ref().map(|it| it.success.success.into()),
                p_value: it.against.as_ref().map(|it| it.success.p_value),
                duration_ms,
                energy_mj,
                operator_requests,
                replans,
            }
        })
        .collect();
    let outcomes = rows.first().map_or([0; 3].into(), |it| it.outcomes);
    let answer = CampaignAnswer {
        schema: "cotama/campaign/1",
        mission: loaded.mission.name.clone(),
        runs: settings.runs,
        seed: settings.seed,
        strategy: settings.strategy.name().into(),
        policy: rows.first().map_or(String::new(), |it| it.policy.into()),
        shard: None,
        outcomes,
        failing: 0,
        failure_probability: None,
        requirements: Vec::new(),
        failures: Vec::new(),
        shrunk: 0,
        shrinking_runs: 0,
        decision: None,
        digest: String::new(),
        policies: rows,
        report: None,
    };
    ended(args, &answer, screen)
}

impl From<Interval> for Measured {
    fn from(it: Interval) -> Self {
        Self { estimate: it.estimate, low: it.low, high: it.high, confidence: it.confidence }
    }
}

impl From<[u64; 3]> for Outcomes {
    fn from([completed, safe, failed]: [u64; 3]) -> Self {
        Self { completed, safe, failed }
    }
}
