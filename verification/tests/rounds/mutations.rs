//! Ways to break a system, made for every place where each is possible.

use cotama_core::net::{Arc, EventId, Net, OutputId, PlaceId, Role, Signal, Transition};
use cotama_core::system::{Component, Delivery, Link, Of, System, Target};

/// A system with one thing changed.
pub(crate) struct Mutant {
    pub(crate) kind: &'static str,
    pub(crate) name: String,
    pub(crate) system: System<'static>,
}

/// All mutants of the first so many nets of a system and of their links; test data, which lives to
/// the end.
pub(crate) fn mutants(of: System<'static>, nets: u16) -> Vec<Mutant> {
    let mut maker = Maker { of, made: Vec::new() };
    for at in 0..nets {
        let component = of.components[usize::from(at)];
        for (transition, number) in component.net.transitions.iter().zip(0..) {
            maker.guards(at, number, transition);
            maker.says(at, number, transition);
            maker.does(at, number, transition);
            maker.goes(at, number, transition);
        }
    }
    maker.links(nets);
    maker.shared(nets);
    maker.clears();
    maker.made
}

struct Maker {
    of: System<'static>,
    made: Vec<Mutant>,
}

impl Maker {
    fn net(&self, at: u16) -> &'static Net<'static> {
        self.of.components[usize::from(at)].net
    }

    fn push(&mut self, kind: &'static str, name: String, system: System<'static>) {
        self.made.push(Mutant { kind, name, system });
    }

    fn changed(
        &mut self,
        kind: &'static str,
        (at, number): (u16, usize),
        how: &str,
        change: impl FnOnce(&mut Transition<'static>),
    ) {
        let net = self.net(at);
        let mut transitions = net.transitions.to_vec();
        change(&mut transitions[number]);
        let system = self.with(at, Net { transitions: transitions.leak(), ..*net });
        let name = format!(
            "{}.{}: {how}",
            self.of.components[usize::from(at)].name,
            net.transitions[number].name
        );
        self.push(kind, name, system);
    }

    fn with(&self, at: u16, net: Net<'static>) -> System<'static> {
        let mut components = self.of.components.to_vec();
        let it = &mut components[usize::from(at)];
        *it = Component { name: it.name, net: Box::leak(Box::new(net)) };
        System { components: components.leak(), ..self.of }
    }

    fn guards(&mut self, at: u16, number: usize, transition: &'static Transition<'static>) {
        let net = self.net(at);
        for (position, arc) in transition.read.iter().enumerate() {
            let what = condition(net, *arc);
            self.changed("guard dropped", (at, number), &format!("without {what}"), |it| {
                let mut read = it.read.to_vec();
                read.remove(position);
                it.read = read.leak();
            });
            let Some(other) = complement(net, arc.place) else { continue };
            let weight = net.places[arc.place.0 as usize].bound - arc.weight + 1;
            self.changed("guard negated", (at, number), &format!("not {what}"), |it| {
                let mut read = it.read.to_vec();
                read[position] = Arc { place: other, weight };
                it.read = read.leak();
            });
        }
    }

    fn says(&mut self, at: u16, number: usize, transition: &'static Transition<'static>) {
        let outputs = self.net(at).outputs;
        for (position, said) in transition.emits.iter().enumerate() {
            let name = outputs[said.0 as usize].name;
            self.changed("output dropped", (at, number), &format!("without {name}"), |it| {
                let mut emits = it.emits.to_vec();
                emits.remove(position);
                it.emits = emits.leak();
            });
            let is_decision =
                |name: &str| ["global_event", "local_event", "adapt_sonar"].contains(&name);
            if self.of.components[usize::from(at)].name != "cs" {
                continue;
            }
            for (output, id) in
                outputs.iter().zip(0..).filter(|it| is_decision(it.0.name) && it.0.name != name)
            {
                self.changed(
                    "severity swapped",
                    (at, number),
                    &format!("{} for {name}", output.name),
                    |it| {
                        it.emits = vec![OutputId(id)].leak();
                    },
                );
            }
        }
    }

    /// Changes the effects on flags and counters.
    fn does(&mut self, at: u16, number: usize, transition: &'static Transition<'static>) {
        let net = self.net(at);
        let data = |place: PlaceId| net.places[place.0 as usize].role == Role::Data;
        let changed =
            transition.take.iter().chain(transition.give).map(|it| it.place).filter(|it| data(*it));
        let mut changed: Vec<_> = changed.collect();
        changed.sort_unstable();
        changed.dedup();
        for place in changed {
            let both = [Some(place), complement(net, place)];
            let is_it = move |arc: &Arc| both.contains(&Some(arc.place));
            let name = net.places[place.0 as usize].name;
            self.changed("do dropped", (at, number), &format!("{name} stays"), |it| {
                let kept: Vec<_> = it.take.iter().copied().filter(is_it).collect();
                it.take =
                    it.take.iter().copied().filter(|it| !is_it(it)).collect::<Vec<_>>().leak();
                it.give =
                    it.give.iter().copied().filter(|it| !is_it(it)).collect::<Vec<_>>().leak();
                it.read = it.read.iter().copied().chain(kept).collect::<Vec<_>>().leak();
            });
            let flags =
                net.places.iter().zip(0..).filter(|it| it.0.role == Role::Data && it.0.bound == 1);
            let flags: Vec<_> = flags.map(|it| PlaceId(it.1)).collect();
            let Some(position) = flags.iter().position(|&it| it == place) else { continue };
            let other = flags[(position + 1) % flags.len()];
            let used = transition.take.iter().chain(transition.give).chain(transition.read);
            if other == place
                || used
                    .into_iter()
                    .any(|arc| arc.place == other || Some(arc.place) == complement(net, other))
            {
                continue;
            }
            let instead = |arc: &Arc| match arc.place {
                it if it == place => Arc { place: other, ..*arc },
                it if both[1] == Some(it) => {
                    Arc { place: complement(net, other).unwrap_or(it), ..*arc }
                }
                _ => *arc,
            };
            let how = format!("{} for {name}", net.places[other.0 as usize].name);
            self.changed("closure wrong", (at, number), &how, |it| {
                it.take = it.take.iter().map(instead).collect::<Vec<_>>().leak();
                it.give = it.give.iter().map(instead).collect::<Vec<_>>().leak();
            });
        }
    }

    fn goes(&mut self, at: u16, number: usize, transition: &'static Transition<'static>) {
        let net = self.net(at);
        let states: Vec<_> = (0..)
            .map(PlaceId)
            .zip(net.places)
            .filter(|it| it.1.role == Role::State)
            .map(|it| it.0)
            .collect();
        for (position, arc) in transition.give.iter().enumerate() {
            let Some(state) = states.iter().position(|&it| it == arc.place) else { continue };
            let other = states[(state + 1) % states.len()];
            if other == arc.place {
                continue;
            }
            let how = format!("to {}", net.places[other.0 as usize].name);
            self.changed("goes elsewhere", (at, number), &how, |it| {
                let mut give = it.give.to_vec();
                give[position].place = other;
                it.give = give.leak();
            });
        }
    }

    /// A link is dropped by tying its end to an output that is never said: an event without link
    /// would come from outside.
    fn links(&mut self, nets: u16) {
        let links = self.of.links;
        for (position, link) in links.iter().enumerate().filter(|it| it.1.from.component < nets) {
            let net = self.net(link.from.component);
            let mut outputs = net.outputs.to_vec();
            outputs.push(Signal { name: "nothing", doc: "" });
            let silent =
                Of { component: link.from.component, id: OutputId(outputs.len() as u32 - 1) };
            let system = self.with(link.from.component, Net { outputs: outputs.leak(), ..*net });
            let tied = Link { from: silent, ..*link };
            let mut kept = links.to_vec();
            kept[position] = tied;
            let kept: &'static [Link] = kept.leak();
            let (from, to) = (self.output(link.from), self.event(link.to));
            let name = format!("{from} => {to}");
            self.push("link dropped", name.clone(), System { links: kept, ..system });
            let is_alike = |it: &&Link| {
                it.from.component == link.from.component && it.delivery == link.delivery
            };
            let alike: Vec<_> = links.iter().filter(is_alike).map(|it| it.to).collect();
            let at = alike.iter().position(|&it| it == link.to).unwrap_or(0);
            let other = alike[(at + 1) % alike.len()];
            let redirected = Link { to: other, ..*link };
            if other == link.to
                || links.contains(&redirected)
                || link.delivery == (Delivery::Mail { capacity: 0 })
            {
                continue;
            }
            let all: Vec<_> = kept.iter().copied().chain([redirected]).collect();
            let name = format!("{name}: to {}", self.event(other));
            self.push("link redirected", name, System { links: all.leak(), ..system });
        }
    }

    fn output(&self, of: Of<OutputId>) -> String {
        let it = self.of.components[usize::from(of.component)];
        format!("{}.{}", it.name, it.net.outputs[of.id.0 as usize].name)
    }

    fn event(&self, of: Of<EventId>) -> String {
        let it = self.of.components[usize::from(of.component)];
        format!("{}.{}", it.name, it.net.events[of.id.0 as usize].name)
    }

    /// Shares another flag of the same net.
    fn shared(&mut self, nets: u16) {
        let bindings = self.of.bindings;
        for (position, binding) in
            bindings.iter().enumerate().filter(|it| it.1.shared.component < nets)
        {
            let Target::Place(place) = binding.target else { continue };
            let alike = bindings.iter().filter_map(|it| match it.target {
                Target::Place(of) if of.component == place.component && of.id != place.id => {
                    Some(of)
                }
                _ => None,
            });
            let net = self.net(place.component);
            let bound = |of: Of<PlaceId>| net.places[of.id.0 as usize].bound;
            let Some(other) = alike
                .filter(|&it| bound(it) == bound(place))
                .max_by_key(|it| (it.id > place.id, std::cmp::Reverse(it.id)))
            else {
                continue;
            };
            let mut all = bindings.to_vec();
            all[position].target = Target::Place(other);
            let shown = |of: Of<PlaceId>| {
                let it = self.of.components[usize::from(of.component)];
                format!("{}.{}", it.name, it.net.places[of.id.0 as usize].name)
            };
            let name =
                format!("{} = {}, not {}", shown(binding.shared), shown(other), shown(place));
            self.push("shared wrong", name, System { bindings: all.leak(), ..self.of });
        }
    }

    fn clears(&mut self) {
        for (position, clear) in self.of.clears.iter().enumerate() {
            let mut clears = self.of.clears.to_vec();
            clears.remove(position);
            let emptied = Of { component: clear.on.component, id: clear.mailbox };
            let name = format!("{} empties {}", self.event(clear.on), self.event(emptied));
            self.push("clear dropped", name, System { clears: clears.leak(), ..self.of });
        }
    }
}

fn complement(net: &Net<'_>, place: PlaceId) -> Option<PlaceId> {
    if let Role::Complement(of) = net.places[place.0 as usize].role {
        return Some(of);
    }
    net.places.iter().position(|it| it.role == Role::Complement(place)).map(|it| PlaceId(it as u32))
}

fn condition(net: &Net<'_>, arc: Arc) -> String {
    let place = &net.places[arc.place.0 as usize];
    match place.role {
        Role::Complement(of) => {
            let of = &net.places[of.0 as usize];
            if of.bound == 1 {
                format!("!{}", of.name)
            } else {
                format!("{} < {}", of.name, of.bound - arc.weight + 1)
            }
        }
        _ if place.bound == 1 => place.name.to_owned(),
        _ => format!("{} >= {}", place.name, arc.weight),
    }
}
