//! Teams: time to a proof for growing random teams, all tasks at once; and one task with a plan for
//! each number of robots, beside what the thesis does.
//!
//! `joint [SEEDS]`: one setting for all. Teams are crowded: about as many roles as robots.
#![allow(clippy::cast_precision_loss)] // a gap in percent needs no more than a double's digits

#[path = "../../../../../core/tests/common/draw.rs"]
mod draw;
#[allow(dead_code)]
#[path = "../../../../../core/tests/team/teams.rs"]
mod teams;

use cotama_core::team::joint::Outcome;
use cotama_core::team::thesis::{all_coalitions, all_orderings};
use cotama_core::team::{Combine, Cost, Fixed, Team, coalition};
use draw::Draw;
use rustix::time::{ClockId, clock_gettime};
use std::hint::black_box;
use teams::{Kind, OwnedPlan, OwnedTask, OwnedTeam, Room, again, team};

/// The processor's time so far.
fn seconds() -> f64 {
    let now = clock_gettime(ClockId::ThreadCPUTime);
    now.tv_sec as f64 + now.tv_nsec as f64 * 1e-9
}

fn main() {
    let seeds: u64 = std::env::args().nth(1).and_then(|it| it.parse().ok()).unwrap_or(3);
    println!("n   one task, µs   all coalitions, µs   ratio   all orderings, µs");
    (4..=12).for_each(one_task);
    println!(
        "\nrobots, tasks   kind  seed  outcome          cost   gap %         ms     steps  nodes"
    );
    let sizes = [6, 8, 10, 12, 20, 30, 40, 40, 48, 60, 80, 100];
    let tasks = [4, 5, 7, 8, 11, 16, 18, 22, 22, 30, 40, 50];
    for (robots, tasks) in sizes.into_iter().zip(tasks) {
        for (name, largest, must) in [("mixed", false, 50), ("must", false, 100), ("max", true, 50)]
        {
            for seed in 0..seeds {
                let kind = Kind {
                    robots,
                    tasks,
                    roles: 3,
                    plans: 3,
                    most: 100,
                    missing: 40,
                    must,
                    skip: 120,
                    largest,
                };
                let owned = team(&mut Draw::new(seed * 1000 + robots as u64), kind);
                let line = owned.with(prove);
                println!("{robots:6}, {tasks:5} {name:>6} {seed:5}  {line}");
            }
        }
    }
}

/// Proves the best answer; a line of what came out.
fn prove(team: &Team<'_>) -> String {
    let mut room = Room::<128>::new(team, 400_000);
    let mut joint = room.joint();
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
    let (cost, steps, nodes) = (cost.unwrap_or(0), solved.steps, solved.nodes);
    format!("{said:<10} {cost:>10} {gap:>7.3} {time:>10.3} {steps:>9} {nodes:>6}")
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
