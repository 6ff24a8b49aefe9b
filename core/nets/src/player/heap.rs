//! Systems made at run time, packed on the heap so that a [`Player`](super::Player) plays them.

use super::LARGEST;
use super::memory::Packed;
use super::program::{Loaded, order};
use super::size::size;
use crate::net::data::Net;
use crate::net::defect::NetError;
use crate::system::data::{Component, System};
use crate::system::defect::SystemError;

/// How many machine words a marking of this system needs; `None` when it has too many places,
/// events, transitions or links to be played.
pub fn words(system: &System<'_>) -> Option<usize> {
    size(system).map(|size| size.words)
}

/// Returns the most events that can wait in all mailboxes of this system together: the `S` of its
/// player, at least.
pub fn slots(system: &System<'_>) -> usize {
    size(system).map_or(0, |size| size.slots)
}

/// How many transitions of this system have an interval: the `C` of its player, at least.
pub fn clocks(system: &System<'_>) -> usize {
    let transitions = system.components.iter().flat_map(|it| it.net.transitions);
    transitions.filter(|it| it.within.is_some()).count()
}

impl<const W: usize, const C: usize, const S: usize> Packed<W, C, S> {
    /// Packs a system. Places of which no bound is claimed hold up to [`LARGEST`] tokens.
    ///
    /// # Errors
    /// The defect of the system or of one of its nets; [`NetError::Place`] when a place starts with
    /// more than that; [`SystemError::TooLong`] when it has too many parts, `W` is less than
    /// [`words`], `C` less than [`clocks`], or `S` less than [`slots`].
    pub fn of(system: &System<'_>) -> Result<Self, SystemError> {
        for (component, it) in (0..).zip(system.components) {
            let large = || it.net.places.iter().position(|place| place.initial > LARGEST);
            let defect = it.net.defect().or_else(|| Some(NetError::Place { place: large()? }));
            if let Some(defect) = defect {
                return Err(SystemError::Net { component, defect });
            }
        }
        if let Some(defect) = system.defect() {
            return Err(defect);
        }
        let fits = |it: &super::code::Size| it.words <= W && it.clocks <= C && it.slots <= S;
        let size = size(system).filter(fits).ok_or(SystemError::TooLong)?;
        let mut it = Self::sound(system, &size);
        if let [alone] = system.components {
            let mut by_priority = alloc::vec![0; size.entries];
            order(alone.net, &it.code(), &mut by_priority);
            it.order = by_priority;
        }
        Ok(it)
    }

    /// Packs a net alone; see [`of`](Self::of).
    ///
    /// # Errors
    /// The defect of the net; [`NetError::TooLong`] also when it does not fit.
    pub fn alone(net: &Net<'_>) -> Result<Self, NetError> {
        Self::of(&System::alone(&[Component::alone(net)])).map_err(|defect| match defect {
            SystemError::Net { defect, .. } => defect,
            _ => NetError::TooLong,
        })
    }

    /// The program for a player; `system` is the one that was packed.
    pub fn load<'c>(&'c self, system: &System<'c>) -> Loaded<'c, W, C, S> {
        Loaded { system: *system, code: self.code(), order: &self.order }
    }
}
