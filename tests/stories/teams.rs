//! The twelve teams of `models/teams`: each answer is the proven one, and adds up.

use cotama_core::team::winners::{Outcome, Workspace};
use cotama_core::team::{Fixed, Team, bottleneck, coalition, conflict};
use cotama_models::team::instance::Instance;
use serde_json::Value;

use crate::team_tables::again;

/// Runs something on the team of an instance, and on what its file expects.
fn with<R>(name: &str, act: impl FnOnce(&Team<'_>, &Value) -> R) -> R {
    let path = format!("{}/../models/teams/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).expect("the instance is there");
    let expected: Value = serde_json::from_str(&text).expect("it is JSON");
    let instance = Instance::parse(name, &text).expect("it is an instance");
    instance.with_team(|team| act(team, &expected["expected"])).expect("it is not too large")
}

const ALL: [&str; 12] = [
    "01-single-three-by-three",
    "02-single-more-robots-than-tasks",
    "03-single-more-tasks-than-robots",
    "04-single-infeasible",
    "05-coalition-mean-serve-handle-hidden",
    "06-coalition-mean-serve-handle-free",
    "07-coalition-mean-eight-robots-all-sizes",
    "08-coalition-max-carry-table",
    "09-coalition-max-capable-but-impossible",
    "10-simultaneous-greedy-trap",
    "11-simultaneous-indispensable-robot",
    "12-simultaneous-mixed",
];

#[test]
fn each_team_has_the_proven_answer() {
    for name in ALL {
        with(name, |team, expected| {
            let mut workspace = Workspace::<12>::new();
            let mut joint = workspace.winners(team, 2_000);
            let outcome = joint.solve(team, 1_000_000).expect("there is memory").outcome;
            if expected["status"] == "infeasible" {
                assert!(matches!(outcome, Outcome::Infeasible { .. }), "{name}: {outcome:?}");
            } else {
                let cost = expected["cost"].as_u64().expect("a cost");
                assert_eq!(outcome, Outcome::Optimal { cost }, "{name}");
                assert_eq!(again(team, &mut joint), cost, "{name}");
            }
        });
    }
}

#[test]
fn one_task_alone_has_it_too() {
    for name in &ALL[4..9] {
        with(name, |team, expected| {
            let mut fixed = Fixed::<i32, 8, 8>::new();
            let best = coalition(&team.tasks()[0], team.denominator(), &mut fixed.memory());
            let cost = expected["cost"].as_u64();
            assert_eq!(best.ok().map(|it| it.cost), cost, "{name}");
        });
    }
}

#[test]
fn tasks_and_robots_in_conflict_are_named() {
    // Three tasks share two capable robots.
    with(ALL[3], |team, _| {
        let mut workspace = Workspace::<12>::new();
        let mut joint = workspace.winners(team, 2_000);
        let outcome = joint.solve(team, 1_000_000).expect("there is memory").outcome;
        let Outcome::Infeasible { robots } = outcome else { panic!("{outcome:?}") };
        let tasks = (0..team.tasks().len()).filter(|it| joint.in_conflict(*it));
        assert_eq!((tasks.count(), robots.count_ones()), (3, 2));
    });
    // Each role has a robot, all capabilities are there, and still no matching.
    with(ALL[8], |team, _| {
        let mut fixed = Fixed::<i32, 8, 8>::new();
        let mut memory = fixed.memory();
        let roles = team.tasks()[0].plans[0].roles;
        assert!(bottleneck(&roles, &mut memory).is_err());
        let (rows, columns) = conflict(&roles, |row| memory.in_conflict(row));
        assert!(rows > columns);
    });
}
