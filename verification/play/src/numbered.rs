//! A system as one list of places, of events, of outputs and of transitions.

use alloc::borrow::ToOwned;
use alloc::collections::BTreeMap;
use alloc::format;
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;
use cotama_core::net::owned::{OwnedIgnored, OwnedNet, OwnedPlace, OwnedSignal, OwnedTransition};
use cotama_core::net::{Arc, EventId, Net, OutputId, Place, PlaceId, Role, TransitionId, Within};
use cotama_core::system::{Binding, Clear, Component, Delivery, Link, Of, System, Target};
use cotama_core::units::Millis;

/// The location of the tokens of a place.
#[derive(Clone, Copy, Debug)]
pub(super) enum Seat {
    Place(Of<PlaceId>),
    /// The mailbox in which this event waits.
    Mailbox(Of<EventId>),
    /// The free room of a place up to its bound, where no net counts it.
    Complement {
        of: Of<PlaceId>,
        bound: u32,
    },
}

/// A system, or a net alone, to be played: everything in it by one number each.
///
/// Names of a system are `net.name`, of a net alone the net's own. A mailbox is a place, as
/// `net.event.waiting`. Events that another net causes, and outputs that another net hears, are
/// not listed.
#[derive(Clone, Debug)]
pub struct Numbered {
    whole: OwnedNet,
    nets: Vec<OwnedNet>,
    names: Vec<String>,
    links: Vec<Link>,
    bindings: Vec<Binding>,
    clears: Vec<Clear>,
    /// By the number of a place, and how many of them are of use to a reader.
    seats: Vec<Seat>,
    shown: usize,
    mailboxes: BTreeMap<(u16, u32), PlaceId>,
    /// The places of each net.
    places: BTreeMap<(u16, u32), PlaceId>,
    /// By the number of an event, and how many are told from outside.
    events: Vec<Of<EventId>>,
    told: usize,
    /// The first transition of each net.
    first: Vec<u32>,
    /// For each transition the event that chooses it.
    choices: Vec<Option<EventId>>,
}

impl Numbered {
    /// A system that fits together; what does not is found when it is played.
    pub fn of(system: &System<'_>) -> Self {
        let mut numbered = Self {
            whole: OwnedNet::new(system.name, system.doc),
            nets: system.components.iter().map(|it| OwnedNet::from(it.net)).collect(),
            names: system.components.iter().map(|it| it.name.to_owned()).collect(),
            links: system.links.to_vec(),
            bindings: system.bindings.to_vec(),
            clears: system.clears.to_vec(),
            seats: Vec::new(),
            shown: 0,
            mailboxes: BTreeMap::new(),
            places: BTreeMap::new(),
            events: Vec::new(),
            told: 0,
            first: Vec::new(),
            choices: Vec::new(),
        };
        numbered.lay_out(system);
        numbered
    }

    fn lay_out(&mut self, system: &System<'_>) {
        let alone = system.is_alone();
        let name = |it: &Component<'_>, of: &str| {
            if alone { of.to_owned() } else { format!("{}.{of}", it.name) }
        };
        let mut places = BTreeMap::new();
        for (component, it) in (0_u16..).zip(system.components) {
            for (place, id) in it.net.places.iter().zip((0..).map(PlaceId)) {
                let of = Of { component, id };
                let shared = |id: PlaceId| {
                    let place = it.net.places.get(id.0 as usize);
                    place.is_some_and(|it| it.role == Role::Shared)
                        && system.target(Of { component, id }).is_some()
                };
                let borrowed = match place.role {
                    Role::Shared => shared(id),
                    Role::Complement(of) => shared(of),
                    _ => false,
                };
                if !borrowed {
                    let own =
                        OwnedPlace { name: name(it, place.name), ..owned_place(place, place.role) };
                    places.insert((component, id.0), self.seat_of(own, Seat::Place(of)));
                }
            }
        }
        for (component, it) in (0_u16..).zip(system.components) {
            for (event, id) in it.net.events.iter().zip((0..).map(EventId)) {
                let of = Of { component, id };
                match system.delivery(of) {
                    None => {
                        self.events.push(of);
                        let named =
                            OwnedSignal { name: name(it, event.name), doc: event.doc.to_owned() };
                        self.whole.events.push(named);
                    }
                    Some(Delivery::Now) => {}
                    Some(Delivery::Mail { capacity }) => {
                        let label = format!("{}.waiting", name(it, event.name));
                        let place = OwnedPlace::new(&label, 0).at_most(capacity.into());
                        let place = OwnedPlace { role: Role::Mailbox, ..place };
                        let seat = self.seat_of(place, Seat::Mailbox(of));
                        self.mailboxes.insert((component, id.0), seat);
                    }
                }
            }
        }
        (self.shown, self.told) = (self.seats.len(), self.events.len());
        self.borrow(system, &mut places);
        for (component, it) in (0_u16..).zip(system.components) {
            self.add_net(system, component, it.net, &places, |of| name(it, of));
        }
        self.choices = vec![None; self.whole.transitions.len()];
        self.places = places;
    }

    fn seat_of(&mut self, place: OwnedPlace, seat: Seat) -> PlaceId {
        self.whole.places.push(place);
        self.seats.push(seat);
        PlaceId(self.seats.len() as u32 - 1)
    }

    /// Places that belong to other nets, and their complements.
    fn borrow(&mut self, system: &System<'_>, places: &mut BTreeMap<(u16, u32), PlaceId>) {
        for binding in system.bindings {
            let Of { component, id } = binding.shared;
            let seat = match binding.target {
                Target::Place(of) => places.get(&(of.component, of.id.0)),
                Target::Mailbox(of) => self.mailboxes.get(&(of.component, of.id.0)),
            };
            let Some(&seat) = seat else { continue };
            places.insert((component, id.0), seat);
            let Some(net) = system.components.get(usize::from(component)).map(|it| it.net) else {
                continue;
            };
            for (place, number) in net.places.iter().zip(0..) {
                if place.role == Role::Complement(id) {
                    let of = Of { component, id };
                    let name = format!("{}.absent", self.whole.places[seat.0 as usize].name);
                    let it = OwnedPlace { name, ..owned_place(place, Role::Complement(seat)) };
                    let seat = Seat::Complement { of, bound: place.bound };
                    places.insert((component, number), self.seat_of(it, seat));
                }
            }
        }
        // Until here roles have the numbers of one net each.
        for (&(component, place), &seat) in places.iter() {
            let net = system.components.get(usize::from(component)).map(|it| it.net);
            let role = net.and_then(|it| it.places.get(place as usize)).map(|it| it.role);
            if let Some(Role::Complement(of)) = role
                && let Some(&of) = places.get(&(component, of.0))
            {
                self.whole.places[seat.0 as usize].role = Role::Complement(of);
            }
        }
    }

    fn add_net(
        &mut self,
        system: &System<'_>,
        component: u16,
        net: &Net<'_>,
        places: &BTreeMap<(u16, u32), PlaceId>,
        name: impl Fn(&str) -> String,
    ) {
        let place = |id: PlaceId| places.get(&(component, id.0)).copied().unwrap_or(id);
        let arcs = |arcs: &[Arc]| -> Vec<_> {
            arcs.iter().map(|arc| Arc { place: place(arc.place), ..*arc }).collect()
        };
        let first_output = self.whole.outputs.len() as u32;
        let mut outputs = BTreeMap::new();
        for (output, id) in net.outputs.iter().zip((0..).map(OutputId)) {
            let from = Of { component, id };
            if !system.links.iter().any(|it| it.from == from) {
                outputs.insert(id.0, OutputId(first_output + outputs.len() as u32));
                let said = OwnedSignal { name: name(output.name), doc: output.doc.to_owned() };
                self.whole.outputs.push(said);
            }
        }
        let told: BTreeMap<_, _> = (0..)
            .map(EventId)
            .zip(&self.events)
            .filter(|it| it.1.component == component)
            .map(|(number, of)| (of.id, number))
            .collect();
        self.first.push(self.whole.transitions.len() as u32);
        for it in net.transitions {
            self.whole.transitions.push(OwnedTransition {
                doc: it.doc.to_owned(),
                line: it.line,
                on: it.on.and_then(|it| told.get(&it).copied()),
                take: arcs(it.take),
                read: arcs(it.read),
                give: arcs(it.give),
                emits: it.emits.iter().filter_map(|it| outputs.get(&it.0).copied()).collect(),
                within: it.within,
                priority: it.priority,
                ..OwnedTransition::new(&name(it.name))
            });
        }
        let ignored = net.ignored.iter().filter_map(|it| {
            let (event, guard) = (*told.get(&it.event)?, arcs(it.guard));
            Some(OwnedIgnored { event, place: place(it.place), guard })
        });
        self.whole.ignored.extend(ignored);
    }

    /// The number of a place of one of its nets.
    pub fn place(&self, of: Of<PlaceId>) -> Option<PlaceId> {
        self.places.get(&(of.component, of.id.0)).copied()
    }

    /// The number of the first transition of a net; those after it follow in the order of the net.
    pub fn first_transition(&self, component: usize) -> Option<TransitionId> {
        self.first.get(component).copied().map(TransitionId)
    }

    /// The number of an event of one of its nets that is told from outside.
    pub fn event(&self, of: Of<EventId>) -> Option<EventId> {
        let at = self.events.iter().position(|it| *it == of)?;
        u32::try_from(at).ok().map(EventId)
    }

    /// Everything in it as one net, for its names and numbers; it is not what is played.
    pub fn whole(&self) -> &OwnedNet {
        &self.whole
    }

    /// The number of places that a reader wants to see: those behind them follow from these.
    pub fn shown_places(&self) -> usize {
        self.shown
    }

    /// The number of events that are told from outside: those behind them are
    /// [choices](Self::choosing).
    pub fn told_events(&self) -> usize {
        self.told
    }

    /// True if it is a system of nets.
    pub fn is_system(&self) -> bool {
        self.nets.len() > 1 || !self.links.is_empty()
    }

    /// True if nothing in it waits for an event or for time: it moves by nobody's word.
    pub fn is_plain(&self) -> bool {
        self.nets.iter().all(|net| {
            net.events.is_empty() && net.transitions.iter().all(|it| it.within.is_none())
        })
    }

    /// The name of a transition.
    pub fn transition(&self, TransitionId(id): TransitionId) -> &str {
        self.whole.transitions.get(id as usize).map_or("?", |it| &it.name)
    }

    /// The name of the event that a transition needs, whoever tells it; with the event of a
    /// choice it needs none.
    pub fn needs_event(&self, id: TransitionId) -> Option<String> {
        let (net, name, TransitionId(own)) = self.net_of(id)?;
        if self.choice(id).is_some() {
            return None;
        }
        let event = net.transitions.get(own as usize)?.on?;
        let event = &net.events.get(event.0 as usize)?.name;
        Some(if self.is_system() { format!("{name}.{event}") } else { event.clone() })
    }

    /// Returns the outputs of a transition in order: the name, `NET.OUTPUT` in a system, and
    /// whether another net hears it.
    pub fn says(&self, id: TransitionId) -> Vec<(String, bool)> {
        let Some((net, name, TransitionId(own))) = self.net_of(id) else { return Vec::new() };
        let component = self.first.partition_point(|&first| first <= id.0).wrapping_sub(1);
        let emits = net.transitions.get(own as usize).map_or(&[][..], |it| &it.emits);
        let said = emits.iter().filter_map(|&id| {
            let output = &net.outputs.get(id.0 as usize)?.name;
            let said = if self.is_system() { format!("{name}.{output}") } else { output.clone() };
            let heard = |it: &Link| usize::from(it.from.component) == component && it.from.id == id;
            Some((said, self.links.iter().any(heard)))
        });
        said.collect()
    }

    /// For each transition the name of the line of the definition that it comes from, where that
    /// line stands for several transitions: `still` of `still.missed_0`.
    pub fn line_names(&self) -> Vec<Option<&str>> {
        let start = |name: &str| name.find('.').filter(|&at| at > 0);
        // The name that all transitions of a line begin with, if they do, and how many they are.
        let mut lines: BTreeMap<(usize, u32), (Option<&str>, usize)> = BTreeMap::new();
        for (net, at) in self.nets.iter().zip(0_usize..) {
            for it in &net.transitions {
                let base = start(&it.name).map(|end| &it.name[..end]);
                let line = lines.entry((at, it.line)).or_insert((base, 0));
                *line = (line.0.filter(|&one| Some(one) == base), line.1 + 1);
            }
        }
        let mut whole = self.whole.transitions.iter();
        let mut names = Vec::with_capacity(self.whole.transitions.len());
        for (net, at) in self.nets.iter().zip(0_usize..) {
            for (it, whole) in net.transitions.iter().zip(&mut whole) {
                let named = match lines.get(&(at, it.line)) {
                    Some((Some(base), 2..)) => {
                        let after = it.name.len() - base.len();
                        Some(&whole.name[..whole.name.len() - after])
                    }
                    _ => None,
                };
                names.push(named);
            }
        }
        names
    }

    /// The name of the net of a transition.
    pub fn net_name(&self, id: TransitionId) -> &str {
        self.net_of(id).map_or("", |it| it.1)
    }

    /// The names of its nets.
    pub fn net_names(&self) -> &[String] {
        &self.names
    }

    fn net_of(&self, TransitionId(id): TransitionId) -> Option<(&OwnedNet, &str, TransitionId)> {
        let at = self.first.partition_point(|&first| first <= id).checked_sub(1)?;
        Some((self.nets.get(at)?, self.names.get(at)?, TransitionId(id - self.first[at])))
    }

    /// The same where someone else chooses when these transitions fire: those without an event, by
    /// an event of their own.
    ///
    /// An interval is then a window, widened by `tolerance` on both sides: the player does not
    /// force it to fire at its end.
    #[must_use]
    pub fn choosing(mut self, chosen: impl Fn(TransitionId) -> bool, tolerance: Millis) -> Self {
        for id in (0..self.whole.transitions.len() as u32).map(TransitionId) {
            let Some(at) = self.first.partition_point(|&first| first <= id.0).checked_sub(1) else {
                continue;
            };
            let net = &mut self.nets[at];
            let own = (id.0 - self.first[at]) as usize;
            if net.transitions[own].on.is_some() || !chosen(id) {
                continue;
            }
            let event = EventId(net.events.len() as u32);
            let name = format!("fire {own} {}", net.transitions[own].name);
            net.events.push(OwnedSignal { name, doc: String::new() });
            let it = &mut net.transitions[own];
            it.on = Some(event);
            it.within = it.within.map(|it| widened(it, tolerance));
            let number = EventId(self.events.len() as u32);
            let whole = &mut self.whole.transitions[id.0 as usize];
            (whole.on, whole.within) = (Some(number), it.within);
            let name = whole.name.clone();
            self.whole.events.push(OwnedSignal { name, doc: whole.doc.clone() });
            self.events.push(Of { component: at as u16, id: event });
            self.choices[id.0 as usize] = Some(number);
        }
        self
    }

    /// The event that chooses a transition.
    pub fn choice(&self, TransitionId(id): TransitionId) -> Option<EventId> {
        self.choices.get(id as usize).copied().flatten()
    }

    pub(super) fn number(&self, of: Of<TransitionId>) -> TransitionId {
        let first = self.first.get(usize::from(of.component)).copied().unwrap_or(0);
        TransitionId(first + of.id.0)
    }

    pub(super) fn event_of(&self, EventId(id): EventId) -> Option<Of<EventId>> {
        self.events.get(id as usize).copied()
    }

    pub(super) fn seat(&self, PlaceId(id): PlaceId) -> Option<Seat> {
        self.seats.get(id as usize).copied()
    }

    pub(super) fn mailbox(&self, of: Of<EventId>) -> PlaceId {
        self.mailboxes.get(&(of.component, of.id.0)).copied().unwrap_or(PlaceId(u32::MAX))
    }

    pub(super) fn with_system<T>(&self, then: impl FnOnce(&System<'_>) -> T) -> T {
        let views: Vec<_> = self.nets.iter().map(OwnedNet::view).collect();
        let nets: Vec<_> = views.iter().map(|it| it.net()).collect();
        let components: Vec<_> =
            self.names.iter().zip(&nets).map(|(name, net)| Component { name, net }).collect();
        then(&System {
            name: &self.whole.name,
            doc: &self.whole.doc,
            components: &components,
            links: &self.links,
            bindings: &self.bindings,
            clears: &self.clears,
        })
    }
}

fn owned_place(place: &Place<'_>, role: Role) -> OwnedPlace {
    OwnedPlace {
        role,
        doc: place.doc.to_owned(),
        ..OwnedPlace::new(place.name, place.initial).at_most(place.bound)
    }
}

fn widened(it: Within, Millis(tolerance): Millis) -> Within {
    let by = u32::try_from(tolerance).unwrap_or(Within::LATEST);
    let latest = it.latest.map(|it| it.saturating_add(by).min(Within::LATEST));
    Within { earliest: it.earliest.saturating_sub(by), latest }
}
