//! Properties of every allocator: memory that suffices, and answers that cannot contradict
//! themselves.

use cotama_core::allocation::{Allocator, Answer, MemoryError, Planned, Shortfall};
use cotama_core::exact::{Exact, Item, Objective, Stage};
use cotama_core::front::{Front, Node};
use cotama_core::panorama::Panorama;
use cotama_core::problem::{Candidate, Problem};
use proptest::prelude::*;

const fn way(cost: u32, quality: u32) -> Candidate<1> {
    Candidate { cost: [cost], quality, id: 0 }
}

static TWO: [&[Candidate<1>]; 2] = [&[way(1, 1), way(2, 3)], &[way(3, 0)]];

fn problem(limit: u64) -> Problem<'static, 1> {
    Problem::new(&TWO, [limit], [0]).unwrap()
}

/// The error that says so, of an allocator that was given less.
fn short<T: std::fmt::Debug>(answer: Result<T, MemoryError>) -> (&'static str, usize, usize) {
    let error = answer.unwrap_err();
    let said =
        format!("the {} needs {} elements, {} were given", error.what, error.needed, error.given);
    assert_eq!(error.to_string(), said);
    (error.what, error.needed, error.given)
}

#[test]
fn memory_too_small_is_named_and_counted_and_the_plan_stays_as_it_was() {
    let problem = problem(9);
    let exact = |items: usize, stages: usize, plan: &mut [u16]| {
        let (mut items, mut stages) = (vec![Item::EMPTY; items], vec![Stage::EMPTY; stages]);
        Exact::new(&[], 99, &mut items, &mut stages).allocate(&problem, plan)
    };
    let mut plan = [7; 2];
    assert_eq!(short(exact(3, 2, &mut plan[..1])), ("plan", 2, 1));
    assert_eq!(short(exact(2, 2, &mut plan)), ("items of the exact allocator", 3, 2));
    assert_eq!(short(exact(3, 1, &mut plan)), ("stages of the exact allocator", 2, 1));
    let rule = |caps: usize, plan: &mut [u16]| {
        Panorama::new(&mut vec![[0]; caps]).allocate(&problem, plan)
    };
    assert_eq!(short(rule(2, &mut [])), ("plan", 2, 0));
    assert_eq!(short(rule(1, &mut plan)), ("caps of the paper's rule", 2, 1));
    assert_eq!(plan, [7; 2]);
    let front = |nodes: usize| {
        Front::new(&mut vec![Node::EMPTY; nodes]).find(&problem).map(|plans| plans.len())
    };
    assert_eq!(short(front(0)), ("nodes of the front", 1, 0));
    assert_eq!(short(front(2)), ("nodes of the front", 3, 2));
    assert_eq!(short(front(4)), ("nodes of the front", 5, 4));
    assert_eq!(front(5), Ok(2));
}

#[test]
fn more_memory_than_needed_is_left_alone() {
    let (mut items, mut stages) = ([Item::EMPTY; 9], [Stage::EMPTY; 9]);
    let mut plan = [7; 4];
    let mut exact = Exact::new(&[Objective::MostQuality], 99, &mut items, &mut stages);
    let answer = exact.allocate(&problem(5), &mut plan);
    let Ok(Answer::Planned(Planned { cost, quality, bound, optimal, .. })) = answer else {
        panic!("{answer:?}")
    };
    assert_eq!((cost, quality, bound, optimal), ([5], 3, Some(3), true));
    assert_eq!(plan, [1, 0, 7, 7]);
}

#[test]
fn a_plan_that_is_not_found_leaves_the_memory_for_it_as_it_was() {
    let mut plan = [7; 2];
    let (mut items, mut stages) = ([Item::EMPTY; 3], [Stage::EMPTY; 2]);
    let mut exact = Exact::new(&[], 99, &mut items, &mut stages);
    let short = Shortfall::new(0, 3, 4);
    for answer in [
        exact.allocate(&problem(3), &mut plan),
        Panorama::new(&mut [[0]; 2]).allocate(&problem(3), &mut plan),
    ] {
        assert!(matches!(answer, Ok(Answer::Infeasible { shortfall, .. }) if shortfall == short));
    }
    assert_eq!(plan, [7; 2]);
}

#[test]
fn no_activity_is_a_plan_of_nothing() {
    let nothing = Problem::<1>::new(&[], [0], [0]).unwrap();
    let exact = Exact::new(&[Objective::Least(0)], 0, &mut [], &mut []).allocate(&nothing, &mut []);
    let rule = Panorama::new(&mut []).allocate(&nothing, &mut []);
    for answer in [exact, rule] {
        let Ok(Answer::Planned(planned)) = answer else { panic!("{answer:?}") };
        assert_eq!((planned.cost, planned.quality), ([0], 0));
    }
    assert_eq!(Front::new(&mut [Node::EMPTY]).find(&nothing).unwrap().totals(0), Some(([0], 0)));
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_shortfall_is_above_its_limit_or_is_none(limit: u64, least: u64, axis in 0..4_usize) {
        match Shortfall::new(axis, limit, least) {
            None => prop_assert!(least <= limit),
            Some(it) => {
                prop_assert_eq!((it.axis(), it.limit(), it.least()), (axis, limit, least));
                prop_assert!(it.gap() > 0 && it.limit() + it.gap() == it.least());
            }
        }
    }
}
