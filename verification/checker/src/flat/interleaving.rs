//! The net of all interleavings, built transition by transition.

use super::step::Step;
use super::{FlatError, MOST_TRANSITIONS};
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{EventId, Net, OutputId, PlaceId, Role, Transition};
use cotama_core::system::{Delivery, Of, System};
use std::collections::{BTreeMap, BTreeSet};

/// The most comparisons of conditions under which events are ignored: some seconds.
const MOST_COMPARED: usize = 10_000_000;

pub(super) struct Flat<'s> {
    pub(super) system: &'s System<'s>,
    pub(super) net: OwnedNet,
    /// The places of each component, by their new ids.
    pub(super) places: Vec<Vec<PlaceId>>,
    /// Complements, by place.
    pub(super) absent: BTreeMap<PlaceId, PlaceId>,
    /// The complements made here.
    made: Vec<(PlaceId, PlaceId)>,
    /// The place of waiting events and that of the room, with the capacity, by component and event.
    pub(super) mailboxes: BTreeMap<(u16, u32), (PlaceId, PlaceId, u16)>,
    pub(super) wanted: BTreeSet<PlaceId>,
    /// The conditions compared so far.
    compared: usize,
}

impl<'s> Flat<'s> {
    pub(super) fn new(system: &'s System<'s>, wanted: BTreeSet<PlaceId>) -> Self {
        let net = OwnedNet::new(system.name, system.doc);
        let mut flat = Self {
            system,
            net,
            places: Vec::new(),
            absent: BTreeMap::new(),
            made: Vec::new(),
            mailboxes: BTreeMap::new(),
            wanted: BTreeSet::new(),
            compared: 0,
        };
        flat.add_places();
        for place in wanted {
            let of = &flat.net.places[place.0 as usize];
            let (name, doc) = (format!("{}.absent", of.name), of.doc.clone());
            let complement = OwnedPlace {
                name,
                doc,
                initial: of.bound - of.initial,
                bound: of.bound,
                role: Role::Complement(place),
            };
            let complement = flat.push(complement);
            flat.absent.insert(place, complement);
            flat.made.push((place, complement));
        }
        flat
    }

    pub(super) fn push(&mut self, place: OwnedPlace) -> PlaceId {
        self.net.places.push(place);
        PlaceId(self.net.places.len() as u32 - 1)
    }

    pub(super) fn component(&self, at: u16) -> (&'s str, &'s Net<'s>) {
        let component = &self.system.components[usize::from(at)];
        (component.name, component.net)
    }

    pub(super) fn components(&self) -> u16 {
        self.system.components.len() as u16
    }

    pub(super) fn build(&mut self) -> Result<(), FlatError> {
        for component in 0..self.components() {
            let (name, net) = self.component(component);
            for output in net.outputs {
                let doc = output.doc;
                self.net
                    .output(&format!("{name}.{}", output.name), doc)
                    .map_err(|_| FlatError::TooMany)?;
            }
            for transition in net.transitions.iter().filter(|it| it.on.is_none()) {
                let steps = self.fired(vec![Step::default()], component, transition)?;
                self.add(steps, transition, None)?;
            }
            for (event, number) in net.events.iter().zip(0..) {
                let id = EventId(number);
                let mut start = Step::default();
                let on = match self.system.delivery(Of { component, id }) {
                    Some(Delivery::Now) => continue,
                    Some(Delivery::Mail { .. }) => {
                        let (waiting, room, _) = self.mailboxes[&(component, number)];
                        start.then(waiting, 1, -1);
                        start.then(room, 0, 1);
                        None
                    }
                    None => {
                        let event = self.net.event(&format!("{name}.{}", event.name), event.doc);
                        Some(event.map_err(|_| FlatError::TooMany)?)
                    }
                };
                let starts = self.cleared(vec![start], component, id);
                for transition in net.transitions.iter().filter(|it| it.on == Some(id)) {
                    let steps = self.fired(starts.clone(), component, transition)?;
                    self.add(steps, transition, on)?;
                }
                if on.is_none() {
                    let ignored = self.ignored(&starts, component, id)?;
                    self.add(ignored, &Transition::NOTHING, None)?;
                }
            }
        }
        self.follow();
        Ok(())
    }

    /// Puts the emptying of a mailbox by an event first.
    fn cleared(&self, steps: Vec<Step>, component: u16, on: EventId) -> Vec<Step> {
        let clears = self.system.clears.iter().filter(|it| it.on == Of { component, id: on });
        clears.fold(steps, |steps, clear| {
            let (waiting, room, capacity) = self.mailboxes[&(component, clear.mailbox.0)];
            let emptied = |step: &Step, count: i64| {
                let mut step = step.clone();
                step.then(waiting, count, -count);
                step.then(room, i64::from(capacity) - count, count);
                step
            };
            steps
                .iter()
                .flat_map(|step| (0..=i64::from(capacity)).map(move |count| emptied(step, count)))
                .collect()
        })
    }

    /// A transition fires, and all that it says arrives.
    fn fired(
        &mut self,
        mut steps: Vec<Step>,
        component: u16,
        transition: &Transition<'_>,
    ) -> Result<Vec<Step>, FlatError> {
        let (name, net) = self.component(component);
        let mut changes: BTreeMap<PlaceId, (i64, i64)> = BTreeMap::new();
        let mut guests = BTreeSet::new();
        for (arc, change) in transition
            .take
            .iter()
            .map(|arc| (arc, -1))
            .chain(transition.read.iter().map(|arc| (arc, 0)))
        {
            let weight = i64::from(arc.weight);
            let it = changes.entry(self.place(component, arc.place)?).or_default();
            *it = (it.0.max(weight), it.1 + change * weight);
        }
        for arc in transition.give {
            changes.entry(self.place(component, arc.place)?).or_default().1 +=
                i64::from(arc.weight);
        }
        for arc in transition.take.iter().chain(transition.give) {
            if net.places[arc.place.0 as usize].role == Role::Shared {
                guests.insert(self.place(component, arc.place)?);
            }
        }
        // The complement that the owner has follows its place, when the guest does not move it.
        for place in guests {
            let change = changes.get(&place).map_or(0, |it| it.1);
            if let Some(&absent) = self.absent.get(&place)
                && !self.made.contains(&(place, absent))
                && changes.get(&absent).is_none_or(|it| it.1 == 0)
            {
                let it = changes.entry(absent).or_default();
                *it = (it.0.max(change), -change);
            }
        }
        for step in &mut steps {
            step.name.push(format!("{name}.{}", transition.name));
            for (&place, &(need, change)) in &changes {
                step.then(place, need, change);
            }
        }
        for &output in transition.emits {
            let from = Of { component, id: output };
            let links: Vec<_> =
                self.system.links.iter().filter(|link| link.from == from).copied().collect();
            if links.is_empty() {
                let said = self.output(component, output);
                for step in &mut steps {
                    step.outputs.push(said);
                }
            }
            for link in links {
                if let Some(&(waiting, room, _)) =
                    self.mailboxes.get(&(link.to.component, link.to.id.0))
                {
                    for step in &mut steps {
                        step.then(room, 1, -1);
                        step.then(waiting, 0, 1);
                    }
                    continue;
                }
                let (_, net) = self.component(link.to.component);
                let starts = self.cleared(steps, link.to.component, link.to.id);
                let mut all = self.ignored(&starts, link.to.component, link.to.id)?;
                for transition in net.transitions.iter().filter(|it| it.on == Some(link.to.id)) {
                    all.extend(self.fired(starts.clone(), link.to.component, transition)?);
                }
                if all.len() > MOST_TRANSITIONS {
                    return Err(FlatError::TooMany);
                }
                steps = all;
            }
        }
        Ok(steps)
    }

    fn output(&self, component: u16, output: OutputId) -> OutputId {
        let before = self
            .system
            .components
            .iter()
            .take(usize::from(component))
            .map(|it| it.net.outputs.len() as u32);
        OutputId(before.sum::<u32>() + output.0)
    }

    /// No transition on an event is enabled: for each of them some need is not met. A condition
    /// that implies another one is left out.
    fn ignored(
        &mut self,
        starts: &[Step],
        component: u16,
        event: EventId,
    ) -> Result<Vec<Step>, FlatError> {
        let (name, net) = self.component(component);
        let mut unmet: Vec<BTreeMap<PlaceId, i64>> = vec![BTreeMap::new()];
        for transition in net.transitions.iter().filter(|it| it.on == Some(event)) {
            let mut lacks = Vec::new();
            for arc in transition.take.iter().chain(transition.read) {
                let place = self.place(component, arc.place)?;
                let bound = i64::from(self.net.places[place.0 as usize].bound);
                let absent = self.complement(place)?;
                lacks.push((absent, bound - i64::from(arc.weight) + 1));
            }
            let mut next: Vec<BTreeMap<PlaceId, i64>> = Vec::new();
            for before in &unmet {
                for &(absent, least) in &lacks {
                    self.compared += next.len();
                    if self.compared > MOST_COMPARED {
                        return Err(FlatError::TooMuch);
                    }
                    let mut both = before.clone();
                    let held = both.entry(absent).or_default();
                    *held = (*held).max(least);
                    if !self.contradicts(&both) && !next.iter().any(|other| implies(&both, other)) {
                        next.retain(|other| !implies(other, &both));
                        next.push(both);
                    }
                }
            }
            unmet = next;
        }
        let label = format!("{name}.{} ignored", net.events[event.0 as usize].name);
        let under = |step: &Step, needs: &BTreeMap<PlaceId, i64>| {
            let mut step = step.clone();
            for (&place, &need) in needs {
                step.then(place, need, 0);
            }
            step.name.push(label.clone());
            step
        };
        Ok(starts
            .iter()
            .flat_map(|step| unmet.iter().map(move |needs| under(step, needs)))
            .collect())
    }

    /// Whether these tokens cannot all be there, a place and its complement holding its bound
    /// together.
    fn contradicts(&self, needs: &BTreeMap<PlaceId, i64>) -> bool {
        needs.iter().any(|(place, need)| {
            let other = self.absent.get(place).and_then(|absent| needs.get(absent));
            other.is_some_and(|other| {
                need + other > i64::from(self.net.places[place.0 as usize].bound)
            })
        })
    }

    /// Adds the transitions that steps stand for; those whose needs contradict each other are left
    /// out.
    fn add(
        &mut self,
        steps: Vec<Step>,
        like: &Transition<'_>,
        on: Option<EventId>,
    ) -> Result<(), FlatError> {
        for step in steps {
            if self.contradicts(&step.needs) {
                continue;
            }
            if self.net.transitions.len() >= MOST_TRANSITIONS {
                return Err(FlatError::TooMany);
            }
            let mut it = OwnedTransition::new(&step.name.join(" + ")).doc(like.doc);
            (it.on, it.within, it.priority, it.emits) =
                (on, like.within, like.priority, step.outputs);
            for (&place, &change) in &step.effects {
                let need = step.needs.get(&place).copied().unwrap_or(0).max(-change);
                let weight = |tokens: i64| u32::try_from(tokens).unwrap_or(u32::MAX);
                it = match (need, change) {
                    (0, 0) => it,
                    (need, 0) => it.read(place, weight(need)),
                    (0, gain) => it.give(place, weight(gain)),
                    (need, gain) if gain > 0 => {
                        it.read(place, weight(need)).give(place, weight(gain))
                    }
                    (need, loss) if need + loss > 0 => {
                        it.take(place, weight(need)).give(place, weight(need + loss))
                    }
                    (need, _) => it.take(place, weight(need)),
                };
            }
            self.net.transition(it).map_err(|_| FlatError::TooMany)?;
        }
        Ok(())
    }

    /// Complements that were made here follow their places, and names become unique.
    fn follow(&mut self) {
        let mut names: BTreeMap<String, u32> = BTreeMap::new();
        for it in &mut self.net.transitions {
            for &(place, absent) in &self.made {
                let weight = |arcs: &[cotama_core::net::Arc], of: PlaceId| {
                    arcs.iter().find(|arc| arc.place == of).map_or(0, |arc| arc.weight)
                };
                let (taken, given) = (weight(&it.take, place), weight(&it.give, place));
                if taken == given {
                    continue;
                }
                let read = weight(&it.read, absent);
                it.read.retain(|arc| arc.place != absent);
                if given > taken {
                    let lost = given - taken;
                    *it = std::mem::take(it).take(absent, lost.max(read));
                    if read > lost {
                        *it = std::mem::take(it).give(absent, read - lost);
                    }
                } else {
                    *it = std::mem::take(it).give(absent, taken - given);
                    if read > 0 {
                        *it = std::mem::take(it).read(absent, read);
                    }
                }
            }
            let count = names.entry(it.name.clone()).or_default();
            *count += 1;
            if *count > 1 {
                it.name = format!("{} #{count}", it.name);
            }
        }
    }
}

/// Whether the first of two conditions asks for at least what the second one does.
fn implies(a: &BTreeMap<PlaceId, i64>, b: &BTreeMap<PlaceId, i64>) -> bool {
    b.iter().all(|(place, least)| a.get(place).is_some_and(|held| held >= least))
}
