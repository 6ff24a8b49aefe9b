//! Why no transition uses an event, in words.

use super::game::Unused;
use super::needs::{ignored_in, not_enabled, overflowing};
use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::String;
use cotama_core::net::{EventId, Net, PlaceId, TransitionId, Within};
use cotama_core::player::Why;

/// An event that no transition used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// The event.
    pub event: EventId,
    /// Why, in a word.
    pub reason: Reason,
    /// Why, in words, with the names of what lacks.
    pub text: String,
}

/// Why no transition uses an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// A marked place ignores it on purpose.
    OnPurpose,
    /// No transition on it has the tokens that it needs.
    NotEnabled,
    /// One has, but its interval has not begun.
    TooEarly,
    /// One has, but its interval is over.
    TooLate,
    /// One has, but a place would hold more than its bound, or a mailbox is full.
    Full,
}

impl Refusal {
    /// Why an event is not used at a marking.
    pub(super) fn of(net: &Net<'_>, marking: &[u32], event: EventId, why: Unused) -> Self {
        let transition = |TransitionId(id): TransitionId| net.transitions.get(id as usize);
        let name = |id| transition(id).map_or("?", |it| it.name);
        let within =
            |id| transition(id).and_then(|it| it.within).map_or_else(String::new, interval);
        let tokens = |PlaceId(id): PlaceId| marking.get(id as usize).copied().unwrap_or(0);
        let why = match why {
            Unused::Ignored(why) => why,
            Unused::Full { mailbox: PlaceId(mailbox) } => {
                let mailbox = net.places.get(mailbox as usize).map_or("?", |it| it.name);
                let text = format!("refused: {mailbox} is full");
                return Self { event, reason: Reason::Full, text };
            }
        };
        let (reason, text) = match why {
            Why::OnPurpose => (Reason::OnPurpose, ignored_in(net, &tokens, event)),
            Why::TooEarly(id) => (
                Reason::TooEarly,
                format!("too early: `{}` fires on it {} after it is enabled", name(id), within(id)),
            ),
            Why::TooLate(id) => (
                Reason::TooLate,
                format!("too late: `{}` fires on it {} after it is enabled", name(id), within(id)),
            ),
            Why::Full(id) => {
                let place = transition(id).and_then(|it| overflowing(net, &tokens, it));
                let text = place.map_or_else(
                    || format!("`{}` would put too many tokens into a place", name(id)),
                    |(place, bound)| {
                        format!("`{}` would put more than {bound} tokens into {place}", name(id))
                    },
                );
                (Reason::Full, text)
            }
            Why::NotEnabled | Why::Behind | Why::NoSuchEvent => {
                (Reason::NotEnabled, not_enabled(net, &tokens, event))
            }
        };
        Self { event, reason, text }
    }

    /// An event of a round in which nothing happens, as a place would hold too much.
    pub(super) fn round_is_full(event: EventId) -> Self {
        let text = "the round does not happen: a place would hold more than its bound".to_owned();
        Self { event, reason: Reason::Full, text }
    }

    /// An event of a round that would be used if it were alone.
    pub(super) fn taken_by_others(event: EventId) -> Self {
        let text = "others of the round took what it needs".to_owned();
        Self { event, reason: Reason::NotEnabled, text }
    }
}

fn interval(within: Within) -> String {
    match within.latest {
        None => format!("{} ms or more", within.earliest),
        Some(latest) => format!("{} to {latest} ms", within.earliest),
    }
}
