//! Answers about random nets, against a plain search of their markings.

use super::nets::{any_net, enabled, explore, replay};
use cotama_checker::structural::certificate::unreachable;
use cotama_checker::structural::{Answer, Effort, Limits, Structure};
use cotama_core::net::{PlaceId, TransitionId};
use cotama_verification::property::Linear;
use cotama_verification::pt::Pt;
use proptest::collection::vec;
use proptest::prelude::*;

fn holds(linear: &Linear, marking: &[u32]) -> bool {
    let tokens = |&(place, weight): &(PlaceId, i64)| weight * i64::from(marking[place.0 as usize]);
    linear.constant + linear.weights.iter().map(tokens).sum::<i64>() <= 0
}

/// A net and some inequalities over its places.
fn with_goal() -> impl Strategy<Value = (Pt, Vec<Linear>)> {
    let goal = vec((-4..=6_i64, vec(-2..=2_i64, 5)), 1..=3);
    (any_net(), goal).prop_map(|(pt, goal)| {
        let linear = |(constant, weights): (i64, Vec<i64>)| {
            let weights =
                weights.into_iter().take(pt.places.len()).enumerate().filter(|it| it.1 != 0);
            Linear {
                constant,
                weights: weights.map(|(at, weight)| (PlaceId(at as u32), weight)).collect(),
            }
        };
        let goal = goal.into_iter().map(linear).collect();
        (pt, goal)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    #[test]
    fn a_goal_called_unreachable_is_and_a_reached_marking_meets_it((pt, goal) in with_goal()) {
        let mut structure = Structure::new(&pt, &Limits::default());
        let (markings, _) = explore(&pt, 500);
        let there = |marking: &Vec<u32>| goal.iter().all(|it| holds(it, marking));
        for _ in 0..2 {
            match structure.reach(&goal) {
                Answer::Impossible(proof) => {
                    prop_assert!(!markings.iter().any(there));
                    prop_assert!(unreachable(&pt, structure.dead(), &goal, &proof));
                }
                Answer::Reachable(trace) => prop_assert!(there(&replay(&pt, &trace))),
                Answer::Unknown(_) => {}
            }
            structure.find_dead_transitions();
        }
    }

    #[test]
    fn no_marking_passes_a_bound(pt in any_net(), weights in vec(-2..=2_i64, 5)) {
        let mut structure = Structure::new(&pt, &Limits::default());
        let (markings, _) = explore(&pt, 500);
        let bounds = structure.bounds().to_vec();
        for (place, bound) in bounds.iter().enumerate() {
            let Some(bound) = bound else { continue };
            prop_assert!(bound.holds(&pt, structure.dead()));
            prop_assert_eq!(&bound.weights, &[(PlaceId(place as u32), 1)]);
            prop_assert!(markings.iter().all(|it| i64::from(it[place]) <= bound.at_most));
        }
        let weights: Vec<_> =
            (0..).map(PlaceId).zip(weights).take(pt.places.len()).filter(|it| it.1 != 0).collect();
        if let Some(bound) = structure.upper_bound(&weights) {
            prop_assert!(bound.holds(&pt, structure.dead()));
            let above = Linear { constant: -bound.at_most, weights };
            prop_assert!(markings.iter().all(|it| holds(&above, it)));
        }
        match structure.one_safe() {
            Answer::Impossible(proof) => {
                prop_assert!(markings.iter().flatten().all(|&it| it <= 1));
                prop_assert_eq!(proof.len(), pt.places.len());
                prop_assert!(
                    proof.iter().all(|it| it.at_most <= 1 && it.holds(&pt, structure.dead()))
                );
            }
            Answer::Reachable(trace) => prop_assert!(replay(&pt, &trace).iter().any(|&it| it > 1)),
            Answer::Unknown(_) => {}
        }
    }

    #[test]
    fn deadlocks_are_not_missed_and_not_made_up(pt in any_net()) {
        let mut structure = Structure::new(&pt, &Limits::default());
        let (markings, _) = explore(&pt, 500);
        match structure.deadlock() {
            Answer::Impossible(proof) => {
                prop_assert!(markings.iter().all(|it| enabled(&pt, it).next().is_some()));
                prop_assert!(proof.holds(&pt, structure.dead()));
            }
            Answer::Reachable(trace) => {
                prop_assert!(enabled(&pt, &replay(&pt, &trace)).next().is_none());
            }
            Answer::Unknown(_) => {}
        }
    }

    #[test]
    fn dead_transitions_never_fire(pt in any_net()) {
        let mut structure = Structure::new(&pt, &Limits::default());
        structure.find_dead_transitions();
        prop_assert!(structure.dead().holds(&pt));
        for marking in explore(&pt, 500).0 {
            prop_assert!(
                enabled(&pt, &marking).all(|it| structure.dead().can_fire(TransitionId(it)))
            );
        }
    }

    #[test]
    fn small_limits_are_an_answer(
        (pt, goal) in with_goal(),
        work in 0..200_u64,
        nodes in 0..4_u32,
    ) {
        let mut structure = Structure::with_effort(&pt, &Limits::default(), Effort { work, nodes });
        let (markings, _) = explore(&pt, 500);
        if let Answer::Impossible(proof) = structure.reach(&goal) {
            prop_assert!(!markings.iter().any(|marking| goal.iter().all(|it| holds(it, marking))));
            prop_assert!(unreachable(&pt, structure.dead(), &goal, &proof));
        }
        structure.find_dead_transitions();
        prop_assert!(structure.dead().holds(&pt));
        let bounds = structure.bounds().to_vec();
        prop_assert!(bounds.iter().flatten().all(|it| it.holds(&pt, structure.dead())));
    }
}
