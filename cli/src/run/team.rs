//! `cotama run` and `cotama replay` of teams of robots: those of the program, and files.

mod compared;

use crate::answers::team::{AwardRow, SkillRow, TeamAnswer, TeamErrorRow, TeamRun};
use crate::args::{Compare, Fidelity, OperatorName, ReplayArgs, RunArgs, STEPS};
use crate::exit::{Exit, Failure};
use crate::file_errors::FileErrors;
use crate::input;
use crate::kind::{self, Kind};
use crate::names::{is_name, near, quoted};
use crate::output::{self, Screen};
use crate::recording;
use crate::render;
use crate::team::{Chosen, Team};
use compared::compared;
use cotama_campaign::plan::{Fault, Plan};
use cotama_campaign::recorded::{self, Again};
use cotama_campaign::subject::Subject;
use cotama_models::missions::embedded;
use cotama_models::team::scenario::{self, FaultsOfTeam, Method, Scenario, Trust};
use cotama_pages::team as page;
use cotama_sim::fleet::Kind as Letters;
use cotama_sim::fleet::record::{Fate, Record, SkillUses};
use cotama_sim::fleet::scenarios::{FleetOptions, ServiceOptions, fleet, service};
use cotama_sim::fleet::trace::{self, Trace};
use cotama_sim::trace::TraceError;
use std::path::{Path, PathBuf};

/// Refuses options that are not for missions.
pub(crate) fn none_given(args: &RunArgs) -> Result<(), Failure> {
    match args.team.first() {
        None => Ok(()),
        Some(option) => Err(Failure::new(format!("{option} is for teams"))
            .help("run a team: `cotama run fleet`, `cotama run service`")),
    }
}

/// Refuses a name that is nearly that of a team.
pub(crate) fn not_meant(name: &str) -> Result<(), Failure> {
    let known = embedded::mission(name).is_some() || Path::new(name).exists();
    let teams = Team::ALL.iter().map(|it| it.0.name());
    match near(name, teams).filter(|_| is_name(name) && !known) {
        None => Ok(()),
        Some(team) => {
            let message = format!("there is no mission `{name}`, and no file of this name");
            Err(Failure::new(message).help(format!("did you mean the team `{team}`?")))
        }
    }
}

/// What differs from the team and its options.
#[derive(Clone, Copy, Default)]
struct Variant {
    method: Option<Method>,
    trust: Option<Trust>,
}

impl Chosen {
    /// Returns what is run for these options with a seed and a variant.
    fn made(&self, args: &RunArgs) -> Result<impl Fn(u64, Variant) -> Scenario, Failure> {
        let script = args.faults != "none";
        if args.team.hidden_handle && !matches!(self, Self::Known(Team::Service)) {
            return Err(Failure::new("--hidden-handle is for `cotama run service`"));
        }
        if let Some(option) = args.team.first_of_size().filter(|_| !self.is_fleet()) {
            return Err(Failure::new(format!("{option} is for `cotama run fleet`")));
        }
        let usual = FleetOptions::default();
        let number = |it: Option<u64>, usual: usize| it.map_or(usual, |it| it as usize);
        let robots = number(args.team.robots, usual.robots);
        let failures = number(args.team.failures, usual.failures.min(robots / 8));
        if failures > robots {
            return Err(Failure::new(format!("--failures {failures}: there are {robots} robots")));
        }
        let (tasks, loss) = (number(args.team.tasks, usual.tasks), args.team.loss);
        let (hidden_handle, allocation) = (args.team.hidden_handle, args.team.allocation);
        let (takeover, kills) = (args.team.kills.is_some(), number(args.team.kills, 0));
        let (gripper, trust) = (args.team.gripper.unwrap_or(0), args.team.trust);
        let file = match self {
            Self::File(scenario) => Some((**scenario).clone()),
            Self::Known(_) => None,
        };
        let is_fleet = self.is_fleet();
        let own = move |seed: u64, variant: Variant| {
            let method = variant.method.or(allocation.map(Method::from));
            let trust = variant.trust.or(trust.map(Trust::from));
            let mut scenario = match &file {
                Some(scenario) => Scenario { seed, ..scenario.clone() },
                None if is_fleet => {
                    let failures = if script { failures } else { 0 };
                    let gripper_fails_permille = gripper;
                    let kills = if script { kills } else { 0 };
                    let size = FleetOptions { robots, tasks, failures, seed, ..usual };
                    fleet(&FleetOptions { gripper_fails_permille, takeover, kills, ..size })
                }
                None => {
                    let disturbances = script && !hidden_handle;
                    let options = ServiceOptions {
                        hidden_handle,
                        disturbances,
                        seed,
                        ..ServiceOptions::default()
                    };
                    service(&options)
                }
            };
            if !script && file.is_some() {
                scenario.faults.clear();
            }
            if let Some(loss) = loss {
                scenario.network.loss_permille = loss;
            }
            scenario.method = method.unwrap_or(scenario.method);
            scenario.trust = trust.unwrap_or(scenario.trust);
            scenario
        };
        // Faults are those of this team, whatever its size.
        let given = match args.faults.as_str() {
            "script" | "none" => None,
            file => Some(faults(file, &own(args.seed.unwrap_or(0), Variant::default()))?),
        };
        Ok(move |seed: u64, variant: Variant| {
            let mut scenario = own(seed, variant);
            if let Some(given) = &given {
                scenario.faults.clone_from(given);
            }
            scenario
        })
    }

    fn is_fleet(&self) -> bool {
        matches!(self, Self::Known(Team::Fleet))
    }
}

/// Reads the faults of a file for a team.
fn faults(file: &str, team: &Scenario) -> Result<Vec<scenario::Fault>, Failure> {
    let wanted = [Kind::TeamFaults];
    let text = kind::text(file, "a file of a team's faults", input::MISSION_BYTES, &wanted)?;
    Ok(team.faults_of(file, &text)?.faults)
}

/// Runs a team and reports.
pub(crate) fn run(args: &RunArgs, chosen: &Chosen, screen: &Screen) -> Result<Exit, Failure> {
    for_missions(args)?;
    let made = chosen.made(args)?;
    if let Some(seeds) = args.team.seeds {
        let given = [
            (Compare::Allocation, args.team.allocation.is_some(), "allocation"),
            (Compare::Trust, args.team.trust.is_some(), "trust"),
        ];
        if let Some((_, _, what)) = given.into_iter().find(|it| it.0 == args.team.compare && it.1) {
            let message = format!("--{what} with --seeds: every {what} is run and compared");
            return Err(Failure::new(message).help("leave one of them out"));
        }
        return compared(args, &made, seeds, screen);
    }
    let trace = Trace::of(&made(args.seed.unwrap_or(0), Variant::default()));
    let usual = || PathBuf::from("report").join(report_name(&trace.header.scenario));
    let folder = args.report.clone().unwrap_or_else(usual);
    let folder = (!args.no_report).then_some(folder.as_path());
    let run = written(&trace, args.trace.as_deref(), folder)?;
    let answer = answer(&trace, run);
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        let next = next(args, &answer);
        screen.print(&render::team::screen(&answer, &trace, Some(&next), screen.width()))?;
    }
    Ok(ended(&answer))
}

/// Runs the team of a trace again, and compares record by record.
pub(crate) fn replay(args: &ReplayArgs, text: &str, screen: &Screen) -> Result<Exit, Failure> {
    recording::no_team(&args.recording)?;
    let given = [("--mission", args.mission.is_some()), ("--seed", args.seed.is_some())];
    if let Some((option, _)) = given.into_iter().find(|it| it.1) {
        let message = format!("{option}: a trace names its team and its seed");
        return Err(Failure::new(message).help("leave it out"));
    }
    let name = &args.file;
    let stored =
        Trace::parse(name, text).map_err(|TraceError { line, column, message, .. }| {
            FileErrors::at(input::name(name), text.to_owned(), line, column, message)
                .help("the trace of a team is written by `cotama run TEAM --trace FILE.jsonl`")
        })?;
    let (trace, difference) = trace::replay(&stored)?;
    let run = written(&trace, args.trace.as_deref(), args.report.as_deref())?;
    let mut answer = answer(&trace, run);
    answer.identical = Some(difference.is_none());
    answer.difference = difference.as_ref().map(crate::replay::record_difference);
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        let screen_text = render::team::screen(&answer, &trace, None, screen.width());
        let compared =
            render::run::records_compared(difference.is_none(), answer.difference.as_ref());
        screen.print(&(screen_text + &compared))?;
    }
    Ok(if difference.is_none() { Exit::Success } else { Exit::Violated })
}

/// Runs a recorded failure of a team again, and compares its end.
pub(crate) fn replay_faults(
    args: &ReplayArgs,
    text: &str,
    screen: &Screen,
) -> Result<Exit, Failure> {
    recording::no_team(&args.recording)?;
    if args.seed.is_some() {
        let message = "--seed: the runs of a team's campaign have the seed 0";
        return Err(Failure::new(message).help("leave it out"));
    }
    let Some(name) = args.mission.clone().or_else(|| FaultsOfTeam::team_of(text)) else {
        let message = "a file of a team's faults needs a team";
        let help = format!("cotama replay {} --mission service", quoted(&args.file));
        return Err(Failure::of(input::name(&args.file), message).help(help));
    };
    let Some(team) = Chosen::of(&name)? else {
        let message = format!("`{name}` is no team");
        return Err(Failure::new(message).help("give `fleet`, `service`, or the path of a file"));
    };
    let team = team.scenario();
    let file = team.faults_of(&args.file, text)?;
    let scenario = Scenario { faults: file.faults.clone(), ..team.clone() };
    let again = match &file.expected {
        None => None,
        Some(expected) => {
            let plan = Plan { faults: file.faults.into_iter().map(Fault::Team).collect() };
            let again = recorded::again_by(&Subject::of_team(team, None), &plan, expected);
            Some(again.map_err(|it| Failure::of(input::name(&args.file), it.to_string()))?)
        }
    };
    let trace = Trace::of(&scenario);
    let run = written(&trace, args.trace.as_deref(), args.report.as_deref())?;
    let mut answer = answer(&trace, run);
    answer.identical = again.as_ref().map(Again::is_identical);
    answer.returns = again.as_ref().map(Again::returns);
    answer.failure = again.as_ref().map(crate::replay::recorded_failure);
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        let mut text = render::team::screen(&answer, &trace, None, screen.width());
        if let (Some(failure), Some(returns)) = (&answer.failure, answer.returns) {
            let allocation = format!("allocation {}", trace.header.allocation);
            text += &render::run::returned(failure, returns, &allocation);
        }
        screen.print(&text)?;
    }
    Ok(match answer.returns {
        Some(true) => Exit::Success,
        Some(false) => Exit::Violated,
        None => ended(&answer),
    })
}

/// A name as that of a folder: of other characters `-` stands in their place.
fn report_name(scenario: &str) -> String {
    let plain = |it: char| if it.is_ascii_alphanumeric() || it == '_' { it } else { '-' };
    let name: String = scenario.chars().take(60).map(plain).collect();
    if name.is_empty() { "team".to_owned() } else { name }
}

/// The numbers of a run, with the files that were written of it.
fn written(trace: &Trace, file: Option<&Path>, report: Option<&Path>) -> Result<TeamRun, Failure> {
    let mut run = of(trace);
    if let Some(path) = file {
        output::file(path, trace.to_json_lines().as_bytes())?;
        run.trace = Some(path.display().to_string());
    }
    if let Some(folder) = report {
        output::make_folder(folder)?;
        let path = folder.join("index.html");
        output::file(&path, page::html(trace).as_bytes())?;
        run.report = Some(path.display().to_string());
    }
    Ok(run)
}

fn ended(answer: &TeamAnswer) -> Exit {
    if answer.outcome == "completed" { Exit::Success } else { Exit::Violated }
}

/// The command that suggests itself.
fn next(args: &RunArgs, answer: &TeamAnswer) -> String {
    if let Some(trace) = answer.run.as_ref().and_then(|it| it.trace.as_deref()) {
        return format!("cotama replay {}", quoted(trace));
    }
    match args.mission.mission.as_str() {
        "fleet" => "cotama run fleet --seeds 5".to_owned(),
        "service" if answer.loss_permille == 0 => "cotama run service --loss 10".to_owned(),
        "service" => "cotama run fleet".to_owned(),
        file => format!("cotama run {} --trace team.jsonl", quoted(file)),
    }
}

/// Refuses options that only missions have.
fn for_missions(args: &RunArgs) -> Result<(), Failure> {
    recording::no_team(&args.recording)?;
    let given = [
        ("--objective", args.objective.is_some()),
        ("--monitor-period", args.monitor_period.is_some()),
        ("--upward", args.upward),
        ("--fidelity", args.fidelity != Fidelity::Line),
        ("--measured", args.measured.is_some()),
        ("--margins", args.margins.is_some()),
        ("--activities", args.activities.is_some()),
        ("--operator", args.operator != OperatorName::Script),
        ("--steps", args.planning.steps != STEPS),
    ];
    let given = given.into_iter().find(|it| it.1).map(|it| it.0);
    match args.planning.first().or(given) {
        None => Ok(()),
        Some(option) => Err(Failure::new(format!("{option} is for missions, and this is a team"))),
    }
}

fn answer(trace: &Trace, run: TeamRun) -> TeamAnswer {
    TeamAnswer {
        schema: "cotama/run-team/1",
        scenario: trace.header.scenario.clone(),
        outcome: match (trace.run().is_sound(), run.reported) {
            (true, 0) => "completed",
            (true, _) => "reported",
            (false, _) => "failed",
        },
        seed: trace.header.seed,
        robots: trace.header.robots.len() as u64,
        tasks: trace.header.tasks.len() as u64,
        loss_permille: trace.header.loss_permille,
        run: Some(run),
        compared: None,
        identical: None,
        difference: None,
        returns: None,
        failure: None,
    }
}

/// Returns the result of a run.
fn of(trace: &Trace) -> TeamRun {
    let run = trace.run();
    let done = run.count(Fate::Done) as u64;
    let mut answer = TeamRun {
        allocation: trace.header.allocation.clone(),
        done,
        reported: run.count(Fate::Reported) as u64,
        duration_ms: run.end_ms,
        robot_time_ms: run.busy_ms,
        energy_mj: run.energy_mj,
        cost_ms: run.cost_ms,
        mean_time_ms: run.waited_ms / done.max(1),
        auctions: u64::from(run.rounds),
        reopened: u64::from(run.reopened),
        robots_out: run.out as u64,
        takeovers: u64::from(run.takeovers),
        messages: Letters::ALL
            .iter()
            .chain(&[Letters::Copy][..usize::from(run.copies > 0)])
            .map(|it| (it.name(), run.sent(*it)))
            .collect(),
        messages_lost: run.lost,
        failed_uses: u64::from(run.failed_uses),
        charges: run.charges,
        skills: run.skills.iter().map(|it| skill(trace, it)).collect(),
        performance_permille: performance(trace, run.cost_ms),
        awards: Vec::new(),
        errors: Vec::new(),
        report: None,
        trace: None,
    };
    for record in &trace.records {
        match record {
            Record::Awarded { t_ms, task, round, plan, robots, costs_ms, success, .. } => {
                answer.awards.push(AwardRow {
                    t_ms: *t_ms,
                    round: *round,
                    task: trace.task(*task).to_owned(),
                    plan: plan.clone(),
                    robots: robots.iter().map(|it| trace.robot(*it).to_owned()).collect(),
                    costs_ms: costs_ms.clone(),
                    success: success.clone(),
                });
            }
            Record::Error { t_ms, robot, task, class, why } => answer.errors.push(TeamErrorRow {
                t_ms: *t_ms,
                robot: trace.robot(*robot).to_owned(),
                task: trace.task(*task).to_owned(),
                class: class.name().to_owned(),
                why: why.clone(),
            }),
            _ => {}
        }
    }
    answer
}

fn skill(trace: &Trace, it: &SkillUses) -> SkillRow {
    SkillRow {
        robot: trace.robot(it.robot).to_owned(),
        skill: it.skill.clone(),
        uses: it.uses,
        failed: it.failed,
        reliability: it.reliability,
    }
}

/// The performance of a team (2.7): of the utility of all tasks what is left when the time of
/// robots, and the utility of what is not done, are taken away; in thousandths, rounded down.
fn performance(trace: &Trace, cost_ms: u64) -> Option<i64> {
    let utility = trace.scenario().ok()?.tasks.iter().map(|it| i128::from(it.utility_ms)).sum();
    let left: i128 = (utility - i128::from(cost_ms)) * 1_000;
    i64::try_from(left.checked_div_euclid(utility)?).ok()
}
