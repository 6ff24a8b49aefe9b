//! Nets that move by nobody's word, made to move by the user's.

use cotama_core::net::EventId;
use cotama_core::net::owned::{OwnedNet, OwnedSignal};
use std::collections::BTreeMap;

/// The net as it is played, and whether its transitions are fired by name.
///
/// In a plain place/transition net, without events and time, no transition would ever wait for
/// anything. There each transition gets an event of its own name.
pub(super) fn playable(mut net: OwnedNet) -> (OwnedNet, bool) {
    if !net.events.is_empty() || net.transitions.iter().any(|it| it.within.is_some()) {
        return (net, false);
    }
    let mut known = BTreeMap::new();
    for transition in &mut net.transitions {
        let next = EventId(net.events.len() as u32);
        let event = *known.entry(transition.name.clone()).or_insert(next);
        if event == next {
            net.events
                .push(OwnedSignal { name: transition.name.clone(), doc: transition.doc.clone() });
        }
        transition.on = Some(event);
    }
    (net, true)
}

#[cfg(test)]
mod tests {
    use super::*;
    use cotama_models::nets::find;

    #[test]
    fn transitions_of_a_plain_net_are_fired_by_name() {
        let (net, by_name) = playable(find("philosophers:2").unwrap());
        assert!(by_name && net.events.len() == 10);
        assert_eq!(net.events[3].name, net.transitions[3].name);
        assert_eq!(net.transitions[3].on, Some(EventId(3)));
    }

    #[test]
    fn a_net_with_events_or_time_is_played_as_it_is() {
        let door = find("door").unwrap();
        assert_eq!(playable(door.clone()), (door, false));
        let mut timed = find("philosophers:2").unwrap();
        timed.transitions[0].within = Some(cotama_core::net::Within { earliest: 1, latest: None });
        assert_eq!(playable(timed.clone()), (timed, false));
    }
}
