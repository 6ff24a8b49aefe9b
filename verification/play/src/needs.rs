//! The needs that a transition lacks, in words.

use super::condition::condition;
use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use cotama_core::net::{Arc, EventId, Ignored, Net, PlaceId, Transition};

/// The most transitions of which it is said what they lack.
const SHOWN: usize = 2;
/// The most tokens of a place in play.
const LARGEST: u32 = 65_535;

/// Why no transition on an event is enabled, where places hold these tokens.
pub fn not_enabled(net: &Net<'_>, tokens: &dyn Fn(PlaceId) -> u32, event: EventId) -> String {
    let mut on = net.transitions.iter().filter(|it| it.on == Some(event));
    let said: Vec<_> = on
        .by_ref()
        .take(SHOWN)
        .map(|it| format!("`{}` needs {}", it.name, lacks(net, tokens, it)))
        .collect();
    match (said.is_empty(), on.count()) {
        (true, _) => "no transition is on it".to_owned(),
        (false, 0) => said.join("; "),
        (false, more) => format!("{}; and {more} more", said.join("; ")),
    }
}

fn lacks(net: &Net<'_>, tokens: &dyn Fn(PlaceId) -> u32, it: &Transition<'_>) -> String {
    let all = it.take.iter().chain(it.read);
    let lacking = all.filter(|arc| tokens(arc.place) < arc.weight);
    lacking.map(|&arc| condition(net, arc)).collect::<Vec<_>>().join(" & ")
}

/// Returns the condition under which an event is ignored on purpose at these tokens, in words.
///
/// ```
/// use cotama_core::net::{EventId, PlaceId};
/// use cotama_play::ignored_in;
/// cotama_core::net! {
///     mod drive {
///         places { Idle: 1, Driving }
///         flags { charged }
///         events { Go }
///         transitions { go on Go [charged]: Idle => Driving; }
///         ignore { Go in Idle [!charged]; Go in Driving; }
///         laws { handles(all); }
///     }
/// }
/// let tokens = |place: PlaceId| drive::NET.places[place.0 as usize].initial;
/// let said = ignored_in(&drive::NET, &tokens, EventId(0));
/// assert_eq!(said, "ignored on purpose in Idle [!charged]");
/// ```
pub fn ignored_in(net: &Net<'_>, tokens: &dyn Fn(PlaceId) -> u32, event: EventId) -> String {
    let here = net.ignored.iter().filter(|it| it.event == event && it.holds(tokens));
    let place = |it: &Ignored<'_>| {
        let guard: Vec<_> = it.guard.iter().map(|arc| condition(net, *arc)).collect();
        let place = condition(net, Arc { place: it.place, weight: 1 });
        if guard.is_empty() { place } else { format!("{place} [{}]", guard.join(" & ")) }
    };
    let places: Vec<_> = here.map(place).collect();
    format!("ignored on purpose in {}", places.join(", "))
}

/// The first place that a firing would fill beyond its bound, and the bound.
pub fn overflowing<'n>(
    net: &Net<'n>,
    tokens: &dyn Fn(PlaceId) -> u32,
    transition: &Transition<'_>,
) -> Option<(&'n str, u32)> {
    transition.give.iter().find_map(|give| {
        let place = net.places.get(give.place.0 as usize)?;
        let bound = place.bound.min(LARGEST);
        let taken =
            transition.take.iter().filter(|it| it.place == give.place).map(|it| it.weight).sum();
        let after = tokens(give.place).saturating_sub(taken).saturating_add(give.weight);
        (after > bound).then_some((place.name, bound))
    })
}
