//! The composed supervisors against the state counts of an independent exploration.
#![allow(missing_docs)]

use cotama_core::net::EventId;
use cotama_core::player::Outcome;
use cotama_core::system::Of;
use cotama_core::units::Millis;
use cotama_models::cotama::{decision, environment};
use std::collections::{BTreeSet, HashMap};

const NOW: Millis = Millis(0);

/// After each round the environment does one thing, or nothing: 4,166 states and 22,810 such steps,
/// as counted by two other programs for the same model.
#[test]
fn the_rounds_reach_4166_states() {
    let first = decision::Player::new();
    let mut seen = HashMap::from([(*first.marking(), 0_usize)]);
    let (mut states, mut edges) = (vec![first], 0);
    let mut fired = BTreeSet::new();
    let mut at = 0;
    while let Some(&state) = states.get(at) {
        at += 1;
        let mut after = state;
        let mut observer = |firing: &decision::Firing<'_>| {
            fired.insert((firing.id.component, firing.id.id.0));
        };
        assert_eq!(after.round_with(NOW, &mut observer).waiting, 0, "no mailbox is ever full");
        let events = (0..environment::NET.events.len()).map(|event| Some(EventId(event as u32)));
        for event in std::iter::once(None).chain(events) {
            let mut next = after;
            if let Some(id) = event {
                match next.offer_id(NOW, Of { component: 5, id }, (), &mut observer) {
                    Outcome::Fired { .. } => {}
                    Outcome::Ignored { .. } => continue,
                    other => panic!("{other:?}"),
                }
            }
            edges += 1;
            seen.entry(*next.marking()).or_insert_with(|| {
                states.push(next);
                states.len() - 1
            });
        }
    }
    assert_eq!((states.len(), edges), (4_166, 22_810));
    let never: Vec<_> = decision::SYSTEM.components[..4]
        .iter()
        .zip(0_u16..)
        .flat_map(|(it, component)| {
            let names = it.net.transitions.iter().zip(0_u32..);
            names
                .filter(|(_, id)| !fired.contains(&(component, *id)))
                .map(|(it, _)| it.name)
                .collect::<Vec<_>>()
        })
        .collect();
    println!("{never:?}");
}
