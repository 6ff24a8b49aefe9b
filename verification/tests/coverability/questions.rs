//! Coverability, dead transitions, and formulas.

use super::{end, net, set};
use Answer::{After, Never, NotAsked};
use cotama_core::net::{PlaceId, TransitionId};
use cotama_verification::coverability::{Coverable, Limits, coverable, reaches};
use cotama_verification::property::{self, Question, Reachability};
use cotama_verification::pt::Pt;

/// A lock with two keys, of which one can be copied without end; `both` needs both and a place that
/// is never marked.
fn lock() -> Pt {
    net(
        &[1, 0, 0, 0],
        &[
            [&[(0, 1)], &[(0, 1), (1, 1)]],
            [&[(0, 1)], &[(2, 1)]],
            [&[(1, 3), (2, 1)], &[(1, 3), (2, 1)]],
            [&[(1, 1), (2, 1), (3, 1)], &[(2, 1)]],
        ],
    )
}

#[derive(Debug, PartialEq)]
enum Answer {
    After(u128),
    Never,
    NotAsked,
}

fn answer(pt: &Pt, text: &str) -> Answer {
    let Question::Formula(formula) = property::parse(text, pt).unwrap().question else {
        panic!("no formula")
    };
    let goal = Reachability::new(&formula).unwrap().goal;
    match reaches(pt, &goal, &Limits::default()) {
        None => NotAsked,
        Some(Coverable::Yes(way)) => {
            let marking = end(pt, &way);
            let condition = property::Condition::new(&goal, pt).unwrap();
            assert!(condition.holds(marking.as_slice()), "{text} in {marking:?}");
            After(way.length)
        }
        Some(Coverable::No) => Never,
        Some(Coverable::Unknown(unfinished)) => panic!("{text}: {unfinished}"),
    }
}

#[test]
fn goals_that_more_tokens_keep_true_are_answered_exactly() {
    let pt = lock();
    assert_eq!(answer(&pt, "EF (p1 >= 4 & p2 >= 1)"), After(5));
    assert_eq!(answer(&pt, "EF (p0 >= 1 & p2 >= 1)"), Never);
    assert_eq!(answer(&pt, "EF p1 + p2 >= 7"), After(7));
    assert_eq!(answer(&pt, "EF fireable(t2)"), After(4));
    assert_eq!(answer(&pt, "EF fireable(t3)"), Never);
    assert_eq!(answer(&pt, "EF !deadlock"), After(0));
    // The law is broken by what is looked for.
    assert_eq!(answer(&pt, "AG p1 <= 9"), After(10));
    assert_eq!(answer(&pt, "AG p0 + p2 <= 1"), Never);
    assert_eq!(answer(&pt, "AG !(p0 & p2)"), Never);
}

#[test]
fn other_goals_are_left_to_other_engines() {
    let pt = lock();
    for text in
        ["EF p1 = 4", "EF p1 <= 0", "EF deadlock", "EF p1 >= p2", "AG p1 >= 1", "EF !fireable(t0)"]
    {
        assert_eq!(answer(&pt, text), NotAsked, "{text}");
    }
}

#[test]
fn transitions_that_can_never_fire_are_named() {
    let pt = lock();
    let set = set(&pt);
    assert_eq!(set.dead_transitions(), [TransitionId(3)]);
    assert_eq!(set.enables(TransitionId(3)), None);
    assert!(pt.enabled(&end(&pt, &set.enables(TransitionId(2)).unwrap()), 2));
}

#[test]
fn a_place_that_is_not_there_holds_nothing() {
    let pt = lock();
    let start = Coverable::Yes(cotama_verification::coverability::Sequence {
        length: 0,
        firings: Some(vec![]),
    });
    assert_eq!(coverable(&pt, &[(PlaceId(9), 1)], &Limits::default()), Coverable::No);
    assert_eq!(coverable(&pt, &[(PlaceId(9), 0)], &Limits::default()), start);
    assert_eq!(coverable(&pt, &[], &Limits::default()), start);
    // Places that are there hold any number, or no more than they do.
    let Coverable::Yes(way) = coverable(&pt, &[(PlaceId(1), u64::MAX)], &Limits::default()) else {
        panic!()
    };
    assert_eq!(way.length, u128::from(u64::MAX));
    assert_eq!(coverable(&pt, &[(PlaceId(2), u64::MAX)], &Limits::default()), Coverable::No);
}
