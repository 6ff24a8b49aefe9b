//! Shortest paths to markings.

use super::{at_least, fired, net};
use cotama_core::net::TransitionId;
use cotama_models::nets::families::{kanban, philosophers};
use cotama_verification::explicit::{Goal, Limits, Reached, reach};
use cotama_verification::property::{Atom, Formula};
use cotama_verification::pt::Pt;

fn search(pt: &Pt, goal: &Formula, jobs: usize) -> Reached {
    reach(pt, Goal::new(goal).unwrap(), &Limits::default(), jobs, &|_| ())
}

#[test]
fn the_initial_marking_is_reached_by_nothing() {
    let pt = net(&[1], &[[&[(0, 1)], &[], &[]]]);
    assert_eq!(search(&pt, &at_least(0, 1), 1), Reached::Trace { transitions: vec![], states: 1 });
}

#[test]
fn philosophers_starve_after_each_took_one_fork() {
    for n in 2..=9 {
        let pt = Pt::from(&philosophers(n).unwrap().view().net());
        let Reached::Trace { transitions, .. } = search(&pt, &Formula::Atom(Atom::Deadlock), 1)
        else {
            panic!("no deadlock of {n}")
        };
        assert_eq!(transitions.len(), n as usize);
        let end = fired(&pt, &transitions);
        assert!((0..pt.transitions.len() as u32).all(|it| !pt.enabled(&end, it)));
    }
}

#[test]
fn a_kanban_system_never_stops() {
    let pt = Pt::from(&kanban(2).unwrap().view().net());
    assert_eq!(search(&pt, &Formula::Atom(Atom::Deadlock), 2), Reached::Never { states: 4_600 });
}

#[test]
fn of_two_transitions_with_the_same_effect_the_first_that_is_enabled_leads_the_way() {
    let start: [&[(u32, u32)]; 3] = [&[(0, 1)], &[(2, 1)], &[(1, 1)]];
    let again: [&[(u32, u32)]; 3] = [&[(0, 1)], &[], &[(1, 1)]];
    let pt = net(&[1, 0, 0], &[start, again, again]);
    let way = Reached::Trace { transitions: vec![TransitionId(1)], states: 2 };
    assert_eq!(search(&pt, &at_least(1, 1), 1), way);
}

#[test]
fn of_two_shortest_ways_the_one_with_the_first_last_transition_is_told() {
    let step = |from: &'static [(u32, u32)], to: &'static [(u32, u32)]| [from, &[][..], to];
    let fork = [step(&[(0, 1)], &[(1, 1)]), step(&[(0, 1)], &[(2, 1)])];
    let join = [step(&[(1, 1)], &[(3, 1)]), step(&[(2, 1)], &[(3, 1)])];
    let pt = net(&[1, 0, 0, 0], &[fork, join].concat());
    let way = vec![TransitionId(0), TransitionId(2)];
    let Reached::Trace { transitions, .. } = search(&pt, &at_least(3, 1), 1) else {
        panic!("there is a way")
    };
    assert_eq!(transitions, way);
}

#[test]
fn ways_are_the_same_on_any_number_of_threads() {
    let pt = Pt::from(&kanban(4).unwrap().view().net());
    let places = 0..pt.places.len() as u32;
    for goal in
        places.step_by(5).map(|it| Formula::And(vec![at_least(it, 4), at_least((it + 3) % 16, 2)]))
    {
        let one = search(&pt, &goal, 1);
        assert!((2..=5).all(|jobs| search(&pt, &goal, jobs) == one), "{goal:?}");
        if let Reached::Trace { transitions, .. } = &one {
            fired(&pt, transitions);
        }
    }
}

#[test]
fn a_temporal_formula_is_no_goal() {
    assert!(
        Goal::new(&Formula::Exists(Box::new(Formula::Finally(Box::new(at_least(0, 1)))))).is_none()
    );
}
