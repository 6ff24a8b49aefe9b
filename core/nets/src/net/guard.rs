//! Guards: conditions become tokens that must be there.

use super::data::{Arc, PlaceId};
use super::lookup::{Found, Meant};
use super::source::{Ignore, Line, Relation, Source};
use super::text::Text;
use super::variant::Variant;

impl Ignore<'_> {
    /// Returns the same as a transition line with only event and guard.
    const fn as_line(&self) -> Line<'_> {
        Line {
            name: "",
            doc: "",
            on: self.event,
            guard: self.guard,
            take: &[],
            give: &[],
            read: &[],
            changes: &[],
            emits: &[],
            within: None,
            priority: 0,
        }
    }
}

impl Line<'_> {
    /// Whether it stands for a line of `ignore`: transitions have names.
    pub(super) const fn is_ignore(&self) -> bool {
        self.name.is_empty()
    }
}

impl Source<'_> {
    /// How many pairs of event and place a name in a line of `ignore` stands for.
    pub(super) const fn pairs(&self, name: &str) -> usize {
        match self.find(name) {
            Found::Group(group) => self.groups[group].members.len(),
            _ => 1,
        }
    }

    /// The place of such a pair.
    #[track_caller]
    pub(super) const fn ignored_in(&self, it: &Ignore<'_>, named: usize, pair: usize) -> PlaceId {
        let name = it.places[named];
        let found = match self.find(name) {
            Found::Group(group) => self.find(self.groups[group].members[pair]),
            found => found,
        };
        match found {
            Found::Place(place) | Found::Data(place, _) => PlaceId(place as u32),
            // A text takes time to make: only what is not there needs it.
            _ => {
                let text = Text::new().with("net ").name(self.name).with(", ignore: ");
                self.place(text, name, Meant::AnyOrGroup)
            }
        }
    }

    /// Returns the condition of a line of `ignore`: a token in the place, and its guard.
    #[track_caller]
    pub(super) const fn ignoring(&self, it: &Ignore<'_>, place: PlaceId) -> Variant {
        let line = it.as_line();
        let mut variant = Variant::NOTHING;
        variant.needs(self, &line, place, 1);
        let mut at = 0;
        while at < line.guard.len() {
            variant.test(self, &line, at);
            at += 1;
        }
        variant.settle(self);
        if !variant.possible {
            self.at_line(&line)
                .with("its guard can never hold in ")
                .name(self.declared(place.0 as usize).name)
                .with(": the conditions contradict each other")
                .stop();
        }
        variant
    }
}

impl Variant {
    /// How much a line of `ignore` asks besides the token in its place.
    pub(super) const fn asked(&self) -> usize {
        self.len() - self.asks(0).is_none() as usize
    }

    /// Returns the condition of a line of `ignore` on the place touched here, if it asks for more
    /// than a token in the place of the line, the first one.
    pub(super) const fn asks(&self, at: usize) -> Option<Arc> {
        let (place, _, tokens, _) = self.arcs(at);
        let implied = at == 0 && tokens == 1;
        if implied { None } else { Some(Arc { place, weight: tokens as u32 }) }
    }

    /// Adds a condition of the guard.
    #[track_caller]
    pub(super) const fn test(&mut self, source: &Source<'_>, line: &Line<'_>, at: usize) {
        let test = line.guard[at];
        let (place, complement) = match source.find(test.name) {
            Found::Place(place) => (place, None),
            Found::Data(place, data) => (place, Some(source.complement(data))),
            Found::Group(_) => {
                let text = source.at_line(line).with("the guard tests a group, ").name(test.name);
                if line.is_ignore() {
                    text.with(": write a line for each of its places").stop()
                }
                text.with(": read it instead, as `read ").with(test.name).with("`").stop()
            }
            Found::Nothing => {
                source.nothing(source.at_line(line).with("in its guard: "), test.name, Meant::Any)
            }
        };
        let bound = source.declared(place).bound;
        // The value is at least `low` and at most `high`.
        let (low, high) = match test.relation {
            Relation::Less if test.value == 0 => (bound + 1, bound),
            Relation::Less => (0, test.value - 1),
            Relation::AtMost => (0, test.value),
            Relation::Equal => (test.value, test.value),
            Relation::AtLeast => (test.value, bound),
            Relation::More => (test.value.saturating_add(1), bound),
        };
        if low > bound {
            source
                .at_line(line)
                .with("its guard can never hold: ")
                .name(test.name)
                .with(" is at most ")
                .number(bound)
                .stop();
        }
        if low > 0 {
            self.needs(source, line, PlaceId(place as u32), low);
        }
        if high < bound {
            match complement {
                Some(complement) => self.needs(source, line, complement, bound - high),
                None => source
                    .at_line(line)
                    .with("its guard asks that the place ")
                    .name(test.name)
                    .with(if high == 0 { " is empty" } else { " holds few tokens" })
                    .with(if line.is_ignore() { ", and it" } else { ", and a transition" })
                    .with(" can only ask for tokens that are there: test a flag or a counter, ")
                    .with(if line.is_ignore() { "or" } else { "or read" })
                    .with(" a place that is marked instead")
                    .stop(),
            }
        }
    }
}
