//! Families of nets: one net for each number `n`, known in the literature with its counts; and
//! [teams](crate::team::protocol).
//!
//! They are plain place/transition nets, without events and time, to measure and to test checkers
//! with. Played, they would fire for ever by themselves. What is known of them is stated as laws.
//!
//! ```
//! use cotama_models::nets::families::{PHILOSOPHERS, philosophers};
//!
//! let net = philosophers(5).unwrap();
//! assert_eq!((net.places.len(), net.transitions.len()), (25, 25));
//! let error = PHILOSOPHERS.net(1).unwrap_err();
//! assert_eq!(error.to_string(), "there is no philosophers:1; n is from 2 to 10000");
//! ```

mod fms;
mod kanban;
mod philosophers;
mod swimming_pool;
mod team;
mod token_ring;

pub use fms::{FMS, fms};
pub use kanban::{KANBAN, kanban};
pub use philosophers::{PHILOSOPHERS, philosophers};
pub use swimming_pool::{SWIMMING_POOL, swimming_pool};
pub use team::{TEAM, TEAM_OLD, TEAM_TEXT};
pub use token_ring::{TOKEN_RING, token_ring};

use cotama_core::net::owned::{OwnedLaw, OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{Arc, PlaceId};

/// A family of nets.
///
/// ```
/// use cotama_models::nets::families::KANBAN;
/// assert_eq!((KANBAN.name, KANBAN.least, KANBAN.most), ("kanban", 1, 65_535));
/// assert_eq!(KANBAN.net(5).unwrap().name, "kanban_5");
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// Name of the family.
    pub name: &'static str,
    /// Description of the family.
    pub description: &'static str,
    /// The smallest `n`.
    pub least: u32,
    /// The largest `n`: the net takes at most some 100 megabytes, and no place starts with more
    /// than 65,535 tokens.
    pub most: u32,
    grow: fn(&mut Draft, u32),
}

impl Family {
    /// The net for `n`.
    ///
    /// # Errors
    /// When `n` is less than [`Family::least`] or more than [`Family::most`].
    pub fn net(&self, n: u32) -> Result<OwnedNet, OutOfRange> {
        let Self { name: family, least, most, .. } = *self;
        if !(least..=most).contains(&n) {
            return Err(OutOfRange { family, asked: n, least, most });
        }
        let mut draft = Draft { net: OwnedNet::new(&format!("{family}_{n}"), self.description) };
        (self.grow)(&mut draft, n);
        Ok(draft.net)
    }
}

/// A family has no net for this number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OutOfRange {
    /// The family.
    pub family: &'static str,
    /// The number.
    pub asked: u32,
    /// The smallest that there is.
    pub least: u32,
    /// The largest that there is.
    pub most: u32,
}

impl core::fmt::Display for OutOfRange {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { family, asked, least, most } = self;
        write!(f, "there is no {family}:{asked}; n is from {least} to {most}")
    }
}

impl core::error::Error for OutOfRange {}

/// A net in the making. Families are small enough for ids to count their parts.
struct Draft {
    net: OwnedNet,
}

impl Draft {
    fn place(&mut self, name: &str, tokens: u32, bound: u32) -> PlaceId {
        self.net.places.push(OwnedPlace::new(name, tokens).at_most(bound));
        PlaceId(self.net.places.len() as u32 - 1)
    }

    /// A transition with weights of one. A place that it takes from and gives to as well is read.
    fn transition(&mut self, name: &str, from: &[PlaceId], to: &[PlaceId]) {
        let line = self.net.transitions.len() as u32;
        let arc = |&place: &PlaceId| Arc { place, weight: 1 };
        let (read, take) = from.iter().map(arc).partition(|arc| to.contains(&arc.place));
        let give = to.iter().filter(|place| !from.contains(place)).map(arc).collect();
        self.net.transitions.push(OwnedTransition {
            line,
            take,
            read,
            give,
            ..OwnedTransition::new(name)
        });
    }

    fn invariant(&mut self, places: &[PlaceId], equals: u32) {
        let sum = places.iter().map(|&place| Arc { place, weight: 1 }).collect();
        self.law(OwnedLaw::Invariant { sum, equals });
    }

    fn law(&mut self, law: OwnedLaw) {
        self.net.laws.push(law);
    }
}
