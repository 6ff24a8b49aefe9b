//! A player of any system, whatever its size.

use super::numbered::{Numbered, Seat};
use alloc::borrow::ToOwned;
use alloc::boxed::Box;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;
use cotama_core::net::{EventId, NetError, Place, PlaceId, TransitionId};
use cotama_core::player::{
    Checked, Firing, Loaded, Outcome, Packed, Player, Stepped, Why, clocks, words,
};
use cotama_core::system::owned::OwnedSystem;
use cotama_core::system::{System, SystemError};
use cotama_core::units::Millis;

/// The largest sizes of the players, of which there are few, as each has code of its own: machine
/// words of a marking, transitions with an interval, and what waits in mailboxes. Nothing is
/// carried along, so slots take no memory.
const MOST_WORDS: usize = 256;
const MOST_CLOCKS: usize = 256;
const SMALL: usize = 16;
const SLOTS: usize = u16::MAX as usize;

/// A transition that fired, by its number on the [`Numbered`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Fired {
    /// The transition.
    pub transition: TransitionId,
    /// Time of the firing.
    pub at: Millis,
    /// True if an event that was offered from outside made it fire.
    pub offered: bool,
}

/// Why no transition uses an event that is offered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unused {
    /// The event is ignored.
    Ignored(Why<TransitionId>),
    /// A mailbox on the way is full, and nothing has happened.
    Full {
        /// The place on the [`Numbered`] that counts what waits in it.
        mailbox: PlaceId,
    },
}

/// A net or a system in play. Numbers are those of its [`Numbered`].
pub trait Game<'c> {
    /// As [`Player::now`].
    fn now(&self) -> Millis;
    /// As [`Player::wake_at`].
    fn wake_at(&self) -> Option<Millis>;
    /// As [`Player::round_is_due`].
    fn round_is_due(&self) -> bool;
    /// The tokens of a place, or what waits in a mailbox.
    fn tokens(&self, place: PlaceId) -> u32;
    /// As [`Player::advance`]; whether there is more to catch up with.
    fn advance(&mut self, to: Millis, fired: &mut Vec<Fired>) -> bool;
    /// As [`Player::offer`].
    ///
    /// # Errors
    /// Why nothing fired.
    fn offer(
        &mut self,
        at: Millis,
        event: EventId,
        fired: &mut Vec<Fired>,
    ) -> Result<TransitionId, Unused>;
    /// As [`Player::round`]; whether there is more to catch up with first.
    fn round(&mut self, at: Millis, fired: &mut Vec<Fired>) -> bool;
    /// As [`Player::step`], which a net alone has.
    fn step(&mut self, at: Millis, events: &[EventId], fired: &mut Vec<Fired>) -> Stepped;
    /// The same game, to go on with in another way.
    fn fork(&self) -> Box<dyn Game<'c> + 'c>;
    /// Returns marking and clocks: two games of one system where these and the time are the same go
    /// on alike.
    fn state(&self) -> Vec<u64>;
}

/// The player of a game: bounds are checked, so that steps can be taken too.
type Played<'c, const W: usize, const C: usize> = Checked<Loaded<'c, W, C, SLOTS>>;

#[derive(Clone, Copy)]
struct Playing<'c, const W: usize, const C: usize> {
    player: Player<Played<'c, W, C>, W, C, SLOTS>,
    numbered: &'c Numbered,
}

type Seen<'f, 'c, const W: usize, const C: usize> = Firing<'f, Played<'c, W, C>>;

fn told<const W: usize, const C: usize>(numbered: &Numbered, it: &Seen<'_, '_, W, C>) -> Fired {
    Fired { transition: numbered.number(it.id), at: it.at, offered: it.event.is_some() }
}

impl<'c, const W: usize, const C: usize> Game<'c> for Playing<'c, W, C> {
    fn now(&self) -> Millis {
        self.player.now()
    }

    fn wake_at(&self) -> Option<Millis> {
        self.player.wake_at()
    }

    fn round_is_due(&self) -> bool {
        self.player.round_is_due()
    }

    fn tokens(&self, place: PlaceId) -> u32 {
        match self.numbered.seat(place) {
            Some(Seat::Place(place)) => self.player.tokens(place),
            Some(Seat::Mailbox(event)) => self.player.waiting(&event),
            Some(Seat::Complement { of, bound }) => bound.saturating_sub(self.player.tokens(of)),
            None => 0,
        }
    }

    fn advance(&mut self, to: Millis, fired: &mut Vec<Fired>) -> bool {
        let numbered = self.numbered;
        let mut observer = |it: &Seen<'_, 'c, W, C>| fired.push(told(numbered, it));
        self.player.advance_with(to, &mut observer).behind
    }

    fn offer(
        &mut self,
        at: Millis,
        event: EventId,
        fired: &mut Vec<Fired>,
    ) -> Result<TransitionId, Unused> {
        let numbered = self.numbered;
        let Some(event) = numbered.event_of(event) else {
            return Err(Unused::Ignored(Why::NoSuchEvent));
        };
        let mut observer = |it: &Seen<'_, 'c, W, C>| fired.push(told(numbered, it));
        match self.player.offer_with(at, &event, &mut observer).map(|it| numbered.number(it)) {
            Outcome::Fired { transition, .. } => Ok(transition),
            Outcome::Ignored { why } => Err(Unused::Ignored(why)),
            Outcome::Refused { full } => Err(Unused::Full { mailbox: numbered.mailbox(full) }),
        }
    }

    fn round(&mut self, at: Millis, fired: &mut Vec<Fired>) -> bool {
        let numbered = self.numbered;
        let mut observer = |it: &Seen<'_, 'c, W, C>| fired.push(told(numbered, it));
        self.player.round_with(at, &mut observer).behind
    }

    fn step(&mut self, at: Millis, events: &[EventId], fired: &mut Vec<Fired>) -> Stepped {
        let numbered = self.numbered;
        let events: Vec<_> = events.iter().filter_map(|&it| numbered.event_of(it)).collect();
        let mut observer = |it: &Seen<'_, 'c, W, C>| fired.push(told(numbered, it));
        self.player.step_with(at, &events, &mut observer)
    }

    fn fork(&self) -> Box<dyn Game<'c> + 'c> {
        Box::new(*self)
    }

    fn state(&self) -> Vec<u64> {
        let (marking, clocks) = (self.player.marking(), self.player.clocks());
        let used = marking.iter().rposition(|&it| it != 0).map_or(0, |it| it + 1);
        let running = clocks.iter().zip(0_u64..).filter(|it| *it.0 != 0);
        let running = running.map(|(&elapsed, at)| at << 32 | u64::from(elapsed));
        core::iter::once(used as u64)
            .chain(marking[..used].iter().copied())
            .chain(running)
            .collect()
    }
}

/// A continuation for a game that has just begun, with the transitions that fired at its start.
type Then<'t> = dyn for<'c> FnMut(Box<dyn Game<'c> + 'c>, Vec<Fired>) + 't;

impl Numbered {
    /// Plays it from its start, at this time.
    ///
    /// # Errors
    /// Why it cannot be played.
    pub fn play(&self, start: Millis, then: &mut Then<'_>) -> Result<(), NotPlayed> {
        self.with_system(|system| match Size::of(system)? {
            Size::Small => {
                let packed = packed::<SMALL, SMALL>(system)?;
                let (game, fired) = self.begin(packed.load(system), start);
                then(game, fired);
                Ok(())
            }
            Size::Large => {
                let packed = packed::<MOST_WORDS, MOST_CLOCKS>(system)?;
                let (game, fired) = self.begin(packed.load(system), start);
                then(game, fired);
                Ok(())
            }
        })
    }

    /// Plays it from its start, at this time, for as long as the program runs: its memory is never
    /// given back. Returns the numbers, the game, and the transitions that fired at its start.
    ///
    /// # Errors
    /// Why it cannot be played.
    pub fn leak(self, start: Millis) -> Result<Leaked, NotPlayed> {
        let it: &'static Self = Box::leak(Box::new(self));
        let system: &'static _ =
            Box::leak(Box::new(it.with_system(|it| OwnedSystem::from(it)).leak()));
        let (game, fired) = match Size::of(system)? {
            Size::Small => {
                let packed: &'static _ = Box::leak(Box::new(packed::<SMALL, SMALL>(system)?));
                it.begin(packed.load(system), start)
            }
            Size::Large => {
                let packed = packed::<MOST_WORDS, MOST_CLOCKS>(system)?;
                let packed: &'static _ = Box::leak(Box::new(packed));
                it.begin(packed.load(system), start)
            }
        };
        Ok((it, game, fired))
    }

    fn begin<'c, const W: usize, const C: usize>(
        &'c self,
        program: Loaded<'c, W, C, SLOTS>,
        start: Millis,
    ) -> (Box<dyn Game<'c> + 'c>, Vec<Fired>) {
        let mut fired = Vec::new();
        let mut observer = |it: &Seen<'_, 'c, W, C>| fired.push(told(self, it));
        let player = Player::<_, W, C, SLOTS>::start(Checked(program), start, &mut observer);
        (Box::new(Playing { player, numbered: self }), fired)
    }
}

/// A game that lasts as long as the program.
pub type Leaked = (&'static Numbered, Box<dyn Game<'static>>, Vec<Fired>);

/// The player that is large enough: each size is a program of its own to compile, so there are two.
enum Size {
    Small,
    Large,
}

impl Size {
    fn of(system: &System<'_>) -> Result<Self, NotPlayed> {
        match (words(system), clocks(system)) {
            (Some(0..=SMALL), 0..=SMALL) => Ok(Self::Small),
            (Some(0..=MOST_WORDS), 0..=MOST_CLOCKS) => Ok(Self::Large),
            (Some(0..=MOST_WORDS), clocks) => Err(NotPlayed::Clocks(clocks)),
            (Some(words), _) => {
                let mut places = system.components.iter().flat_map(|it| it.net.places);
                let unbounded = places.any(|it| it.bound == Place::UNBOUNDED);
                Err(NotPlayed::Words { words, unbounded })
            }
            (None, _) => Err(NotPlayed::Parts),
        }
    }
}

fn packed<const W: usize, const C: usize>(
    system: &System<'_>,
) -> Result<Packed<W, C, SLOTS>, NotPlayed> {
    Packed::of(system).map_err(|it| refused(system, it))
}

/// Why a net or a system cannot be played.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NotPlayed {
    /// A marking is too large.
    Words {
        /// The machine words that it needs.
        words: usize,
        /// True if a place has no bound: it takes 17 bits, and a 1-safe place 2.
        unbounded: bool,
    },
    /// More than 65,533 places, events or transitions.
    Parts,
    /// So many transitions have an interval, which is too many.
    Clocks(usize),
    /// This place starts with more than its bound, or more than 65,535 tokens.
    Place(String),
    /// The net or the system does not fit together.
    Defect(SystemError),
}

fn refused(system: &System<'_>, defect: SystemError) -> NotPlayed {
    match defect {
        SystemError::Net { component, defect: NetError::Place { place } } => {
            let net = system.components.get(usize::from(component)).map(|it| it.net);
            let name = net.and_then(|it| it.places.get(place)).map_or("?", |it| it.name);
            NotPlayed::Place(name.to_owned())
        }
        SystemError::TooLong => NotPlayed::Parts,
        other => NotPlayed::Defect(other),
    }
}

impl fmt::Display for NotPlayed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let large = "the net is too large to be played";
        match self {
            Self::Words { words, .. } => {
                write!(
                    f,
                    "{large}: a marking needs {words} machine words, and {MOST_WORDS} are the most"
                )
            }
            Self::Parts => {
                write!(f, "{large}: it has more than 65 533 places, events or transitions")
            }
            Self::Clocks(clocks) => write!(
                f,
                "{large}: {clocks} transitions have an interval, and {MOST_CLOCKS} are the most"
            ),
            Self::Place(name) => {
                write!(f, "the net cannot be played: place `{name}` starts with too many tokens")
            }
            Self::Defect(SystemError::Net { defect, .. }) => {
                write!(f, "the net cannot be played: {defect}")
            }
            Self::Defect(defect) => write!(f, "the nets cannot be played: {defect}"),
        }
    }
}

impl core::error::Error for NotPlayed {}

impl NotPlayed {
    /// Returns the remedy, where it is known.
    pub fn help(&self) -> Option<&'static str> {
        match self {
            Self::Words { unbounded: true, .. } => {
                Some("claim bounds of places: a place without one takes 17 bits, a 1-safe place 2")
            }
            Self::Place(_) => {
                Some("a place holds at most its bound, and at most 65535 tokens in play")
            }
            _ => None,
        }
    }
}
