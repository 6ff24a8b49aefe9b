//! What a system does, told step by step.

use super::data::Of;
use crate::net::{EventId, TransitionId};
use crate::units::Millis;

/// What became of an event that was offered from outside, or that is read from a mailbox.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[must_use = "an event may have been ignored or refused"]
pub enum Offered {
    /// A transition fired.
    Fired(Of<TransitionId>),
    /// None did; the event is gone.
    Ignored,
    /// A transition could not fire because this mailbox, of this event, is full; nothing has
    /// happened.
    Refused {
        /// The event whose mailbox is full.
        full: Of<EventId>,
    },
    /// There is no such event, or the system is behind the time it was told.
    NotNow,
}

/// What happens inside, in the order in which it does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Happening<M> {
    /// A transition fired.
    Fired {
        /// Which.
        transition: Of<TransitionId>,
        /// On which event of its net; `None` when by itself.
        on: Option<Of<EventId>>,
        /// What the event carries along.
        carries: M,
        /// When.
        at: Millis,
    },
    /// A net ignored an event for good.
    Ignored {
        /// Which.
        event: Of<EventId>,
        /// What it carries along.
        carries: M,
    },
    /// Something was put into a mailbox.
    Mailed {
        /// Whose.
        to: Of<EventId>,
        /// What it carries along.
        carries: M,
    },
    /// Something was taken out of a mailbox by an event that empties it.
    Cleared {
        /// Whose.
        mailbox: Of<EventId>,
        /// What it carried along.
        carries: M,
    },
}

/// Is told what happens inside. `()` observes nothing; any closure that takes a [`Happening`] is
/// one.
pub trait Witness<M> {
    /// Something has happened.
    fn see(&mut self, happening: &Happening<M>);
}

impl<M> Witness<M> for () {
    #[inline]
    fn see(&mut self, _: &Happening<M>) {}
}

impl<M, F: FnMut(&Happening<M>)> Witness<M> for F {
    #[inline]
    fn see(&mut self, happening: &Happening<M>) {
        self(happening);
    }
}

/// What a round did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[must_use = "something may have been ignored or may still wait"]
pub struct Turned {
    /// How much was read and made a transition fire.
    pub fired: u32,
    /// How much was read and ignored.
    pub ignored: u32,
    /// In how many mailboxes something goes on waiting because another one is full.
    pub waiting: u32,
}
