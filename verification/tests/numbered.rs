//! Nets without names, by the numbers of their places.

use cotama_core::net::PlaceId;
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_verification::pt::Pt;

/// Arcs: a place and a weight.
pub(crate) type Arcs<'a> = &'a [(u32, u32)];

/// A net of places, given by their tokens, and transitions: what each takes, what it reads where
/// there are three, and what it gives. A place that is both taken from and given to is needed.
pub(crate) fn net<const N: usize>(initial: &[u32], transitions: &[[Arcs<'_>; N]]) -> Pt {
    let mut net = OwnedNet::new("net", "");
    for (at, &tokens) in initial.iter().enumerate() {
        net.place(OwnedPlace::new(&format!("p{at}"), tokens)).unwrap();
    }
    for (at, arcs) in transitions.iter().enumerate() {
        let [take, between @ .., give] = &arcs[..] else { panic!("t{at} has one kind of arcs") };
        let mut transition = OwnedTransition::new(&format!("t{at}"));
        for &(place, weight) in *take {
            transition = transition.take(PlaceId(place), weight);
        }
        for &(place, weight) in between.iter().copied().flatten() {
            transition = transition.read(PlaceId(place), weight);
        }
        for &(place, weight) in *give {
            transition = transition.give(PlaceId(place), weight);
        }
        net.transition(transition).unwrap();
    }
    Pt::from(&net.view().net())
}
