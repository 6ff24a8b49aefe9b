//! Behaviour at limits.

use super::net;
use cotama_core::net::PlaceId;
use cotama_verification::coverability::{
    Bounded, CoverabilitySet, Coverable, FIRINGS, Limit, Limits, Unfinished, bounded, coverable,
};
use cotama_verification::pt::Pt;
use std::time::Instant;

/// A ring of places with many tokens, and a place that counts what one step drops: no sum bounds
/// it.
fn wide() -> Pt {
    net(
        &[40, 0, 0, 0, 0, 9],
        &[
            [&[(0, 1)], &[(1, 1)]],
            [&[(1, 1)], &[(2, 1)]],
            [&[(2, 1)], &[(3, 1)]],
            [&[(3, 1)], &[(0, 1)]],
            [&[(4, 1), (5, 2)], &[(4, 3), (5, 1)]],
        ],
    )
}

#[test]
fn a_limit_of_markings_is_an_answer() {
    let limits = Limits { states: 10, ..Limits::default() };
    let expected = Unfinished { limit: Limit::States, nodes: 10 };
    assert_eq!(bounded(&wide(), &limits), Bounded::Unknown(expected));
    assert_eq!(CoverabilitySet::new(&wide(), &limits).unwrap_err(), expected);
    assert_eq!(coverable(&wide(), &[(PlaceId(3), 40)], &limits), Coverable::Unknown(expected));
    assert_eq!(expected.to_string(), "ended by the limit of markings after 10 markings");
}

#[test]
fn a_limit_of_memory_is_an_answer() {
    let limits = Limits { bytes: 20_000, ..Limits::default() };
    let Err(unfinished) = CoverabilitySet::new(&wide(), &limits) else { panic!("it does not fit") };
    assert_eq!(unfinished.limit, Limit::Bytes);
    assert!((50..100).contains(&unfinished.nodes));
}

#[test]
fn a_search_stops_when_its_time_is_over() {
    let limits = Limits { deadline: Some(Instant::now()), ..Limits::default() };
    let Bounded::Unknown(unfinished) = bounded(&wide(), &limits) else { panic!("it was stopped") };
    assert_eq!(unfinished.limit, Limit::Time);
    assert_eq!(unfinished.nodes, 1);
}

#[test]
fn a_sequence_that_is_too_long_is_not_written_out() {
    let pt = net(&[0], &[[&[], &[(0, 1)]]]);
    let limits = Limits::default();
    let Coverable::Yes(way) = coverable(&pt, &[(PlaceId(0), FIRINGS)], &limits) else { panic!() };
    assert_eq!(way.firings.map(|it| it.len()), Some(1_000_000));
    let more = &[(PlaceId(0), FIRINGS + 1)];
    let Coverable::Yes(way) = coverable(&pt, more, &limits) else { panic!() };
    assert_eq!((way.length, way.firings), (1_000_001, None));
    let Coverable::Yes(way) = coverable(&pt, &[(PlaceId(0), u64::MAX - 1)], &limits) else {
        panic!()
    };
    assert_eq!((way.length, way.firings), (u128::from(u64::MAX) - 1, None));
}

#[test]
fn a_pump_of_astronomic_length_is_still_a_pump() {
    // A chain in which each place takes 1,000,000 tokens of the one before: the last ones pass any
    // number.
    let arcs: Vec<[Vec<(u32, u32)>; 2]> = std::iter::once([vec![], vec![(0, 1)]])
        .chain((0..9).map(|it| [vec![(it, 1_000_000)], vec![(it + 1, 1)]]))
        .collect();
    let arcs: Vec<[&[(u32, u32)]; 2]> =
        arcs.iter().map(|it| [it[0].as_slice(), it[1].as_slice()]).collect();
    let pt = net(&[0; 10], &arcs);
    let Bounded::No(growth) = bounded(&pt, &Limits::default()) else { panic!("it is unbounded") };
    assert_eq!((growth.stem.length, growth.pump.length), (0, 1));
    match coverable(&pt, &[(PlaceId(9), 1)], &Limits::default()) {
        Coverable::Yes(way) => assert_eq!(way.firings, None),
        Coverable::Unknown(unfinished) => assert_eq!(unfinished.limit, Limit::Tokens),
        Coverable::No => panic!("it is coverable"),
    }
    let Coverable::Yes(way) = coverable(&pt, &[(PlaceId(3), 1)], &Limits::default()) else {
        panic!()
    };
    assert_eq!((way.length, way.firings), (1_000_001_000_001_000_001, None));
}
