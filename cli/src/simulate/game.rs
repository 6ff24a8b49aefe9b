//! A player of any net, whatever its size.

use crate::exit::{Exit, Failure};
use cotama_core::net::{
    Defect, EventId, Firing, Loaded, Net, Outcome, OutputId, Packed, Place, Player, Round,
    TransitionId, clocks, words,
};
use cotama_core::units::Millis;

/// The sizes of the players: machine words of a marking, and transitions with an interval.
const MOST_WORDS: usize = 256;
const MOST_CLOCKS: usize = 256;

/// A transition that fired.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Fired {
    pub(super) transition: TransitionId,
    pub(super) at: Millis,
    /// Whether an event that was offered made it fire.
    pub(super) offered: bool,
}

/// A net in play.
pub(super) trait Game<'c> {
    /// As [`Player::now`].
    fn now(&self) -> Millis;
    /// As [`Player::wake_at`].
    fn wake_at(&self) -> Option<Millis>;
    /// As [`Player::advance`]; whether there is more to catch up with.
    fn advance(&mut self, to: Millis, fired: &mut Vec<Fired>) -> bool;
    /// As [`Player::offer`].
    fn offer(
        &mut self,
        at: Millis,
        event: EventId,
        fired: &mut Vec<Fired>,
    ) -> Outcome<TransitionId>;
    /// As [`Player::round`].
    fn round(&mut self, at: Millis, events: &[EventId], fired: &mut Vec<Fired>) -> Round;
    /// The same game, to go on with in another way.
    fn fork(&self) -> Box<dyn Game<'c> + 'c>;
}

impl<'c, const W: usize, const C: usize> Game<'c> for Player<Loaded<'c, W>, W, C> {
    fn now(&self) -> Millis {
        Player::now(self)
    }

    fn wake_at(&self) -> Option<Millis> {
        Player::wake_at(self)
    }

    fn advance(&mut self, to: Millis, fired: &mut Vec<Fired>) -> bool {
        self.advance_with(to, &mut |it: &Seen<'_>| fired.push(it.into())).behind
    }

    fn offer(
        &mut self,
        at: Millis,
        event: EventId,
        fired: &mut Vec<Fired>,
    ) -> Outcome<TransitionId> {
        self.offer_with(at, &event, &mut |it: &Seen<'_>| fired.push(it.into()))
    }

    fn round(&mut self, at: Millis, events: &[EventId], fired: &mut Vec<Fired>) -> Round {
        self.round_with(at, events, &mut |it: &Seen<'_>| fired.push(it.into()))
    }

    fn fork(&self) -> Box<dyn Game<'c> + 'c> {
        Box::new(*self)
    }
}

type Seen<'f> = Firing<'f, EventId, TransitionId, OutputId>;

impl From<&Seen<'_>> for Fired {
    fn from(firing: &Seen<'_>) -> Self {
        Self { transition: firing.id, at: firing.at, offered: firing.event.is_some() }
    }
}

/// What is done with a game that has just begun, and with what fired at its start.
pub(super) type Then<'t> =
    dyn for<'c> FnMut(Box<dyn Game<'c> + 'c>, Vec<Fired>) -> Result<Exit, Failure> + 't;

/// Plays a net from its start, at time zero.
pub(super) fn play(net: &Net<'_>, then: &mut Then<'_>) -> Result<Exit, Failure> {
    match words(net) {
        Some(0..=1) => with_words::<1>(net, then),
        Some(2..=4) => with_words::<4>(net, then),
        Some(5..=16) => with_words::<16>(net, then),
        Some(17..=64) => with_words::<64>(net, then),
        Some(65..=MOST_WORDS) => with_words::<MOST_WORDS>(net, then),
        Some(words) => {
            let failure = large(&format!(
                "a marking needs {words} machine words, and {MOST_WORDS} are the most"
            ));
            Err(if net.places.iter().any(|it| it.bound == Place::UNBOUNDED) {
                failure.help(
                    "claim bounds of places: a place without one takes 17 bits, a 1-safe place 2",
                )
            } else {
                failure
            })
        }
        None => Err(large("it has more than 65 533 places, events or transitions")),
    }
}

fn with_words<const W: usize>(net: &Net<'_>, then: &mut Then<'_>) -> Result<Exit, Failure> {
    let packed = Packed::<W>::of(net).map_err(|defect| refused(net, defect))?;
    let program = packed.load(net);
    let mut fired = vec![];
    let game = match clocks(net) {
        0 => start::<W, 0>(program, &mut fired),
        1..=16 => start::<W, 16>(program, &mut fired),
        17..=MOST_CLOCKS => start::<W, MOST_CLOCKS>(program, &mut fired),
        clocks => {
            return Err(large(&format!(
                "{clocks} transitions have an interval, and {MOST_CLOCKS} are the most"
            )));
        }
    };
    then(game, fired)
}

fn start<'c, const W: usize, const C: usize>(
    program: Loaded<'c, W>,
    fired: &mut Vec<Fired>,
) -> Box<dyn Game<'c> + 'c> {
    let mut observer = |it: &Seen<'_>| fired.push(it.into());
    Box::new(Player::<_, W, C>::start(program, Millis(0), &mut observer))
}

fn large(why: &str) -> Failure {
    Failure::new(format!("the net is too large to be played: {why}"))
}

fn refused(net: &Net<'_>, defect: Defect) -> Failure {
    match defect {
        Defect::Place { place } => {
            let name = net.places.get(place).map_or("?", |place| place.name);
            Failure::new(format!(
                "the net cannot be played: place `{name}` starts with too many tokens"
            ))
            .help("a place holds at most its bound, and at most 65535 tokens in play")
        }
        Defect::TooLong => large("it has too many parts"),
        other => Failure::new(format!(
            "the net cannot be played: its lists do not fit together: {other:?}"
        )),
    }
}
