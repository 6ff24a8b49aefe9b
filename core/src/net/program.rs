//! What a [`Player`](super::Player) plays: a packed net and the types of its events.

use super::code::Code;
use super::data::{EventId, Law, Net, OutputId, Place, TransitionId};
use core::fmt::Debug;

/// An event, with what it carries along.
pub trait Kind {
    /// Which event of the net it is. What it carries along cannot decide anything.
    fn id(&self) -> EventId;
}

impl Kind for EventId {
    #[inline]
    fn id(&self) -> EventId {
        *self
    }
}

/// A net that can be played. `net!` makes one without any bytes; [`Loaded`] is one of a net made at
/// run time.
///
/// `W` is the number of words of a marking.
pub trait Program<const W: usize> {
    /// Its events.
    type Event: Kind;
    /// The lines of its definition.
    type Transition: Copy + Debug + PartialEq;
    /// Its outputs.
    type Output: Copy + Debug + PartialEq + 'static;

    /// The packed net.
    fn code(&self) -> Code<'_, W>;

    /// The line of a transition.
    fn transition(&self, id: TransitionId) -> Self::Transition;

    /// What a transition says.
    fn outputs(&self, id: TransitionId) -> &[Self::Output];

    /// What is claimed of the net.
    fn laws(&self) -> &[Law<'_>];

    /// The places of the net.
    fn places(&self) -> &[Place<'_>];
}

/// A net whose `Role::State` places are those of a state machine, or are not.
pub trait StateMachine {
    /// Its places.
    type State: Copy + 'static;
    /// All of them.
    const STATES: &'static [Self::State];
    /// Whether exactly one of them is marked at any time.
    const IS_ONE: bool;
}

/// A net made at run time, packed.
#[derive(Clone, Copy, Debug)]
pub struct Loaded<'c, const W: usize> {
    /// The net.
    pub net: Net<'c>,
    /// The same, packed.
    pub code: Code<'c, W>,
}

impl<const W: usize> Program<W> for Loaded<'_, W> {
    type Event = EventId;
    type Transition = TransitionId;
    type Output = OutputId;

    #[inline]
    fn code(&self) -> Code<'_, W> {
        self.code
    }

    #[inline]
    fn transition(&self, id: TransitionId) -> TransitionId {
        id
    }

    fn outputs(&self, id: TransitionId) -> &[OutputId] {
        self.net.transitions.get(id.0 as usize).map_or(&[], |it| it.emits)
    }

    fn laws(&self) -> &[Law<'_>] {
        self.net.laws
    }

    fn places(&self) -> &[Place<'_>] {
        self.net.places
    }
}

impl<const W: usize, P: Program<W>> Program<W> for &P {
    type Event = P::Event;
    type Transition = P::Transition;
    type Output = P::Output;

    #[inline]
    fn code(&self) -> Code<'_, W> {
        P::code(self)
    }

    #[inline]
    fn transition(&self, id: TransitionId) -> P::Transition {
        P::transition(self, id)
    }

    #[inline]
    fn outputs(&self, id: TransitionId) -> &[P::Output] {
        P::outputs(self, id)
    }

    fn laws(&self) -> &[Law<'_>] {
        P::laws(self)
    }

    fn places(&self) -> &[Place<'_>] {
        P::places(self)
    }
}

/// A transition that has just fired.
#[derive(Debug)]
pub struct Firing<'f, E, T, O> {
    /// The line of the definition.
    pub transition: T,
    /// The transition.
    pub id: TransitionId,
    /// The event, with what it carries along; `None` for one that fires by itself.
    pub event: Option<&'f E>,
    /// What it says, in this order.
    pub outputs: &'f [O],
    /// When it fired. A transition that was due earlier than the player was told so fired when it
    /// was due.
    pub at: crate::units::Millis,
}

/// What [`Observer::on_fire`] of a player of this program gets.
pub type FiringOf<'f, P, const W: usize> =
    Firing<'f, <P as Program<W>>::Event, <P as Program<W>>::Transition, <P as Program<W>>::Output>;

/// Is told every transition that fires: where actions, logs and recorders hang on. `()` observes
/// nothing and costs nothing; any closure that takes a [`Firing`] is one.
pub trait Observer<E, T, O> {
    /// A transition has fired.
    fn on_fire(&mut self, firing: &Firing<'_, E, T, O>);
}

impl<E, T, O> Observer<E, T, O> for () {
    #[inline]
    fn on_fire(&mut self, _: &Firing<'_, E, T, O>) {}
}

impl<E, T, O, F: FnMut(&Firing<'_, E, T, O>)> Observer<E, T, O> for F {
    #[inline]
    fn on_fire(&mut self, firing: &Firing<'_, E, T, O>) {
        self(firing);
    }
}
