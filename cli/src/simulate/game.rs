//! A player of any net, whatever its size.

use crate::exit::{Exit, Failure};
use cotama_core::net::{Defect, EventId, Net, Place, TransitionId};
use cotama_core::player::{
    Checked, Firing, Loaded, Outcome, Packed, Player, Stepped, Why, clocks, words,
};
use cotama_core::system::{Component, System};
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
    /// As [`Player::offer`]: what fired, or why nothing did.
    fn offer(
        &mut self,
        at: Millis,
        event: EventId,
        fired: &mut Vec<Fired>,
    ) -> Result<TransitionId, Why<TransitionId>>;
    /// As [`Player::step`].
    fn step(&mut self, at: Millis, events: &[EventId], fired: &mut Vec<Fired>) -> Stepped;
    /// The same game, to go on with in another way.
    fn fork(&self) -> Box<dyn Game<'c> + 'c>;
}

/// What is played: bounds are checked, so that steps can be taken too.
type Played<'c, const W: usize, const C: usize> = Checked<Loaded<'c, W, C>>;

impl<'c, const W: usize, const C: usize> Game<'c> for Player<Played<'c, W, C>, W, C> {
    fn now(&self) -> Millis {
        Player::now(self)
    }

    fn wake_at(&self) -> Option<Millis> {
        Player::wake_at(self)
    }

    fn advance(&mut self, to: Millis, fired: &mut Vec<Fired>) -> bool {
        self.advance_with(to, &mut |it: &Seen<'_, 'c, W, C>| fired.push(it.into())).behind
    }

    fn offer(
        &mut self,
        at: Millis,
        event: EventId,
        fired: &mut Vec<Fired>,
    ) -> Result<TransitionId, Why<TransitionId>> {
        let outcome = self
            .offer_with(at, &event.into(), &mut |it: &Seen<'_, 'c, W, C>| fired.push(it.into()));
        match outcome.map(|it| it.id) {
            Outcome::Fired { transition, .. } => Ok(transition),
            Outcome::Ignored { why } => Err(why),
            // A net alone has no mailboxes.
            Outcome::Refused { .. } => Err(Why::NotEnabled),
        }
    }

    fn step(&mut self, at: Millis, events: &[EventId], fired: &mut Vec<Fired>) -> Stepped {
        let events: Vec<_> = events.iter().map(|&it| it.into()).collect();
        self.step_with(at, &events, &mut |it: &Seen<'_, 'c, W, C>| fired.push(it.into()))
    }

    fn fork(&self) -> Box<dyn Game<'c> + 'c> {
        Box::new(*self)
    }
}

type Seen<'f, 'c, const W: usize, const C: usize> = Firing<'f, Played<'c, W, C>>;

impl<const W: usize, const C: usize> From<&Seen<'_, '_, W, C>> for Fired {
    fn from(firing: &Seen<'_, '_, W, C>) -> Self {
        Self { transition: firing.id.id, at: firing.at, offered: firing.on.is_some() }
    }
}

/// What is done with a game that has just begun, and with what fired at its start.
pub(super) type Then<'t> =
    dyn for<'c> FnMut(Box<dyn Game<'c> + 'c>, Vec<Fired>) -> Result<Exit, Failure> + 't;

/// Plays a net from its start, at time zero.
pub(super) fn play(net: &Net<'_>, then: &mut Then<'_>) -> Result<Exit, Failure> {
    match words(&System::alone(&[Component::alone(net)])) {
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
    match clocks(&System::alone(&[Component::alone(net)])) {
        0 => with::<W, 0>(net, then),
        1..=16 => with::<W, 16>(net, then),
        17..=MOST_CLOCKS => with::<W, MOST_CLOCKS>(net, then),
        clocks => Err(large(&format!(
            "{clocks} transitions have an interval, and {MOST_CLOCKS} are the most"
        ))),
    }
}

fn with<const W: usize, const C: usize>(
    net: &Net<'_>,
    then: &mut Then<'_>,
) -> Result<Exit, Failure> {
    let packed = Packed::<W, C>::alone(net).map_err(|defect| refused(net, defect))?;
    let alone = [Component::alone(net)];
    let program = Checked(packed.load(&System::alone(&alone)));
    let mut fired = vec![];
    let mut observer = |it: &Seen<'_, '_, W, C>| fired.push(it.into());
    let game = Player::<_, W, C>::start(program, Millis(0), &mut observer);
    then(Box::new(game), fired)
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
        other => Failure::new(format!("the net cannot be played: {other}")),
    }
}
