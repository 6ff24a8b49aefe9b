//! Answers of random instances: added again, and against another way to find them.

use crate::broken::files;
use cotama_models::team::instance::{Assignment, Instance, PlanProof, Proof, Verdict};
use proptest::prelude::*;
use std::fmt::Write;

/// An instance of one kind, as a file would say it.
fn text(kind: &str, parts: u32, robots: usize, tasks: &str) -> String {
    let names: Vec<_> = (0..robots).map(|it| format!("\"r{it}\"")).collect();
    format!(
        "{{\"format\": \"cotama-team-assignment/1\", \"name\": \"drawn\", \"kind\": \"{kind}\", \
         \"cost_denominator\": {parts}, \"robots\": [{}], \"tasks\": [{tasks}]}}",
        names.join(", ")
    )
}

fn list(costs: &[Option<u32>]) -> String {
    let costs: Vec<_> =
        costs.iter().map(|it| it.map_or("null".to_owned(), |it| it.to_string())).collect();
    format!("[{}]", costs.join(", "))
}

fn cost() -> impl Strategy<Value = Option<u32>> {
    prop::option::weighted(0.7, prop_oneof![0..20_u32, 0..=1_000_000_000_u32])
}

/// Adds an answer again from the instance alone; the certificate is checked too.
fn added(instance: &Instance, answer: &Assignment) -> Option<u64> {
    let parts = u64::from(instance.denominator);
    let mut taken = vec![false; instance.robots.len()];
    let (mut sum, mut number) = (0_u64, 0);
    for (task, it) in instance.tasks.iter().enumerate() {
        let Some(done) = answer.done.get(number).filter(|done| done.task == task) else {
            sum += parts * u64::from(it.skip?.get());
            continue;
        };
        number += 1;
        let plan = &it.plans[done.plan];
        assert_eq!(done.robots.len(), plan.roles.len());
        let mut costs = vec![];
        for (role, robot) in done.robots.iter().enumerate() {
            assert!(!std::mem::replace(&mut taken[*robot], true), "a robot twice");
            costs.push(u64::from(plan.table().unwrap().cost(role, *robot)?.get()));
        }
        let joint = match it.combine {
            cotama_core::team::Combine::Sum => costs.iter().sum::<u64>() * parts,
            cotama_core::team::Combine::Mean => {
                costs.iter().sum::<u64>() * (parts / costs.len() as u64)
            }
            cotama_core::team::Combine::Max => *costs.iter().max()? * parts,
        };
        sum += joint + parts * u64::from(plan.extra);
    }
    assert_eq!(number, answer.done.len());
    Some(sum)
}

/// Returns the sum of the least costs of the tasks at these prices, less the prices: no assignment
/// costs less.
fn at_prices(instance: &Instance, prices: &[u64]) -> u64 {
    let pays = |it: &cotama_models::team::instance::InstanceTask| {
        let costs = it.plans[0].costs.iter().zip(prices);
        let done = costs.filter_map(|(cost, price)| Some(u64::from((*cost)?.get()) + price));
        done.chain(it.skip.map(|it| it.get().into())).min().unwrap()
    };
    instance.tasks.iter().map(pays).sum::<u64>() - prices.iter().sum::<u64>()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// Prices prove what one assignment says, and the search says the same.
    #[test]
    fn tasks_of_one_robot_each_are_proven_by_prices(
        robots in 1..6_usize,
        table in prop::collection::vec((cost(), prop::collection::vec(cost(), 6)), 0..7),
    ) {
        let mut tasks = vec![];
        for (number, (skip, costs)) in table.iter().enumerate() {
            let skip = skip.map_or("null".into(), |it| it.to_string());
            let costs = list(&costs[..robots]);
            let name = format!("\"name\": \"t{number}\"");
            tasks.push(format!("{{{name}, \"skip_cost\": {skip}, \"cost\": {costs}}}"));
        }
        let text = text("single", 3, robots, &tasks.join(", "));
        let single = Instance::parse("", &text).unwrap();
        let answer = single.solve(1).unwrap();
        let joint = Instance::parse("", &text.replace("\"single\"", "\"simultaneous\"")).unwrap();
        let other = joint.solve(1_000_000).unwrap();
        prop_assert_eq!(answer.cost(), other.cost());
        match (&answer.verdict, &answer.proof) {
            (Verdict::Optimal { cost }, Proof::Prices(prices)) => {
                prop_assert_eq!(added(&single, &answer), Some(*cost));
                prop_assert_eq!(at_prices(&single, prices) * 3, *cost);
            }
            (Verdict::Infeasible(reason), Proof::Hall) => {
                prop_assert!(matches!(other.verdict, Verdict::Infeasible(_)));
                prop_assert!(reason.tasks.len() > reason.robots.len());
                for task in &reason.tasks {
                    let costs = single.tasks[*task].plans[0].costs.iter().enumerate();
                    let able = costs.filter(|it| it.1.is_some()).map(|it| it.0);
                    prop_assert!(able.into_iter().all(|it| reason.robots.contains(&it)));
                    prop_assert!(single.tasks[*task].skip.is_none());
                }
            }
            other => prop_assert!(false, "{other:?}"),
        }
    }

    /// Each plan of a coalition has its proof, and no plan is better.
    #[test]
    fn a_coalition_is_proven_plan_by_plan(
        robots in 1..5_usize,
        is_max: bool,
        skip in cost(),
        table in prop::collection::vec(
            (0..9_u32, prop::collection::vec(prop::collection::vec(cost(), 5), 1..5)), 1..4),
    ) {
        let mut plans = vec![];
        for (number, (extra, roles)) in table.iter().enumerate() {
            let mut all = vec![];
            for (role, costs) in roles.iter().enumerate() {
                all.push(format!("{{\"name\": \"{role}\", \"cost\": {}}}", list(&costs[..robots])));
            }
            plans.push(format!(
                "{{\"name\": \"{number}\", \"extra_cost\": {extra}, \"roles\": [{}]}}",
                all.join(", ")
            ));
        }
        let (combine, kind) =
            if is_max { ("max", "coalition-max") } else { ("mean", "coalition-mean") };
        let skip = skip.map_or("null".into(), |it| it.to_string());
        let mut task = String::new();
        write!(
            task, "{{\"name\": \"t\", \"skip_cost\": {skip}, \"combine\": \"{combine}\", \
             \"plans\": [{}]}}", plans.join(", ")
        ).unwrap();
        let text = text(kind, 12, robots, &task);
        let alone = Instance::parse("", &text).unwrap();
        let answer = alone.solve(1).unwrap();
        let joint = Instance::parse("", &text.replace(kind, "simultaneous")).unwrap();
        prop_assert_eq!(answer.cost(), joint.solve(1_000_000).unwrap().cost());
        if let Some(cost) = answer.cost() {
            prop_assert_eq!(added(&alone, &answer), Some(cost));
        }
        let Proof::Plans(proofs) = &answer.proof else { panic!("{:?}", answer.proof) };
        for (plan, proof) in alone.tasks[0].plans.iter().zip(proofs) {
            let table = plan.table().unwrap();
            let role = |it: usize, robot| table.cost(it, robot).map(|it| u64::from(it.get()));
            let able = |it: &usize, robot: &usize, below: u64| {
                role(*it, *robot).is_some_and(|it| it < below)
            };
            match proof {
                PlanProof::Prices { cost, prices } => {
                    let pays = |it| {
                        let cost = |robot| Some(role(it, robot)? + prices[robot]);
                        let costs = (0..robots).filter_map(cost);
                        costs.min().unwrap()
                    };
                    let sum = (0..plan.roles.len()).map(pays).sum::<u64>();
                    let sum = sum - prices.iter().sum::<u64>();
                    let sum = sum * (12 / plan.roles.len() as u64);
                    prop_assert_eq!(sum + 12 * u64::from(plan.extra), *cost);
                    prop_assert!(answer.cost().unwrap() <= *cost);
                }
                PlanProof::Threshold { cost, largest, roles, robots: few } => {
                    prop_assert!(roles.len() > few.len());
                    prop_assert_eq!(12 * (u64::from(*largest) + u64::from(plan.extra)), *cost);
                    for robot in (0..robots).filter(|it| !few.contains(it)) {
                        prop_assert!(!roles.iter().any(|it| able(it, &robot, (*largest).into())));
                    }
                    prop_assert!(answer.cost().unwrap() <= *cost);
                }
                PlanProof::Impossible { roles, robots: few } => {
                    prop_assert!(roles.len() > few.len());
                    for robot in (0..robots).filter(|it| !few.contains(it)) {
                        prop_assert!(!roles.iter().any(|it| able(it, &robot, u64::MAX)));
                    }
                }
            }
        }
    }
}

#[test]
fn a_budget_of_nothing_leaves_a_true_bound() {
    for (name, text) in files("teams") {
        let instance = Instance::parse(&name, &text).unwrap();
        let best = instance.solve(1_000_000).unwrap();
        for steps in [0, 10, 100, 1_000] {
            let less = instance.solve(steps).unwrap();
            if let (Some(bound), Some(best)) = (less.bound(), best.cost()) {
                assert!(bound <= best, "{name}: {bound}");
            }
            if let Some(cost) = less.cost() {
                assert_eq!(added(&instance, &less), Some(cost), "{name}");
                assert!(best.cost().is_some_and(|it| it <= cost), "{name}");
            }
        }
    }
}

#[test]
fn an_instance_that_is_too_large_has_a_bound_and_no_answer() {
    let names: Vec<_> = (0..200).map(|it| Some(it + 5)).collect();
    let task = |skip| {
        format!("{{\"name\": \"{skip}\", \"skip_cost\": {skip}, \"cost\": {}}}", list(&names))
    };
    let tasks = [task("null"), task("3"), task("900")].join(", ");
    let joint = Instance::parse("", &text("simultaneous", 2, 200, &tasks)).unwrap();
    let answer = joint.solve(1_000).unwrap();
    assert_eq!(answer.verdict, Verdict::Unknown { cost: None, bound: 2 * (5 + 3 + 5) });
    let single = Instance::parse("", &text("single", 2, 200, &tasks)).unwrap();
    assert_eq!(single.solve(1).unwrap().cost(), Some(2 * (5 + 3 + 6)));
}

#[test]
fn without_robots_tasks_are_left_undone() {
    let of = |skip| {
        let task = format!("{{\"name\": \"t\", \"skip_cost\": {skip}, \"cost\": []}}");
        Instance::parse("", &text("single", 1, 0, &task)).unwrap().solve(1).unwrap()
    };
    assert_eq!(of("7").cost(), Some(7));
    assert!(matches!(of("null").verdict, Verdict::Infeasible(_)));
}

#[test]
fn greedy_rounds_cost_as_much_as_in_the_table_of_the_thesis() {
    let greedy = |number: usize| {
        let (name, text) = &files("teams")[number];
        Instance::parse(name, text).unwrap().greedy().unwrap()
    };
    assert_eq!((greedy(9).cost, greedy(9).unserved), (2 * 18, 0)); // Table 3.3: 12 of 30
    assert_eq!(greedy(10).unserved, 1);
}
