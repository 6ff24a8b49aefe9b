//! `cotama run fleet` and `cotama run service`: teams of robots.

use crate::answers::team::{
    AwardRow, Compared, ComparedRow, ErrorRow, Interval, TeamAnswer, TeamRun,
};
use crate::args::RunArgs;
use crate::exit::{Exit, Failure};
use crate::names::{is_name, near};
use crate::output::{self, Screen};
use crate::render;
use cotama_models::missions::embedded;
use cotama_sim::fleet::Kind;
use cotama_sim::fleet::campaign::{Results, Spread, compare};
use cotama_sim::fleet::record::{Fate, Record};
use cotama_sim::fleet::scenarios::{FleetOptions, ServiceOptions, fleet, service};
use cotama_sim::fleet::task::Method;
use cotama_sim::fleet::trace::Trace;
use cotama_sim::report;
use std::path::{Path, PathBuf};
use std::thread;

/// A scenario of a team.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Team {
    Fleet,
    Service,
}

impl Team {
    /// All, with a line of what they are.
    pub(crate) const ALL: [(Self, &'static str); 2] = [
        (Self::Service, "Four robots serve a drink, with what goes wrong in it (Rohrmueller 2011)"),
        (Self::Fleet, "Forty robots carry two hundred deliveries in an office; some robots fail"),
    ];

    /// Its name on the command line.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Fleet => "fleet",
            Self::Service => "service",
        }
    }

    /// The one of this name.
    pub(crate) fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().map(|it| it.0).find(|it| it.name() == name)
    }
}

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

/// Runs a team and reports.
pub(crate) fn run(args: &RunArgs, team: Team, screen: &Screen) -> Result<Exit, Failure> {
    for_missions(args)?;
    let script = match args.faults.as_str() {
        "script" => true,
        "none" => false,
        file => {
            return Err(Failure::new(format!("--faults {file}: teams read no file of faults"))
                .help("give `script` or `none`"));
        }
    };
    let fleet_options = FleetOptions::default();
    let number = |it: Option<u64>, usual: usize| it.map_or(usual, |it| it as usize);
    let robots = number(args.team.robots, fleet_options.robots);
    let failures = number(args.team.failures, fleet_options.failures.min(robots / 8));
    let fleet_options = FleetOptions {
        robots,
        tasks: number(args.team.tasks, fleet_options.tasks),
        failures: if script { failures } else { 0 },
        loss_permille: args.team.loss.unwrap_or(fleet_options.loss_permille),
        method: args.team.allocation.map_or(fleet_options.method, Method::from),
        seed: args.seed,
    };
    if failures > robots {
        return Err(Failure::new(format!("--failures {failures}: there are {robots} robots")));
    }
    let scenario = match team {
        Team::Fleet => {
            if args.team.hidden_handle {
                return Err(Failure::new("--hidden-handle is for `cotama run service`"));
            }
            if let Some(seeds) = args.team.seeds {
                return compared(args, &fleet_options, seeds, screen);
            }
            fleet(&fleet_options)
        }
        Team::Service => {
            if let Some(option) = args.team.first_of_fleet() {
                return Err(Failure::new(format!("{option} is for `cotama run fleet`")));
            }
            service(&ServiceOptions {
                hidden_handle: args.team.hidden_handle,
                disturbances: script && !args.team.hidden_handle,
                loss_permille: args.team.loss.unwrap_or(0),
                seed: args.seed,
            })
        }
    };
    let trace = Trace::of(&scenario);
    let mut run = of(&trace);
    if let Some(path) = &args.trace {
        output::file(path, trace.to_json_lines().as_bytes())?;
        run.trace = Some(path.display().to_string());
    }
    if !args.no_report {
        let usual = || PathBuf::from("report").join(team.name());
        let folder = args.report.clone().unwrap_or_else(usual);
        output::make_folder(&folder)?;
        let path = folder.join("index.html");
        output::file(&path, report::team::html(&trace).as_bytes())?;
        run.report = Some(path.display().to_string());
    }
    let outcome = match (trace.run.is_sound(), run.reported) {
        (true, 0) => "completed",
        (true, _) => "reported",
        (false, _) => "failed",
    };
    let answer = answer(team, outcome, &fleet_options, &trace, run);
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        screen.print(&render::team::screen(&answer, &trace, screen.width()))?;
    }
    Ok(if outcome == "completed" { Exit::Success } else { Exit::Violated })
}

/// Refuses options that only missions have.
fn for_missions(args: &RunArgs) -> Result<(), Failure> {
    let planning = &args.planning;
    let given = [
        ("--objective", args.objective.is_some()),
        ("--allocator", planning.allocator.is_some()),
        ("--lost", !planning.lost.is_empty()),
        ("--duration-limit", planning.duration_limit.is_some()),
        ("--energy-limit", planning.energy_limit.is_some()),
        ("--monitor-period", args.monitor_period.is_some()),
        ("--upward", args.upward),
    ];
    match given.into_iter().find(|it| it.1) {
        None => Ok(()),
        Some((option, _)) => {
            Err(Failure::new(format!("{option} is for missions, and this is a team")))
        }
    }
}

fn answer(
    team: Team,
    outcome: &'static str,
    options: &FleetOptions,
    trace: &Trace,
    run: TeamRun,
) -> TeamAnswer {
    TeamAnswer {
        schema: "cotama/run-team/1",
        scenario: team.name().to_owned(),
        outcome,
        seed: options.seed,
        robots: trace.header.robots.len() as u64,
        tasks: trace.header.tasks.len() as u64,
        loss_permille: trace.header.loss_permille,
        run: Some(run),
        compared: None,
    }
}

/// What a run came to.
fn of(trace: &Trace) -> TeamRun {
    let run = &trace.run;
    let done = run.count(Fate::Done) as u64;
    let mut answer = TeamRun {
        allocation: trace.header.allocation,
        done,
        reported: run.count(Fate::Reported) as u64,
        duration_ms: run.end_ms,
        robot_time_ms: run.busy_ms,
        cost_ms: run.cost_ms,
        mean_time_ms: run.waited_ms / done.max(1),
        auctions: u64::from(run.rounds),
        reopened: u64::from(run.reopened),
        robots_out: run.out as u64,
        messages: Kind::ALL.iter().map(|it| (it.name(), run.sent(*it))).collect(),
        messages_lost: run.lost,
        awards: Vec::new(),
        errors: Vec::new(),
        report: None,
        trace: None,
    };
    for record in &trace.records {
        match record {
            Record::Awarded { t_ms, task, round, plan, robots, costs_ms, .. } => {
                answer.awards.push(AwardRow {
                    t_ms: *t_ms,
                    round: *round,
                    task: trace.task(*task).to_owned(),
                    plan: plan.clone(),
                    robots: robots.iter().map(|it| trace.robot(*it).to_owned()).collect(),
                    costs_ms: costs_ms.clone(),
                });
            }
            Record::Error { t_ms, robot, task, class, why } => answer.errors.push(ErrorRow {
                t_ms: *t_ms,
                robot: trace.robot(*robot).to_owned(),
                task: trace.task(*task).to_owned(),
                class: class.clone(),
                why: why.clone(),
            }),
            _ => {}
        }
    }
    answer
}

/// Many seeds, with one allocation or with all.
fn compared(
    args: &RunArgs,
    options: &FleetOptions,
    seeds: u64,
    screen: &Screen,
) -> Result<Exit, Failure> {
    let all = [Method::Optimal, Method::Rounds, Method::OneByOne];
    let methods = args.team.allocation.map_or(all.to_vec(), |it| vec![it.into()]);
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let results = compare(options, seeds, &methods, threads);
    let unsound: usize = results.iter().map(|it| it.unsound).sum();
    let reported: usize = results.iter().map(|it| it.reported).sum();
    let answer = TeamAnswer {
        schema: "cotama/run-team/1",
        scenario: Team::Fleet.name().to_owned(),
        outcome: match (unsound, reported) {
            (0, 0) => "completed",
            (0, _) => "reported",
            _ => "failed",
        },
        seed: options.seed,
        robots: options.robots as u64,
        tasks: options.tasks as u64,
        loss_permille: options.loss_permille,
        run: None,
        compared: Some(Compared {
            seeds,
            confidence_permille: 950,
            allocations: results.iter().map(row).collect(),
        }),
    };
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        screen.print(&render::team::compared(&answer, options, screen.width()))?;
    }
    Ok(if unsound == 0 { Exit::Success } else { Exit::Violated })
}

fn row(it: &Results) -> ComparedRow {
    ComparedRow {
        allocation: it.method.name(),
        cost_ms: it.cost_ms.into(),
        mean_time_ms: it.waited_ms.into(),
        more_ms: it.more_ms.into(),
        more_permille: it.more_permille.into(),
        done: it.done as u64,
        reported: it.reported as u64,
        reopened: it.reopened,
        unsound: it.unsound as u64,
    }
}

impl From<Spread> for Interval {
    fn from(it: Spread) -> Self {
        let half = i64::try_from(it.half_width).unwrap_or(i64::MAX);
        let (low, high) = (it.mean.saturating_sub(half), it.mean.saturating_add(half));
        Self { mean: it.mean, low, high }
    }
}
