//! A system as one net: the interleaving meaning of several nets.
//!
//! Every mailbox becomes two places, `net.event.waiting` and `net.event.room`. A transition on an
//! event that arrives by mail also takes it out of the mailbox; where no transition on it is
//! enabled, a transition of its own ignores it for good. A rendezvous becomes one transition with
//! what it makes others do, one for each combination of what they can do. What is mailed needs
//! room. An event that empties a mailbox is one transition for each number that can wait in it.
//!
//! Turns, priorities and the order in which a net reads its mailboxes are gone: any order is
//! possible, so what never happens here never happens in a round. Places keep their names, as
//! `net.place`; a place whose absence decides something gets a complement, `net.place.absent`.

mod branch;
mod error;
mod interleaving;
mod lowered;
mod moves;
mod observed;
mod observer;
mod path;
mod places;
mod rounds;
mod step;
mod turn;
mod walk;

pub use error::FlatError;
pub use observer::{Looks, Observer};
pub use path::Part;
pub use rounds::{Rounds, rounds};
pub use walk::{Happened, Size};

use cotama_core::net::owned::OwnedNet;
use cotama_core::system::System;
use interleaving::Flat;
use std::collections::BTreeSet;

/// The most transitions of a flat net.
pub const MOST_TRANSITIONS: usize = 100_000;

/// Makes a system one net.
///
/// # Errors
/// When it does not fit together, when the absence of tokens in a place without a bound decides, or
/// when the net would be too large.
///
/// ```
/// use cotama_core::{net, system};
/// use cotama_verification::check::{Model, Options, Verdict, check};
/// use cotama_verification::{flat::flat, property};
/// net! {
///     mod bell {
///         places { Here: 1 }
///         events { press }
///         outputs { ring }
///         transitions { ring on press: Here => Here emit ring; }
///     }
/// }
/// net! {
///     mod dog {
///         places { Asleep: 1, Awake }
///         events { heard }
///         transitions { wake on heard: Asleep => Awake; }
///         ignore { heard in Awake; }
///     }
/// }
/// system! { mod house { nets { bell: bell, dog: dog } links { bell.ring => dog.heard mail 2; } } }
/// # fn main() {
/// let net = flat(&house::SYSTEM).unwrap();
/// let model = Model::from(&net.view().net());
/// let wakes = property::parse("EF dog.Awake", model.pt()).unwrap();
/// assert_eq!(check(&model, &wakes, &Options::default()).verdict, Verdict::Holds(true));
/// # }
/// ```
pub fn flat(system: &System<'_>) -> Result<OwnedNet, FlatError> {
    if let Some(defect) = system.defect() {
        return Err(FlatError::Defect(defect));
    }
    // The first pass finds out of which places the absence decides something.
    let mut first = Flat::new(system, BTreeSet::new());
    first.build()?;
    let mut second = Flat::new(system, first.wanted);
    second.build()?;
    Ok(second.net)
}
