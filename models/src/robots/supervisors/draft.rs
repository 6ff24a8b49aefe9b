//! A net that is made line by line, with names in place of ids.

use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{EventId, OutputId, PlaceId, Role};

/// A net under way. A name that is not there is a mistake of the program.
pub(super) struct Draft {
    net: OwnedNet,
}

/// A line of a net: a transition.
#[derive(Clone, Debug, Default)]
pub(super) struct Line {
    /// Name of the transition.
    name: String,
    on: String,
    take: Vec<(String, u32)>,
    give: Vec<(String, u32)>,
    read: Vec<(String, u32)>,
    emits: Vec<String>,
}

impl Line {
    /// A transition that an event fires.
    pub(super) fn on(name: impl Into<String>, event: impl Into<String>) -> Self {
        Self { name: name.into(), on: event.into(), ..Self::default() }
    }

    /// The token moves from one place to another, or stays where both are one.
    pub(super) fn goes(mut self, from: &str, to: &str) -> Self {
        self.take.push((from.to_owned(), 1));
        self.give.push((to.to_owned(), 1));
        self
    }

    /// Only where a flag is as it is said.
    pub(super) fn when(self, flag: &str, is: bool) -> Self {
        let name = if is { flag.to_owned() } else { not(flag) };
        self.when_at_least(&name, 1)
    }

    /// Only where a place has so many tokens.
    pub(super) fn when_at_least(mut self, place: &str, tokens: u32) -> Self {
        self.read.push((place.to_owned(), tokens));
        self
    }

    /// A flag that is down goes up.
    pub(super) fn raises(self, flag: &str) -> Self {
        self.goes(&not(flag), flag)
    }

    /// A flag that is up goes down.
    pub(super) fn lowers(self, flag: &str) -> Self {
        self.goes(flag, &not(flag))
    }

    pub(super) fn emits(mut self, output: impl Into<String>) -> Self {
        self.emits.push(output.into());
        self
    }

    pub(super) fn name(&self) -> &str {
        &self.name
    }

    /// The same under another name.
    pub(super) fn named(self, name: String) -> Self {
        Self { name, ..self }
    }
}

/// Returns the name of the place that is marked where a flag is down.
fn not(flag: &str) -> String {
    format!("!{flag}")
}

impl Draft {
    pub(super) fn new(name: &str, doc: &str) -> Self {
        Self { net: OwnedNet::new(name, doc) }
    }

    fn add(&mut self, place: OwnedPlace) {
        let added = self.net.place(place);
        debug_assert!(added.is_ok(), "ids count the places of a robot");
    }

    /// A place of the net's own state.
    pub(super) fn place(&mut self, name: &str, initial: u32, doc: &str) {
        self.add(OwnedPlace::new(name, initial).at_most(1).doc(doc));
    }

    fn with_complement(&mut self, name: &str, role: Role, initial: u32, doc: &str) {
        let of = PlaceId(self.net.places.len() as u32);
        self.add(OwnedPlace { role, ..OwnedPlace::new(name, initial).at_most(1).doc(doc) });
        let complement = OwnedPlace::new(&not(name), 1 - initial).at_most(1);
        self.add(OwnedPlace { role: Role::Complement(of), ..complement });
    }

    /// A flag of its own that is down at the start.
    pub(super) fn flag(&mut self, name: &str, doc: &str) {
        self.with_complement(name, Role::Data, 0, doc);
    }

    /// A place of another net.
    pub(super) fn shared(&mut self, name: &str) {
        self.with_complement(name, Role::Shared, 0, "");
    }

    /// A store of tokens and its complement, which is empty at the start; once, if it is asked
    /// twice.
    pub(super) fn store(&mut self, name: &str, spent: &str, tokens: u32, doc: &str) {
        if self.net.places.iter().any(|it| it.name == name) {
            return;
        }
        let of = PlaceId(self.net.places.len() as u32);
        let store = OwnedPlace::new(name, tokens).at_most(tokens).doc(doc);
        self.add(OwnedPlace { role: Role::Data, ..store });
        let spent = OwnedPlace::new(spent, 0).at_most(tokens);
        self.add(OwnedPlace { role: Role::Complement(of), ..spent });
    }

    pub(super) fn event(&mut self, name: &str, doc: &str) {
        let added = self.net.event(name, doc);
        debug_assert!(added.is_ok(), "ids count the events of a robot");
    }

    pub(super) fn output(&mut self, name: &str, doc: &str) {
        if self.net.outputs.iter().all(|it| it.name != name) {
            let added = self.net.output(name, doc);
            debug_assert!(added.is_ok(), "ids count the outputs of a robot");
        }
    }

    pub(super) fn line(&mut self, line: Line) {
        let Line { name, on, take, give, read, emits } = line;
        let place = |it: &(String, u32)| {
            let at = self.net.places.iter().position(|place| place.name == it.0);
            debug_assert!(at.is_some(), "the place {} of the line {name}", it.0);
            (PlaceId(at.map_or(u32::MAX, |at| at as u32)), it.1)
        };
        let event = self.net.events.iter().position(|it| it.name == on);
        debug_assert!(event.is_some(), "the event {on} of the line {name}");
        let output = |it: &String| {
            let at = self.net.outputs.iter().position(|known| known.name == *it);
            debug_assert!(at.is_some(), "the output {it} of the line {name}");
            OutputId(at.map_or(u32::MAX, |at| at as u32))
        };
        let mut made =
            OwnedTransition::new(&name).on(EventId(event.map_or(u32::MAX, |it| it as u32)));
        made = take.iter().map(place).fold(made, |made, it| made.take(it.0, it.1));
        made = give.iter().map(place).fold(made, |made, it| made.give(it.0, it.1));
        made = read.iter().map(place).fold(made, |made, it| made.read(it.0, it.1));
        made.emits = emits.iter().map(output).collect();
        let added = self.net.transition(made);
        debug_assert!(added.is_ok(), "ids count the transitions of a robot");
    }

    pub(super) fn done(self) -> OwnedNet {
        self.net
    }
}
