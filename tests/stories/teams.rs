//! The twelve teams of `models/teams`: each answer is the proven one, and adds up.

use cotama_core::team::joint::Outcome;
use cotama_core::team::{Combine, Cost, Fixed, Team, bottleneck, coalition, conflict};
use serde_json::Value;

use crate::team_tables::{OwnedPlan, OwnedTask, OwnedTeam, Room, again};

/// The number at a field; 0 where it is absent.
fn number(of: &Value, field: &str) -> u32 {
    of[field].as_u64().unwrap_or(0) as u32
}

/// The costs of a role, one a robot.
fn costs(of: &Value) -> Vec<Option<Cost>> {
    let all = of.as_array().expect("a list").iter();
    all.map(|it| it.as_u64().and_then(|it| Cost::new(it as u32))).collect()
}

fn task(of: &Value) -> OwnedTask {
    let plan = |of: &Value| {
        let roles = of["roles"].as_array().expect("roles").iter();
        OwnedPlan {
            extra: number(of, "extra_cost"),
            costs: roles.flat_map(|it| costs(&it["cost"])).collect(),
        }
    };
    let plans = match of["plans"].as_array() {
        Some(plans) => plans.iter().map(plan).collect(),
        None => vec![OwnedPlan { extra: 0, costs: costs(&of["cost"]) }],
    };
    let combine = match of["combine"].as_str() {
        Some("mean") => Combine::Mean,
        Some("max") => Combine::Max,
        _ => Combine::Sum,
    };
    let skip = of["skip_cost"].as_u64().and_then(|it| Cost::new(it as u32));
    OwnedTask { skip, combine, plans }
}

/// Runs something on the team of an instance.
fn with<R>(name: &str, act: impl FnOnce(&Team<'_>, &Value) -> R) -> R {
    let path = format!("{}/../models/teams/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).expect("the instance is there");
    let instance: Value = serde_json::from_str(&text).expect("it is JSON");
    let tasks = instance["tasks"].as_array().expect("tasks").iter().map(task).collect();
    let robots = instance["robots"].as_array().expect("robots").len();
    let owned = OwnedTeam { robots, denominator: number(&instance, "cost_denominator"), tasks };
    owned.with(|team| act(team, &instance))
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
        with(name, |team, instance| {
            let mut room = Room::<12>::new(team, 2_000);
            let mut joint = room.joint();
            let outcome = joint.solve(team, 1_000_000).expect("there is memory").outcome;
            let expected = &instance["expected"];
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
        with(name, |team, instance| {
            let mut fixed = Fixed::<i32, 8, 8>::new();
            let best = coalition(&team.tasks()[0], team.denominator(), &mut fixed.memory());
            let cost = instance["expected"]["cost"].as_u64();
            assert_eq!(best.ok().map(|it| it.cost), cost, "{name}");
        });
    }
}

#[test]
fn who_is_in_conflict_is_named() {
    // Three tasks share two capable robots.
    with(ALL[3], |team, _| {
        let mut room = Room::<12>::new(team, 2_000);
        let mut joint = room.joint();
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
