//! Answers of a player.

use crate::net::data::{EventId, TransitionId};
use crate::system::data::{Of, System};
use core::fmt;
use core::marker::PhantomData;

/// The outcome of an event.
///
/// ```
/// use cotama_core::{net, player::{Outcome, Why}, units::Millis};
/// net! {
///     mod lamp {
///         places { Off: 1, On, Warm }
///         events { press }
///         transitions { on on press: Off => On; heat: On => Warm; }
///     }
/// }
/// let mut lamp = lamp::Player::new();
/// let fired = Outcome::Fired { transition: lamp::Transition::on, settled: 1 }; // `heat` too
/// assert_eq!(lamp.offer(Millis(0), &lamp::Event::press), fired);
/// let ignored = Outcome::Ignored { why: Why::NotEnabled };
/// assert_eq!(lamp.offer(Millis(1), &lamp::Event::press), ignored);
/// ```
///
/// `Debug` says a mailbox by its name, as `Refused { full: arm.take }`, where the type of a line
/// [knows names](EventNames).
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[must_use = "an event may have been ignored or refused"]
pub enum Outcome<T> {
    /// A transition fired.
    Fired {
        /// The transition that fired first.
        transition: T,
        /// How many more fired at the same instant: by a rendezvous, or at once by themselves.
        settled: u32,
    },
    /// No transition fired; the event is gone.
    Ignored {
        /// The reason.
        why: Why<T>,
    },
    /// A transition could not fire because this mailbox, of this event, is full; nothing has
    /// happened.
    Refused {
        /// The event whose mailbox is full.
        full: Of<EventId>,
    },
}

impl<T> Outcome<T> {
    /// Whether a transition fired.
    pub const fn fired(&self) -> bool {
        matches!(self, Self::Fired { .. })
    }

    /// The same with transitions told in another way.
    #[inline]
    pub fn map<U>(self, f: impl FnOnce(T) -> U) -> Outcome<U> {
        match self {
            Self::Fired { transition, settled } => {
                Outcome::Fired { transition: f(transition), settled }
            }
            Self::Ignored { why } => Outcome::Ignored {
                why: match why {
                    Why::OnPurpose => Why::OnPurpose,
                    Why::NotEnabled => Why::NotEnabled,
                    Why::TooEarly(it) => Why::TooEarly(f(it)),
                    Why::TooLate(it) => Why::TooLate(f(it)),
                    Why::Full(it) => Why::Full(f(it)),
                    Why::Behind => Why::Behind,
                    Why::NoSuchEvent => Why::NoSuchEvent,
                },
            },
            Self::Refused { full } => Outcome::Refused { full },
        }
    }
}

/// Names of events, known by the type of a line: `net!` and `system!` make types that know their
/// names.
pub trait EventNames {
    /// Writes the name of an event, `NET.EVENT` in a system; where no names are known, its numbers.
    ///
    /// # Errors
    /// When the writer has one.
    fn event(event: Of<EventId>, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{event:?}")
    }

    /// Writes the name of an event of a system.
    ///
    /// # Errors
    /// When the writer has one.
    fn event_of(
        system: &System<'_>,
        event: Of<EventId>,
        f: &mut fmt::Formatter<'_>,
    ) -> fmt::Result {
        let component = system.components.get(usize::from(event.component));
        match component.and_then(|it| Some((it, it.net.events.get(event.id.0 as usize)?))) {
            Some((_, named)) if system.is_alone() => f.write_str(named.name),
            Some((it, named)) => write!(f, "{}.{}", it.name, named.name),
            None => write!(f, "{event:?}"),
        }
    }
}

impl EventNames for Of<TransitionId> {}
impl EventNames for u16 {}

/// An event that is written by its name.
pub(super) struct ByName<T>(pub(super) Of<EventId>, pub(super) PhantomData<T>);

impl<T: EventNames> fmt::Debug for ByName<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        T::event(self.0, f)
    }
}

impl<T: EventNames + fmt::Debug> fmt::Debug for Outcome<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fired { transition, settled } => f
                .debug_struct("Fired")
                .field("transition", transition)
                .field("settled", settled)
                .finish(),
            Self::Ignored { why } => f.debug_struct("Ignored").field("why", why).finish(),
            Self::Refused { full } => {
                let full = ByName::<T>(*full, PhantomData);
                f.debug_struct("Refused").field("full", &full).finish()
            }
        }
    }
}

/// Why an event is ignored. When a transition on it has its tokens: what else the first such one
/// lacks, even where the event is ignored on purpose.
///
/// ```
/// use cotama_core::{net, player::{Outcome::Ignored, Why}, units::Millis};
/// net! {
///     mod safe {
///         places { Locked: 1, Open }
///         events { turn, shut }
///         transitions { open on turn: Locked => Open within 100..=200 ms; }
///         ignore { shut in Locked; }
///     }
/// }
/// use safe::{Event, Transition};
/// let mut safe = safe::Player::new();
/// let why = |outcome| match outcome { Ignored { why } => Some(why), _ => None };
/// let early = why(safe.offer(Millis(50), &Event::turn));
/// assert_eq!(early, Some(Why::TooEarly(Transition::open)));
/// assert_eq!(why(safe.offer(Millis(60), &Event::shut)), Some(Why::OnPurpose));
/// let late = why(safe.offer(Millis(300), &Event::turn));
/// assert_eq!(late, Some(Why::TooLate(Transition::open)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Why<T> {
    /// A marked place ignores it on purpose.
    OnPurpose,
    /// No transition on it has the tokens it needs.
    NotEnabled,
    /// This one has, but its interval has not begun.
    TooEarly(T),
    /// This one has, but its interval is over.
    TooLate(T),
    /// This one has, but a place would hold more than its bound.
    Full(T),
    /// The player is behind the time it was told: [`Player::advance`](super::Player::advance) it
    /// first.
    Behind,
    /// There is no such event.
    NoSuchEvent,
}

/// The outcome of passing time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[must_use = "the player may be behind"]
pub struct Advanced {
    /// How many transitions fired.
    pub fired: u32,
    /// Whether there is more to catch up with than [`CATCH_UP`](super::CATCH_UP) transitions: call
    /// again.
    pub behind: bool,
}

/// The outcome of a round.
///
/// ```
/// use cotama_core::{net, player::Round, system, units::Millis};
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
///     }
/// }
/// system! { mod house { nets { bell: bell, dog: dog } links { bell.ring => dog.heard mail 2; } } }
/// # fn main() {
/// let mut house = house::Player::new();
/// let press = house::Event::bell(bell::Event::press);
/// assert!(house.offer(Millis(0), &press).fired() && house.offer(Millis(1), &press).fired());
/// // The first wakes the dog; to the second it does not listen.
/// assert_eq!(house.round(Millis(10)), Round { fired: 1, ignored: 1, ..Round::default() });
/// # }
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[must_use = "something may have been ignored or may still wait"]
pub struct Round {
    /// How much was read and made a transition fire.
    pub fired: u32,
    /// How much was read and ignored.
    pub ignored: u32,
    /// The number of mailboxes in which something goes on waiting because another one is full.
    pub waiting: u32,
    /// Whether there was no round: there is more to catch up with first, so call again.
    pub behind: bool,
}

/// The outcome of a synchronous step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[must_use = "an event may have been ignored"]
pub struct Stepped {
    /// How many transitions fired.
    pub fired: u32,
    /// Bit `i` is set when no transition on the `i`-th of the events fired; of the first 64.
    pub ignored: u64,
    /// Whether nothing happened because a place would have held more than its bound. Not in a net
    /// whose bounds are proven.
    pub full: bool,
}
