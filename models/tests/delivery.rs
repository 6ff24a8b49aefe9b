//! The shipped supervisors, explored in rounds.
#![allow(missing_docs)]

use cotama_core::net::{EventId, TransitionId};
use cotama_core::system::{Happening, Of, Offered};
use cotama_core::units::Millis;
use cotama_models::cotama::delivery;
use std::collections::{BTreeSet, HashMap};

const NOW: Millis = Millis(0);

/// Events that nothing in the system causes.
fn outside() -> Vec<Of<EventId>> {
    let system = delivery::SYSTEM;
    let all = system.components.iter().zip(0..).flat_map(|(it, component)| {
        (0..it.net.events.len() as u32).map(move |id| Of { component, id: EventId(id) })
    });
    all.filter(|event| system.delivery(*event).is_none()).collect()
}

#[test]
fn the_rounds_reach_14824_states() {
    let first = delivery::Player::<()>::new();
    let mut seen = HashMap::from([(*first.marking(), 0_usize)]);
    let (mut states, mut edges) = (vec![first], 0);
    let mut fired = BTreeSet::new();
    let outside = outside();
    let mut at = 0;
    while let Some(&state) = states.get(at) {
        at += 1;
        let mut after = state;
        let mut witness = |happening: &Happening<()>| {
            if let Happening::Fired { transition: Of { component, id: TransitionId(id) }, .. } = happening {
                fired.insert((*component, *id));
            }
        };
        assert_eq!(after.round(NOW, &mut witness).waiting, 0, "no mailbox is ever full");
        for event in std::iter::once(None).chain(outside.iter().map(Some)) {
            let mut next = after;
            if let Some(id) = event {
                match next.offer(NOW, *id, (), &mut witness) {
                    Offered::Fired(_) => {}
                    Offered::Ignored => continue,
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
    assert_eq!((states.len(), edges), (14_824, 147_728));
    let transitions = delivery::SYSTEM.components.iter().zip(0..).flat_map(|(it, component)| {
        it.net
            .transitions
            .iter()
            .zip(0..)
            .map(move |(t, id)| ((component, id), format!("{}.{}", it.name, t.name)))
    });
    let never: Vec<_> = transitions.filter(|it| !fired.contains(&it.0)).map(|it| it.1).collect();
    // Variants of counters that no state has, a halt that always comes after the drive is stopped, and a link that is lost
    // where the operator drives, which ends the mission before anything else can be hard.
    let expected = [
        "ls.abort.End",
        "pf.a6.level_0",
        "pf.a6.level_1",
        "pf.a7.level_2",
        "pf.a8.level_0",
        "pf.a8.level_1",
        "pf.a9.level_2",
        "pf.as1.level_0",
        "pf.as1.level_1",
        "pf.as2.level_2",
        "permit.destroyed.Granted",
        "cs.slow3.mcl_0",
        "cs.hard6",
        "cs.camera2",
    ];
    assert_eq!(never, expected);
}
