//! Problems: what is refused, and what is said of those that are not.

use cotama_core::monitor::worst;
use cotama_core::problem::{Candidate, Problem, ProblemError};
use proptest::prelude::*;

type Lists = Vec<Vec<Candidate<3>>>;

fn lists() -> impl Strategy<Value = Lists> {
    let candidate = (any::<[u32; 3]>(), any::<u32>()).prop_map(|(cost, quality)| Candidate {
        cost,
        quality,
        id: 0,
    });
    prop::collection::vec(prop::collection::vec(candidate, 1..5), 0..6)
}

#[test]
fn the_defect_of_an_invalid_problem_is_named() {
    const ONE: [Candidate<2>; 1] = [Candidate { cost: [1, 1], quality: 0, id: 0 }];
    let refused = |activities: &[&[Candidate<2>]], order| {
        let error = Problem::new(activities, [9, 9], order).unwrap_err();
        (error, error.to_string())
    };
    let said = |error, text: &str| (error, text.to_owned());
    assert_eq!(
        refused(&[&ONE, &[]], [0, 1]),
        said(ProblemError::NoCandidates { activity: 1 }, "activity 1 has no candidate")
    );
    let many = vec![ONE[0]; Problem::<2>::MAX_CANDIDATES + 1];
    assert_eq!(
        refused(&[&ONE, &ONE, &many], [0, 1]),
        said(
            ProblemError::TooManyCandidates { activity: 2 },
            "activity 2 has more than 65535 candidates"
        )
    );
    assert!(Problem::new(&[&many[1..]], [9, 9], [0, 1]).is_ok());
    let long = vec![&ONE[..]; Problem::<2>::MAX_ACTIVITIES + 1];
    assert_eq!(
        refused(&long, [0, 1]),
        said(ProblemError::TooManyActivities, "more than 65535 activities")
    );
    assert!(Problem::new(&long[1..], [9, 9], [1, 0]).is_ok());
    for order in [[0, 0], [1, 1], [0, 2], [usize::MAX, 1]] {
        assert_eq!(
            refused(&[&ONE], order),
            said(ProblemError::BadOrder, "the order of treatment must name every axis once")
        );
    }
}

/// 65,535 activities at the largest costs: the largest sums there are, and they fit.
#[test]
fn the_largest_problem_does_not_overflow() {
    const MOST: [Candidate<1>; 2] = [Candidate { cost: [u32::MAX], quality: u32::MAX, id: 0 }; 2];
    let activities = vec![&MOST[..]; Problem::<1>::MAX_ACTIVITIES];
    let problem = Problem::new(&activities, [0], [0]).unwrap();
    let sum = 65_535 * u64::from(u32::MAX);
    assert_eq!((problem.least(0), worst(&activities)), (sum, [sum]));
    assert_eq!(problem.totals(&vec![1; activities.len()]), Some(([sum], sum)));
    assert_eq!(problem.combinations(), None);
    assert_eq!(Problem::new(&activities[..127], [0], [0]).unwrap().combinations(), Some(1 << 127));
    assert_eq!(Problem::new(&activities[..128], [0], [0]).unwrap().combinations(), None);
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_plan_costs_the_sum_of_its_candidates_and_never_less_than_the_least(
        lists in lists(), draws in prop::collection::vec(any::<prop::sample::Index>(), 6)
    ) {
        let slices: Vec<_> = lists.iter().map(Vec::as_slice).collect();
        let problem = Problem::new(&slices, [0; 3], [2, 0, 1]).unwrap();
        let plan: Vec<u16> =
            lists.iter().zip(&draws).map(|(list, draw)| draw.index(list.len()) as u16).collect();
        let chosen = || lists.iter().zip(&plan).map(|(list, &at)| list[usize::from(at)]);
        let cost: [u64; 3] =
            std::array::from_fn(|axis| chosen().map(|it| u64::from(it.cost[axis])).sum());
        let quality = chosen().map(|it| u64::from(it.quality)).sum();
        prop_assert_eq!(problem.totals(&plan), Some((cost, quality)));
        let most = worst(&slices);
        for axis in 0..3 {
            prop_assert!((problem.least(axis)..=most[axis]).contains(&cost[axis]));
        }
        prop_assert!(problem.with_limits(cost).within_limits(&cost));
        for axis in 0..3 {
            let mut less = cost;
            if let Some(limit) = less[axis].checked_sub(1) {
                less[axis] = limit;
                prop_assert!(!problem.with_limits(less).within_limits(&cost));
            }
        }
    }

    #[test]
    fn a_list_of_choices_that_is_no_plan_has_no_totals(lists in lists(), at: prop::sample::Index) {
        let slices: Vec<_> = lists.iter().map(Vec::as_slice).collect();
        let problem = Problem::new(&slices, [0; 3], [0, 1, 2]).unwrap();
        let mut plan = vec![0; lists.len()];
        prop_assert!(problem.totals(&plan).is_some());
        prop_assert_eq!(problem.totals(&[&plan[..], &[0]].concat()), None);
        if !plan.is_empty() {
            prop_assert_eq!(problem.totals(&plan[1..]), None);
            let activity = at.index(plan.len());
            plan[activity] = lists[activity].len() as u16;
            prop_assert_eq!(problem.totals(&plan), None);
        }
        let product: usize = lists.iter().map(Vec::len).product();
        prop_assert_eq!(problem.combinations(), Some(product as u128));
    }
}
