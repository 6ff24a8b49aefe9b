//! Random nets: of every shape that the player treats in a way of its own.

use crate::draw::Draw;
use cotama_core::net::owned::{OwnedIgnored, OwnedLaw, OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{Arc, EventId, OutputId, Place, PlaceId, Role, Within};

/// The most words of a marking of a [random net](random_net).
pub const WORDS: usize = 4;

/// The most transitions with an interval of a [random net](random_net).
pub const CLOCKS: usize = 8;

/// Whether transitions have intervals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Time {
    /// No net has intervals.
    Without,
    /// Up to [`CLOCKS`] have.
    With,
}

/// A net of this seed, without defect: places with arcs at random, or a state machine with
/// counters.
///
/// # Panics
/// Never: it has fewer places than ids.
pub fn random_net(draw: &mut Draw, time: Time) -> OwnedNet {
    let mut net = OwnedNet::new("random", "");
    let is_machine = one_in(draw, 2);
    for event in 0..draw.between(u64::from(is_machine), 4) {
        net.event(&format!("e{event}"), "").expect("few events");
    }
    for output in 0..draw.between(0, 2) {
        net.output(&format!("o{output}"), "").expect("few outputs");
    }
    let states = if is_machine { places_of_a_machine(&mut net, draw) } else { 0 };
    if !is_machine {
        scattered_places(&mut net, draw);
    }
    let many = if net.places.len() > 16 { 40 } else { 16 };
    for number in 0..draw.between(1, many) {
        let transition = OwnedTransition::new(&format!("t{number}"));
        let transition = if is_machine {
            arcs_of_a_machine(transition, &net, states, draw)
        } else {
            scattered_arcs(transition, &net, draw)
        };
        let transition = trigger(transition, &net, draw, time);
        net.transition(transition).expect("few transitions");
    }
    if one_in(draw, 2) {
        let priorities: &[i16] =
            if one_in(draw, 8) { &[i16::MIN, 0, i16::MAX] } else { &[-1, 0, 1, 2] };
        for transition in &mut net.transitions {
            transition.priority = *pick(draw, priorities);
        }
    }
    if !net.events.is_empty() {
        for _ in 0..draw.between(0, 3) {
            let event = EventId(below(draw, net.events.len()) as u32);
            let it = OwnedIgnored::new(event, any_place(&net, draw));
            net.ignored.push(guarded(it, &net, &mut draw.clone()));
        }
    }
    net
}

/// The same, often under a guard on any places.
pub fn guarded(mut it: OwnedIgnored, net: &OwnedNet, draw: &mut Draw) -> OwnedIgnored {
    while one_in(draw, 2) {
        let place = any_place(net, draw);
        if it.guard.iter().all(|arc| arc.place != place) {
            it = it.guard(place, *pick(draw, &[1, 1, 1, 2, 300, u32::MAX]));
        }
    }
    it
}

/// One in so many times.
pub fn one_in(draw: &mut Draw, times: u64) -> bool {
    draw.between(1, times) == 1
}

/// One of these.
///
/// # Panics
/// When there is none.
pub fn pick<'a, T>(draw: &mut Draw, from: &'a [T]) -> &'a T {
    &from[below(draw, from.len())]
}

pub(super) fn below(draw: &mut Draw, length: usize) -> usize {
    draw.between(0, length as u64 - 1) as usize
}

fn any_place(net: &OwnedNet, draw: &mut Draw) -> PlaceId {
    PlaceId(below(draw, net.places.len()) as u32)
}

/// Few tokens, seldom as many as it can hold.
fn initial(draw: &mut Draw, bound: u32) -> u32 {
    let few = draw.between(0, 3) as u32;
    if one_in(draw, 8) { bound.min(65_535) } else { few.min(bound) }
}

fn scattered_places(net: &mut OwnedNet, draw: &mut Draw) {
    let many = one_in(draw, 8);
    for number in 0..if many { draw.between(30, 60) } else { draw.between(1, 12) } {
        let bound = match draw.between(0, 15) {
            _ if many => draw.between(1, 3) as u32,
            0 | 1 => Place::UNBOUNDED,
            2 => *pick(draw, &[7, 8, 255, 256, 40_000, 65_535, 65_536, 1 << 31]),
            _ => draw.between(1, 5) as u32,
        };
        let place = OwnedPlace::new(&format!("p{number}"), initial(draw, bound)).at_most(bound);
        let role =
            *pick(draw, &[Role::State, Role::State, Role::Data, Role::Shared, Role::Mailbox]);
        net.place(OwnedPlace { role, ..place }).expect("few places");
    }
}

/// Weights are small; a few are more than the place can ever hold.
fn weight(draw: &mut Draw) -> u32 {
    match draw.between(0, 39) {
        0 => *pick(draw, &[4, 7, 8, 9, 16, 300, 65_535, 65_536, 131_072, u32::MAX]),
        1..=4 => 3,
        5..=11 => 2,
        _ => 1,
    }
}

fn scattered_arcs(mut it: OwnedTransition, net: &OwnedNet, draw: &mut Draw) -> OwnedTransition {
    for _ in 0..draw.between(0, 5).div_ceil(2) {
        add(&mut it.take, any_place(net, draw), weight(draw));
    }
    for _ in 0..draw.between(0, 3).saturating_sub(1) {
        let place = any_place(net, draw);
        if it.take.iter().all(|arc| arc.place != place) {
            add(&mut it.read, place, weight(draw));
        }
    }
    for _ in 0..draw.between(0, 4) / 2 {
        add(&mut it.give, any_place(net, draw), weight(draw));
    }
    it
}

/// States with one token, counters with their complements, and other data; how many states.
fn places_of_a_machine(net: &mut OwnedNet, draw: &mut Draw) -> u32 {
    let states = if one_in(draw, 10) { draw.between(20, 70) } else { draw.between(1, 8) } as u32;
    let marked = draw.between(0, u64::from(states) - 1) as u32;
    let bound = *pick(draw, &[1, 1, 1, 2]);
    for state in 0..states {
        let place =
            OwnedPlace::new(&format!("s{state}"), u32::from(state == marked)).at_most(bound);
        net.place(place).expect("few places");
    }
    for counter in 0..draw.between(0, 2) {
        let bound = *pick(draw, &[1, 1, 2, 3, 5, 7, 300]);
        let tokens = draw.between(0, u64::from(bound)) as u32;
        let place = OwnedPlace::new(&format!("c{counter}"), tokens).at_most(bound);
        let of = net.place(OwnedPlace { role: Role::Data, ..place }).expect("few places");
        let place = OwnedPlace::new(&format!("not c{counter}"), bound - tokens).at_most(bound);
        net.place(OwnedPlace { role: Role::Complement(of), ..place }).expect("few places");
    }
    for data in 0..draw.between(0, 2) {
        let bound = *pick(draw, &[1, 3, 4, Place::UNBOUNDED]);
        let place = OwnedPlace::new(&format!("d{data}"), initial(draw, bound)).at_most(bound);
        net.place(OwnedPlace { role: Role::Data, ..place }).expect("few places");
    }
    let sum = (0..states).map(|state| Arc { place: PlaceId(state), weight: 1 }).collect();
    net.laws.push(OwnedLaw::Invariant { sum, equals: 1 });
    if states > 1 {
        net.laws.push(OwnedLaw::NeverBoth(PlaceId(0), PlaceId(states - 1)));
    }
    states
}

/// From a state to a state, or staying in one that is read; counters count up and down, or are
/// tested.
fn arcs_of_a_machine(
    it: OwnedTransition,
    net: &OwnedNet,
    states: u32,
    draw: &mut Draw,
) -> OwnedTransition {
    let mut state = || PlaceId(below(draw, states as usize) as u32);
    let (from, to) = (state(), state());
    let mut it = if one_in(draw, 24) { it.read(from, 1) } else { it.take(from, 1).give(to, 1) };
    for place in states..net.places.len() as u32 {
        let weight = *pick(draw, &[1, 1, 1, 2]);
        let (this, next) = (PlaceId(place), PlaceId(place + 1));
        let has_complement = net
            .places
            .get(place as usize + 1)
            .is_some_and(|next| next.role == Role::Complement(this));
        match (draw.between(0, 7), net.places[place as usize].role) {
            (_, Role::Complement(_)) => {}
            (0, _) => it.read.push(Arc { place: this, weight }),
            (1, _) if has_complement => it.read.push(Arc { place: next, weight }),
            (2, _) if has_complement => it = it.take(this, weight).give(next, weight),
            (3, _) if has_complement => it = it.take(next, weight).give(this, weight),
            (2, _) => it = it.take(this, weight),
            (3, _) => it = it.give(this, weight),
            _ => {}
        }
    }
    it
}

/// Draws the event and the outputs of a transition. One that fires at once by itself mostly moves
/// tokens to later places only, so that the net settles.
fn trigger(
    mut it: OwnedTransition,
    net: &OwnedNet,
    draw: &mut Draw,
    time: Time,
) -> OwnedTransition {
    for _ in 0..draw.between(0, 2) {
        if !net.outputs.is_empty() {
            it.emits.push(OutputId(below(draw, net.outputs.len()) as u32));
        }
    }
    if !net.events.is_empty() && !one_in(draw, 4) {
        it.on = Some(EventId(below(draw, net.events.len()) as u32));
    }
    let timed = net.transitions.iter().filter(|it| it.within.is_some()).count();
    if time == Time::With && timed < CLOCKS && !one_in(draw, 3) {
        it.within = Some(interval(draw));
    }
    let settles = it.give.iter().all(|given| it.take.iter().any(|taken| taken.place < given.place));
    let at_once = it.on.is_none() && it.within.is_none_or(|within| within.earliest == 0);
    if at_once && (!settles || it.take.is_empty()) && !one_in(draw, 20) {
        if net.events.is_empty() {
            it.give.retain(|given| it.take.iter().any(|taken| taken.place < given.place));
        } else {
            it.on = Some(EventId(below(draw, net.events.len()) as u32));
        }
    }
    it
}

pub(super) fn interval(draw: &mut Draw) -> Within {
    let earliest = if one_in(draw, 6) { 0 } else { draw.between(1, 20) as u32 };
    let latest = match draw.between(0, 2) {
        0 => Some(earliest),
        1 => Some(earliest + draw.between(0, 20) as u32),
        _ => None,
    };
    Within { earliest, latest }
}

fn add(arcs: &mut Vec<Arc>, place: PlaceId, weight: u32) {
    if arcs.iter().all(|arc| arc.place != place) {
        arcs.push(Arc { place, weight });
    }
}
