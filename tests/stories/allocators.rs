//! The allocators against plain transcriptions of what they promise.

use cotama_core::allocation::{Allocator, Answer};
use cotama_core::exact::{Exact, Item, Objective, Stage};
use cotama_core::front::{Front, Node};
use cotama_core::panorama::Panorama;
use cotama_core::problem::{Candidate, Problem};
use cotama_tests::instances::{Instance, small};

/// Every plan's choices, costs and quality.
fn every_plan<const A: usize>(instance: &Instance<A>) -> Vec<(Vec<u16>, [u64; A], u64)> {
    let mut plans = vec![(Vec::new(), [0u64; A], 0u64)];
    for candidates in &instance.activities {
        plans = plans
            .iter()
            .flat_map(|(choices, cost, quality)| {
                candidates.iter().enumerate().map(move |(choice, c)| {
                    let mut choices = choices.clone();
                    choices.push(choice as u16);
                    let cost = core::array::from_fn(|axis| cost[axis] + u64::from(c.cost[axis]));
                    (choices, cost, quality + u64::from(c.quality))
                })
            })
            .collect();
    }
    plans
}

pub(crate) fn exact<const A: usize>(
    problem: &Problem<A>,
    objectives: &[Objective],
    steps: u64,
) -> (Answer<A>, Vec<u16>) {
    let count = problem.activities().iter().map(|c| c.len()).sum();
    let (mut items, mut stages) = (vec![Item::EMPTY; count], vec![Stage::EMPTY; problem.activities().len()]);
    let mut plan = vec![0; problem.activities().len()];
    let answer = Exact::new(objectives, steps, &mut items, &mut stages).allocate(problem, &mut plan).unwrap();
    (answer, plan)
}

/// Larger is better: the amount of each objective in a plan.
fn worth<const A: usize>(objectives: &[Objective], cost: &[u64; A], quality: u64) -> Vec<i128> {
    let one = |objective: &Objective| match *objective {
        Objective::MostQuality => i128::from(quality),
        Objective::Least(axis) => -i128::from(cost[axis]),
        Objective::Most(axis) => i128::from(cost[axis]),
    };
    objectives.iter().map(one).collect()
}

fn exact_is_brute_force<const A: usize>(seed: u64) {
    let instance = small::<A>(seed);
    let slices = instance.slices();
    let problem = instance.problem(&slices);
    let orders: [&[Objective]; 6] = [
        &[Objective::MostQuality],
        &[Objective::Least(0)],
        &[Objective::Most(A - 1)],
        &[Objective::MostQuality, Objective::Least(A - 1), Objective::Least(0)],
        &[Objective::Least(1), Objective::MostQuality],
        &[],
    ];
    let feasible: Vec<_> =
        every_plan(&instance).into_iter().filter(|(_, cost, _)| problem.within_limits(cost)).collect();
    for objectives in orders {
        let best = feasible.iter().map(|(_, cost, quality)| worth(objectives, cost, *quality)).max();
        let (answer, plan) = exact(&problem, objectives, u64::MAX);
        let story =
            || format!("seed {seed}, {A} axes, {objectives:?}: {instance:?} gives {answer:?} {plan:?}");
        match (answer, &best) {
            (Answer::Planned(planned), Some(best)) => {
                assert_eq!(problem.totals(&plan), Some((planned.cost, planned.quality)), "{}", story());
                assert!(problem.within_limits(&planned.cost) && planned.optimal, "{}", story());
                assert_eq!(&worth(objectives, &planned.cost, planned.quality), best, "{}", story());
            }
            (Answer::Infeasible { axis, least, .. }, None) => {
                let reachable = every_plan(&instance)
                    .iter()
                    .filter(|(_, cost, _)| (0..axis).all(|before| cost[before] <= instance.limits[before]))
                    .map(|(_, cost, _)| cost[axis])
                    .min();
                assert_eq!(reachable, Some(least), "{}", story());
                assert!(least > instance.limits[axis], "{}", story());
            }
            _ => panic!("{}", story()),
        }
    }
    anytime_bounds_hold(&problem, feasible.iter().map(|(_, _, quality)| *quality).max(), seed);
}

/// At every step budget, from one to all, the bound is at least the optimum and the plan is a plan.
fn anytime_bounds_hold<const A: usize>(problem: &Problem<A>, optimum: Option<u64>, seed: u64) {
    let (Answer::Planned(_) | Answer::Infeasible { .. }, _) =
        exact(problem, &[Objective::MostQuality], u64::MAX)
    else {
        panic!("seed {seed}")
    };
    for steps in 1.. {
        let (answer, _) = exact(problem, &[Objective::MostQuality], steps);
        match answer {
            Answer::Planned(planned) => {
                assert!(
                    planned.bound >= optimum && Some(planned.quality) <= optimum,
                    "seed {seed}, {steps} steps"
                );
                assert!(problem.within_limits(&planned.cost));
                assert_eq!(
                    planned.optimal,
                    planned.bound == Some(planned.quality),
                    "seed {seed}, {steps} steps"
                );
                assert!(!planned.optimal || Some(planned.quality) == optimum, "seed {seed}, {steps} steps");
                if planned.optimal {
                    break;
                }
            }
            Answer::Unknown { bound, .. } => assert!(Some(bound) >= optimum, "seed {seed}, {steps} steps"),
            Answer::Infeasible { .. } => {
                assert_eq!(optimum, None, "seed {seed}");
                break;
            }
        }
        assert!(steps < 100_000, "seed {seed} does not end");
    }
}

#[test]
fn exact_is_brute_force_on_20_000_small_problems() {
    for seed in 0..20_000 {
        match seed % 3 {
            0 => exact_is_brute_force::<2>(seed),
            1 => exact_is_brute_force::<3>(seed),
            _ => exact_is_brute_force::<4>(seed),
        }
    }
}

#[test]
fn the_front_is_every_undominated_plan_of_5_000_small_problems() {
    for seed in 0..5_000 {
        let instance = small::<2>(seed);
        let slices = instance.slices();
        let problem = instance.problem(&slices);
        let mut feasible: Vec<([u64; 2], u64)> = every_plan(&instance)
            .into_iter()
            .map(|(_, cost, quality)| (cost, quality))
            .filter(|(cost, _)| problem.within_limits(cost))
            .collect();
        feasible.sort_unstable();
        feasible.dedup();
        let beats = |a: &([u64; 2], u64), b: &([u64; 2], u64)| {
            a != b && a.0[0] <= b.0[0] && a.0[1] <= b.0[1] && a.1 >= b.1
        };
        let expected: Vec<_> = feasible
            .iter()
            .copied()
            .filter(|plan| !feasible.iter().any(|other| beats(other, plan)))
            .collect();
        let mut nodes = vec![Node::EMPTY; 20_000];
        let mut front = Front::new(&mut nodes);
        let plans = front.find(&problem).unwrap();
        let mut found: Vec<_> = (0..plans.len()).filter_map(|index| plans.totals(index)).collect();
        let mut plan = vec![0; slices.len()];
        for (index, totals) in found.iter().enumerate() {
            assert!(plans.plan(index, &mut plan));
            assert_eq!(problem.totals(&plan).as_ref(), Some(totals), "seed {seed}");
        }
        found.sort_unstable();
        assert_eq!(found, expected, "seed {seed}");
    }
}

/// The rules of the paper, written down once more without any care for speed.
fn rules_of_the_paper<const A: usize>(problem: &Problem<A>) -> Option<Vec<u16>> {
    let mut left: Vec<Vec<(usize, &Candidate<A>)>> =
        problem.activities().iter().map(|c| c.iter().enumerate().collect()).collect();
    for axis in problem.order() {
        for candidates in &mut left {
            candidates.sort_by_key(|(_, c)| c.cost[axis]);
        }
        let mut chosen: Vec<usize> = left.iter().map(|candidates| candidates.len() - 1).collect();
        let sum = |chosen: &[usize]| -> u64 {
            left.iter().zip(chosen).map(|(candidates, &at)| u64::from(candidates[at].1.cost[axis])).sum()
        };
        for activity in (0..left.len()).rev() {
            while sum(&chosen) > problem.limits()[axis] && chosen[activity] > 0 {
                chosen[activity] -= 1;
            }
        }
        if sum(&chosen) > problem.limits()[axis] {
            return None;
        }
        for (candidates, at) in left.iter_mut().zip(chosen) {
            let cap = candidates[at].1.cost[axis];
            candidates.retain(|(_, c)| c.cost[axis] <= cap);
        }
    }
    let last = *problem.order().last()?;
    let pick = |candidates: &Vec<(usize, &Candidate<A>)>| {
        let best = candidates.iter().map(|(_, c)| c.cost[last]).max()?;
        candidates.iter().filter(|(_, c)| c.cost[last] == best).map(|(index, _)| *index as u16).min()
    };
    left.iter().map(pick).collect()
}

pub(crate) fn panorama<const A: usize>(problem: &Problem<A>) -> Option<Vec<u16>> {
    let widest = problem.activities().iter().map(|c| c.len()).max().unwrap_or(0);
    let (mut caps, mut sorted) = (vec![[0; A]; problem.activities().len()], vec![0; widest]);
    let mut plan = vec![0; problem.activities().len()];
    match Panorama::new(&mut caps, &mut sorted).allocate(problem, &mut plan).unwrap() {
        Answer::Planned(planned) => {
            assert_eq!(problem.totals(&plan), Some((planned.cost, planned.quality)));
            assert!(problem.within_limits(&planned.cost));
            Some(plan)
        }
        _ => None,
    }
}

#[test]
fn panorama_is_its_rules_on_20_000_small_problems() {
    for seed in 0..20_000 {
        let instance = small::<3>(seed);
        let slices = instance.slices();
        let problem = instance.problem(&slices);
        assert_eq!(panorama(&problem), rules_of_the_paper(&problem), "seed {seed}");
    }
}
