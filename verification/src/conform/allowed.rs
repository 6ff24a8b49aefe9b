//! The records allowed in place of the recorded one.

use crate::play::{Game, Numbered, Unused};
use cotama_core::net::{EventId, TransitionId};
use cotama_core::player::Why;
use cotama_core::units::Millis;

/// The records allowed next.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Allowed {
    /// The transitions that could fire; just one where the player had to fire it.
    pub fired: Vec<MayFire>,
    /// The events that a transition would have used.
    pub events: Vec<MayTell>,
}

/// A transition that could fire.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct MayFire {
    /// The transition.
    pub transition: String,
    /// Earliest time.
    pub earliest: Millis,
    /// Not after; none: at any time after that.
    pub latest: Option<Millis>,
}

/// An event that would have been used.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct MayTell {
    /// The event.
    pub event: String,
    /// The transition that it would have made fire.
    pub transition: String,
}

impl Allowed {
    /// Returns the records allowed in a game.
    pub(super) fn of(numbered: &Numbered, game: &dyn Game<'_>) -> Self {
        let whole = numbered.whole();
        let ids = (0..whole.transitions.len() as u32).map(TransitionId);
        let fired = ids.filter_map(|id| {
            let (earliest, latest) = window(numbered, game, id)?;
            Some(MayFire { transition: numbered.transition(id).to_owned(), earliest, latest })
        });
        let events = whole.events.iter().take(numbered.told_events()).zip((0..).map(EventId));
        let events = events.filter_map(|(event, id)| {
            let fired = game.fork().offer(game.now(), id, &mut Vec::new()).ok()?;
            let transition = numbered.transition(fired).to_owned();
            Some(MayTell { event: event.name.clone(), transition })
        });
        Self { fired: fired.collect(), events: events.collect() }
    }

    /// The same with what is allowed in another way.
    pub(super) fn add(&mut self, other: Self) {
        for it in other.fired {
            if !self.fired.contains(&it) {
                self.fired.push(it);
            }
        }
        for it in other.events {
            if !self.events.contains(&it) {
                self.events.push(it);
            }
        }
    }

    /// Just this.
    pub(super) fn only(transition: &str, earliest: Millis, latest: Millis) -> Self {
        let transition = transition.to_owned();
        let fired = vec![MayFire { transition, earliest, latest: Some(latest) }];
        Self { fired, events: Vec::new() }
    }
}

/// From when on, and until when, a transition that is chosen can fire, if nothing else happens.
pub(super) fn window(
    numbered: &Numbered,
    game: &dyn Game<'_>,
    id: TransitionId,
) -> Option<(Millis, Option<Millis>)> {
    let choice = numbered.choice(id)?;
    let within = numbered.whole().transitions.get(id.0 as usize)?.within;
    let now = game.now().0;
    let at = |at: u64| offered(game, Millis(at), choice);
    let earliest = match at(now) {
        Ok(_) => now,
        Err(Unused::Ignored(Why::TooEarly(_))) => {
            let last = now.saturating_add(within.map_or(0, |it| it.earliest.into()));
            let early = |it: u64| matches!(at(it), Err(Unused::Ignored(Why::TooEarly(_))));
            first_without(now, last, early)
        }
        Err(_) => return None,
    };
    let Some(length) = within.and_then(|it| it.latest) else {
        return Some((Millis(earliest), None));
    };
    let late = |it: u64| matches!(at(it), Err(Unused::Ignored(Why::TooLate(_))));
    let end = earliest.saturating_add(u64::from(length)).saturating_add(1);
    let latest = first_without(earliest, end, |it| !late(it)).saturating_sub(1);
    Some((Millis(earliest), Some(Millis(latest))))
}

/// Returns the outcome of an event at a later instant.
pub(super) fn offered(
    game: &dyn Game<'_>,
    at: Millis,
    event: EventId,
) -> Result<TransitionId, Unused> {
    game.fork().offer(at, event, &mut Vec::new())
}

/// The first instant after `from` of which something is not true any more; it is true of `from`,
/// and not of `to`.
fn first_without(mut from: u64, mut to: u64, is: impl Fn(u64) -> bool) -> u64 {
    while from + 1 < to {
        let middle = from + (to - from) / 2;
        if is(middle) { from = middle } else { to = middle }
    }
    to
}
