//! The paper's allocator against a transcription of its rules, and against the exact one.

use crate::instances::{Instance, Zones, paper_like, small};
use crate::solve::{exact, panorama};
use cotama_core::allocation::{Allocator, Answer};
use cotama_core::panorama::Panorama;
use cotama_core::problem::{Candidate, Problem};

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

/// A step is a candidate looked at: for the highest on every axis at once, to lower an activity,
/// and to choose, up to the one that is chosen.
#[test]
fn the_steps_of_the_rule_are_the_candidates_it_looks_at() {
    let ways = [9, 5, 2].map(|it| Candidate { cost: [it], quality: 0, id: 0 });
    let activities = [&ways[..]; 2];
    // Within 18 nothing is lowered; the last activity alone within 11, whether that is met just so
    // or not; both below.
    let all = 6;
    for (limit, steps) in
        [(18, all + 1 + 1), (12, all + 3 + 1 + 3), (11, all + 3 + 1 + 3), (10, all + 3 + 3 + 2 + 3)]
    {
        let problem = Problem::new(&activities, [limit], [0]).unwrap();
        let answer = Panorama::new(&mut [[0]; 2]).allocate(&problem, &mut [0; 2]).unwrap();
        let Answer::Planned(planned) = answer else { panic!("{answer:?}") };
        assert_eq!(planned.steps, steps, "within {limit}");
    }
}

/// On a later axis only what an earlier one has lowered is looked at again.
#[test]
fn an_axis_looks_again_only_at_activities_that_were_lowered() {
    let ways = [[9, 1], [5, 7], [2, 4]].map(|cost| Candidate { cost, quality: 0, id: 0 });
    let activities = [&ways[..]; 2];
    // Duration lowers the last activity to 5, where the highest energy is still 7; at 2 it is 4.
    for (duration, steps, plan) in
        [(18, 6 + 2 + 2, [1, 1]), (14, 6 + 3 + 3 + 2 + 2, [1, 1]), (12, 6 + 3 + 3 + 2 + 3, [1, 2])]
    {
        let problem = Problem::new(&activities, [duration, 99], [0, 1]).unwrap();
        let mut chosen = [0; 2];
        let answer = Panorama::new(&mut [[0; 2]; 2]).allocate(&problem, &mut chosen).unwrap();
        let Answer::Planned(planned) = answer else { panic!("{answer:?}") };
        assert_eq!((planned.steps, chosen), (steps, plan), "within {duration}");
    }
}
