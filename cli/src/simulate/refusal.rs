//! Why no transition uses an event, in words.

use crate::answers::model::{RefusalReason, RefusalRow};
use cotama_core::net::{EventId, Net, PlaceId, TransitionId, Within};
use cotama_core::player::Why;
use cotama_verification::play::{Unused, ignored_in, not_enabled, overflowing};

/// Why an event is not used at a marking.
pub(super) fn refusal(net: &Net<'_>, marking: &[u32], event: EventId, why: Unused) -> RefusalRow {
    let transition = |TransitionId(id): TransitionId| net.transitions.get(id as usize);
    let name = |id| transition(id).map_or("?", |it| it.name);
    let within = |id| transition(id).and_then(|it| it.within).map_or_else(String::new, interval);
    let tokens = |place| tokens(marking, place);
    let why = match why {
        Unused::Ignored(why) => why,
        Unused::Full { mailbox: PlaceId(mailbox) } => {
            let mailbox = net.places.get(mailbox as usize).map_or("?", |it| it.name);
            let text = format!("refused: {mailbox} is full");
            return RefusalRow { event: event_name(net, event), reason: RefusalReason::Full, text };
        }
    };
    let (reason, text) = match why {
        Why::OnPurpose => (RefusalReason::OnPurpose, ignored_in(net, &tokens, event)),
        Why::TooEarly(id) => (
            RefusalReason::TooEarly,
            format!("too early: `{}` fires on it {} after it is enabled", name(id), within(id)),
        ),
        Why::TooLate(id) => (
            RefusalReason::TooLate,
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
            (RefusalReason::Full, text)
        }
        Why::NotEnabled | Why::Behind | Why::NoSuchEvent => {
            (RefusalReason::NotEnabled, not_enabled(net, &tokens, event))
        }
    };
    RefusalRow { event: event_name(net, event), reason, text }
}

/// An event of a round in which nothing happens, as a place would hold too much.
pub(super) fn round_is_full(net: &Net<'_>, event: EventId) -> RefusalRow {
    let text = "the round does not happen: a place would hold more than its bound".to_owned();
    RefusalRow { event: event_name(net, event), reason: RefusalReason::Full, text }
}

/// An event of a round that would be used if it were alone.
pub(super) fn taken_by_others(net: &Net<'_>, event: EventId) -> RefusalRow {
    let text = "others of the round took what it needs".to_owned();
    RefusalRow { event: event_name(net, event), reason: RefusalReason::NotEnabled, text }
}

fn event_name(net: &Net<'_>, EventId(id): EventId) -> String {
    net.events.get(id as usize).map_or_else(String::new, |it| it.name.to_owned())
}

fn tokens(marking: &[u32], PlaceId(id): PlaceId) -> u32 {
    marking.get(id as usize).copied().unwrap_or(0)
}

fn interval(within: Within) -> String {
    match within.latest {
        None => format!("{} ms or more", within.earliest),
        Some(latest) => format!("{} to {latest} ms", within.earliest),
    }
}
