//! Nets with so many places that markings are not packed are searched as others are.

use crate::check::nets::any;
use crate::properties::random::Random;
use cotama_verification::explicit::{Graph, Limit, Limits, statespace};
use cotama_verification::pt::{Lists, Pt};
use std::time::Instant;

/// The same with so many places that nothing needs or changes, each with a token.
fn padded(pt: &Pt, more: usize) -> Pt {
    let places = pt.places.len() + more;
    let names = (pt.places.len()..places).map(|it| format!("more{it}"));
    let lists = |at: u32| pt.needs.of(at).iter().copied();
    let transitions = 0..pt.transitions.len() as u32;
    let needs = Lists::new(transitions.clone().map(lists));
    let effects = Lists::new(transitions.map(|it| pt.effects.of(it).iter().copied()));
    Pt {
        places: pt.places.iter().cloned().chain(names).collect(),
        initial: pt.initial.iter().copied().chain(std::iter::repeat_n(1, more)).collect(),
        consumers: needs.reversed(places),
        changers: effects.reversed(places),
        needs,
        effects,
        ..pt.clone()
    }
}

#[test]
fn markings_that_are_not_packed_are_the_same() {
    let mut random = Random(17);
    let limits = Limits { states: 2_000, ..Limits::default() };
    let mut compared = 0;
    for _ in 0..400 {
        let narrow = any(&mut random);
        let (count, more) = (narrow.places.len(), 8_200);
        let Ok(graph) = Graph::new(&narrow, &limits, &|_| ()) else { continue };
        compared += 1;
        let wide = padded(&narrow, more);
        let other = Graph::new(&wide, &limits, &|_| ()).unwrap();
        assert_eq!((graph.states(), graph.arcs()), (other.states(), other.arcs()));
        for state in 0..graph.states() as u32 {
            assert_eq!(graph.marking(state), other.marking(state)[..count]);
            assert_eq!(graph.successors(state), other.successors(state));
            assert_eq!(graph.transitions(state), other.transitions(state));
        }
        assert_eq!(graph.liveness(), other.liveness());
        let spaces = [&narrow, &wide].map(|it| statespace(it, &limits, 1, &|_| ()));
        let [one, two] = spaces.each_ref().map(|it| {
            (it.states, it.arcs, it.dead_markings, &it.dead_transitions, it.depth, it.limit)
        });
        assert_eq!(one, two);
        assert_eq!(spaces[0].bounds, spaces[1].bounds[..count]);
        assert_eq!(spaces[0].max_sum + more as u64, spaces[1].max_sum);
    }
    assert!(compared > 100, "only {compared}");
}

#[test]
fn limits_are_answers() {
    // Forty tokens on a ring of four places: almost all markings differ from the start in four.
    let step = |from: u32| [[(from, 1)], [((from + 1) % 4, 1)]];
    let arcs = [0, 1, 2, 3].map(step);
    let ring = super::net(&[40, 0, 0, 0], &arcs.each_ref().map(|it| [&it[0][..], &[], &it[1][..]]));
    let wide = padded(&ring, 8_200);
    let within = |limits| statespace(&wide, &limits, 1, &|_| ());
    let few = within(Limits { states: 10, ..Limits::default() });
    assert_eq!((few.states, few.limit), (10, Some(Limit::States)));
    let over = within(Limits { deadline: Some(Instant::now()), ..Limits::default() });
    assert_eq!((over.states, over.limit), (1, Some(Limit::Time)));
    let none = within(Limits { bytes: 1_000, ..Limits::default() });
    assert_eq!((none.states, none.limit), (0, Some(Limit::Bytes)));
    let all = within(Limits::default());
    assert_eq!((all.states, all.limit), (12_341, None));
    assert!(all.bytes - few.bytes > 50 * all.states, "{} {}", few.bytes, all.bytes);
    let part = within(Limits { bytes: all.bytes - 1, ..Limits::default() });
    assert_eq!(part.limit, Some(Limit::Bytes));
    assert!(part.bytes > 0 && part.states < all.states);
}
