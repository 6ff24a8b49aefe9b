//! Teams: time to a proof for growing random teams, all tasks at once; and one task with a plan for
//! each number of robots, beside what the thesis does.
//!
//! `joint [SEEDS]`: one setting for all. Teams are crowded: about as many roles as robots.
//! `joint SEEDS --export DIR`: those of 20 to 60 robots, as files, with what came out and how long
//! it took, for `../teams.py`.
#![allow(clippy::cast_precision_loss)] // a gap in percent needs no more than a double's digits

#[path = "../../../../../../core/tests/common/draw.rs"]
mod draw;
#[allow(dead_code)]
#[path = "../../../../../../core/assignment/tests/team/teams.rs"]
mod teams;

use cotama_core::team::winners::{Outcome, Workspace};
use cotama_core::team::{Combine, Cost, Fixed, Team, coalition};
use cotama_models::team::thesis::{all_coalitions, all_orderings};
use draw::Draw;
use rustix::time::{ClockId, clock_gettime};
use std::fmt::Write;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use teams::{Kind, OwnedPlan, OwnedTask, OwnedTeam, again, team};

/// The processor's time so far.
fn seconds() -> f64 {
    let now = clock_gettime(ClockId::ThreadCPUTime);
    now.tv_sec as f64 + now.tv_nsec as f64 * 1e-9
}

fn main() {
    let seeds: u64 = std::env::args().nth(1).and_then(|it| it.parse().ok()).unwrap_or(3);
    let mut arguments = std::env::args().skip_while(|it| it != "--export").skip(1);
    let folder = arguments.next().map(PathBuf::from);
    if let Some(folder) = folder {
        return export(seeds, &folder);
    }
    println!("n   one task, µs   all coalitions, µs   ratio   all orderings, µs");
    (4..=12).for_each(one_task);
    println!(
        "\nrobots, tasks   kind  seed  outcome          cost   gap %         ms     steps  nodes"
    );
    let sizes = [6, 8, 10, 12, 20, 30, 40, 40, 48, 60, 80, 100];
    let tasks = [4, 5, 7, 8, 11, 16, 18, 22, 22, 30, 40, 50];
    for (robots, tasks) in sizes.into_iter().zip(tasks) {
        for name in KINDS {
            for seed in 0..seeds {
                let line = drawn(robots, tasks, name, seed).with(prove).line;
                println!("{robots:6}, {tasks:5} {name:>6} {seed:5}  {line}");
            }
        }
    }
}

/// Half of the tasks must be done; all must; only the largest cost of a role counts.
const KINDS: [&str; 3] = ["mixed", "must", "max"];

/// A crowded team.
fn drawn(robots: usize, tasks: usize, kind: &str, seed: u64) -> OwnedTeam {
    let must = if kind == "must" { 100 } else { 50 };
    let kind = Kind {
        robots,
        tasks,
        roles: 3,
        plans: 3,
        most: 100,
        missing: 40,
        must,
        skip: 120,
        largest: kind == "max",
    };
    team(&mut Draw::new(seed * 1000 + robots as u64), kind)
}

/// Writes teams, and a line of JSON for each with the answer and its time.
fn export(seeds: u64, folder: &Path) {
    std::fs::create_dir_all(folder).expect("the folder can be made");
    let mut results = String::new();
    for (robots, tasks) in [(20, 11), (30, 16), (40, 22), (48, 22), (60, 30)] {
        for kind in KINDS {
            for seed in 0..seeds {
                let name = format!("{robots}-{tasks}-{kind}-{seed}");
                let owned = drawn(robots, tasks, kind, seed);
                let Proven { line, said, cost, seconds } = owned.with(prove);
                println!("{name:<16} {line}");
                let file = folder.join(format!("{name}.json"));
                std::fs::write(file, instance(&name, &owned)).expect("it can be written");
                let cost = cost.map_or("null".into(), |it| it.to_string());
                let _ = writeln!(
                    results,
                    "{{\"name\": \"{name}\", \"status\": \"{said}\", \"cost\": {cost}, \
                     \"seconds\": {seconds:.9}}}"
                );
            }
        }
    }
    std::fs::write(folder.join("results.jsonl"), results).expect("it can be written");
}

/// A team as a `cotama-team-assignment/1` file.
fn instance(name: &str, team: &OwnedTeam) -> String {
    let names = |what: &str, count: usize| -> Vec<String> {
        (0..count).map(|it| format!("\"{what}{it}\"")).collect()
    };
    let number = |it: Option<Cost>| it.map_or("null".into(), |it| it.get().to_string());
    let tasks = team.tasks.iter().enumerate().map(|(task, it)| {
        let plans = it.plans.iter().enumerate().map(|(plan, it)| {
            let roles = it.costs.chunks(team.robots).enumerate().map(|(role, costs)| {
                let costs: Vec<_> = costs.iter().map(|it| number(*it)).collect();
                format!("{{\"name\": \"r{role}\", \"cost\": [{}]}}", costs.join(","))
            });
            let roles: Vec<_> = roles.collect();
            let (extra, roles) = (it.extra, roles.join(","));
            format!("{{\"name\": \"p{plan}\", \"extra_cost\": {extra}, \"roles\": [{roles}]}}")
        });
        let combine = match it.combine {
            Combine::Sum => "sum",
            Combine::Mean => "mean",
            Combine::Max => "max",
        };
        let (skip, plans) = (number(it.skip), plans.collect::<Vec<_>>().join(","));
        format!(
            "{{\"name\": \"t{task}\", \"skip_cost\": {skip}, \"combine\": \"{combine}\", \
             \"plans\": [{plans}]}}"
        )
    });
    let (robots, tasks) = (names("", team.robots), tasks.collect::<Vec<_>>());
    format!(
        "{{\"format\": \"cotama-team-assignment/1\", \"name\": \"{name}\", \
         \"kind\": \"simultaneous\", \"cost_denominator\": {}, \"robots\": [{}], \
         \"tasks\": [{}]}}\n",
        team.denominator,
        robots.join(","),
        tasks.join(",\n")
    )
}

/// The result of a comparison.
struct Proven {
    line: String,
    said: &'static str,
    cost: Option<u64>,
    seconds: f64,
}

/// Proves the best answer.
fn prove(team: &Team<'_>) -> Proven {
    let mut workspace = Workspace::<128>::new();
    let mut joint = workspace.winners(team, 400_000);
    let start = seconds();
    let solved = joint.solve(team, 20_000_000).expect("there is memory");
    let time = (seconds() - start) * 1e3;
    let (said, cost, bound) = match solved.outcome {
        Outcome::Optimal { cost } => ("optimal", Some(cost), cost),
        Outcome::Infeasible { .. } => ("infeasible", None, 0),
        Outcome::Unknown { cost, bound } => ("unknown", cost, bound),
    };
    let gap = cost.map_or(0.0, |it| (it - bound) as f64 * 100.0 / it.max(1) as f64);
    if let Some(cost) = cost {
        assert_eq!(again(team, &mut joint), cost);
    }
    let (steps, nodes) = (solved.steps, solved.nodes);
    let told = cost.unwrap_or(0);
    let line = format!("{said:<10} {told:>10} {gap:>7.3} {time:>10.3} {steps:>9} {nodes:>6}");
    Proven { line, said, cost, seconds: time / 1e3 }
}

/// The median time of a few runs, each of so many.
fn median(batch: u32, mut act: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..7)
        .map(|_| {
            let start = seconds();
            (0..batch).for_each(|_| act());
            (seconds() - start) * 1e6 / f64::from(batch)
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[3]
}

/// One task with a plan for each number of robots, all capable, of which the mean counts.
fn one_task(n: usize) {
    let mut draw = Draw::new(n as u64);
    let parts = 27_720; // 1 to 12 divide it
    let mut plan = |roles: usize| OwnedPlan {
        extra: 0,
        costs: (0..roles * n).map(|_| Cost::new(draw.between(1, 100) as u32)).collect(),
    };
    let plans = (1..=n).map(&mut plan).collect();
    let tasks = vec![OwnedTask { skip: None, combine: Combine::Mean, plans }];
    OwnedTeam { robots: n, denominator: parts, tasks }.with(|team| {
        let task = &team.tasks()[0];
        let mut fixed = Fixed::<i32, 12, 12>::new();
        let mut memory = fixed.memory();
        let mut ours = None;
        let fast = median(2_000, || ours = coalition(black_box(task), parts, &mut memory).ok());
        let mut theirs = None;
        let mut entries = [None; 144];
        let slow = median(1, || {
            theirs = all_coalitions(black_box(task), parts, &mut entries, &mut memory).best;
        });
        assert_eq!(ours.map(|it| it.cost), theirs.map(|it| it.0));
        let orderings = if n <= 9 {
            let mut best = None;
            let time = median(1, || best = all_orderings(task, parts, &mut [0; 12]).best);
            assert_eq!(best.map(|it| it.0), theirs.map(|it| it.0));
            format!("{time:19.1}")
        } else {
            String::new()
        };
        println!("{n:2} {fast:13.2} {slow:20.1} {:7.0} {orderings}", slow / fast);
    });
}
