//! The conditions that transitions are required to have.

use cotama_core::net::{Arc, PlaceId, Transition};
use cotama_core::system::{Of, System, Target};

/// Every transition of a net that goes from the place `from` to the place `to` is enabled only
/// where places of the system are marked, so that it holds in any surroundings: also in those in
/// which nobody asks for it elsewhere.
#[derive(Clone, Copy, Debug)]
pub struct Guarded {
    /// The net, by its name in the system.
    pub net: &'static str,
    /// The places that the transitions leave.
    pub from: &'static str,
    /// The places that the transitions reach.
    pub to: &'static str,
    /// The places, each as `net.place`.
    pub by: &'static [&'static str],
}

impl Guarded {
    /// The transitions of a system that do not look at all of the places; of a system without such
    /// a net none.
    ///
    /// ```
    /// use cotama_models::cotama::{REQUIREMENTS, delivery};
    /// let mut guarded = REQUIREMENTS.iter().flat_map(|it| it.guarded);
    /// assert!(guarded.all(|it| it.unguarded(&delivery::SYSTEM).next().is_none()));
    /// ```
    pub fn unguarded<'s>(self, system: &System<'s>) -> impl Iterator<Item = &'s str> {
        let system = *system;
        let component = system.components.iter().zip(0..=u16::MAX).find(|it| it.0.name == self.net);
        component.into_iter().flat_map(move |(it, component)| {
            let net = it.net;
            let goes = move |arcs: &[Arc], to: &str| {
                arcs.iter()
                    .any(|arc| net.places.get(arc.place.0 as usize).is_some_and(|it| it.name == to))
            };
            let is_guarded = move |it: &Transition<'s>| {
                let reads = |by: &&str| {
                    it.read.iter().any(|arc| is_named(&system, Of { component, id: arc.place }, by))
                };
                self.by.iter().all(reads)
            };
            let is_meant =
                move |it: &&Transition<'s>| goes(it.take, self.from) && goes(it.give, self.to);
            net.transitions
                .iter()
                .filter(is_meant)
                .filter(move |it| !is_guarded(it))
                .map(|it| it.name)
        })
    }
}

/// Whether a place, or the one that it shares, is `net.place`.
fn is_named(system: &System<'_>, place: Of<PlaceId>, name: &str) -> bool {
    let target = system.bindings.iter().find(|it| it.shared == place).map(|it| it.target);
    let place = match target {
        None => place,
        Some(Target::Place(place)) => place,
        Some(Target::Mailbox(_)) => return false,
    };
    let component = system.components.get(usize::from(place.component));
    let of = component.and_then(|it| Some((it.name, it.net.places.get(place.id.0 as usize)?.name)));
    name.split_once('.') == of
}
