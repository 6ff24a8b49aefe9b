//! The explicit engine: counts, shortest paths, graphs and liveness of textbook nets, families,
//! random and public nets.

mod families;
mod graphs;
mod limits;
mod plain;
mod public;
mod random;
mod ways;
mod wide;

use crate::numbered::net;
use cotama_core::net::{PlaceId, TransitionId};
use cotama_verification::explicit::{Limits, StateSpace, statespace};
use cotama_verification::property::{Atom, Formula, Linear};
use cotama_verification::pt::Pt;

/// All that is counted, on one thread and without limits.
fn space(pt: &Pt) -> StateSpace {
    statespace(pt, &Limits::default(), 1, &|_| ())
}

/// `place >= tokens`.
fn at_least(place: u32, tokens: i64) -> Formula {
    Formula::Atom(Atom::AtMost(Linear { constant: tokens, weights: vec![(PlaceId(place), -1)] }))
}

/// Fires transitions from the initial marking; each must be enabled.
fn fired(pt: &Pt, way: &[TransitionId]) -> Vec<u32> {
    way.iter().fold(pt.initial.clone(), |marking, it| {
        assert!(pt.enabled(&marking, it.0), "{it:?} is not enabled in {marking:?}");
        pt.fire(&marking, it.0).unwrap()
    })
}
