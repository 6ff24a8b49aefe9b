//! Nets whose markings nobody could visit one by one.

use super::nets::{kanban, philosophers, replay};
use cotama_checker::structural::{Answer, Limits, Structure};
use cotama_core::net::PlaceId;

#[test]
fn a_kanban_system_of_2000_cards_is_bounded_and_never_stops() {
    let pt = kanban(2_000);
    let mut structure = Structure::new(&pt, &Limits::default());
    let bounds: Vec<_> =
        structure.bounds().iter().map(|it| it.as_ref().map(|it| it.at_most)).collect();
    assert_eq!(bounds, [Some(2_000); 16]);
    let Answer::Impossible(proof) = structure.deadlock() else { panic!("not proved") };
    assert!(proof.holds(&pt, structure.dead()));
    let busy = [(PlaceId(0), 1), (PlaceId(4), 1), (PlaceId(8), 1), (PlaceId(12), 1)];
    assert_eq!(structure.upper_bound(&busy).unwrap().at_most, 8_000);
}

#[test]
fn two_hundred_philosophers_are_1_safe_and_can_starve() {
    let pt = philosophers(200, false);
    let mut structure = Structure::new(&pt, &Limits::default());
    let Answer::Impossible(bounds) = structure.one_safe() else { panic!("not proved") };
    assert!(bounds.iter().step_by(50).all(|it| it.holds(&pt, structure.dead())));
    let Answer::Reachable(trace) = structure.deadlock() else { panic!("not found") };
    assert_eq!(trace.len(), 200);
    assert!(super::nets::enabled(&pt, &replay(&pt, &trace)).next().is_none());
}

#[test]
fn two_hundred_philosophers_who_keep_an_order_never_starve() {
    let pt = philosophers(200, true);
    let mut structure = Structure::new(&pt, &Limits::default());
    assert!(matches!(structure.deadlock(), Answer::Impossible(_)));
}
