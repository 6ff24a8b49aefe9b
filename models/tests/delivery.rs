//! The shipped supervisors, explored in rounds by players.
#![allow(missing_docs)]

use cotama_core::net::EventId;
use cotama_core::player::Outcome;
use cotama_core::system::Of;
use cotama_core::units::Millis;
use cotama_models::cotama::{delivery, permit};
use std::collections::{BTreeSet, HashSet};

const NOW: Millis = Millis(0);

/// Events that nothing in the system causes.
fn outside() -> Vec<Of<EventId>> {
    let system = delivery::SYSTEM;
    let all = system.components.iter().zip(0..).flat_map(|(it, component)| {
        (0..it.net.events.len() as u32).map(move |id| Of { component, id: EventId(id) })
    });
    all.filter(|event| system.delivery(*event).is_none()).collect()
}

/// The checker counts the same on the net of rounds.
#[test]
fn the_shipped_supervisors_reach_110346_states_by_1346810_steps() {
    let first = delivery::Player::new();
    let mut seen = HashSet::from([*first.marking()]);
    let (mut states, mut edges) = (vec![first], 0);
    let mut fired = BTreeSet::new();
    let outside = outside();
    let moving = {
        use cotama_models::cotama::{path_following::Place as Pf, teleoperation::Place as To};
        let pf = [Pf::Optimal, Pf::Reduced, Pf::Odometric, Pf::Reactive, Pf::Degraded];
        let to = [To::Full, To::Degraded].map(delivery::Place::to);
        [&pf.map(delivery::Place::pf)[..], &to].concat()
    };
    let mut at = 0;
    while let Some(&state) = states.get(at) {
        at += 1;
        let mut after = state;
        let mut observer = |firing: &delivery::Firing<'_>| {
            fired.insert((firing.id.component, firing.id.id.0));
        };
        assert_eq!(after.round_with(NOW, &mut observer).waiting, 0, "no mailbox is ever full");
        // Between rounds who is permitted to move is whom an adapter moves, and nobody else.
        let moves = moving.iter().any(|it| after.tokens(*it) > 0);
        assert_eq!(moves, after.tokens(delivery::Place::permit(permit::Place::Granted)) > 0);
        for event in std::iter::once(None).chain(outside.iter().map(Some)) {
            let mut next = after;
            if let Some(id) = event {
                match next.offer_id(NOW, *id, (), &mut observer) {
                    Outcome::Fired { .. } => {}
                    Outcome::Ignored { .. } => continue,
                    other @ Outcome::Refused { .. } => panic!("{other:?}"),
                }
            }
            edges += 1;
            if seen.insert(*next.marking()) {
                states.push(next);
            }
        }
    }
    assert_eq!(
        (states.len(), edges),
        (cotama_golden::figure("delivery.states"), cotama_golden::figure("delivery.steps"))
    );
    let all = delivery::SYSTEM.components.iter().zip(0..).flat_map(|(it, component)| {
        it.net
            .transitions
            .iter()
            .zip(0..)
            .map(move |(t, id)| ((component, id), format!("{}.{}", it.name, t.name)))
    });
    let never: Vec<_> = all.filter(|it| !fired.contains(&it.0)).map(|it| it.1).collect();
    let unused = [
        // The drive ends in the round after its goal, before anything can abort it.
        "ls.abort.End",
        // The level is what the place says: full in `Optimal`, fewer in `Reduced`.
        "pf.a6.level_0",
        "pf.a6.level_1",
        "pf.a7.level_2",
        "pf.a8.level_0",
        "pf.a8.level_1",
        "pf.a9.level_2",
        "pf.a19.level_0",
        "pf.a19.level_1",
        "pf.a20.level_2",
        "pf.as1.level_0",
        "pf.as1.level_1",
        "pf.as2.level_2",
        // The abort comes first and takes the permit back.
        "permit.destroyed.Granted",
        // Too slow without localisation: nothing runs that could be.
        "cs.slow3.mcl_0",
        "cs.slow5.mcl_0",
        // A driver without a link has been stopped by the loss of the link.
        "cs.hard6",
        "cs.camera2",
    ];
    assert_eq!(never, unused);
}
