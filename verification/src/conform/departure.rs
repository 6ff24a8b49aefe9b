//! The departure of a recording from the model, in words.

use super::allowed::Allowed;
use crate::play::{Game, NotPlayed, Numbered, Unused, ignored_in, not_enabled, overflowing};
use cotama_core::net::{EventId, TransitionId, Within};
use cotama_core::player::Why;
use cotama_core::units::Millis;

/// The departure of a recording from the model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Departure {
    /// The line, from 1.
    pub line: usize,
    /// Time of the departure.
    pub at: Millis,
    /// Why it cannot be so.
    pub reason: String,
    /// The records allowed there.
    pub allowed: Allowed,
}

/// Why it cannot be said whether a recording is a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refused {
    /// The model cannot be played.
    Model(NotPlayed),
    /// The model has no event, transition or net of this name.
    Name {
        /// The line that says it, and the column there; none for the header.
        at: Option<(usize, usize)>,
        /// `event`, `transition` or `net`.
        kind: &'static str,
        /// The name.
        name: String,
        /// The known names.
        known: Vec<String>,
    },
    /// The model does not come to rest at this instant.
    Endless(Millis),
}

/// Why no transition uses an event now.
pub(super) fn unused(
    numbered: &Numbered,
    game: &dyn Game<'_>,
    event: EventId,
    why: Unused,
) -> String {
    let whole = numbered.whole();
    let view = whole.view();
    let net = view.net();
    let tokens = |place| game.tokens(place);
    let within = |id: TransitionId| {
        let it = net.transitions.get(id.0 as usize).and_then(|it| it.within);
        it.map_or_else(String::new, interval)
    };
    match why {
        Unused::Full { mailbox } => {
            let name = whole.places.get(mailbox.0 as usize).map_or("a mailbox", |it| &it.name);
            format!("{name} is full")
        }
        Unused::Ignored(Why::OnPurpose) => ignored_in(&net, &tokens, event),
        Unused::Ignored(Why::TooEarly(id)) => {
            format!(
                "`{}` can fire {} after it is enabled, not before",
                numbered.transition(id),
                within(id)
            )
        }
        Unused::Ignored(Why::TooLate(id)) => {
            format!(
                "`{}` can fire {} after it is enabled, not later",
                numbered.transition(id),
                within(id)
            )
        }
        Unused::Ignored(Why::Full(id)) => {
            let it = net.transitions.get(id.0 as usize);
            let full = it.and_then(|it| overflowing(&net, &tokens, it));
            let (place, bound) =
                full.map_or(("a place", String::new()), |it| (it.0, format!(" {}", it.1)));
            format!("`{}` would put more than{bound} tokens into {place}", numbered.transition(id))
        }
        Unused::Ignored(_) => not_enabled(&net, &tokens, event),
    }
}

fn interval(within: Within) -> String {
    match within.latest {
        None => format!("{} ms or more", within.earliest),
        Some(latest) if latest == within.earliest => format!("{latest} ms"),
        Some(latest) => format!("{} to {latest} ms", within.earliest),
    }
}
