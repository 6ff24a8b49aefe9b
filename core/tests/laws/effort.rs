//! What it takes to judge random nets and systems: classes, markings, firings, and all that is said
//! of those that break a law or have a defect.

use crate::draw::Draw;
use crate::efforts::Effort;
use crate::random::{Random, net};
use crate::systems::parts;
use cotama_core::net::owned::{OwnedLaw, OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{Arc, EventId, Graph, Known, Net, OutputId, PlaceId, Role, judge};
use cotama_core::player::{Packed, Program, Steps, clocks, is_state_machine, slots, words};
use cotama_core::system::{self, Component, Delivery, System, SystemDefect, Target};

/// The same net with one more event, and some transitions on any of them.
fn with_another_event(random: &mut Random, mut owned: OwnedNet) -> OwnedNet {
    let own = owned.places.iter().filter(|it| it.role == Role::State).count() as u32;
    owned.event("last", "").unwrap();
    let events = owned.events.len() as u32;
    for at in 0..=random.below(3) {
        let mut it = OwnedTransition::new(&format!("more{at}"))
            .on(EventId(random.below(events)))
            .take(PlaceId(random.below(own)), 1)
            .give(PlaceId(random.below(own)), 1);
        if random.chance(60) {
            let earliest = random.below(4);
            it = it.within(earliest, random.chance(50).then(|| earliest + random.below(3)));
        }
        owned.transitions.push(it);
    }
    owned
}

/// Notes all that is found of a net.
fn judged<const W: usize>(effort: &mut Effort, owned: &OwnedNet) {
    let view = owned.view();
    let net = view.net();
    let packed = Packed::<W, 9>::alone(&net).unwrap();
    let code = packed.code();
    effort.note(&is_state_machine(&net));
    effort.note(&code);
    let graph = Graph::of(&net, &code);
    effort.count("classes", graph.classes() as u64);
    let said = |violation: &cotama_core::net::Violation<'_, W>| {
        let mut text = String::new();
        violation.write(&net, &code, &mut text).unwrap();
        (violation.culprit, violation.way.steps().to_vec(), violation.marking, text)
    };
    match graph.settles(&net, &code) {
        Ok(settle) => effort.note(&settle),
        Err(violation) => {
            effort.note(&said(&violation));
            effort.next();
            return;
        }
    }
    for law in net.laws {
        let broken = graph.breaks(&net, &code, law);
        effort.count("broken", u64::from(broken.is_some()));
        effort.note(&broken.as_ref().map(&said));
    }
    let mut alone = net;
    alone.laws = &[];
    let known = judge(&alone, &code).unwrap();
    effort.note(&(known, known.settle(), known.bounded()));
    if let Known::Explored { markings, firings, .. } = known {
        effort.count("markings", markings as u64);
        effort.count("firings", firings as u64);
    }
    effort.next();
}

#[test]
fn random_nets_have_so_many_classes_and_say_the_same_of_their_laws() {
    let (mut random, mut effort) = (Random(Draw::new(81)), Effort::new(200));
    for at in 0..3_000 {
        let mut owned = net(&mut random);
        if at % 2 == 1 {
            owned = with_another_event(&mut random, owned);
        }
        if at % 5 == 0 {
            // Over two words.
            for more in 0..20 {
                let place = OwnedPlace::new(&format!("wide{more}"), more % 3).at_most(3);
                owned.places.push(OwnedPlace { role: Role::Data, ..place });
            }
            judged::<2>(&mut effort, &owned);
        } else {
            judged::<1>(&mut effort, &owned);
        }
    }
    effort.compare("tests/golden/effort_laws.txt");
}

/// Many timers at once: zones with many differences.
#[test]
fn nets_with_many_timers_have_so_many_classes() {
    let (mut random, mut effort) = (Random(Draw::new(82)), Effort::new(100));
    for _ in 0..1_500 {
        let mut owned = OwnedNet::new("timers", "");
        for name in ["go", "stop", "last"] {
            owned.event(name, "").unwrap();
        }
        let places = 3 + random.below(3);
        for at in 0..places {
            let initial = u32::from(random.chance(60));
            owned.places.push(OwnedPlace::new(&format!("P{at}"), initial).at_most(1));
        }
        for at in 0..3 + random.below(5) {
            let (from, to) = (random.below(places), random.below(places));
            let mut it = OwnedTransition::new(&format!("t{at}")).take(PlaceId(from), 1);
            // Most lead onward, so that it settles.
            if to > from || random.chance(20) {
                it = it.give(PlaceId(to), 1);
            }
            if random.chance(30) {
                it = it.on(EventId(random.below(3)));
            }
            let earliest = 1 + random.below(9);
            let latest = random.chance(70).then(|| earliest + random.below(9));
            it = if random.chance(85) { it.within(earliest, latest) } else { it };
            it.priority = random.below(3) as i16;
            owned.transitions.push(it);
        }
        for at in 0..places {
            owned.laws.push(OwnedLaw::Reachable(PlaceId(at)));
            owned.laws.push(OwnedLaw::AlwaysCan(PlaceId(at)));
            owned.laws.push(OwnedLaw::NeverBoth(PlaceId(at), PlaceId((at + 1) % places)));
        }
        owned.laws.extend([OwnedLaw::DeadlockFree { end: None }, OwnedLaw::Deterministic]);
        judged::<1>(&mut effort, &owned);
    }
    effort.compare("tests/golden/effort_timers.txt");
}

#[test]
fn random_systems_have_so_many_states_and_say_the_same_of_what_they_forget() {
    let (mut random, mut effort) = (Random(Draw::new(83)), Effort::new(50));
    for _ in 0..500 {
        let parts = parts(&mut random);
        parts.with_system(|system| {
            effort.note(&(words(system), slots(system), clocks(system), system.defect()));
            let Ok(packed) = Packed::<2, 0, 18>::of(system) else { return };
            let code = packed.code();
            effort.note(&code);
            match system::judge(system, &code) {
                Ok(states) => effort.count("states", states as u64),
                Err(violation) => {
                    let mut text = String::new();
                    violation.write(system, &code, &mut text).unwrap();
                    effort.note(&(violation.culprit, violation.steps(), violation.marking, text));
                    effort.count("forgetful", 1);
                }
            }
        });
        effort.next();
    }
    effort.compare("tests/golden/effort_systems.txt");
}

/// One thing in a net is made wrong, or seems so.
fn wrong(random: &mut Random, net: &mut OwnedNet) {
    let places = net.places.len() as u32;
    let beyond = |random: &mut Random, length: u32| length.saturating_sub(1) + random.below(2);
    let transition = random.below(net.transitions.len() as u32) as usize;
    let place = random.below(places) as usize;
    match random.below(14) {
        0 => net.places[place].initial = net.places[place].bound.saturating_add(random.below(2)),
        1 => net.places[place].role = Role::Complement(PlaceId(beyond(random, places))),
        2 => net.places[place].name = net.places[0].name.clone(),
        3 => net.places[place].bound += random.below(3),
        4 => {
            let arc = Arc { place: PlaceId(beyond(random, places)), weight: random.below(2) };
            net.transitions[transition].take.push(arc);
        }
        5 => {
            let arc = Arc { place: PlaceId(beyond(random, places)), weight: 1 };
            net.transitions[transition].give.push(arc);
        }
        6 => {
            let arc = Arc { place: PlaceId(beyond(random, places)), weight: random.below(2) };
            net.transitions[transition].read.push(arc);
        }
        7 => {
            let event = EventId(beyond(random, net.events.len() as u32));
            net.transitions[transition].on = Some(event);
        }
        8 => {
            let output = OutputId(beyond(random, net.outputs.len() as u32));
            net.transitions[transition].emits.push(output);
        }
        9 => {
            let latest = [0, 3, 2_000_000_000, u32::MAX][random.below(4) as usize];
            let earliest = [0, 4, 1 << 30, u32::MAX][random.below(4) as usize];
            let it = net.transitions[transition].clone();
            net.transitions[transition] = it.within(earliest, Some(latest));
        }
        10 => {
            for name in ["E0", "E1", "E0"].iter().take(1 + random.below(3) as usize) {
                let _ = net.event(name, "");
            }
        }
        11 => {
            let (event, at) = (beyond(random, net.events.len() as u32), beyond(random, places));
            let it = cotama_core::net::owned::OwnedIgnored::new(EventId(event), PlaceId(at));
            let guard = PlaceId(beyond(random, places));
            net.ignored.push(it.guard(guard, random.below(2)));
        }
        12 => {
            let place = PlaceId(beyond(random, places));
            net.laws.push(match random.below(5) {
                0 => OwnedLaw::NeverBoth(place, PlaceId(0)),
                1 => OwnedLaw::NeverBoth(PlaceId(0), place),
                2 => OwnedLaw::Reachable(place),
                3 => OwnedLaw::AlwaysCan(place),
                _ => OwnedLaw::DeadlockFree { end: Some(place) },
            });
        }
        _ => {
            let arc = |random: &mut Random| {
                let place = PlaceId(beyond(random, places).saturating_sub(random.below(2)));
                Arc { place, weight: random.below(3) }
            };
            let sum = (0..=random.below(3)).map(|_| arc(random)).collect();
            net.laws.push(OwnedLaw::Invariant { sum, equals: 1 });
        }
    }
}

#[test]
fn what_is_wrong_with_a_net_is_found_and_said() {
    let (mut random, mut effort) = (Random(Draw::new(84)), Effort::new(500));
    for _ in 0..5_000 {
        let mut owned = net(&mut random);
        for _ in 0..=random.below(2) {
            wrong(&mut random, &mut owned);
        }
        let view = owned.view();
        let net = view.net();
        let defect = net.defect();
        effort.count("defects", u64::from(defect.is_some()));
        effort.note(&(defect, defect.map(|it| it.to_string())));
        effort.note(&Packed::<2, 9>::alone(&net).map(|it| it.code().fingerprint));
        effort.next();
    }
    effort.compare("tests/golden/effort_defects.txt");
}

/// One thing in a system is made wrong, or seems so.
fn wrong_together(random: &mut Random, parts: &mut crate::systems::Parts) {
    let nets = parts.nets.len() as u32;
    let link = random.below(parts.links.len().max(1) as u32) as usize;
    let binding = random.below(parts.bindings.len().max(1) as u32) as usize;
    let (kind, number) = (random.below(12), random.below(5));
    if let Some(it) = parts.links.get_mut(link) {
        match kind {
            0 => it.from.component = (nets - 1 + number % 2) as u16,
            1 => it.to.component = (number % (nets + 1)) as u16,
            2 => it.from.id = OutputId(number),
            3 => it.to.id = EventId(number),
            4 => it.delivery = Delivery::Now,
            5 => it.delivery = Delivery::Mail { capacity: number as u16 },
            _ => {}
        }
    }
    if let Some(it) = parts.bindings.get_mut(binding) {
        match (kind, &mut it.target) {
            (6, _) => it.shared.component = (number % (nets + 1)) as u16,
            (7, _) => it.shared.id = PlaceId(number),
            (8, Target::Place(of)) => of.id = PlaceId(number),
            (8, Target::Mailbox(of)) => of.id = EventId(number),
            (9, Target::Place(of)) => of.component = (number % (nets + 1)) as u16,
            (9, Target::Mailbox(of)) => of.component = (number % (nets + 1)) as u16,
            _ => {}
        }
    }
    if kind == 10 {
        let it = parts.bindings.get(binding).copied();
        parts.bindings.extend(it.filter(|_| number > 1));
        if number < 2 {
            parts.bindings.pop();
        }
    }
    if let (11, Some(it)) = (kind, parts.clears.first_mut()) {
        if number < 2 {
            it.mailbox = EventId(2 + number);
        } else {
            it.on.id = EventId(number);
        }
    }
}

#[test]
fn what_is_wrong_with_a_system_is_found_and_said() {
    let (mut random, mut effort) = (Random(Draw::new(85)), Effort::new(200));
    for _ in 0..4_000 {
        let mut parts = parts(&mut random);
        for _ in 0..=random.below(3) {
            wrong_together(&mut random, &mut parts);
        }
        parts.with_system(|system| {
            let defect: Option<SystemDefect> = system.defect();
            effort.count("defects", u64::from(defect.is_some()));
            effort.note(&(defect, defect.map(|it| it.to_string())));
            if defect.is_none() {
                effort.note(&(words(system), slots(system)));
            }
        });
        effort.next();
    }
    effort.compare("tests/golden/effort_system_defects.txt");
}

/// The steps of a net whose transitions are `T`.
fn steps<const T: usize>(effort: &mut Effort, net: &Net<'_>) {
    let alone = [Component::alone(net)];
    let system = System::alone(&alone);
    let packed = Packed::<1, 9>::alone(net).unwrap();
    let code = packed.code();
    let steps = Steps::<T, 1>::of(&system, &code);
    // As the program on the heap finds them.
    let loaded = packed.load(&system);
    for at in 0..T {
        assert_eq!(steps.takes[at], loaded.takes(at as u16));
        assert_eq!(Some(steps.order[at]), loaded.ordered(at));
    }
    effort.note(&steps);
}

#[test]
fn steps_that_the_compiler_lists_are_those_of_a_net_on_the_heap() {
    let (mut random, mut effort) = (Random(Draw::new(86)), Effort::new(100));
    for _ in 0..1_000 {
        let owned = net(&mut random);
        let view = owned.view();
        let net = view.net();
        match net.transitions.len() {
            1 => steps::<1>(&mut effort, &net),
            2 => steps::<2>(&mut effort, &net),
            3 => steps::<3>(&mut effort, &net),
            4 => steps::<4>(&mut effort, &net),
            _ => steps::<5>(&mut effort, &net),
        }
        effort.next();
    }
    effort.compare("tests/golden/effort_steps.txt");
}
