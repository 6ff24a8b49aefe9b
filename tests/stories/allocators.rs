//! The allocators against plain transcriptions of what they promise.

use cotama_core::allocation::{Allocator, Answer};
use cotama_core::exact::{Exact, Item, Objective, Seen, Stage};
use cotama_core::front::{Front, Node};
use cotama_core::panorama::Panorama;
use cotama_core::problem::{Candidate, Problem};
use cotama_tests::instances::{Draw, Instance, Zones, paper_like, random_mission, small};

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
    let (mut items, mut stages) =
        (vec![Item::EMPTY; count], vec![Stage::EMPTY; problem.activities().len()]);
    let mut plan = vec![0; problem.activities().len()];
    let answer = Exact::new(objectives, steps, &mut items, &mut stages)
        .allocate(problem, &mut plan)
        .unwrap();
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
    let feasible: Vec<_> = every_plan(&instance)
        .into_iter()
        .filter(|(_, cost, _)| problem.within_limits(cost))
        .collect();
    for objectives in orders {
        let best =
            feasible.iter().map(|(_, cost, quality)| worth(objectives, cost, *quality)).max();
        let (answer, plan) = exact(&problem, objectives, u64::MAX);
        let story = || {
            format!("seed {seed}, {A} axes, {objectives:?}: {instance:?} gives {answer:?} {plan:?}")
        };
        match (answer, &best) {
            (Answer::Planned(planned), Some(best)) => {
                assert_eq!(
                    problem.totals(&plan),
                    Some((planned.cost, planned.quality)),
                    "{}",
                    story()
                );
                assert!(problem.within_limits(&planned.cost) && planned.optimal, "{}", story());
                assert_eq!(&worth(objectives, &planned.cost, planned.quality), best, "{}", story());
            }
            (Answer::Infeasible { axis, least, .. }, None) => {
                let reachable = every_plan(&instance)
                    .iter()
                    .filter(|(_, cost, _)| {
                        (0..axis).all(|before| cost[before] <= instance.limits[before])
                    })
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

/// However the candidates of each activity are written, the plan has the same candidates, by their
/// numbers.
#[test]
fn the_order_of_candidates_does_not_change_the_plan() {
    for seed in 0..5_000 {
        let instance = small::<2>(seed);
        let mut draw = Draw::new(seed);
        let mut shuffled = instance.clone();
        for candidates in &mut shuffled.activities {
            for last in (1..candidates.len()).rev() {
                candidates.swap(last, draw.between(0, last as u64) as usize);
            }
        }
        let chosen = |instance: &Instance<2>| {
            let slices = instance.slices();
            let (answer, plan) =
                exact(&instance.problem(&slices), &[Objective::MostQuality], u64::MAX);
            let numbers = |(c, &choice): (&Vec<Candidate<2>>, &u16)| {
                let candidate = c[usize::from(choice)];
                (candidate.cost, candidate.quality)
            };
            (answer, instance.activities.iter().zip(&plan).map(numbers).collect::<Vec<_>>())
        };
        let (answer, plan) = chosen(&instance);
        if matches!(answer, Answer::Planned(_)) {
            assert_eq!((answer, plan), chosen(&shuffled), "seed {seed}");
        }
    }
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
                assert!(
                    !planned.optimal || Some(planned.quality) == optimum,
                    "seed {seed}, {steps} steps"
                );
                if planned.optimal {
                    break;
                }
            }
            Answer::Unknown { bound, .. } => {
                assert!(Some(bound) >= optimum, "seed {seed}, {steps} steps")
            }
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
            left.iter()
                .zip(chosen)
                .map(|(candidates, &at)| u64::from(candidates[at].1.cost[axis]))
                .sum()
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
        candidates
            .iter()
            .filter(|(_, c)| c.cost[last] == best)
            .map(|(index, _)| *index as u16)
            .min()
    };
    left.iter().map(pick).collect()
}

pub(crate) fn panorama<const A: usize>(problem: &Problem<A>) -> Option<Vec<u16>> {
    let activities = problem.activities().len();
    let (mut caps, mut plan) = (vec![[0; A]; activities], vec![0; activities]);
    match Panorama::new(&mut caps).allocate(problem, &mut plan).unwrap() {
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

/// A problem over two axes written as (duration, energy) pairs.
fn pairs(activities: &[&[[u32; 2]]], limits: [u64; 2]) -> Instance<2> {
    let candidate = |(id, &cost): (usize, &[u32; 2])| Candidate { cost, quality: 0, id: id as u16 };
    Instance {
        activities: activities
            .iter()
            .map(|c| c.iter().enumerate().map(candidate).collect())
            .collect(),
        limits,
    }
}

/// Whether the rule of the paper finds a plan with the axes in this order.
fn rule_finds(instance: &Instance<2>, order: [usize; 2]) -> bool {
    let slices = instance.slices();
    panorama(&Problem::new(&slices, instance.limits, order).unwrap()).is_some()
}

fn exact_finds(instance: &Instance<2>) -> bool {
    let slices = instance.slices();
    matches!(exact(&instance.problem(&slices), &[], u64::MAX).0, Answer::Planned(_))
}

#[test]
fn the_rule_misses_plans_that_the_exact_allocator_finds() {
    let one_order = pairs(&[&[[5, 1], [1, 2]], &[[5, 1], [1, 10]]], [6, 3]);
    assert_eq!((rule_finds(&one_order, [0, 1]), rule_finds(&one_order, [1, 0])), (false, true));
    assert!(exact_finds(&one_order));

    let both_orders = pairs(&[&[[1, 3], [2, 5]], &[[1, 5], [4, 1], [3, 2]]], [4, 5]);
    assert_eq!(
        (rule_finds(&both_orders, [0, 1]), rule_finds(&both_orders, [1, 0])),
        (false, false)
    );
    assert!(exact_finds(&both_orders));
}

#[test]
fn random_problems_have_more_plans_that_the_rule_misses_and_none_the_other_way() {
    let (mut missed, mut missed_in_both_orders) = (0, 0);
    for seed in 0..20_000 {
        let instance = small::<2>(seed);
        let found = [rule_finds(&instance, [0, 1]), rule_finds(&instance, [1, 0])];
        if exact_finds(&instance) {
            missed += u32::from(!found[0]);
            missed_in_both_orders += u32::from(found == [false, false]);
        } else {
            assert_eq!(found, [false, false], "seed {seed}: a plan that is none");
        }
    }
    assert_eq!((missed, missed_in_both_orders), (1497, 344));
}

/// The documented promise to firmware: 17 activities within 100,000 steps and this memory. Most
/// missions are proven with far fewer; the others end with a plan and a bound.
#[test]
fn a_plan_of_17_activities_keeps_its_promised_steps_and_bytes() {
    let (mut proven, mut worst_gap, mut steps) = (0, 0, Vec::new());
    for seed in 0..10_000 {
        let instance = random_mission(seed);
        let slices = instance.slices();
        let problem = instance.problem(&slices);
        let (mut items, mut stages) = (vec![Item::EMPTY; 17 * 21], vec![Stage::EMPTY; 17]);
        let mut seen = vec![Seen::EMPTY; 4096];
        let mut plan = [0; 17];
        let mut exact = Exact::new(&[Objective::MostQuality], 100_000, &mut items, &mut stages)
            .with_memory(&mut seen);
        let Ok(Answer::Planned(planned)) = exact.allocate(&problem, &mut plan) else {
            panic!("seed {seed}")
        };
        let bound = planned.bound.expect("the exact allocator proves one");
        proven += u32::from(planned.optimal);
        worst_gap = worst_gap.max((bound - planned.quality) * 1000 / bound);
        assert!(planned.steps <= 100_000);
        steps.push(planned.steps);
    }
    steps.sort_unstable();
    // Of 10,000: proven best, the worst gap in permille, the median and the 90th percentile of the
    // steps.
    assert_eq!((proven, worst_gap, steps[5_000], steps[9_000]), (9842, 26, 761, 9727));
    assert_eq!((size_of::<Item<2>>(), size_of::<Stage<2>>(), size_of::<Seen<2>>()), (32, 256, 40));
}

/// Nodes that are remembered save steps and never an answer: whatever the memory, what is proven
/// best is the same.
#[test]
fn memory_for_nodes_does_not_change_what_is_proven() {
    let mut compared = 0;
    for seed in 0..600 {
        let instance = random_mission(seed);
        let slices = instance.slices();
        let problem = instance.problem(&slices);
        let proven = |memory: usize| {
            let (mut items, mut stages) = (vec![Item::EMPTY; 17 * 21], vec![Stage::EMPTY; 17]);
            let (mut seen, mut plan) = (vec![Seen::EMPTY; memory], [0; 17]);
            let mut exact = Exact::new(&[Objective::MostQuality], 300_000, &mut items, &mut stages)
                .with_memory(&mut seen);
            match exact.allocate(&problem, &mut plan) {
                Ok(Answer::Planned(planned)) if planned.optimal => {
                    Some((planned.quality, planned.steps))
                }
                _ => None,
            }
        };
        if let (Some((without, steps)), Some((little, _)), Some((much, _))) =
            (proven(0), proven(37), proven(5_000))
        {
            assert_eq!((without, without), (little, much), "seed {seed}");
            compared += u32::from(steps > 5_000);
        }
    }
    assert_eq!(compared, 97, "missions hard enough that nodes are remembered");
}

/// The paper's rule looks at each candidate a fixed number of times: its steps have a proven bound.
#[test]
fn the_rule_takes_at_most_five_looks_at_each_candidate() {
    for seed in 0..10_000 {
        let instance = paper_like(17, Zones::Three, [seed % 1000, 999 - seed % 1000], seed);
        let slices = instance.slices();
        let problem = instance.problem(&slices);
        let (mut caps, mut plan) = ([[0; 2]; 17], [0; 17]);
        let steps = match Panorama::new(&mut caps).allocate(&problem, &mut plan) {
            Ok(Answer::Planned(planned)) => planned.steps,
            Ok(Answer::Infeasible { steps, .. }) => steps,
            other => panic!("seed {seed}: {other:?}"),
        };
        assert!(steps <= 5 * slices.iter().map(|c| c.len() as u64).sum::<u64>(), "seed {seed}");
    }
}
