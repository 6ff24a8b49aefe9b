//! The consequences of siphons with marked traps for deadlocks and liveness.

use super::class::class;
use super::siphon::Siphons;
use cotama_property::pt::Pt;

/// The proofs from the minimal siphons of a net; `None` where they prove nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Commoner {
    /// No reachable marking is dead.
    pub deadlock_free: Option<bool>,
    /// From every reachable marking every transition can fire again.
    pub live: Option<bool>,
}

/// Applies Commoner's theorem.
///
/// If no arc asks for more than one token, the empty places of a dead marking are a siphon. So a
/// net in which every siphon contains a marked trap is free of deadlocks. If it is also an
/// asymmetric-choice net, it is live. An extended free-choice net is live only if every siphon
/// contains a marked trap.
///
/// ```
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_verification::pt::Pt;
/// use cotama_checker::structural::{commoner, minimal_siphons};
///
/// let mut lamp = OwnedNet::new("lamp", "");
/// let off = lamp.place(OwnedPlace::new("off", 1)).unwrap();
/// let on = lamp.place(OwnedPlace::new("on", 0)).unwrap();
/// lamp.transition(OwnedTransition::new("press").take(off, 1).give(on, 1)).unwrap();
/// lamp.transition(OwnedTransition::new("release").take(on, 1).give(off, 1)).unwrap();
/// let lamp = Pt::from(&lamp.view().net());
/// let found = commoner(&lamp, &minimal_siphons(&lamp, 100, 1_000_000));
/// assert_eq!((found.deadlock_free, found.live), (Some(true), Some(true)));
/// ```
pub fn commoner(pt: &Pt, siphons: &Siphons) -> Commoner {
    let class = class(pt);
    let controlled = siphons.controlled() == Some(true);
    let single =
        (0..pt.transitions.len() as u32).all(|it| pt.needs.of(it).iter().all(|arc| arc.1 == 1));
    // An isolated place is a siphon that no transition waits for.
    let starves = siphons.siphons.iter().any(|it| {
        it.trap.is_none() && it.places.iter().any(|place| !pt.consumers.of(place.0).is_empty())
    });
    let live = if class.asymmetric_choice && controlled {
        Some(true)
    } else if class.extended_free_choice && starves {
        Some(false)
    } else {
        None
    };
    Commoner {
        deadlock_free: (controlled && single && !pt.transitions.is_empty()).then_some(true),
        live,
    }
}
