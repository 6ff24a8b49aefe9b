//! Invariants and semiflows of random nets, against their definitions.

use super::nets::{any_net, explore};
use cotama_checker::structural::{
    place_invariants, place_semiflows, transition_invariants, transition_semiflows,
};
use cotama_verification::pt::Pt;
use proptest::prelude::*;

/// By how much each transition changes each place.
fn matrix(pt: &Pt) -> Vec<Vec<i128>> {
    let mut matrix = vec![vec![0; pt.transitions.len()]; pt.places.len()];
    for transition in 0..pt.transitions.len() as u32 {
        for &(place, by) in pt.effects.of(transition) {
            matrix[place as usize][transition as usize] = by.into();
        }
    }
    matrix
}

/// The rank, by elimination without fractions.
fn rank(mut rows: Vec<Vec<i128>>) -> usize {
    let mut rank = 0;
    for column in 0..rows.first().map_or(0, Vec::len) {
        let Some(pivot) = (rank..rows.len()).find(|&it| rows[it][column] != 0) else { continue };
        rows.swap(rank, pivot);
        let pivot = rows[rank].clone();
        for row in &mut rows[rank + 1..] {
            let (a, b) = (pivot[column], row[column]);
            for (it, pivot) in row.iter_mut().zip(&pivot) {
                *it = *it * a - pivot * b;
            }
        }
        rank += 1;
    }
    rank
}

fn dense(flow: &[(u32, i64)], length: usize) -> Vec<i128> {
    let mut all = vec![0; length];
    for &(at, weight) in flow {
        all[at as usize] = weight.into();
    }
    all
}

fn is_flow(rows: &[Vec<i128>], flow: &[i128]) -> bool {
    let width = rows.first().map_or(0, Vec::len);
    (0..width).all(|column| {
        rows.iter().zip(flow).map(|(row, weight)| row[column] * weight).sum::<i128>() == 0
    })
}

fn transposed(rows: &[Vec<i128>]) -> Vec<Vec<i128>> {
    (0..rows.first().map_or(0, Vec::len))
        .map(|at| rows.iter().map(|row| row[at]).collect())
        .collect()
}

proptest! {
    #[test]
    fn invariants_span_all_that_transitions_leave_as_it_is(pt in any_net()) {
        let rows = matrix(&pt);
        let flows = place_invariants(&pt).unwrap();
        let all: Vec<_> = flows.iter().map(|it| dense(it, pt.places.len())).collect();
        prop_assert!(all.iter().all(|it| is_flow(&rows, it)));
        prop_assert_eq!(rank(all), pt.places.len() - rank(rows.clone()));
        prop_assert_eq!(flows.len(), pt.places.len() - rank(rows.clone()));
        let cycles = transition_invariants(&pt).unwrap();
        let all: Vec<_> = cycles.iter().map(|it| dense(it, pt.transitions.len())).collect();
        prop_assert!(all.iter().all(|it| is_flow(&transposed(&rows), it)));
        prop_assert_eq!(rank(all), pt.transitions.len() - rank(rows));
    }

    #[test]
    fn invariants_hold_in_every_reachable_marking(pt in any_net()) {
        let value = |marking: &[u32], flow: &[(u32, i64)]| -> i64 {
            flow.iter().map(|&(place, weight)| weight * i64::from(marking[place as usize])).sum()
        };
        for flow in place_invariants(&pt).unwrap() {
            let start = value(&pt.initial, &flow);
            prop_assert!(explore(&pt, 300).0.iter().all(|it| value(it, &flow) == start));
        }
    }

    #[test]
    fn semiflows_are_the_minimal_ones_and_all_of_them(pt in any_net()) {
        let rows = matrix(&pt);
        let found = place_semiflows(&pt, 1_000);
        prop_assert!(found.complete);
        let all: Vec<_> = found.flows.iter().map(|it| dense(it, pt.places.len())).collect();
        prop_assert!(
            all.iter().all(|it| is_flow(&rows, it) && it.iter().all(|&weight| weight >= 0))
        );
        let within = |small: &[i128], large: &[i128]| {
            small.iter().zip(large).all(|(&a, &b)| a == 0 || b > 0)
        };
        for (at, one) in all.iter().enumerate() {
            prop_assert!(all.iter().enumerate().all(|(it, other)| it == at || !within(one, other)));
        }
        // Any flow with small weights contains one of them.
        for code in 1..4_usize.pow(pt.places.len() as u32) {
            let flow: Vec<_> =
                (0..pt.places.len()).map(|at| (code >> (2 * at) & 3) as i128).collect();
            prop_assert!(!is_flow(&rows, &flow) || all.iter().any(|it| within(it, &flow)));
        }
        let cycles = transition_semiflows(&pt, 1_000);
        prop_assert!(cycles.complete);
        prop_assert!(
            cycles
                .flows
                .iter()
                .all(|it| is_flow(&transposed(&rows), &dense(it, pt.transitions.len())))
        );
        prop_assert!(cycles.flows.iter().flatten().all(|it| it.1 > 0));
    }

    #[test]
    fn a_limit_on_rows_leaves_fewer_semiflows_but_no_wrong_ones(
        pt in any_net(),
        limit in 0..8_usize,
    ) {
        let some = place_semiflows(&pt, limit);
        let all = place_semiflows(&pt, 1_000);
        prop_assert!(some.flows.iter().all(|it| all.flows.contains(it)));
        prop_assert!(!some.complete || some == all);
    }
}
