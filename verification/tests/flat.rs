//! A system as one net does everything that its rounds do.
#![allow(missing_docs)]

use cotama_core::net::{EventId, PlaceId, Role};
use cotama_core::system::Of;
use cotama_core::units::Millis;
use cotama_core::{net, system};
use cotama_verification::flat::flat;
use cotama_verification::pt::Pt;
use std::collections::{BTreeSet, HashSet};

net! {
    /// Asks for a job, gives it up, or has it done.
    pub mod client {
        places { Idle: 1, Waiting, Served }
        flags { urgent }
        events { ask, give_up, done, hurry }
        outputs { job, cancel }
        transitions {
            ask on ask: Idle => Waiting do urgent = false emit job;
            give_up on give_up: Waiting => Idle emit cancel;
            done on done: Waiting => Served;
            again: Served => Idle;
            hurry on hurry [!urgent]: Waiting => Waiting do urgent = true;
        }
    }
}

net! {
    /// Does jobs; two at a time when they are urgent, none when it is tired.
    pub mod server {
        places { Ready: 1, Working, Tired }
        counters { jobs: 0 of 2 }
        shared { urgent, queue: 0 of 2 }
        events { job, cancel, work, rest }
        outputs { done }
        transitions {
            first on job: Ready => Working do jobs += 1;
            second on job [urgent]: Working => Working do jobs += 1;
            stop on cancel: Working => Ready do jobs = 0;
            last on work [jobs <= 1]: Working => Tired do jobs = 0 emit done;
            work on work [jobs > 1]: Working => Working do jobs -= 1;
            rest on rest [queue < 2]: Tired => Ready;
        }
    }
}

system! {
    /// A client and a server.
    pub mod shop {
        nets { client: client, server: server }
        links {
            client.job => server.job mail 2;
            client.cancel => server.cancel now;
            server.done => client.done mail 1;
        }
        shared { server.urgent = client.urgent; }
        pending { server.queue = server.job; }
        clears { server.cancel empties server.job; }
    }
}

type Shop = shop::Player;

/// Returns the tokens of a player in a place of the flat net.
fn tokens(player: &Shop, name: &str) -> u32 {
    let (component, rest) = name.split_once('.').unwrap();
    let at = shop::SYSTEM.components.iter().position(|it| it.name == component).unwrap();
    let net = shop::SYSTEM.components[at].net;
    let component = at as u16;
    let waiting = |name: &str| {
        let event = net.events.iter().position(|it| it.name == name).unwrap();
        player.waiting(&Of { component, id: EventId(event as u32) })
    };
    let capacity = |name: &str| if name == "job" { 2 } else { 1 };
    match rest.rsplit_once('.') {
        Some((of, "waiting")) => waiting(of),
        Some((of, "room")) => capacity(of) - waiting(of),
        Some((of, "absent")) => {
            1 - tokens(player, &format!("{}.{of}", shop::SYSTEM.components[at].name))
        }
        _ => {
            let place = net.places.iter().position(|it| it.name == rest).unwrap();
            player.tokens(Of { component, id: PlaceId(place as u32) })
        }
    }
}

#[test]
fn every_state_of_the_rounds_is_one_of_the_interleavings() {
    let net = flat(&shop::SYSTEM).unwrap();
    let view = net.view();
    assert_eq!(view.net().defect(), None);
    let pt = Pt::from(&view.net());
    let (mut reached, mut next) = (HashSet::from([pt.initial.clone()]), vec![pt.initial.clone()]);
    while let Some(marking) = next.pop() {
        for transition in (0..pt.transitions.len() as u32).filter(|&it| pt.enabled(&marking, it)) {
            let after = pt.fire(&marking, transition).unwrap();
            if reached.insert(after.clone()) {
                next.push(after);
            }
        }
    }
    // Complements and mailboxes keep their sums, and each net has one token.
    for marking in &reached {
        let of = |name: &str| marking[pt.place(name).unwrap().0 as usize];
        assert_eq!(of("server.job.waiting") + of("server.job.room"), 2);
        assert_eq!(of("client.urgent") + of("client.not_urgent"), 1);
        assert_eq!(of("server.Ready") + of("server.Working") + of("server.Tired"), 1);
    }

    let events: Vec<_> = [(0, 0), (0, 1), (0, 3), (1, 2), (1, 3)]
        .map(|(component, event)| Of { component, id: EventId(event) })
        .into();
    let (mut known, mut states) = (BTreeSet::new(), vec![Shop::new()]);
    while let Some(state) = states.pop() {
        let flattened: Vec<u32> = pt.places.iter().map(|name| tokens(&state, name)).collect();
        assert!(reached.contains(&flattened), "{:?} {flattened:?}", pt.places);
        if known.insert(*state.marking()) {
            let mut after = state;
            let _ = after.round(Millis(0));
            states.push(after);
            for &event in &events {
                let mut one = state;
                if one.offer_id(Millis(0), event, (), &mut ()).fired() {
                    states.push(one);
                }
            }
        }
    }
    assert_eq!(
        (pt.places.len(), pt.transitions.len(), reached.len(), known.len()),
        (17, 27, 55, 31)
    );
}

net! {
    /// Has jobs, and has enough of them.
    pub mod owner {
        places { Open: 1, Closed }
        counters { jobs: 0 of 2 }
        events { add, open }
        transitions {
            add on add [jobs < 2]: Open => Open do jobs += 1;
            close [jobs >= 2]: Open => Closed;
            open on open: Closed => Open do jobs = 0;
        }
    }
}

net! {
    /// Does the jobs of another one, whose room it does not know, or brings one.
    pub mod guest {
        places { Idle: 1, Tired }
        shared { jobs: 0 of 2 }
        events { work, bring, rest }
        transitions {
            work on work: Idle => Tired do jobs -= 1;
            bring on bring: Idle => Idle do jobs += 1;
            rest on rest: Tired => Idle;
        }
    }
}

system! {
    /// A net changes a counter of another one.
    pub mod helped {
        nets { owner: owner, guest: guest }
        shared { guest.jobs = owner.jobs; }
    }
}

#[test]
fn the_complement_of_the_owner_follows_a_change_by_a_guest() {
    let net = flat(&helped::SYSTEM).unwrap();
    let pt = Pt::from(&net.view().net());
    let (mut reached, mut next) = (HashSet::from([pt.initial.clone()]), vec![pt.initial.clone()]);
    while let Some(marking) = next.pop() {
        for transition in (0..pt.transitions.len() as u32).filter(|&it| pt.enabled(&marking, it)) {
            let after = pt.fire(&marking, transition).unwrap();
            if reached.insert(after.clone()) {
                next.push(after);
            }
        }
    }
    let mut complements = 0;
    for (place, at) in net.places.iter().zip(0..) {
        if let Role::Complement(of) = place.role {
            complements += 1;
            assert!(reached.iter().all(|it| it[at] + it[of.0 as usize] == place.bound));
        }
    }
    let names = ["owner.Open", "owner.Closed", "owner.jobs", "guest.Idle", "guest.Tired"];
    let of = |component, id| Of { component, id: PlaceId(id) };
    let jobs = owner::NET.places.iter().position(|it| it.name == "jobs").unwrap() as u32;
    let places = [of(0, 0), of(0, 1), of(0, jobs), of(1, 0), of(1, 1)];
    let at = names.map(|name| pt.place(name).unwrap().0 as usize);
    let reached: BTreeSet<_> = reached.iter().map(|it| at.map(|at| it[at])).collect();
    let (mut known, mut states) = (BTreeSet::new(), vec![helped::Player::new()]);
    while let Some(state) = states.pop() {
        let tokens = places.map(|it| state.tokens(it));
        assert!(reached.contains(&tokens), "{tokens:?}");
        if known.insert(tokens) {
            for (component, id) in [(0, 0), (0, 1), (1, 0), (1, 1), (1, 2)] {
                let mut after = state;
                let _ = after.offer_id(Millis(0), Of { component, id: EventId(id) }, (), &mut ());
                states.push(after);
            }
        }
    }
    // With two jobs it closes at once: only the interleavings have two and are open.
    assert_eq!((complements, reached.len(), known.len()), (1, 12, 10));
}
