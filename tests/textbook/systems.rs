//! Random systems: of every shape that the player treats in a way of its own.

use super::nets::{below, guarded, interval, one_in, pick};
use crate::draw::Draw;
use cotama_core::net::owned::{OwnedIgnored, OwnedLaw, OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{Arc, EventId, Net, OutputId, Place, PlaceId, Role};
use cotama_core::player::slots;
use cotama_core::system::{Binding, Clear, Component, Delivery, Link, Of, System, Target};

/// The most transitions with an interval of a [random system](random_system).
pub const CLOCKS: usize = 12;

/// The most that waits in the mailboxes of a [random system](random_system).
pub const SLOTS: usize = 12;

/// A system that owns its lists.
#[derive(Clone, Debug, Default)]
pub struct OwnedSystem {
    /// The nets, in the order of their turns.
    pub nets: Vec<OwnedNet>,
    /// Which output causes which event.
    pub links: Vec<Link>,
    /// The owner of each shared place.
    pub bindings: Vec<Binding>,
    /// Which event empties which mailbox.
    pub clears: Vec<Clear>,
}

impl OwnedSystem {
    /// A net alone.
    pub fn alone(net: OwnedNet) -> Self {
        Self { nets: vec![net], ..Self::default() }
    }

    /// Tells a story of the system.
    pub fn with<R>(&self, story: impl FnOnce(&System<'_>) -> R) -> R {
        let views: Vec<_> = self.nets.iter().map(OwnedNet::view).collect();
        let nets: Vec<Net<'_>> = views.iter().map(|it| it.net()).collect();
        let components: Vec<_> = nets.iter().map(Component::alone).collect();
        let (links, bindings, clears) = (&self.links, &self.bindings, &self.clears);
        let (name, doc) = ("random", "");
        story(&System { name, doc, components: &components, links, bindings, clears })
    }

    fn delivery(&self, to: Of<EventId>) -> Option<Delivery> {
        self.links.iter().find(|it| it.to == to).map(|it| it.delivery)
    }
}

/// A system of two to four nets of this seed. Seldom it does not fit together.
///
/// # Panics
/// Never: it has fewer of everything than ids.
pub fn random_system(draw: &mut Draw) -> OwnedSystem {
    let mut system = OwnedSystem::default();
    for number in 0..draw.between(2, 4) {
        system.nets.push(places_and_signals(&format!("net{number}"), draw));
    }
    let rising = one_in(draw, 2);
    for component in 0..system.nets.len() {
        for output in 0..system.nets[component].outputs.len() {
            for _ in 0..draw.between(0, 4).div_ceil(2) {
                let id = OutputId(output as u32);
                link(&mut system, Of { component: component as u16, id }, rising, draw);
            }
        }
    }
    for component in 0..system.nets.len() as u16 {
        for _ in 0..draw.between(0, 3) {
            share(&mut system, component, draw);
        }
    }
    for component in 0..system.nets.len() {
        for number in 0..draw.between(4, 10) {
            let timed = system.nets.iter().flat_map(|it| &it.transitions);
            let timed = timed.filter(|it| it.within.is_some()).count();
            let transition = transition(&system, component, number, timed < CLOCKS, draw);
            system.nets[component].transition(transition).expect("few transitions");
        }
    }
    for component in 0..system.nets.len() as u16 {
        let events = system.nets[usize::from(component)].events.len();
        let event = |draw: &mut Draw| EventId(below(draw, events) as u32);
        let (on, mailbox) = (event(draw), event(draw));
        let of = Of { component, id: mailbox };
        if matches!(system.delivery(of), Some(Delivery::Mail { .. })) && one_in(draw, 2) {
            system.clears.push(Clear { on: Of { component, id: on }, mailbox });
        }
    }
    // Last, so that guards can name what is shared.
    let mut draw = draw.clone();
    for net in &mut system.nets {
        let all = std::mem::take(&mut net.ignored);
        net.ignored = all.into_iter().map(|it| guarded(it, net, &mut draw)).collect();
    }
    system
}

/// A net without transitions: a state machine, a counter with its complement, and other data.
fn places_and_signals(name: &str, draw: &mut Draw) -> OwnedNet {
    let mut net = OwnedNet::new(name, "");
    for event in 0..draw.between(1, 4) {
        net.event(&format!("e{event}"), "").expect("few events");
    }
    for output in 0..draw.between(1, 3) {
        net.output(&format!("o{output}"), "").expect("few outputs");
    }
    let states = draw.between(1, 3);
    for state in 0..states {
        let place = OwnedPlace::new(&format!("s{state}"), u32::from(state == 0)).at_most(1);
        net.place(place).expect("few places");
    }
    let sum = (0..states as u32).map(|it| Arc { place: PlaceId(it), weight: 1 }).collect();
    net.laws.push(OwnedLaw::Invariant { sum, equals: 1 });
    if one_in(draw, 2) {
        let bound = *pick(draw, &[1, 1, 2, 3]);
        let tokens = draw.between(0, u64::from(bound)) as u32;
        let place = OwnedPlace::new("counter", tokens).at_most(bound);
        let of = net.place(OwnedPlace { role: Role::Data, ..place }).expect("few places");
        let place = OwnedPlace::new("not counter", bound - tokens).at_most(bound);
        net.place(OwnedPlace { role: Role::Complement(of), ..place }).expect("few places");
    }
    for data in 0..draw.between(0, 2) {
        let bound = *pick(draw, &[1, 1, 2, 3, 3, 300, Place::UNBOUNDED]);
        let tokens = draw.between(0, u64::from(bound.min(2))) as u32;
        let place = OwnedPlace::new(&format!("d{data}"), tokens).at_most(bound);
        net.place(OwnedPlace { role: Role::Data, ..place }).expect("few places");
    }
    let event = EventId(below(draw, net.events.len()) as u32);
    net.ignored.push(OwnedIgnored::new(event, PlaceId(0)));
    net
}

/// From an output to an event: by a rendezvous mostly with nets on one side only.
fn link(system: &mut OwnedSystem, from: Of<OutputId>, rising: bool, draw: &mut Draw) {
    let component = below(draw, system.nets.len()) as u16;
    let id = EventId(below(draw, system.nets[usize::from(component)].events.len()) as u32);
    let to = Of { component, id };
    let may_meet = component != from.component && (component > from.component) == rising;
    let delivery = match system.delivery(to) {
        Some(Delivery::Now) if !may_meet && !one_in(draw, 20) => return,
        Some(delivery) => delivery,
        None if may_meet && !one_in(draw, 3) => Delivery::Now,
        None => Delivery::Mail { capacity: draw.between(1, 3) as u16 },
    };
    system.links.push(Link { from, to, delivery });
    if system.with(slots) > SLOTS {
        system.links.pop();
    }
}

/// A place of a net that is another net's, or a mailbox; with its complement or without.
fn share(system: &mut OwnedSystem, component: u16, draw: &mut Draw) {
    let owner = below(draw, system.nets.len()) as u16;
    let boxes: Vec<_> = system.links.iter().filter(|it| it.delivery != Delivery::Now).collect();
    let (target, bound) = match boxes.get(below(draw, boxes.len().max(1))) {
        Some(Link { to, delivery: Delivery::Mail { capacity }, .. }) if one_in(draw, 2) => {
            (Target::Mailbox(*to), u32::from(*capacity))
        }
        _ => {
            let places = &system.nets[usize::from(owner)].places;
            let at = below(draw, places.len());
            let is_own = matches!(places[at].role, Role::State | Role::Data);
            if owner == component || !is_own {
                return;
            }
            let found =
                (Target::Place(Of { component: owner, id: PlaceId(at as u32) }), places[at].bound);
            if places[at].role == Role::State {
                system.nets[usize::from(owner)].laws.clear(); // others may move its tokens
            }
            found
        }
    };
    let mine = |it: &Binding| it.shared.component == component && it.target == target;
    if system.bindings.iter().any(mine) {
        return;
    }
    let net = &mut system.nets[usize::from(component)];
    let name = format!("shared{}", net.places.len());
    let place = OwnedPlace { role: Role::Shared, ..OwnedPlace::new(&name, 0).at_most(bound) };
    let id = net.place(place).expect("few places");
    system.bindings.push(Binding { shared: Of { component, id }, target });
    if one_in(draw, 2) && bound != Place::UNBOUNDED {
        let place = OwnedPlace::new(&format!("not {name}"), bound).at_most(bound);
        net.place(OwnedPlace { role: Role::Complement(id), ..place }).expect("few places");
    }
}

/// From a state to a state; it counts, tests, waits and says something.
fn transition(
    system: &OwnedSystem,
    component: usize,
    number: u64,
    may_wait: bool,
    draw: &mut Draw,
) -> OwnedTransition {
    let net = &system.nets[component];
    let states = net.places.iter().filter(|it| it.role == Role::State).count();
    let mut it = OwnedTransition::new(&format!("t{number}"));
    if !one_in(draw, 4) {
        it.on = Some(EventId(below(draw, net.events.len()) as u32));
    }
    if may_wait && one_in(draw, 2) {
        it.within = Some(interval(draw));
    }
    let at_once = it.on.is_none() && it.within.is_none_or(|it| it.earliest == 0);
    let (mut from, mut to) = (below(draw, states), below(draw, states));
    // Transitions that fire at once by themselves mostly lead on to later states only, so that the
    // net settles.
    if at_once && !one_in(draw, 20) {
        (from, to) = (from.min(to), from.max(to));
        if from == to {
            it.on = Some(EventId(below(draw, net.events.len()) as u32));
        }
    }
    it = match (one_in(draw, 6) && it.on.is_some(), from as u32, to as u32) {
        (true, from, _) => it.read(PlaceId(from), 1),
        (_, from, to) => it.take(PlaceId(from), 1).give(PlaceId(to), 1),
    };
    for at in states..net.places.len() {
        it = data(it, system, Of { component: component as u16, id: PlaceId(at as u32) }, draw);
    }
    for _ in 0..draw.between(0, 2) {
        it.emits.push(OutputId(below(draw, net.outputs.len()) as u32));
    }
    if one_in(draw, 3) {
        it.priority = *pick(draw, &[-1, 1, 2]);
    }
    it
}

/// Adds the effect of a transition on a place of data: it tests it, or counts up or down, with the
/// complement where the net has one; mailboxes are only tested.
fn data(
    it: OwnedTransition,
    system: &OwnedSystem,
    of: Of<PlaceId>,
    draw: &mut Draw,
) -> OwnedTransition {
    let (net, place) = (&system.nets[usize::from(of.component)], of.id);
    let role = net.places[place.0 as usize].role;
    if let Role::Complement(_) = role {
        return it;
    }
    let weight = *pick(draw, &[1, 1, 1, 1, 2]);
    let absence = net.places.iter().position(|it| it.role == Role::Complement(place));
    let absence = absence.map(|it| PlaceId(it as u32));
    let is_mailbox = |it: &Binding| it.shared == of && matches!(it.target, Target::Mailbox(_));
    let only_read = system.bindings.iter().any(is_mailbox);
    match (draw.between(0, 9), absence) {
        (0 | 1, _) => it.read(place, weight),
        (2 | 3, Some(absence)) => it.read(absence, weight),
        _ if only_read => it,
        (4, Some(absence)) => it.take(place, weight).give(absence, weight),
        (5, Some(absence)) => it.take(absence, weight).give(place, weight),
        // The complement follows a shared place where the net does not move it.
        (6, Some(absence)) if role == Role::Shared => it.read(absence, 1).give(place, weight),
        (7, Some(_)) if role == Role::Shared => it.take(place, weight),
        (4, None) => it.take(place, weight),
        (5, None) => it.give(place, weight),
        (6, None) => it.take(place, 1).give(place, weight),
        _ => it,
    }
}
