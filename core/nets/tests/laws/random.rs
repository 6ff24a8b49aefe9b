//! Small random nets.

use crate::draw::Draw;
use cotama_core::net::owned::{OwnedIgnored, OwnedLaw, OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{Arc, EventId, PlaceId, Role};

/// The source of random nets.
pub(crate) struct Random(pub(crate) Draw);

impl Random {
    pub(crate) fn below(&mut self, limit: u32) -> u32 {
        self.0.between(0, u64::from(limit) - 1) as u32
    }

    /// True in so many of a hundred cases.
    pub(crate) fn chance(&mut self, percent: u32) -> bool {
        self.below(100) < percent
    }
}

/// A net of up to five transitions on up to four places, some of them flags or shared, with
/// intervals up to 4 ms, and all laws that it can have.
pub(crate) fn net(random: &mut Random) -> OwnedNet {
    let mut net = OwnedNet::new("random", "");
    let own = 2 + random.below(3) as usize;
    for at in 0..own {
        let bound = 1 + u32::from(random.chance(15));
        let initial = u32::from(at == 0 || random.chance(15));
        net.places.push(OwnedPlace::new(&format!("P{at}"), initial).at_most(bound));
    }
    if own < 4 && random.chance(35) {
        let role = if random.chance(50) { Role::Shared } else { Role::Data };
        data(&mut net, role, u32::from(random.chance(50)));
    }
    let events = random.below(3);
    for at in 0..events {
        net.event(&format!("E{at}"), "").unwrap();
    }
    for at in 0..=random.below(5) {
        let transition = transition(random, &net, own, at);
        net.transitions.push(transition);
    }
    for event in 0..events {
        for place in 0..own as u32 {
            if random.chance(45) {
                let it = OwnedIgnored::new(EventId(event), PlaceId(place));
                let places: Vec<_> = (0..net.places.len() as u32).map(PlaceId).collect();
                net.ignored.push(guarded(random, it, &places));
            }
        }
    }
    laws(&mut net, own);
    net
}

/// The same, in some cases with a guard on these places, the last ones more often.
pub(crate) fn guarded(
    random: &mut Random,
    mut it: OwnedIgnored,
    places: &[PlaceId],
) -> OwnedIgnored {
    while random.chance(40) {
        let count = places.len() as u32;
        let place = places[random.below(count).max(random.below(count)) as usize];
        if it.guard.iter().all(|arc| arc.place != place) {
            it = it.guard(place, 1 + u32::from(random.chance(10)));
        }
    }
    it
}

/// Adds a flag, or a shared one, with its complement.
fn data(net: &mut OwnedNet, role: Role, initial: u32) {
    let of = PlaceId(net.places.len() as u32);
    net.places.push(OwnedPlace { role, ..OwnedPlace::new("flag", initial).at_most(1) });
    let complement = OwnedPlace::new("not_flag", 1 - initial).at_most(1);
    net.places.push(OwnedPlace { role: Role::Complement(of), ..complement });
}

fn transition(random: &mut Random, net: &OwnedNet, own: usize, at: u32) -> OwnedTransition {
    let place = |random: &mut Random| PlaceId(random.below(own as u32));
    let mut it = OwnedTransition { line: at, ..OwnedTransition::new(&format!("t{at}")) };
    if !net.events.is_empty() && random.chance(60) {
        it = it.on(EventId(random.below(net.events.len() as u32)));
    }
    if random.chance(92) {
        it = it.take(place(random), 1);
    }
    let mut given = vec![];
    for _ in 0..u32::from(random.chance(92)) + u32::from(random.chance(7)) {
        given.push(place(random));
    }
    given.sort_unstable();
    given.dedup();
    for place in given {
        it = it.give(place, 1);
    }
    let taken = |it: &OwnedTransition, place| it.take.iter().any(|arc| arc.place == place);
    let read = place(random);
    if random.chance(15) && !taken(&it, read) {
        it = it.read(read, 1);
    }
    if net.places.len() > own && random.chance(60) {
        let (flag, complement) = (PlaceId(own as u32), PlaceId(own as u32 + 1));
        let (from, to) = if random.chance(50) { (flag, complement) } else { (complement, flag) };
        it = if random.chance(50) { it.read(from, 1) } else { it.take(from, 1).give(to, 1) };
    }
    if random.chance(if it.on.is_some() { 50 } else { 70 }) {
        let earliest = random.below(5);
        let latest = random.chance(60).then(|| earliest + random.below(5 - earliest));
        it = it.within(earliest, latest);
    }
    it.priority = if random.chance(25) { random.below(3) as i16 - 1 } else { 0 };
    it
}

fn laws(net: &mut OwnedNet, own: usize) {
    let sum = (0..own).map(|at| Arc { place: PlaceId(at as u32), weight: 1 }).collect();
    let equals = net.places.iter().take(own).map(|it| it.initial).sum();
    net.laws = vec![
        OwnedLaw::Invariant { sum, equals },
        OwnedLaw::HandlesAll,
        OwnedLaw::Deterministic,
        OwnedLaw::DeadlockFree { end: None },
        OwnedLaw::DeadlockFree { end: Some(PlaceId(1)) },
    ];
    for at in 0..own as u32 {
        net.laws.push(OwnedLaw::Reachable(PlaceId(at)));
        net.laws.push(OwnedLaw::AlwaysCan(PlaceId(at)));
        net.laws.push(OwnedLaw::NeverBoth(PlaceId(at), PlaceId((at + 1) % own as u32)));
    }
}

/// The same net in which events raise and lower its shared places: what other nets do to it.
pub(crate) fn with_others(net: &OwnedNet) -> OwnedNet {
    let mut both = net.clone();
    for (at, place) in net.places.iter().enumerate() {
        let complement = PlaceId(at as u32);
        let Role::Complement(of) = place.role else { continue };
        if net.places[of.0 as usize].role != Role::Shared {
            continue;
        }
        for (from, to) in [(complement, of), (of, complement)] {
            let event = both.event(&format!("other{}", from.0), "").unwrap();
            both.transition(OwnedTransition::new("other").on(event).take(from, 1).give(to, 1))
                .unwrap();
        }
    }
    both
}
