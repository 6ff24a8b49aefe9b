//! Whether the lists of a net fit together.

use super::data::{Arc, Law, Net, PlaceId, Role, Within};
use core::fmt;

/// A defect in the lists of a [`Net`].
///
/// ```
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_core::net::{NetError, PlaceId};
///
/// let mut net = OwnedNet::new("lamp", "");
/// net.place(OwnedPlace::new("off", 1)).unwrap();
/// net.transition(OwnedTransition::new("press").take(PlaceId(0), 1).give(PlaceId(7), 1)).unwrap();
/// assert_eq!(net.view().net().defect(), Some(NetError::UnknownId { transition: 0 }));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NetError {
    /// A list is longer than ids can count.
    TooLong,
    /// A transition names a place, event or output that the net does not have.
    UnknownId {
        /// The position of the transition.
        transition: usize,
    },
    /// A transition has an arc of weight zero, or names a place twice where it may only once.
    Arcs {
        /// The position of the transition.
        transition: usize,
    },
    /// A transition's interval ends before it begins, or only after 4,294,967,294 ms.
    Interval {
        /// The position of the transition.
        transition: usize,
    },
    /// A place has more tokens at the start than its bound, or the complement of a place is not
    /// one.
    Place {
        /// The position of the place.
        place: usize,
    },
    /// A law or an ignored event names something that the net does not have.
    Law,
    /// Two places, two events or two outputs have one name.
    Twice {
        /// In which list: places, events or outputs.
        list: &'static str,
        /// The position of one of them, behind another.
        at: usize,
    },
}

impl fmt::Display for NetError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::TooLong => write!(f, "a list has more entries than ids can count"),
            Self::UnknownId { transition } => write!(
                f,
                "transition {transition} names a place, an event or an output that the net does \
                 not have; add it, or name another"
            ),
            Self::Arcs { transition } => write!(
                f,
                "transition {transition} has an arc of weight 0, or names a place twice in what \
                 it gives, or in what it takes and reads; write one arc with the whole weight"
            ),
            Self::Interval { transition } => write!(
                f,
                "transition {transition} has an interval that ends before it begins, or after {} \
                 ms; leave the end out for one without end",
                Within::LATEST
            ),
            Self::Place { place } => write!(
                f,
                "place {place} has more tokens at the start than its bound or than can be played, \
                 or does not sum to the bound with the place that it complements"
            ),
            Self::Law => write!(
                f,
                "a law or an ignored event names something that the net does not have, a place \
                 twice, or one with weight 0"
            ),
            Self::Twice { list, at } => write!(
                f,
                "entry {at} of the {list} has the name of an earlier one; give each its own"
            ),
        }
    }
}

impl core::error::Error for NetError {}

impl Net<'_> {
    /// Returns the first defect of the lists, or `None`.
    pub fn defect(&self) -> Option<NetError> {
        let lists =
            [self.places.len(), self.events.len(), self.outputs.len(), self.transitions.len()];
        if lists.iter().any(|&length| u32::try_from(length).is_err()) {
            return Some(NetError::TooLong);
        }
        self.place_defect()
            .or_else(|| self.transition_defect())
            .or_else(|| self.law_defect())
            .or_else(|| self.name_defect())
    }

    fn name_defect(&self) -> Option<NetError> {
        let twice = |list, at: Option<usize>| at.map(|at| NetError::Twice { list, at });
        let names = |signals: &[super::Signal<'_>]| again(signals.len(), |at| signals[at].name);
        twice("places", again(self.places.len(), |at| self.places[at].name))
            .or_else(|| twice("events", names(self.events)))
            .or_else(|| twice("outputs", names(self.outputs)))
    }

    fn has(&self, place: PlaceId) -> bool {
        (place.0 as usize) < self.places.len()
    }

    fn place_defect(&self) -> Option<NetError> {
        let bad = |place: &super::Place<'_>| {
            let complements = |of: PlaceId| {
                let of = self.places.get(of.0 as usize);
                of.is_some_and(|of| {
                    of.bound == place.bound
                        && of.initial.checked_add(place.initial) == Some(of.bound)
                })
            };
            place.initial > place.bound
                || matches!(place.role, Role::Complement(of) if !complements(of))
        };
        self.places.iter().position(bad).map(|place| NetError::Place { place })
    }

    fn transition_defect(&self) -> Option<NetError> {
        self.transitions.iter().enumerate().find_map(|(transition, it)| {
            let needs = || it.take.iter().chain(it.read);
            let known = needs().chain(it.give).all(|arc| self.has(arc.place))
                && it.on.is_none_or(|event| (event.0 as usize) < self.events.len())
                && it.emits.iter().all(|output| (output.0 as usize) < self.outputs.len());
            let sound = once([it.take, it.read]) && once([it.give, &[]]);
            let timed = it.within.is_none_or(Within::is_sound);
            match (known, sound, timed) {
                (false, ..) => Some(NetError::UnknownId { transition }),
                (_, false, _) => Some(NetError::Arcs { transition }),
                (_, _, false) => Some(NetError::Interval { transition }),
                _ => None,
            }
        })
    }

    fn law_defect(&self) -> Option<NetError> {
        let ignored = |it: &super::Ignored<'_>| {
            (it.event.0 as usize) < self.events.len()
                && self.has(it.place)
                && it.guard.iter().all(|arc| self.has(arc.place))
                && once([it.guard, &[]])
        };
        let law = |law: &Law<'_>| match *law {
            Law::Invariant { sum, .. } => {
                sum.iter().all(|arc| self.has(arc.place)) && once([sum, &[]])
            }
            Law::NeverBoth(a, b) => self.has(a) && self.has(b),
            Law::Reachable(place) | Law::AlwaysCan(place) => self.has(place),
            Law::DeadlockFree { end } => end.is_none_or(|end| self.has(end)),
            Law::HandlesAll | Law::Settles | Law::Deterministic => true,
        };
        (!self.ignored.iter().all(ignored) || !self.laws.iter().all(law)).then_some(NetError::Law)
    }
}

/// Every weight counts and no place occurs twice in these lists together.
fn once(lists: [&[Arc]; 2]) -> bool {
    let arcs = || lists.into_iter().flatten();
    // Most lists are sorted, and long ones must be checked in one pass.
    let sorted = arcs().zip(arcs().skip(1)).all(|(before, arc)| before.place < arc.place);
    arcs().all(|arc| arc.weight > 0)
        && (sorted
            || arcs()
                .enumerate()
                .all(|(at, arc)| arcs().skip(at + 1).all(|other| other.place != arc.place)))
}

/// The position of a name that an earlier one has too. Nets made at run time can be large.
#[cfg(feature = "alloc")]
fn again<'n>(count: usize, name: impl Fn(usize) -> &'n str) -> Option<usize> {
    let mut order: alloc::vec::Vec<usize> = (0..count).collect();
    order.sort_unstable_by_key(|&at| (name(at), at));
    let twice = |pair: &&[usize]| name(pair[0]) == name(pair[1]);
    order.windows(2).filter(twice).map(|pair| pair[1]).min()
}

/// The position of a name that an earlier one has too. Without a heap nets are small.
#[cfg(not(feature = "alloc"))]
fn again<'n>(count: usize, name: impl Fn(usize) -> &'n str) -> Option<usize> {
    (0..count).find(|&at| (0..at).any(|earlier| name(earlier) == name(at)))
}
