//! One line of `transitions` stands for one transition or several: from each place of a group, for
//! each old value of what it sets. Here a line and the number of a variant become arcs.

use super::data::PlaceId;
use super::lookup::{Found, Meant};
use super::source::{By, Group, Line, Source};
use super::text::same;

/// The most places that one transition may touch.
const TOUCHED: usize = 32;
/// The most transitions that one line may stand for.
const VARIANTS: usize = 4_096;
/// The most tokens of a place, and the largest weight.
pub(super) const MOST: u64 = 65_535;

/// The effect of one variant of a line on one place.
#[derive(Clone, Copy)]
pub(super) struct Touch {
    pub(super) place: PlaceId,
    /// Tokens removed.
    pub(super) take: u64,
    /// Tokens added.
    pub(super) give: u64,
    /// Tokens that must be there.
    pub(super) need: u64,
}

/// One transition of a line.
#[derive(Clone, Copy)]
pub(super) struct Variant {
    touched: [Touch; TOUCHED],
    length: usize,
    /// Whether its guard can hold at all.
    pub(super) possible: bool,
}

impl Source<'_> {
    /// The group that a line takes from or reads; only one can.
    #[track_caller]
    const fn group(&self, line: &Line<'_>) -> Option<Group<'_>> {
        let mut group = None;
        let mut at = 0;
        while at < line.take.len() + line.read.len() {
            let name = if at < line.take.len() {
                line.take[at].0
            } else {
                line.read[at - line.take.len()].0
            };
            if let Found::Group(found) = self.find(name) {
                if group.is_some() {
                    self.at_line(line)
                        .with("it names two groups; write one line for each member of one of them")
                        .stop();
                }
                group = Some(self.groups[found]);
            }
            at += 1;
        }
        group
    }

    /// How many variants a line has, possible or not.
    #[track_caller]
    pub(super) const fn variants(&self, line: &Line<'_>) -> usize {
        let mut variants = match self.group(line) {
            Some(group) => group.members.len(),
            None => 1,
        };
        let mut at = 0;
        while at < line.changes.len() {
            let change = line.changes[at];
            if let (By::Become(_), Found::Data(place, _)) = (change.by, self.find(change.name)) {
                variants *= self.declared(place).bound as usize + 1;
                if variants > VARIANTS {
                    self.at_line(line)
                        .with("it stands for more than ")
                        .number(VARIANTS as u64)
                        .with(" transitions: one for each old value of ")
                        .name(change.name)
                        .with("; set what has fewer values, or count with `+= 1` and `-= 1`")
                        .stop();
                }
            }
            at += 1;
        }
        variants
    }

    /// The name of the group member that a variant takes, and what is left of its number for old
    /// values.
    pub(super) const fn member(&self, line: &Line<'_>, variant: usize) -> (Option<&str>, usize) {
        match self.group(line) {
            Some(group) => {
                (Some(group.members[variant % group.members.len()]), variant / group.members.len())
            }
            None => (None, variant),
        }
    }

    /// The arcs of one variant of a line.
    #[track_caller]
    pub(super) const fn variant(&self, line: &Line<'_>, number: usize) -> Variant {
        let mut variant = Variant::NOTHING;
        let (member, mut old) = self.member(line, number);

        let mut at = 0;
        while at < line.take.len() {
            if let Some((place, weight)) =
                self.arc(line, line.take[at], member, Meant::PlaceOrGroup)
            {
                let touch = variant.touch(self, line, place);
                if touch.take > 0 {
                    self.at_line(line)
                        .with("it takes ")
                        .name(line.take[at].0)
                        .with(" twice; write a weight, as `")
                        .with(self.declared(place.0 as usize).name)
                        .with(" * 2`")
                        .stop();
                }
                touch.take = weight;
            }
            at += 1;
        }
        let mut at = 0;
        while at < line.read.len() {
            if let Some((place, weight)) =
                self.arc(line, line.read[at], member, Meant::PlaceOrGroup)
            {
                variant.needs(self, line, place, weight);
            }
            at += 1;
        }
        let mut at = 0;
        while at < line.give.len() {
            if let Some((place, weight)) = self.arc(line, line.give[at], None, Meant::Place) {
                let touch = variant.touch(self, line, place);
                if touch.give > 0 {
                    self.at_line(line)
                        .with("it gives ")
                        .name(line.give[at].0)
                        .with(" twice; write a weight, as `")
                        .with(line.give[at].0)
                        .with(" * 2`")
                        .stop();
                }
                touch.give = weight;
            }
            at += 1;
        }
        let mut at = 0;
        while at < line.guard.len() {
            variant.test(self, line, at);
            at += 1;
        }
        let mut at = 0;
        while at < line.changes.len() {
            old = variant.change(self, line, at, old);
            at += 1;
        }
        variant.settle(self);
        variant
    }

    /// A place and weight of a line; `None` for `_`.
    #[track_caller]
    const fn arc(
        &self,
        line: &Line<'_>,
        written: (&str, u64),
        member: Option<&str>,
        meant: Meant,
    ) -> Option<(PlaceId, u64)> {
        let (name, weight) = written;
        if same(name, "_") {
            return None;
        }
        if weight == 0 || weight > MOST {
            self.at_line(line)
                .with("the weight ")
                .number(weight)
                .with(" of ")
                .name(name)
                .with(" is not from 1 to 65,535")
                .stop();
        }
        let place = match (self.find(name), member) {
            (Found::Place(place), _) => place,
            (Found::Group(_), Some(member)) => match self.find(member) {
                Found::Place(place) => place,
                _ => self.nothing(
                    self.at_line(line).with("in group ").name(name).with(": "),
                    member,
                    Meant::Place,
                ),
            },
            (Found::Group(_), None) => self
                .at_line(line)
                .with("a transition cannot put a token into a group: ")
                .with("name the place that it means instead of ")
                .name(name)
                .with(", or write `_ => _ read ")
                .with(name)
                .with("` to leave tokens where they are")
                .stop(),
            (Found::Data(..), _) => self
                .at_line(line)
                .name(name)
                .with(" is data, not a place: test it in a guard, as `[")
                .with(name)
                .with("]`, and change it with `do`")
                .stop(),
            (Found::Nothing, _) => self.nothing(self.at_line(line), name, meant),
        };
        let bound = self.declared(place).bound;
        if weight > bound {
            self.at_line(line)
                .with("the weight ")
                .number(weight)
                .with(" of ")
                .name(name)
                .with(" is more than the ")
                .number(bound)
                .with(if bound == 1 { " token" } else { " tokens" })
                .with(" that it is declared for; declare a larger bound, as `")
                .with(name)
                .with(": ")
                .digits(self.declared(place).initial)
                .with(" of ")
                .digits(weight)
                .with("`")
                .stop();
        }
        Some((PlaceId(place as u32), weight))
    }
}

impl Variant {
    /// A variant that touches nothing yet.
    pub(super) const NOTHING: Self = Self {
        touched: [Touch { place: PlaceId(0), take: 0, give: 0, need: 0 }; TOUCHED],
        length: 0,
        possible: true,
    };

    /// Returns the touch of this place, a new one if need be.
    #[track_caller]
    const fn touch(&mut self, source: &Source<'_>, line: &Line<'_>, place: PlaceId) -> &mut Touch {
        let mut at = 0;
        while at < self.length && self.touched[at].place.0 != place.0 {
            at += 1;
        }
        if at == TOUCHED {
            source
                .at_line(line)
                .with("it touches more than 32 places; ")
                .with(if line.is_ignore() {
                    "test fewer"
                } else {
                    "split it into several transitions"
                })
                .stop();
        }
        if at == self.length {
            self.touched[at] = Touch { place, take: 0, give: 0, need: 0 };
            self.length += 1;
        }
        &mut self.touched[at]
    }

    /// Asks for tokens.
    #[track_caller]
    pub(super) const fn needs(
        &mut self,
        source: &Source<'_>,
        line: &Line<'_>,
        place: PlaceId,
        tokens: u64,
    ) {
        let touch = self.touch(source, line, place);
        if tokens > touch.need {
            touch.need = tokens;
        }
    }

    /// Adds a change; gives back the number of the variant less what this change used of it.
    #[track_caller]
    const fn change(
        &mut self,
        source: &Source<'_>,
        line: &Line<'_>,
        at: usize,
        old: usize,
    ) -> usize {
        let change = line.changes[at];
        let (place, complement) = match source.find(change.name) {
            Found::Data(place, data) => (place, source.complement(data)),
            Found::Place(_) | Found::Group(_) => source
                .at_line(line)
                .with("`do` changes flags, counters and shared places, and ")
                .name(change.name)
                .with(" is a place: move tokens with `=>`")
                .stop(),
            Found::Nothing => {
                source.nothing(source.at_line(line).with("in its `do`: "), change.name, Meant::Data)
            }
        };
        let mut other = 0;
        while other < at {
            if same(line.changes[other].name, change.name) {
                source
                    .at_line(line)
                    .with("it changes ")
                    .name(change.name)
                    .with(" twice; write one change")
                    .stop();
            }
            other += 1;
        }
        let bound = source.declared(place).bound;
        let place = PlaceId(place as u32);
        let (up, down, rest) = match change.by {
            By::Add(by) => (by, 0, old),
            By::Subtract(by) => (0, by, old),
            By::Become(value) => {
                let radix = bound as usize + 1;
                let was = (old % radix) as u64;
                if value > bound {
                    source
                        .at_line(line)
                        .with("it sets ")
                        .name(change.name)
                        .with(" to ")
                        .number(value)
                        .with(", beyond its largest value ")
                        .number(bound)
                        .stop();
                }
                if was > 0 {
                    self.needs(source, line, place, was);
                }
                if was < bound {
                    self.needs(source, line, complement, bound - was);
                }
                (value.saturating_sub(was), was.saturating_sub(value), old / radix)
            }
        };
        if up > bound || down > bound {
            source
                .at_line(line)
                .with("it changes ")
                .name(change.name)
                .with(" by more than its largest value ")
                .number(bound)
                .stop();
        }
        let touch = self.touch(source, line, place);
        touch.give += up;
        touch.take += down;
        let touch = self.touch(source, line, complement);
        touch.give += down;
        touch.take += up;
        rest
    }

    /// Finds out whether the conditions contradict each other.
    pub(super) const fn settle(&mut self, source: &Source<'_>) {
        let mut at = 0;
        while at < self.length {
            let touch = &self.touched[at];
            let own = source.own_places();
            let place = touch.place.0 as usize;
            let need = if touch.need > touch.take { touch.need } else { touch.take };
            if place >= own {
                let of = source.places.len() + place - own;
                let mut other = 0;
                while other < self.length {
                    let twin = &self.touched[other];
                    if twin.place.0 as usize == of {
                        let low = if twin.need > twin.take { twin.need } else { twin.take };
                        if low + need > source.declared(of).bound {
                            self.possible = false;
                        }
                    }
                    other += 1;
                }
            }
            at += 1;
        }
    }

    pub(super) const fn len(&self) -> usize {
        self.length
    }

    /// Returns the arcs at a place: tokens removed, read and added. A place of which more must be
    /// there than is removed has the rest removed and put back.
    pub(super) const fn arcs(&self, at: usize) -> (PlaceId, u64, u64, u64) {
        let touch = self.touched[at];
        if touch.take == 0 {
            (touch.place, 0, touch.need, touch.give)
        } else if touch.need > touch.take {
            (touch.place, touch.need, 0, touch.give + touch.need - touch.take)
        } else {
            (touch.place, touch.take, 0, touch.give)
        }
    }
}
