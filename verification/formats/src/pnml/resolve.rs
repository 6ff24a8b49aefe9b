//! From the parts of a file to a net: ids become positions, arcs come to their transitions.

use super::Imported;
use super::document::{
    Document, OwnPlace, OwnTransition, RawIgnored, RawLaw, RawPlace, RawRole, RawTransition, Text,
};
use super::error::{Finding, Findings, Span};
use super::flow::add_arcs;
use super::names::unique;
use super::nodes::Nodes;
use cotama_core::net::owned::{
    OwnedIgnored, OwnedLaw, OwnedNet, OwnedPlace, OwnedSignal, OwnedTransition,
};
use cotama_core::net::{Arc, EventId, OutputId, Place, PlaceId, Role, TransitionId, Within};
use cotama_property::pt::Extras;
use cotama_property::source::quoted;
use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

/// Looks everything up; also where the first random delay stands. With findings what it gives is of
/// no use.
pub(super) fn resolve(document: Document<'_>, findings: &mut Findings) -> (Imported, Option<Span>) {
    let Document { id, name, own, places, transitions, references, arcs, ids, random, notes } =
        document;
    let nodes = Nodes::new(ids, &references, findings);
    let signals = Signals {
        events: positions(&own.events, findings),
        outputs: positions(&own.outputs, findings),
    };

    let mut net = OwnedNet {
        name: own.name.unwrap_or_else(|| name.unwrap_or(id).into_owned()),
        ..OwnedNet::default()
    };
    net.doc = own.doc;
    net.events = own.events.into_iter().map(|(_, signal)| signal).collect();
    net.outputs = own.outputs.into_iter().map(|(_, signal)| signal).collect();

    let names = unique(places.iter().map(|it| {
        let exact = it.own.as_ref().and_then(|own| own.name.as_deref());
        (exact.or(it.name.as_deref()).unwrap_or(&it.id.value), &*it.id.value)
    }));
    let place_ids = places.iter().map(|place| place.id.value.clone().into_owned()).collect();
    let complements = complements(&places);
    net.places =
        places.into_iter().zip(names).map(|(it, name)| place(it, name, &nodes, findings)).collect();
    check_complements(&net.places, &complements, findings);

    let names = unique(transitions.iter().map(|it| {
        let exact = it.own.as_ref().and_then(|own| own.name.as_deref());
        (exact.or(it.name.as_deref()).unwrap_or(&it.id.value), &*it.id.value)
    }));
    let ids = || (0..).map(TransitionId);
    let invisible = transitions.iter().zip(ids()).filter(|it| it.0.invisible);
    let invisible = invisible.map(|it| it.1).collect();
    let shared = transitions.iter().zip(&names).zip(ids()).filter_map(|((it, name), id)| {
        let own = it.name.as_deref().filter(|own| it.own.is_none() && own != name)?;
        Some((id, own.to_owned()))
    });
    let shared_names = shared.collect();
    let transition_ids =
        transitions.iter().map(|transition| transition.id.value.clone().into_owned()).collect();
    // In a file with intervals of TINA a transition without one may wait for ever; elsewhere time
    // does not count.
    let timed = transitions.iter().any(|it| it.own.is_none() && it.delay.is_some());
    let default = timed.then_some(Within { earliest: 0, latest: None });
    let mut extras = Extras { priorities: priorities(&transitions), ..Extras::default() };
    for (index, (it, name)) in transitions.into_iter().zip(names).enumerate() {
        let mut transition =
            OwnedTransition { name, line: index as u32, ..OwnedTransition::default() };
        match it.own {
            Some(own) => signals.transition(*own, &mut transition, findings),
            None => transition.within = it.delay.or(default),
        }
        net.transitions.push(transition);
    }

    add_arcs(&mut net, &mut extras, &nodes, &arcs, findings);
    let of = |text: &Text<'_>, findings: &mut Findings| nodes.place(text, findings);
    for RawIgnored { event, place, guard } in own.ignored {
        let (event, place) = (signals.event(&event, findings), of(&place, findings));
        let once = ("in one guard", "keep the term with the larger weight");
        let guard = terms(guard, once, &nodes, findings);
        if let (Some(event), Some(place)) = (event, place) {
            net.ignored.push(OwnedIgnored { event, place, guard });
        }
    }
    net.laws = own.laws.into_iter().filter_map(|it| law(it, &nodes, findings)).collect();
    let notes = notes.into_iter().collect();
    let random_at = random;
    let random = None;
    let imported =
        Imported { net, place_ids, transition_ids, invisible, shared_names, extras, random, notes };
    (imported, random_at)
}

/// The priorities of transitions, as PIPE has them: those with random delays come after all
/// immediate ones. Empty where the file says none.
fn priorities(transitions: &[RawTransition<'_>]) -> Vec<u32> {
    if !transitions.iter().any(|it| it.priority.is_some() || it.is_random) {
        return Vec::new();
    }
    // Immediate ones may count from 0.
    let shift = u32::from(transitions.iter().any(|it| it.is_random));
    let immediate = |it: &RawTransition<'_>| it.priority.unwrap_or(1).saturating_add(shift);
    transitions.iter().map(|it| if it.is_random { 0 } else { immediate(it) }).collect()
}

/// The positions of events and outputs by their ids.
struct Signals<'a> {
    events: HashMap<Cow<'a, str>, u32>,
    outputs: HashMap<Cow<'a, str>, u32>,
}

fn positions<'a>(
    list: &[(Text<'a>, OwnedSignal)],
    findings: &mut Findings,
) -> HashMap<Cow<'a, str>, u32> {
    let mut positions = HashMap::new();
    for (index, (id, _)) in list.iter().enumerate() {
        if positions.insert(id.value.clone(), index as u32).is_some() {
            let message = format!("the id {} is used twice", quoted(&id.value));
            findings.push(
                Finding::new(id.span, message)
                    .help("give every event and every output an id of its own"),
            );
        }
    }
    positions
}

impl Signals<'_> {
    fn event(&self, id: &Text<'_>, findings: &mut Findings) -> Option<EventId> {
        let event = self.events.get(&id.value).copied().map(EventId);
        if event.is_none() {
            let message = format!("no event has the id {}", quoted(&id.value));
            findings.push(
                Finding::new(id.span, message)
                    .help("declare it with `<event id=\"…\" name=\"…\"/>`"),
            );
        }
        event
    }

    fn transition(
        &self,
        own: OwnTransition<'_>,
        transition: &mut OwnedTransition,
        findings: &mut Findings,
    ) {
        transition.doc = own.doc;
        transition.line = own.line.unwrap_or(transition.line);
        transition.on = own.on.and_then(|id| self.event(&id, findings));
        transition.within = own.within;
        transition.priority = own.priority;
        let Some(emits) = own.emits else { return };
        for id in emits.value.split(super::xml::WHITESPACE).filter(|id| !id.is_empty()) {
            match self.outputs.get(id) {
                Some(&output) => transition.emits.push(OutputId(output)),
                None => findings.push(
                    Finding::new(emits.span, format!("no output has the id {}", quoted(id)))
                        .help("declare it with `<output id=\"…\" name=\"…\"/>`"),
                ),
            }
        }
    }
}

fn place(
    raw: RawPlace<'_>,
    name: String,
    nodes: &Nodes<'_>,
    findings: &mut Findings,
) -> OwnedPlace {
    let mut place = OwnedPlace { name, ..OwnedPlace::new("", raw.initial) };
    let Some(own) = raw.own else { return place };
    let OwnPlace { span, name: _, doc, bound, role } = *own;
    place.doc = doc;
    place.bound = bound.unwrap_or(Place::UNBOUNDED);
    place.role = match role {
        RawRole::State => Role::State,
        RawRole::Data => Role::Data,
        RawRole::Complement(of) => nodes.place(&of, findings).map_or(Role::State, Role::Complement),
        RawRole::Shared => Role::Shared,
        RawRole::Mailbox => Role::Mailbox,
    };
    if place.initial > place.bound {
        let message = format!(
            "{} tokens at the start in a place with the bound {}",
            place.initial, place.bound
        );
        findings.push(
            Finding::new(span, message).help("raise the bound or lower the number of tokens"),
        );
    }
    place
}

/// Which places say that they are complements, and where.
fn complements(places: &[RawPlace<'_>]) -> Vec<(usize, Span)> {
    let complement = |(index, place): (usize, &RawPlace<'_>)| match place.own.as_deref() {
        Some(OwnPlace { role: RawRole::Complement(of), .. }) => Some((index, of.span)),
        _ => None,
    };
    places.iter().enumerate().filter_map(complement).collect()
}

fn check_complements(
    places: &[OwnedPlace],
    complements: &[(usize, Span)],
    findings: &mut Findings,
) {
    for &(index, span) in complements {
        let Role::Complement(PlaceId(of)) = places[index].role else { continue };
        let (place, of) = (&places[index], &places[of as usize]);
        if place.bound != of.bound || place.initial.checked_add(of.initial) != Some(of.bound) {
            let message = format!("the place is not the complement of {}", quoted(&of.name));
            findings.push(
                Finding::new(span, message)
                    .help("both have the same bound, and their tokens at the start sum to it"),
            );
        }
    }
}

/// Terms of an invariant or a guard; in which no place may stand twice, and what to do then.
fn terms(
    terms: Vec<(Text<'_>, u32)>,
    (once, help): (&str, &'static str),
    nodes: &Nodes<'_>,
    findings: &mut Findings,
) -> Vec<Arc> {
    let (mut arcs, mut seen) = (Vec::new(), HashSet::new());
    for (id, weight) in terms {
        let Some(place) = nodes.place(&id, findings) else { continue };
        if !seen.insert(place) {
            let message = format!("the place {} stands twice {once}", quoted(&id.value));
            findings.push(Finding::new(id.span, message).help(help));
        }
        arcs.push(Arc { place, weight });
    }
    arcs
}

fn law(raw: RawLaw<'_>, nodes: &Nodes<'_>, findings: &mut Findings) -> Option<OwnedLaw> {
    Some(match raw {
        RawLaw::Invariant { sum, equals } => {
            let once = ("in one sum", "write one term with the sum of both weights");
            OwnedLaw::Invariant { sum: terms(sum, once, nodes, findings), equals }
        }
        RawLaw::NeverBoth(a, b) => {
            OwnedLaw::NeverBoth(nodes.place(&a, findings)?, nodes.place(&b, findings)?)
        }
        RawLaw::Reachable(place) => OwnedLaw::Reachable(nodes.place(&place, findings)?),
        RawLaw::AlwaysCan(place) => OwnedLaw::AlwaysCan(nodes.place(&place, findings)?),
        RawLaw::HandlesAll => OwnedLaw::HandlesAll,
        RawLaw::Settles => OwnedLaw::Settles,
        RawLaw::DeadlockFree { end: None } => OwnedLaw::DeadlockFree { end: None },
        RawLaw::DeadlockFree { end: Some(end) } => {
            OwnedLaw::DeadlockFree { end: Some(nodes.place(&end, findings)?) }
        }
        RawLaw::Deterministic => OwnedLaw::Deterministic,
    })
}
