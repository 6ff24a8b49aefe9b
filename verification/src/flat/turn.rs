//! How a system acts: the rules of [`Player`](cotama_core::player::Player), over markings that are
//! known in part.

use super::FlatError;
use super::branch::{Branch, Sum};
use super::interleaving::Flat;
use cotama_core::net::owned::OwnedPlace;
use cotama_core::net::{EventId, Law, Net, OutputId, PlaceId, Role, Transition};
use cotama_core::player::SETTLE;
use cotama_core::system::{Delivery, Link, Of};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

/// A transition of one of the nets. Complements are said as what their places hold at most.
#[derive(Clone, Debug)]
struct Move {
    name: String,
    doc: String,
    /// That a place holds so many tokens, or does not.
    tests: Vec<(PlaceId, i64, bool)>,
    changes: BTreeMap<PlaceId, i64>,
    says: Vec<Said>,
}

/// What follows from what a transition emits.
#[derive(Clone, Copy, Debug)]
enum Said {
    /// It leaves the system.
    Aloud(OutputId),
    /// It waits in a mailbox of this capacity.
    Mail(PlaceId, i64),
    /// It happens at once.
    Now(Of<EventId>),
}

/// The transitions of all nets, in the order in which they are tried.
#[derive(Debug)]
pub(super) struct Moves {
    /// By component and event.
    on: Vec<Vec<Vec<Move>>>,
    /// Those that fire at once by themselves, by component.
    urgent: Vec<Vec<Move>>,
    /// The events of each component, with its name.
    names: Vec<Vec<String>>,
    /// Which event empties which mailbox.
    clears: Vec<(Of<EventId>, PlaceId)>,
    components: Vec<String>,
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
        let moves = Self { on, urgent, names, clears, components, sums: Vec::new() };
        let sums = (0..flat.components()).flat_map(|at| sums(flat, at));
        let sums = sums.filter(|sum| moves.keep(sum)).collect();
        Ok(Self { sums, ..moves })
    }

    /// Whether no transition changes a sum.
    fn keep(&self, sum: &Sum) -> bool {
        self.on.iter().flatten().chain(&self.urgent).flatten().all(|it| sum.stays(&it.changes))
    }

    /// What may stay the same in each step: a place of a net whose every change makes something
    /// happen at once in another one, and a place of that one that changes only then; one of them
    /// is marked at the start.
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

/// Where a place of a component is, and whether it is the complement of what is there.
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
        // What shares a place without its complement leaves that to the system.
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
    Ok(Move { name, doc: it.doc.to_owned(), tests, changes, says })
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

/// A mailbox is full, or a net does not settle.
#[derive(Debug)]
pub(super) enum Stop {
    Full,
    Error(FlatError),
}

/// What became of an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Answer {
    Fired,
    Ignored,
    /// Nothing has happened: a mailbox on the way is full.
    Refused,
}

/// A system that acts.
#[derive(Debug)]
pub(super) struct Play<'p, 'k> {
    moves: &'p Moves,
    pub(super) branch: &'p mut Branch<'k>,
    /// What has happened, in order.
    pub(super) name: Vec<String>,
    pub(super) doc: String,
    pub(super) emits: Vec<OutputId>,
    settled: u32,
}

impl<'p, 'k> Play<'p, 'k> {
    pub(super) fn new(moves: &'p Moves, branch: &'p mut Branch<'k>) -> Self {
        Self { moves, branch, name: Vec::new(), doc: String::new(), emits: Vec::new(), settled: 0 }
    }

    /// Delivers an event with all that follows from it.
    pub(super) fn deliver(&mut self, event: Of<EventId>) -> Result<Answer, FlatError> {
        self.whole(|play| {
            play.clear(event);
            let moves = play.moves;
            if let Some(it) =
                play.enabled(&moves.on[usize::from(event.component)][event.id.0 as usize])
            {
                play.doc.clone_from(&it.doc);
                return play.fire(event.component, it).map(|()| Answer::Fired);
            }
            play.ignore(event);
            Ok(Answer::Ignored)
        })
    }

    /// Lets a net settle; stops where a mailbox is full.
    pub(super) fn settle(&mut self, component: u16) -> Result<(), FlatError> {
        for _ in 0..SETTLE {
            let moves = self.moves;
            let Some(it) = self.enabled(&moves.urgent[usize::from(component)]) else {
                return Ok(());
            };
            let fired = self.whole(|play| play.fire(component, it).map(|()| Answer::Fired))?;
            if fired == Answer::Refused {
                return Ok(());
            }
        }
        Err(self.endless(component))
    }

    fn endless(&self, component: u16) -> FlatError {
        FlatError::Endless { net: self.moves.components[usize::from(component)].clone() }
    }

    /// Does all of it or nothing.
    fn whole(
        &mut self,
        act: impl Fn(&mut Self) -> Result<Answer, Stop>,
    ) -> Result<Answer, FlatError> {
        let before = (self.branch.change.clone(), self.name.clone(), self.emits.clone());
        self.settled = 0;
        match act(self) {
            Ok(answer) => Ok(answer),
            Err(Stop::Error(error)) => Err(error),
            Err(Stop::Full) => {
                (self.branch.change, self.name, self.emits) = before;
                Ok(Answer::Refused)
            }
        }
    }

    fn enabled(&mut self, row: &'p [Move]) -> Option<&'p Move> {
        let branch = &mut *self.branch;
        row.iter().find(|it| {
            it.tests.iter().all(|&(place, tokens, is)| branch.holds(place, tokens) == is)
        })
    }

    fn ignore(&mut self, event: Of<EventId>) {
        let name = &self.moves.names[usize::from(event.component)][event.id.0 as usize];
        self.name.push(format!("{name} ignored"));
    }

    fn fire(&mut self, component: u16, it: &'p Move) -> Result<(), Stop> {
        self.name.push(it.name.clone());
        it.changes.iter().for_each(|(&place, &change)| self.branch.add(place, change));
        for &said in &it.says {
            match said {
                Said::Aloud(output) => self.emits.push(output),
                Said::Mail(waiting, capacity) => {
                    if self.branch.holds(waiting, capacity) {
                        return Err(Stop::Full);
                    }
                    self.branch.add(waiting, 1);
                }
                Said::Now(event) => {
                    self.clear(event);
                    let moves = self.moves;
                    let row = &moves.on[usize::from(event.component)][event.id.0 as usize];
                    match self.enabled(row) {
                        Some(it) => self.fire(event.component, it)?,
                        None => self.ignore(event),
                    }
                }
            }
        }
        // All that the net said has arrived: it settles.
        let moves = self.moves;
        let Some(it) = self.enabled(&moves.urgent[usize::from(component)]) else { return Ok(()) };
        if self.settled >= SETTLE {
            return Err(Stop::Error(self.endless(component)));
        }
        self.settled += 1;
        self.fire(component, it)
    }

    /// Empties the mailboxes that an event empties.
    fn clear(&mut self, event: Of<EventId>) {
        let moves = self.moves;
        for &(on, waiting) in &moves.clears {
            while on == event && self.branch.holds(waiting, 1) {
                self.branch.add(waiting, -1);
            }
        }
    }
}
