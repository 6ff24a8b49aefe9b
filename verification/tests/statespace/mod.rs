//! The explicit engine: counts, shortest ways, graphs and liveness of textbook nets, families,
//! random and public nets.

mod families;
mod graphs;
mod limits;
mod plain;
mod public;
mod random;
mod ways;
mod wide;

use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{PlaceId, TransitionId};
use cotama_verification::explicit::{Limits, StateSpace, statespace};
use cotama_verification::property::{Atom, Formula, Linear};
use cotama_verification::pt::Pt;

/// A net of places, given by their tokens, and transitions that take, read and give `(place,
/// weight)`.
fn net(initial: &[u32], transitions: &[[&[(u32, u32)]; 3]]) -> Pt {
    let mut net = OwnedNet::new("net", "");
    for (at, &tokens) in initial.iter().enumerate() {
        net.place(OwnedPlace::new(&format!("p{at}"), tokens)).unwrap();
    }
    for (at, [take, read, give]) in transitions.iter().enumerate() {
        let mut transition = OwnedTransition::new(&format!("t{at}"));
        for &(place, weight) in *take {
            transition = transition.take(PlaceId(place), weight);
        }
        for &(place, weight) in *read {
            transition = transition.read(PlaceId(place), weight);
        }
        for &(place, weight) in *give {
            transition = transition.give(PlaceId(place), weight);
        }
        net.transition(transition).unwrap();
    }
    Pt::from(&net.view().net())
}

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
