//! Graphs of markings: ways, satisfying markings, liveness.

use super::{at_least, net};
use cotama_core::net::TransitionId;
use cotama_models::nets::families::{kanban, philosophers};
use cotama_verification::explicit::Goal;
use cotama_verification::explicit::{Graph, Limit, Limits};
use cotama_verification::property::{Atom, Formula};
use cotama_verification::pt::Pt;

fn graph(pt: &Pt) -> Graph {
    Graph::new(pt, &Limits::default(), &|_| ()).unwrap()
}

#[test]
fn a_kanban_system_is_live_and_returns() {
    let graph = graph(&Pt::from(&kanban(2).unwrap().view().net()));
    assert_eq!((graph.states(), graph.arcs()), (4_600, 28_120));
    assert_eq!(graph.components().count, 1);
    let liveness = graph.liveness();
    assert!(liveness.is_live() && liveness.is_quasi_live() && liveness.reversible);
    assert_eq!(liveness.home, 4_600);
}

#[test]
fn numbers_are_the_same_on_any_number_of_threads() {
    for net in [kanban(3).unwrap(), philosophers(9).unwrap()] {
        let pt = Pt::from(&net.view().net());
        let one = graph(&pt);
        for jobs in [2, 3, 8] {
            let some = Graph::on(&pt, &Limits::default(), jobs, &|_| ()).unwrap();
            assert_eq!((some.states(), some.arcs()), (one.states(), one.arcs()));
            let same = |it: u32| one.successors(it) == some.successors(it);
            assert!((0..one.states() as u32).all(same));
            let alike = |it: u32| one.marking(it) == some.marking(it);
            assert!((0..one.states() as u32).step_by(97).all(alike));
            assert_eq!(one.liveness(), some.liveness());
            // A limit ends all of them after as many markings.
            let limits = Limits { states: 5_000, ..Limits::default() };
            let ended = |jobs| Graph::on(&pt, &limits, jobs, &|_| ()).map(|_| ()).unwrap_err();
            assert_eq!(ended(jobs), ended(1));
        }
    }
}

#[test]
fn philosophers_may_starve() {
    let graph = graph(&Pt::from(&philosophers(5).unwrap().view().net()));
    // All markings but the two deadlocks lead back to each other.
    assert_eq!(graph.components().count, 3);
    let liveness = graph.liveness();
    assert_eq!((liveness.live.len(), liveness.mortal.len(), liveness.dead.len()), (0, 25, 0));
    assert!(liveness.is_quasi_live() && !liveness.is_live() && !liveness.reversible);
    assert_eq!(liveness.home, 0);
    let deadlock = Formula::Atom(Atom::Deadlock);
    let dead = graph.satisfying(Goal::new(&deadlock).unwrap(), 1);
    let dead: Vec<u32> = (0..243).filter(|it| dead[*it as usize]).collect();
    assert_eq!(dead.len(), 2);
    assert!(dead.iter().all(|it| graph.successors(*it).is_empty() && graph.path(*it).len() == 5));
}

#[test]
fn a_starting_transition_is_mortal_and_the_loop_behind_it_live() {
    let start: [&[(u32, u32)]; 3] = [&[(0, 1)], &[], &[(1, 1)]];
    let there: [&[(u32, u32)]; 3] = [&[(1, 1)], &[], &[(2, 1)]];
    let back: [&[(u32, u32)]; 3] = [&[(2, 1)], &[], &[(1, 1)]];
    let never: [&[(u32, u32)]; 3] = [&[(2, 2)], &[], &[]];
    let graph = graph(&net(&[1, 0, 0], &[start, there, back, never]));
    let liveness = graph.liveness();
    assert_eq!(liveness.live, [TransitionId(1), TransitionId(2)]);
    assert_eq!(liveness.mortal, [TransitionId(0)]);
    assert_eq!(liveness.dead, [TransitionId(3)]);
    assert_eq!((liveness.home, liveness.reversible), (2, false));
    let marked = at_least(2, 1);
    let marked = graph.satisfying(Goal::new(&marked).unwrap(), 2);
    assert_eq!(marked.iter().collect::<Vec<_>>(), [false, false, true]);
}

#[test]
fn a_chain_of_a_million_markings_has_a_million_components() {
    let graph = graph(&net(&[999_999], &[[&[(0, 1)], &[], &[]]]));
    assert_eq!((graph.states(), graph.components().count), (1_000_000, 1_000_000));
    assert_eq!(graph.path(999_999).len(), 999_999);
    assert_eq!(graph.liveness().mortal, [TransitionId(0)]);
}

#[test]
fn a_graph_that_passes_a_limit_is_that_limit() {
    let pt = Pt::from(&kanban(3).unwrap().view().net());
    let with = |limits: Limits| {
        Graph::new(&pt, &limits, &|_| ()).map(|it| it.states()).map_err(|it| it.limit)
    };
    assert_eq!(with(Limits { states: 58_399, ..Limits::default() }), Err(Limit::States));
    assert_eq!(with(Limits { states: 58_400, ..Limits::default() }), Ok(58_400));
    assert_eq!(with(Limits { bytes: 1 << 20, ..Limits::default() }), Err(Limit::Bytes));
    assert_eq!(
        with(Limits { deadline: Some(std::time::Instant::now()), ..Limits::default() }),
        Err(Limit::Time)
    );
}
