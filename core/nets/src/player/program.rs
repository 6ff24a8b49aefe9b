//! The program of a [`Player`](super::Player): a packed system and its names.

use super::code::Code;
use super::outcome::EventNames;
use crate::net::data::{EventId, Net, OutputId, TransitionId};
use crate::system::data::{Of, System};
use core::fmt::Debug;

/// An event, with what it carries along.
pub trait Kind {
    /// The event. Nothing that it carries along decides anything.
    fn id(&self) -> Of<EventId>;
}

/// An event of a net alone.
impl Kind for EventId {
    #[inline]
    fn id(&self) -> Of<EventId> {
        Of { component: 0, id: *self }
    }
}

impl Kind for Of<EventId> {
    #[inline]
    fn id(&self) -> Of<EventId> {
        *self
    }
}

/// The names in a system, as types.
pub trait Names {
    /// Names of the events.
    type Event: Kind;
    /// The lines of its definition.
    type Transition: Copy + Debug + PartialEq + EventNames;
    /// Names of the outputs.
    type Output: Copy + Debug + PartialEq;

    /// The line of a transition.
    fn transition(&self, id: Of<TransitionId>) -> Self::Transition;

    /// The `at`-th of what a transition says.
    fn output(&self, id: Of<TransitionId>, at: usize) -> Option<Self::Output>;
}

/// A system, or a net alone, that can be played. [`net!`](crate::net!) and
/// [`system!`](crate::system!) make one without any bytes; [`Loaded`] is one made at run time.
///
/// `W` is the number of words of a marking, `C` that of transitions with an interval, and `S` that
/// of all that can wait in mailboxes: a player of other sizes does not compile.
///
/// ```compile_fail,E0599
/// cotama_core::net! {
///     /// Rings after a while.
///     pub mod bell {
///         places { Quiet: 1, Loud }
///         events { hush }
///         transitions { ring: Quiet => Loud after 1_000 ms; hush on hush: Loud => Quiet; }
///     }
/// }
/// use cotama_core::player::Player;
/// let bell = Player::<bell::Program, 1>::new(); // one word, and no clock: `bell::Player` has one
/// ```
pub trait Program<const W: usize, const C: usize = 0, const S: usize = 0>: Names {
    /// Whether it is a net alone, where that is known: then a player carries no code for what
    /// connects nets, or only that.
    const ALONE: Option<bool>;

    /// Whether what is proven of its code counts: [`Code::bounded`] and [`Code::settle`].
    const TRUSTED: bool = true;

    /// The packed system.
    fn code(&self) -> &Code<'_, W>;

    /// The system as plain data.
    fn system(&self) -> System<'_>;

    /// Returns the tokens taken by each transition of a net alone, by its number: for
    /// [steps](super::Player::step).
    fn takes(&self, transition: u16) -> [u64; W];

    /// The position in [`Code::entries`] of the `at`-th transition by priority, then by number.
    /// Only a net alone has one.
    fn ordered(&self, at: usize) -> Option<u16>;
}

/// A net whose `Role::State` places are those of a state machine, or are not.
pub trait StateMachine {
    /// Names of the places.
    type State: Copy + 'static;
    /// All states, in their order.
    const STATES: &'static [Self::State];
    /// Whether exactly one of them is marked at any time.
    const IS_ONE: bool;
}

/// The tables that synchronous steps need besides the code, for a net of `T` transitions.
#[derive(Clone, Copy, Debug)]
pub struct Steps<const T: usize, const W: usize> {
    /// The tokens taken by each transition, by its number.
    pub takes: [[u64; W]; T],
    /// Positions in [`Code::entries`] by priority, then by number.
    pub order: [u16; T],
}

impl<const T: usize, const W: usize> Steps<T, W> {
    /// Returns the tables of a net alone of `T` transitions.
    pub const fn of(system: &System<'_>, code: &Code<'_, W>) -> Self {
        let net = system.components[0].net;
        let mut steps = Self { takes: [[0; W]; T], order: [0; T] };
        let mut at = 0;
        while at < T {
            let number = code.entries[at].transition as usize;
            let mut arc = 0;
            while arc < net.transitions[number].take.len() {
                let it = net.transitions[number].take[arc];
                let field = code.fields[it.place.0 as usize];
                steps.takes[number][field.word as usize] += field.tokens(it.weight);
                arc += 1;
            }
            at += 1;
        }
        order(net, code, &mut steps.order);
        steps
    }
}

/// Positions of entries of a net alone, by priority, then by number.
pub(super) const fn order<const W: usize>(net: &Net<'_>, code: &Code<'_, W>, order: &mut [u16]) {
    let mut at = 0;
    while at < order.len() {
        let number = code.entries[at].transition as usize;
        let this = net.transitions[number].priority;
        let mut place = at;
        while place > 0 {
            let before = code.entries[order[place - 1] as usize].transition as usize;
            let high = net.transitions[before].priority;
            if high > this || high == this && before < number {
                break;
            }
            order[place] = order[place - 1];
            place -= 1;
        }
        order[place] = at as u16;
        at += 1;
    }
}

/// A system made at run time, packed.
///
/// ```
/// use cotama_core::net::{EventId, owned::{OwnedNet, OwnedPlace, OwnedTransition}};
/// use cotama_core::player::{Packed, Player};
/// use cotama_core::system::{Component, System};
/// use cotama_core::units::Millis;
///
/// let mut lamp = OwnedNet::new("lamp", "");
/// let off = lamp.place(OwnedPlace::new("off", 1)).unwrap();
/// let on = lamp.place(OwnedPlace::new("on", 0)).unwrap();
/// let press = lamp.event("press", "").unwrap();
/// lamp.transition(OwnedTransition::new("on").on(press).take(off, 1).give(on, 1)).unwrap();
/// let view = lamp.view();
/// let net = view.net();
/// let alone = [Component::alone(&net)];
/// let packed = Packed::<1>::alone(&net).unwrap();
/// let mut player: Player<_, 1> =
///     Player::start(packed.load(&System::alone(&alone)), Millis(0), &mut ());
/// assert!(player.offer(Millis(5), &EventId(0).into()).fired());
/// assert_eq!(player.tokens(on), 1);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Loaded<'c, const W: usize, const C: usize = 0, const S: usize = 0> {
    pub(super) system: System<'c>,
    pub(super) code: Code<'c, W>,
    pub(super) order: &'c [u16],
}

impl<const W: usize, const C: usize, const S: usize> Loaded<'_, W, C, S> {
    /// The same where it is known that no bound is ever exceeded: by a proof of the caller's.
    #[must_use]
    pub fn bounded(self) -> Self {
        Self { code: Code { bounded: true, ..self.code }, ..self }
    }
}

impl<const W: usize, const C: usize, const S: usize> Names for Loaded<'_, W, C, S> {
    type Event = Of<EventId>;
    type Transition = Of<TransitionId>;
    type Output = Of<OutputId>;

    #[inline]
    fn transition(&self, id: Of<TransitionId>) -> Of<TransitionId> {
        id
    }

    fn output(&self, id: Of<TransitionId>, at: usize) -> Option<Of<OutputId>> {
        let net = self.system.components.get(usize::from(id.component))?.net;
        let output = *net.transitions.get(id.id.0 as usize)?.emits.get(at)?;
        Some(Of { component: id.component, id: output })
    }
}

impl<const W: usize, const C: usize, const S: usize> Program<W, C, S> for Loaded<'_, W, C, S> {
    const ALONE: Option<bool> = None;

    #[inline]
    fn code(&self) -> &Code<'_, W> {
        &self.code
    }

    fn system(&self) -> System<'_> {
        self.system
    }

    fn takes(&self, transition: u16) -> [u64; W] {
        let mut take = [0_u64; W];
        let net = self.system.components.first().map(|it| it.net);
        let transition = net.and_then(|it| it.transitions.get(usize::from(transition)));
        for arc in transition.map_or(&[][..], |it| it.take) {
            if let Some(field) = self.code.fields.get(arc.place.0 as usize)
                && let Some(word) = take.get_mut(usize::from(field.word))
            {
                *word = word.wrapping_add(field.tokens(arc.weight));
            }
        }
        take
    }

    fn ordered(&self, at: usize) -> Option<u16> {
        self.order.get(at).copied()
    }
}

/// A program without trust in proofs: its player checks every firing against the bounds.
/// Laws speak of what a player does from its start on by [offers](super::Player::offer) and time;
/// where a marking may be another one, after a [restore](super::Player::restore) or a synchronous
/// [step](super::Player::step), only a checked program can be played. `net!` and `system!` name
/// such a player `Checked`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Checked<P>(pub P);

impl<P: Names> Names for Checked<P> {
    type Event = P::Event;
    type Transition = P::Transition;
    type Output = P::Output;

    #[inline]
    fn transition(&self, id: Of<TransitionId>) -> P::Transition {
        self.0.transition(id)
    }

    #[inline]
    fn output(&self, id: Of<TransitionId>, at: usize) -> Option<P::Output> {
        self.0.output(id, at)
    }
}

impl<P, const W: usize, const C: usize, const S: usize> Program<W, C, S> for Checked<P>
where
    P: Program<W, C, S>,
{
    const ALONE: Option<bool> = P::ALONE;
    const TRUSTED: bool = false;

    #[inline]
    fn code(&self) -> &Code<'_, W> {
        self.0.code()
    }

    fn system(&self) -> System<'_> {
        self.0.system()
    }

    fn takes(&self, transition: u16) -> [u64; W] {
        self.0.takes(transition)
    }

    fn ordered(&self, at: usize) -> Option<u16> {
        self.0.ordered(at)
    }
}

impl<P: StateMachine> StateMachine for Checked<P> {
    type State = P::State;
    const STATES: &'static [P::State] = P::STATES;
    const IS_ONE: bool = P::IS_ONE;
}
