//! The transitions of all nets of a system, in the order in which they are tried.

use super::FlatError;
use super::branch::Sum;
use super::interleaving::Flat;
use cotama_core::net::owned::OwnedPlace;
use cotama_core::net::{EventId, Law, Net, OutputId, PlaceId, Role, Transition};
use cotama_core::system::{Delivery, Link, Of};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// A transition of one of the nets. Complements are said as what their places hold at most.
#[derive(Clone, Debug)]
pub(super) struct Move {
    pub(super) name: String,
    pub(super) doc: String,
    /// The tests: whether a place holds so many tokens, or does not.
    pub(super) tests: Vec<(PlaceId, i64, bool)>,
    pub(super) changes: BTreeMap<PlaceId, i64>,
    pub(super) says: Vec<Said>,
    /// The places that decide whether it can fire by itself: those it tests, and those that decide
    /// whether a mailbox on its path is full.
    pub(super) depends: BTreeSet<PlaceId>,
}

/// The effect of an emitted output.
#[derive(Clone, Copy, Debug)]
pub(super) enum Said {
    /// The output leaves the system.
    Aloud(OutputId),
    /// The event waits in a mailbox of this capacity.
    Mail(PlaceId, i64),
    /// The event happens at once.
    Now(Of<EventId>),
}

/// The transitions of all nets, in the order in which they are tried.
#[derive(Debug)]
pub(super) struct Moves {
    /// By component and event.
    pub(super) on: Vec<Vec<Vec<Move>>>,
    /// The transitions that fire at once by themselves, by component.
    pub(super) urgent: Vec<Vec<Move>>,
    /// The events of each component, with its name.
    pub(super) names: Vec<Vec<String>>,
    /// Which event empties which mailbox.
    pub(super) clears: Vec<(Of<EventId>, PlaceId)>,
    pub(super) components: Vec<String>,
    /// Sums of tokens that stay the same.
    pub(super) sums: Vec<Sum>,
}

impl Moves {
    pub(super) fn new(flat: &Flat<'_>) -> Result<Self, FlatError> {
        let clears = flat.system.clears.iter();
        let clears = clears
            .map(|it| (it.on, flat.mailboxes[&(it.on.component, it.mailbox.0)].0))
            .collect::<Vec<_>>();
        let (mut on, mut urgent, mut names, mut components) = (vec![], vec![], vec![], vec![]);
        let mut outputs = 0;
        for at in 0..flat.components() {
            let (name, net) = flat.component(at);
            let row = |event: Option<EventId>| {
                let mut row: Vec<_> = net.transitions.iter().filter(|it| it.on == event).collect();
                row.sort_by_key(|it| Reverse(it.priority));
                row.into_iter()
                    .map(|it| moved(flat, at, it, outputs))
                    .collect::<Result<Vec<_>, _>>()
            };
            let events = 0..net.events.len() as u32;
            on.push(events.map(|it| row(Some(EventId(it)))).collect::<Result<Vec<_>, _>>()?);
            urgent.push(row(None)?);
            names.push(net.events.iter().map(|it| format!("{name}.{}", it.name)).collect());
            components.push(name.to_owned());
            outputs += net.outputs.len() as u32;
        }
        let mut moves = Self { on, urgent, names, clears, components, sums: Vec::new() };
        let all = moves.all_urgent(0..flat.components());
        let depends: Vec<_> = all.map(|(component, it)| moves.depends(component, it)).collect();
        let urgent = moves.urgent.iter_mut().flatten();
        urgent.zip(depends).for_each(|(it, depends)| it.depends = depends);
        let sums = (0..flat.components()).flat_map(|at| sums(flat, at));
        let sums = sums.filter(|sum| moves.keep(sum)).collect();
        Ok(Self { sums, ..moves })
    }

    /// Returns the transitions of these components that fire at once by themselves, in order.
    pub(super) fn all_urgent(&self, components: Range<u16>) -> impl Iterator<Item = (u16, &Move)> {
        components.flat_map(|at| self.urgent[usize::from(at)].iter().map(move |it| (at, it)))
    }

    /// Returns the places that decide whether a transition of a component can fire by itself.
    fn depends(&self, component: u16, first: &Move) -> BTreeSet<PlaceId> {
        let (mut on_the_way, mut has_mail) = (BTreeSet::new(), false);
        let (mut seen, mut next) = (BTreeSet::new(), vec![(component, first)]);
        while let Some((component, it)) = next.pop() {
            on_the_way.extend(it.tests.iter().map(|it| it.0));
            let mut rows = vec![(component, None)];
            for said in &it.says {
                match *said {
                    Said::Aloud(_) => {}
                    Said::Mail(waiting, _) => {
                        on_the_way.insert(waiting);
                        has_mail = true;
                    }
                    Said::Now(of) => rows.push((of.component, Some(of.id.0))),
                }
            }
            for (component, on) in rows.into_iter().filter(|&it| seen.insert(it)) {
                let at = usize::from(component);
                let row = on.map_or(&self.urgent[at], |on| &self.on[at][on as usize]);
                next.extend(row.iter().map(|it| (component, it)));
            }
        }
        // Without mail on the way nothing refuses it.
        if has_mail { on_the_way } else { first.tests.iter().map(|it| it.0).collect() }
    }

    /// Whether no transition changes a sum.
    fn keep(&self, sum: &Sum) -> bool {
        self.on.iter().flatten().chain(&self.urgent).flatten().all(|it| sum.stays(&it.changes))
    }

    /// Returns the sums that may stay the same in each step: a place of a net whose every change
    /// makes something happen at once in another one, and a place of that one that changes only
    /// then; one of them is marked at the start.
    pub(super) fn guesses(&self, flat: &Flat<'_>, initial: &[OwnedPlace]) -> Vec<Sum> {
        let meets = |link: &&Link| link.delivery == Delivery::Now;
        let links: Vec<_> = flat.system.links.iter().filter(meets).collect();
        let meetings: BTreeSet<_> =
            links.iter().map(|it| (it.from.component, it.to.component)).collect();
        let tokens = |place: PlaceId| initial[place.0 as usize].initial;
        let mut guesses = Vec::new();
        for (from, to) in meetings {
            let tells = |it: &Move| {
                it.says.iter().any(|it| matches!(it, Said::Now(of) if of.component == to))
            };
            let told = |on: usize| {
                links.iter().any(|it| {
                    it.from.component == from
                        && it.to == Of { component: to, id: EventId(on as u32) }
                })
            };
            let rows = |of: u16| {
                self.on[usize::from(of)]
                    .iter()
                    .enumerate()
                    .map(|(on, row)| (Some(on), row))
                    .chain([(None, &self.urgent[usize::from(of)])])
            };
            let teller = changed(rows(from), |_, it| tells(it));
            let listener = changed(rows(to), |on, _| on.is_some_and(told));
            for (&a, &b) in teller.iter().flat_map(|a| listener.iter().map(move |b| (a, b))) {
                if tokens(a).min(tokens(b)) == 0 && tokens(a).max(tokens(b)) == 1 {
                    guesses.push(Sum { weights: vec![(a, 1), (b, 1)], total: 1 });
                }
            }
        }
        guesses
    }

    /// Whether something in a net fires at once by itself.
    pub(super) fn settles(&self, component: u16) -> bool {
        !self.urgent[usize::from(component)].is_empty()
    }
}

/// The places that only such transitions change, and some do.
fn changed<'m>(
    rows: impl Iterator<Item = (Option<usize>, &'m Vec<Move>)>,
    only: impl Fn(Option<usize>, &Move) -> bool,
) -> BTreeSet<PlaceId> {
    let mut is_only = BTreeMap::new();
    for (on, it) in rows.flat_map(|(on, row)| row.iter().map(move |it| (on, it))) {
        for place in it.changes.iter().filter(|it| *it.1 != 0).map(|it| *it.0) {
            *is_only.entry(place).or_insert(true) &= only(on, it);
        }
    }
    is_only.into_iter().filter(|it| it.1).map(|it| it.0).collect()
}

/// Returns the new id of a place of a component, and whether it stands for the complement.
fn place(flat: &Flat<'_>, component: u16, net: &Net<'_>, place: PlaceId) -> (PlaceId, bool) {
    let places = &flat.places[usize::from(component)];
    match net.places[place.0 as usize].role {
        Role::Complement(of) => (places[of.0 as usize], true),
        _ => (places[place.0 as usize], false),
    }
}

fn moved(
    flat: &Flat<'_>,
    component: u16,
    it: &Transition<'_>,
    outputs: u32,
) -> Result<Move, FlatError> {
    let (name, net) = flat.component(component);
    let name = format!("{name}.{}", it.name);
    if it.within.is_some() {
        return Err(FlatError::Interval { transition: name });
    }
    let bound = |place: PlaceId| i64::from(flat.net.places[place.0 as usize].bound);
    let mut tests = Vec::new();
    let mut changes: [BTreeMap<PlaceId, i64>; 2] = Default::default();
    for (arc, sign) in it.take.iter().map(|arc| (arc, -1)).chain(it.read.iter().map(|arc| (arc, 0)))
    {
        let (place, is_complement) = place(flat, component, net, arc.place);
        let weight = i64::from(arc.weight);
        *changes[usize::from(is_complement)].entry(place).or_default() += sign * weight;
        tests.push(if is_complement {
            (place, bound(place) - weight + 1, false)
        } else {
            (place, weight, true)
        });
    }
    for arc in it.give {
        let (place, is_complement) = place(flat, component, net, arc.place);
        *changes[usize::from(is_complement)].entry(place).or_default() += i64::from(arc.weight);
    }
    let [changes, mirrored] = changes;
    for (at, declared) in net.places.iter().enumerate() {
        let Role::Complement(of) = declared.role else { continue };
        let (place, _) = place(flat, component, net, PlaceId(at as u32));
        let (change, mirror) =
            (changes.get(&place).unwrap_or(&0), mirrored.get(&place).unwrap_or(&0));
        // A net that shares a place without its complement leaves the latter to the system.
        let is_left = *mirror == 0 && net.places[of.0 as usize].role == Role::Shared;
        if *mirror != -change && !is_left {
            let place = flat.net.places[place.0 as usize].name.clone();
            return Err(FlatError::Complement { place, transition: name });
        }
    }
    for (&place, &gain) in changes.iter().filter(|it| *it.1 > 0) {
        if flat.net.places[place.0 as usize].bound != cotama_core::net::Place::UNBOUNDED {
            tests.push((place, bound(place) - gain + 1, false));
        }
    }
    let mut says = Vec::new();
    for &output in it.emits {
        let from = Of { component, id: output };
        let links = flat.system.links.iter().filter(|link| link.from == from);
        let before = says.len();
        says.extend(links.map(
            |link| match flat.mailboxes.get(&(link.to.component, link.to.id.0)) {
                Some(&(waiting, _, capacity)) => Said::Mail(waiting, i64::from(capacity)),
                None => Said::Now(link.to),
            },
        ));
        if says.len() == before {
            says.push(Said::Aloud(OutputId(outputs + output.0)));
        }
    }
    let (doc, depends) = (it.doc.to_owned(), BTreeSet::new());
    Ok(Move { name, doc, tests, changes, says, depends })
}

/// The sums that a net declares to stay the same, and that have their values at the start.
fn sums(flat: &Flat<'_>, component: u16) -> Vec<Sum> {
    let (_, net) = flat.component(component);
    let sum = |law: &Law<'_>| {
        let Law::Invariant { sum, equals } = *law else { return None };
        let (mut weights, mut at_start) = (Vec::new(), 0);
        for arc in sum {
            let (place, is_complement) = place(flat, component, net, arc.place);
            let of = &flat.net.places[place.0 as usize];
            if is_complement
                || of.role == Role::Mailbox
                || weights.iter().any(|it: &(_, _)| it.0 == place)
            {
                return None;
            }
            weights.push((place, i64::from(arc.weight)));
            at_start += i64::from(arc.weight) * i64::from(of.initial);
        }
        (at_start == i64::from(equals)).then_some(Sum { weights, total: at_start })
    };
    net.laws.iter().filter_map(sum).collect()
}
