//! Two executions of one meaning: players, and the net of rounds, reach the same states by as many
//! steps.

use crate::shared;
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{EventId, Net, OutputId, Place, PlaceId, Role};
use cotama_core::player::{Firing, Loaded, Outcome, Packed, Player};
use cotama_core::system::{Clear, Component, Delivery, Link, Of, System, SystemError};
use cotama_core::units::Millis;
use cotama_verification::explicit::{Graph, Limits};
use cotama_verification::flat::{FlatError, Rounds, Size, rounds};
use cotama_verification::pt::Pt;
use std::collections::BTreeSet;

type States = BTreeSet<Vec<u32>>;

/// Tokens and what waits, by the names of [`flat`](cotama_verification::flat), without complements.
fn names(system: &System<'_>) -> Vec<(String, Result<Of<PlaceId>, Of<EventId>>)> {
    let mut names = Vec::new();
    for (it, component) in system.components.iter().zip(0..) {
        for (place, id) in it.net.places.iter().zip(0..) {
            if !matches!(place.role, Role::Complement(_) | Role::Shared) {
                names.push((
                    format!("{}.{}", it.name, place.name),
                    Ok(Of { component, id: PlaceId(id) }),
                ));
            }
        }
        for (event, id) in it.net.events.iter().zip(0..) {
            let of = Of { component, id: EventId(id) };
            if matches!(system.delivery(of), Some(Delivery::Mail { .. })) {
                names.push((format!("{}.{}.waiting", it.name, event.name), Err(of)));
            }
        }
    }
    names
}

/// Returns the states that players reach; `None` when they are many.
fn played(system: &System<'_>) -> Option<(States, Size)> {
    const NOW: Millis = Millis(0);
    let packed = Packed::<8, 0, 64>::of(system).unwrap();
    let first = Player::start(packed.load(system), NOW, &mut ());
    let names = names(system);
    let tokens = |player: &Player<Loaded<'_, 8, 0, 64>, 8, 0, 64>| {
        let of = |it: &(String, Result<_, _>)| {
            it.1.map_or_else(|event| player.waiting(&event), |at| player.tokens(at))
        };
        names.iter().map(of).collect::<Vec<u32>>()
    };
    let outside = system.components.iter().zip(0..).flat_map(|(it, component)| {
        (0..it.net.events.len() as u32).map(move |id| Of { component, id: EventId(id) })
    });
    let outside: Vec<_> = outside.filter(|&it| system.delivery(it).is_none()).collect();
    let (mut seen, mut next, mut edges) = (States::from([tokens(&first)]), vec![first], 0);
    while let Some(mut player) = next.pop() {
        let _ = player.round(NOW);
        for event in std::iter::once(None).chain(outside.iter().copied().map(Some)) {
            let mut after = player;
            if let Some(event) = event {
                let mut fired = false;
                let mut observer = |_: &Firing<'_, _, _>| fired = true;
                match after.offer_with(NOW, &event, &mut observer) {
                    Outcome::Fired { .. } => {}
                    // Events that waited for room in a mailbox that the event empties may fire.
                    Outcome::Ignored { .. } if fired || after.marking() != player.marking() => {}
                    _ => continue,
                }
            }
            edges += 1;
            if seen.insert(tokens(&after)) {
                next.push(after);
            }
        }
        if seen.len() > 3_000 {
            return None;
        }
    }
    let states = seen.len() as u64;
    Some((seen, Size { states, edges }))
}

/// The same of the net.
fn walked(system: &System<'_>, rounds: &Rounds) -> (States, Size) {
    let net = rounds.net().unwrap();
    assert_eq!(net.view().net().defect(), None);
    let pt = Pt::from(&net.view().net());
    let graph = Graph::new(&pt, &Limits::default(), &|_| ()).unwrap();
    let places: Vec<_> =
        names(system).iter().map(|it| pt.place(&it.0).unwrap().0 as usize).collect();
    let markings = (0..graph.states() as u32).map(|it| graph.marking(it));
    for (marking, state) in markings.clone().zip(0..) {
        // In the turns of the system one transition is enabled, neither none nor two.
        let is_outside = marking[rounds.outside().0 as usize] == 1;
        assert!(
            is_outside || graph.transitions(state).len() == 1,
            "{:?}",
            graph.transitions(state)
        );
    }
    let between = markings.filter(|it| it[rounds.round().0 as usize] == 1);
    let states = between.map(|it| places.iter().map(|&at| it[at]).collect()).collect();
    (states, rounds.size(&graph))
}

/// Numbers that look random.
pub(super) struct Draw(pub(super) u64);

impl Draw {
    pub(super) fn below(&mut self, count: u32) -> u32 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as u32) % count
    }
}

/// A state machine of three states with a counter, on four events; now and then a transition has
/// none.
fn net(draw: &mut Draw) -> OwnedNet {
    let mut net = OwnedNet::new("random", "");
    let states =
        [1, 0, 0].map(|it| net.place(OwnedPlace::new(&format!("s{it}"), it).at_most(1)).unwrap());
    for (place, name) in net.places.iter_mut().zip(["a", "b", "c"]) {
        name.clone_into(&mut place.name);
    }
    let counter = net.place(OwnedPlace::new("n", 0).at_most(2)).unwrap();
    for name in ["e0", "e1", "e2", "e3"] {
        net.event(name, "").unwrap();
        net.output(&format!("o{name}"), "").unwrap();
    }
    for number in 0..3 + draw.below(5) {
        let mut it = OwnedTransition::new(&format!("t{number}"));
        let (from, to) = (draw.below(3), draw.below(3));
        it = it.take(states[from as usize], 1);
        // Without an event it goes forward, so that most nets settle.
        it = if from < to && draw.below(4) == 0 { it } else { it.on(EventId(draw.below(4))) };
        it = it.give(states[to as usize], 1);
        it = match draw.below(5) {
            0 => it.give(counter, 1),
            1 => it.take(counter, 1),
            2 => it.read(counter, 1 + draw.below(2)),
            _ => it,
        };
        it.priority = draw.below(3) as i16;
        it.emits = (0..draw.below(3)).map(|_| OutputId(draw.below(4))).collect();
        it.emits.dedup();
        net.transition(it).unwrap();
    }
    net
}

fn leaked(net: OwnedNet) -> &'static Net<'static> {
    let leaked: &'static OwnedNet = Box::leak(Box::new(net));
    let view: &'static _ = Box::leak(Box::new(leaked.view()));
    Box::leak(Box::new(view.net()))
}

/// Three of them with links: at once to later ones, by mail to any. Some have shared places.
fn system(draw: &mut Draw, shares: bool) -> System<'static> {
    let mut nets = [(); 3].map(|()| net(draw));
    let (mut links, mut clears) = (Vec::<Link>::new(), Vec::new());
    let mut kinds = [[None; 4]; 3];
    for _ in 0..2 + draw.below(6) {
        let (a, b, event) = (draw.below(3) as u16, draw.below(3) as u16, draw.below(4));
        let kind =
            kinds[usize::from(b)][event as usize].get_or_insert_with(|| match draw.below(3) {
                0 if a < b => Delivery::Now,
                more => Delivery::Mail { capacity: 1 + (more as u16 % 2) },
            });
        let from = Of { component: a, id: OutputId(draw.below(4)) };
        let to = Of { component: b, id: EventId(event) };
        let link = Link { from, to, delivery: *kind };
        if (*kind != Delivery::Now || a < b) && !links.contains(&link) {
            links.push(link);
        }
    }
    for component in 0..3_u16 {
        let is_mail = |it: &&Link| it.to.component == component && it.delivery != Delivery::Now;
        if let Some(mail) = links.iter().find(is_mail)
            && draw.below(2) == 0
        {
            clears.push(Clear {
                on: Of { component, id: EventId(draw.below(4)) },
                mailbox: mail.to.id,
            });
        }
    }
    let bindings = if shares { shared::share(draw, &mut nets, &links) } else { Vec::new() };
    let mut names = ["x", "y", "z"].into_iter();
    let components =
        nets.map(|net| Component { name: names.next().unwrap_or_default(), net: leaked(net) });
    System {
        name: "random",
        doc: "",
        components: components.to_vec().leak(),
        links: links.leak(),
        bindings: bindings.leak(),
        clears: clears.leak(),
    }
}

/// Compares so many; how many were compared, their states, and how many are endless.
fn compared(systems: usize, shares: bool) -> (usize, usize, usize) {
    let (mut compared, mut states, mut endless) = (0, 0, 0);
    // A transition that mails more than fits is drawn, too, and is a defect.
    let drawn = (0..).map(|seed| (seed, system(&mut Draw(seed), shares)));
    let sound = drawn.filter(|(seed, it)| match it.defect() {
        None => true,
        Some(SystemError::Overfills(_)) => false,
        Some(other) => panic!("{seed}: {other}"),
    });
    for (seed, system) in sound.take(systems) {
        let rounds = match rounds(&system) {
            Ok(rounds) => rounds,
            Err(FlatError::Endless { .. }) => {
                endless += 1;
                continue;
            }
            Err(other) => panic!("{seed}: {other}"),
        };
        let Some(played) = played(&system) else { continue };
        states += played.0.len();
        compared += 1;
        assert_eq!(walked(&system, &rounds), played, "{seed}");
    }
    (compared, states, endless)
}

#[test]
fn players_and_nets_of_rounds_agree() {
    assert_eq!(compared(400, false), (400, 3_358, 0));
}

#[test]
#[ignore = "seconds: CI runs it"]
fn players_and_nets_of_rounds_agree_with_shared_places() {
    assert_eq!(compared(40, true), (37, 535, 3));
}

#[test]
#[ignore = "a minute: CI runs it"]
fn players_and_nets_of_rounds_agree_with_shared_places_400_times() {
    assert_eq!(compared(400, true), (364, 2_706, 36));
}

#[test]
fn the_decisional_level_agrees() {
    let system = crate::reconstruction::reconstruction::SYSTEM;
    // One word more than it has, and no place without a bound.
    assert!(
        system.components.iter().all(|it| it
            .net
            .places
            .iter()
            .all(|it| it.bound != Place::UNBOUNDED))
    );
    let rounds = rounds(&system).unwrap();
    let (states, size) = walked(&system, &rounds);
    assert_eq!((states.len(), size), (4_166, Size { states: 4_166, edges: 22_810 }));
}
