//! Why no transition uses an event, in words.

use crate::answers::model::{RefusalReason, RefusalRow};
use cotama_core::net::{Arc, EventId, Net, Place, PlaceId, Role, Transition, TransitionId, Within};
use cotama_core::player::Why;

/// The most transitions of which it is said what they lack.
const SHOWN: usize = 2;
/// The most tokens of a place in play.
const LARGEST: u32 = 65_535;

/// Why an event is ignored at a marking.
pub(super) fn refusal(
    net: &Net<'_>,
    marking: &[u32],
    event: EventId,
    why: Why<TransitionId>,
) -> RefusalRow {
    let transition = |TransitionId(id): TransitionId| net.transitions.get(id as usize);
    let name = |id| transition(id).map_or("?", |it| it.name);
    let within = |id| transition(id).and_then(|it| it.within).map_or_else(String::new, interval);
    let (reason, text) = match why {
        Why::OnPurpose => (RefusalReason::OnPurpose, on_purpose(net, marking, event)),
        Why::TooEarly(id) => (
            RefusalReason::TooEarly,
            format!("too early: `{}` fires on it {} after it is enabled", name(id), within(id)),
        ),
        Why::TooLate(id) => (
            RefusalReason::TooLate,
            format!("too late: `{}` fires on it {} after it is enabled", name(id), within(id)),
        ),
        Why::Full(id) => {
            let place = transition(id).and_then(|it| overflowing(net, marking, it));
            let text = place.map_or_else(
                || format!("`{}` would put too many tokens into a place", name(id)),
                |(place, bound)| {
                    format!("`{}` would put more than {bound} tokens into {place}", name(id))
                },
            );
            (RefusalReason::Full, text)
        }
        Why::NotEnabled | Why::Behind | Why::NoSuchEvent => {
            (RefusalReason::NotEnabled, not_enabled(net, marking, event))
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

fn on_purpose(net: &Net<'_>, marking: &[u32], event: EventId) -> String {
    let here = net.ignored.iter().filter(|it| it.event == event && tokens(marking, it.place) > 0);
    let places: Vec<_> =
        here.map(|it| condition(net, Arc { place: it.place, weight: 1 })).collect();
    format!("ignored on purpose in {}", places.join(", "))
}

fn not_enabled(net: &Net<'_>, marking: &[u32], event: EventId) -> String {
    let mut on = net.transitions.iter().filter(|it| it.on == Some(event));
    let lacks = |it: &Transition<'_>| {
        let all = it.take.iter().chain(it.read);
        let lacking = all.filter(|arc| tokens(marking, arc.place) < arc.weight);
        let lacking: Vec<_> = lacking.map(|&arc| condition(net, arc)).collect();
        format!("`{}` needs {}", it.name, lacking.join(" & "))
    };
    let said: Vec<_> = on.by_ref().take(SHOWN).map(lacks).collect();
    match (said.is_empty(), on.count()) {
        (true, _) => "no transition is on it".to_owned(),
        (false, 0) => said.join("; "),
        (false, more) => format!("{}; and {more} more", said.join("; ")),
    }
}

/// What an arc asks for, as a guard.
fn condition(net: &Net<'_>, arc: Arc) -> String {
    let place = |PlaceId(id): PlaceId| net.places.get(id as usize);
    let name = |id| place(id).map_or("?", |it: &Place<'_>| it.name);
    match place(arc.place).map(|it| (it.role, it.bound)) {
        Some((Role::Complement(of), 1)) => format!("!{}", name(of)),
        Some((Role::Complement(of), bound)) => {
            format!("{} <= {}", name(of), bound.saturating_sub(arc.weight))
        }
        _ if arc.weight == 1 => name(arc.place).to_owned(),
        _ => format!("{} >= {}", name(arc.place), arc.weight),
    }
}

/// The first place that a firing would fill beyond its bound, and the bound.
fn overflowing<'n>(
    net: &Net<'n>,
    marking: &[u32],
    transition: &Transition<'_>,
) -> Option<(&'n str, u32)> {
    transition.give.iter().find_map(|give| {
        let place = net.places.get(give.place.0 as usize)?;
        let bound = place.bound.min(LARGEST);
        let taken =
            transition.take.iter().filter(|it| it.place == give.place).map(|it| it.weight).sum();
        let after = tokens(marking, give.place).saturating_sub(taken).saturating_add(give.weight);
        (after > bound).then_some((place.name, bound))
    })
}

fn interval(within: Within) -> String {
    match within.latest {
        None => format!("{} ms or more", within.earliest),
        Some(latest) => format!("{} to {latest} ms", within.earliest),
    }
}
