//! All tasks of a team at once: time, steps and nodes to a proof, for growing random teams.
//!
//! `joint [SEEDS]`; one setting for all. Teams are crowded: about as many roles as robots.

#[path = "../../../../../core/tests/common/draw.rs"]
mod draw;
#[allow(dead_code)]
#[path = "../../../../../core/tests/team/teams.rs"]
mod teams;

use draw::Draw;
use rustix::time::{ClockId, clock_gettime};
use teams::{Kind, Room, again, team};

fn seconds() -> f64 {
    let now = clock_gettime(ClockId::ThreadCPUTime);
    now.tv_sec as f64 + now.tv_nsec as f64 * 1e-9
}

fn main() {
    let seeds: u64 = std::env::args().nth(1).and_then(|it| it.parse().ok()).unwrap_or(3);
    println!(
        "robots, tasks      kind  seed  outcome           cost    gap %       ms   steps  nodes"
    );
    let sizes = [
        (6, 4),
        (8, 5),
        (10, 7),
        (12, 8),
        (20, 11),
        (30, 16),
        (40, 18),
        (40, 22),
        (48, 22),
        (60, 30),
        (80, 40),
        (100, 50),
    ];
    for (robots, tasks) in sizes {
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
                owned.with(|team| {
                    let mut room = Room::<128>::new(team, 400_000);
                    let mut joint = room.joint();
                    let start = seconds();
                    let solved = joint.solve(team, 20_000_000).expect("memory");
                    let time = seconds() - start;
                    use cotama_core::team::joint::Outcome;
                    let (said, cost, gap) = match solved.outcome {
                        Outcome::Optimal { cost } => ("optimal", cost, 0.0),
                        Outcome::Infeasible { .. } => ("infeasible", 0, 0.0),
                        Outcome::Unknown { cost: Some(cost), bound } => ("unknown", cost, (cost - bound) as f64 * 100.0 / cost as f64),
                        Outcome::Unknown { .. } => ("nothing", 0, 100.0),
                    };
                    if said != "infeasible" && cost > 0 { assert_eq!(again(team, &mut joint), cost); }
                    println!("{robots:4}, {tasks:4} {name:>12} {seed:4}   {said:<10} {cost:>10} {gap:>8.3} {:>9.3} {:>8} {:>6}", time * 1e3, solved.steps, solved.nodes);
                });
            }
        }
    }
}
