//! Searches that end before their end, and widths that turn out too small.

use super::{at_least, net, space};
use cotama_core::net::TransitionId;
use cotama_models::nets::families::{kanban, philosophers};
use cotama_verification::explicit::{
    Goal, Graph, Growth, Limit, Limits, Reached, reach, statespace,
};
use cotama_verification::property::{Atom, Formula};
use cotama_verification::pt::Pt;
use std::cell::Cell;
use std::time::Instant;

fn kanban_3() -> Pt {
    Pt::from(&kanban(3).unwrap().view().net())
}

#[test]
fn one_state_too_many_is_a_limit_and_counts_stay_those_of_whole_levels() {
    let pt = kanban_3();
    let all = space(&pt);
    let enough = statespace(&pt, &Limits { states: 58_400, ..Limits::default() }, 1, &|_| ());
    assert_eq!(enough, all);
    for states in [1, 10, 1_000, 58_399] {
        let limits = Limits { states, ..Limits::default() };
        let space = statespace(&pt, &limits, 1, &|_| ());
        assert!(space.states <= states && space.limit == Some(Limit::States));
        assert_eq!(space.bounded, Some(true), "the structure bounds every place");
        let again = statespace(&pt, &limits, 4, &|_| ());
        assert_eq!(
            (again.states, again.arcs, again.depth),
            (space.states, space.arcs, space.depth)
        );
    }
}

#[test]
fn memory_that_is_too_small_is_a_limit_and_never_passed() {
    let pt = kanban_3();
    let all = space(&pt);
    let goal = Formula::Atom(Atom::Deadlock);
    for bytes in [0, 100, 10_000, 100_000, 400_000, all.peak - 1] {
        let limits = Limits { bytes, ..Limits::default() };
        for jobs in [1, 3] {
            let space = statespace(&pt, &limits, jobs, &|_| ());
            assert!(
                space.limit == Some(Limit::Bytes) || jobs > 1 && space.limit.is_none(),
                "{bytes} bytes"
            );
            assert!(space.peak <= bytes, "{} of {bytes} bytes", space.peak);
            assert!(space.states <= all.states);
        }
        let reached = reach(&pt, Goal::new(&goal).unwrap(), &limits, 1, &|_| ());
        assert!(
            matches!(reached, Reached::Unknown { limit: Limit::Bytes, .. }),
            "{bytes}: {reached:?}"
        );
    }
    let enough = statespace(&pt, &Limits { bytes: all.peak, ..Limits::default() }, 1, &|_| ());
    assert_eq!(enough, all);
}

#[test]
fn a_net_of_three_thousand_million_markings_ends_at_its_memory_limit() {
    let pt = Pt::from(&philosophers(20).unwrap().view().net());
    let limits = Limits { bytes: 8 << 20, ..Limits::default() };
    let space = statespace(&pt, &limits, 2, &|_| ());
    assert_eq!((space.limit, space.bounded), (Some(Limit::Bytes), Some(true)));
    assert!(
        space.states > 10_000 && space.peak <= 8 << 20,
        "{} markings, {} bytes",
        space.states,
        space.peak
    );
    assert_eq!(Graph::new(&pt, &limits, &|_| ()).err().map(|it| it.limit), Some(Limit::Bytes));
}

#[test]
fn a_deadline_that_has_passed_is_a_limit() {
    let limits = Limits { deadline: Some(Instant::now()), ..Limits::default() };
    let space = statespace(&kanban_3(), &limits, 2, &|_| ());
    assert_eq!(space.limit, Some(Limit::Time));
}

#[test]
fn progress_is_told_level_by_level() {
    let last = Cell::new(0);
    let space = statespace(&kanban_3(), &Limits::default(), 1, &|it| {
        assert!(it.states >= last.get());
        last.set(it.states);
    });
    assert_eq!(last.get(), space.states);
}

#[test]
fn a_place_without_a_proved_bound_is_widened_until_its_tokens_fit() {
    // Each firing adds 250 tokens, 8,000 times: 2,000,000 tokens where eight bits were guessed.
    let pt = net(&[0, 8_000], &[[&[(1, 1)], &[], &[(0, 250)]]]);
    let space = space(&pt);
    assert_eq!((space.states, space.bounds, space.limit), (8_001, vec![2_000_000, 8_000], None));
    let goal = at_least(0, 1_999_751);
    let reached = reach(&pt, Goal::new(&goal).unwrap(), &Limits::default(), 1, &|_| ());
    let Reached::Trace { transitions, states: 8_001 } = reached else { panic!("{reached:?}") };
    assert_eq!(transitions.len(), 8_000);
    let graph = Graph::new(&pt, &Limits::default(), &|_| ()).unwrap();
    assert_eq!(graph.marking(8_000), [2_000_000, 0]);
}

#[test]
fn a_place_beyond_its_first_guess_does_not_spill_into_its_neighbours() {
    // Reads keep any sum of tokens from bounding the first place; the neighbours hold one token
    // each.
    let grow: [&[(u32, u32)]; 3] = [&[(3, 1)], &[(1, 1)], &[(0, 3)]];
    let shrink: [&[(u32, u32)]; 3] = [&[(0, 2)], &[(2, 1)], &[]];
    let swap: [&[(u32, u32)]; 3] = [&[(1, 1), (2, 1)], &[], &[(1, 1), (2, 1)]];
    let space = space(&net(&[0, 1, 1, 40], &[grow, shrink, swap]));
    assert_eq!((space.bounds, space.limit), (vec![120, 1, 1, 40], None));
}

#[test]
fn more_tokens_than_a_place_may_hold_are_a_limit() {
    let big = u32::MAX;
    let pt = net(&[big - 1, 3], &[[&[(1, 1)], &[], &[(0, 1)]]]);
    let found = space(&pt);
    assert_eq!((found.states, found.limit), (2, Some(Limit::Tokens)));
    assert_eq!(found.bounds, [u64::from(big), 3]);
    let goal = at_least(1, 4);
    let reached = reach(&pt, Goal::new(&goal).unwrap(), &Limits::default(), 1, &|_| ());
    assert_eq!(reached, Reached::Unknown { limit: Limit::Tokens, states: 2 });
    assert_eq!(
        Graph::new(&pt, &Limits::default(), &|_| ()).err().map(|it| it.limit),
        Some(Limit::Tokens)
    );
}

#[test]
fn a_net_that_grows_without_end_is_unbounded() {
    let pt = net(&[1, 0, 0], &[[&[(0, 1)], &[], &[(1, 1)]], [&[(1, 1)], &[], &[(0, 1), (2, 1)]]]);
    let space = space(&pt);
    assert_eq!((space.bounded, space.limit), (Some(false), Some(Limit::Unbounded)));
    let all = [TransitionId(0), TransitionId(1)];
    assert_eq!(space.growth, Some(Growth { first: vec![], repeated: all.to_vec() }));
    assert_eq!(space.states, 1 << 16);
    let few = statespace(&pt, &Limits { states: 100, ..Limits::default() }, 1, &|_| ());
    assert_eq!((few.states, few.limit), (100, Some(Limit::Unbounded)));
}

#[test]
fn weights_whose_products_pass_64_bits_are_no_invariant() {
    // Each of the transitions fires once; the sums of places that they leave as they are have
    // weights of more than 64 bits.
    let [a, b, c, d] = [4_294_967_291, 4_294_967_279, 4_294_967_231, 4_294_967_197];
    let pt = net(
        &[a, 0, 0, 0],
        &[[&[(0, a)], &[], &[(1, b)]], [&[(1, b)], &[], &[(2, c)]], [&[(2, c)], &[], &[(3, d)]]],
    );
    assert_eq!(space(&pt).states, 4);
    let pt = net(
        &[a, 0, 0, 0],
        &[[&[(0, a)], &[], &[(1, b)]], [&[(1, c)], &[], &[(2, d)]], [&[(2, a)], &[], &[(3, b)]]],
    );
    assert_eq!(space(&pt).states, 3);
}
