//! From what was written to a [`Net`](super::Net): names are looked up, lines become transitions.

use super::data::{
    Arc, EventId, Ignored, Law, OutputId, Place, PlaceId, Role, Signal, Transition, Within,
};
use super::lookup::{Found, Meant};
use super::source::{Claim, Line, Source};
use super::text::{Text, as_str, same};
use super::variant::MOST;

/// How long the lists of a net are.
#[derive(Clone, Copy, Debug, Default)]
pub struct Size {
    /// Places.
    pub places: usize,
    /// Transitions.
    pub transitions: usize,
    /// Arcs of all transitions and invariants.
    pub arcs: usize,
    /// Outputs of all transitions.
    pub emits: usize,
    /// Bytes of the names that the lowering makes.
    pub text: usize,
    /// Ignored events.
    pub ignored: usize,
    /// Laws.
    pub laws: usize,
}

/// A part of a list.
#[derive(Clone, Copy, Debug)]
struct Span {
    start: usize,
    length: usize,
}

const EMPTY: Span = Span { start: 0, length: 0 };

#[derive(Clone, Copy, Debug)]
struct Row<'n> {
    name: Span,
    doc: &'n str,
    line: u32,
    on: Option<EventId>,
    take: Span,
    read: Span,
    give: Span,
    emits: Span,
    within: Option<Within>,
    priority: i16,
}

/// The lists of a net, its lengths known when compiling: what `net!` keeps behind a
/// [`Net`](super::Net).
#[derive(Clone, Copy, Debug)]
pub struct Lowered<
    'n,
    const PLACES: usize,
    const TRANSITIONS: usize,
    const ARCS: usize,
    const EMITS: usize,
    const TEXT: usize,
    const IGNORED: usize,
    const LAWS: usize,
> {
    source: Source<'n>,
    names: [Span; PLACES],
    rows: [Row<'n>; TRANSITIONS],
    arcs: [Arc; ARCS],
    emits: [OutputId; EMITS],
    text: [u8; TEXT],
    ignored: [Ignored; IGNORED],
    laws: [(Span, usize); LAWS],
    size: Size,
}

impl<'n> Source<'n> {
    /// How long the lists will be.
    pub const fn size(&self) -> Size {
        self.check();
        let mut size = Size { places: self.own_places() + self.data(), ..SIZE_ZERO };
        let mut at = self.places.len();
        while at < self.own_places() {
            size.text += self.declared(at).name.len() + complement_affix(self, at).len();
            at += 1;
        }
        let mut at = 0;
        while at < self.lines.len() {
            let line = &self.lines[at];
            let variants = self.variants(line);
            let (mut possible, mut labels) = (0, 0);
            let mut number = 0;
            while number < variants {
                let variant = self.variant(line, number);
                if variant.possible {
                    possible += 1;
                    size.emits += line.emits.len();
                    labels += self.label(line, number, variants > 1, &mut [0; 512], 0);
                    let mut touched = 0;
                    while touched < variant.len() {
                        let (_, take, read, give) = variant.arcs(touched);
                        size.arcs +=
                            (take > 0) as usize + (read > 0) as usize + (give > 0) as usize;
                        touched += 1;
                    }
                }
                number += 1;
            }
            if possible == 0 {
                self.at_line(line)
                    .with("it can never fire: its conditions contradict each other, or its changes")
                    .stop();
            }
            size.transitions += possible;
            size.text += if possible > 1 { labels } else { line.name.len() };
            at += 1;
        }
        let mut at = 0;
        while at < self.laws.len() {
            match self.laws[at] {
                Claim::Invariant(sum, _) => {
                    size.arcs += sum.len();
                    size.laws += 1;
                }
                Claim::LeftToChecker => {}
                _ => size.laws += 1,
            }
            at += 1;
        }
        let mut at = 0;
        while at < self.ignored.len() {
            size.ignored += match self.find(self.ignored[at].1) {
                Found::Group(group) => self.groups[group].members.len(),
                _ => 1,
            };
            at += 1;
        }
        size
    }

    /// Writes the name of a variant; its length.
    const fn label<const N: usize>(
        &self,
        line: &Line<'_>,
        number: usize,
        several: bool,
        text: &mut [u8; N],
        start: usize,
    ) -> usize {
        let mut end = put(text, start, line.name);
        if several {
            let (member, mut old) = self.member(line, number);
            if let Some(member) = member {
                end = put(text, end, ".");
                end = put(text, end, member);
            }
            let mut at = 0;
            while at < line.changes.len() {
                let change = line.changes[at];
                if let (super::source::By::Become(_), Found::Data(place, _)) =
                    (change.by, self.find(change.name))
                {
                    let radix = self.declared(place).bound as usize + 1;
                    end = put(text, end, ".");
                    end = put(text, end, change.name);
                    end = put(text, end, "_");
                    end = put_number(text, end, old % radix);
                    old /= radix;
                }
                at += 1;
            }
        }
        end - start
    }

    /// Looks every name up.
    pub const fn lower<
        const PLACES: usize,
        const TRANSITIONS: usize,
        const ARCS: usize,
        const EMITS: usize,
        const TEXT: usize,
        const IGNORED: usize,
        const LAWS: usize,
    >(
        &self,
    ) -> Lowered<'n, PLACES, TRANSITIONS, ARCS, EMITS, TEXT, IGNORED, LAWS> {
        let row = Row {
            name: EMPTY,
            doc: "",
            line: 0,
            on: None,
            take: EMPTY,
            read: EMPTY,
            give: EMPTY,
            emits: EMPTY,
            within: None,
            priority: 0,
        };
        let mut it = Lowered {
            source: *self,
            names: [EMPTY; PLACES],
            rows: [row; TRANSITIONS],
            arcs: [Arc { place: PlaceId(0), weight: 0 }; ARCS],
            emits: [OutputId(0); EMITS],
            text: [0; TEXT],
            ignored: [Ignored { event: EventId(0), place: PlaceId(0) }; IGNORED],
            laws: [(EMPTY, 0); LAWS],
            size: SIZE_ZERO,
        };
        let mut data = 0;
        while data < self.data() {
            let at = self.places.len() + data;
            let start = it.size.text;
            let affix = complement_affix(self, at);
            let name = self.declared(at).name;
            let counter = affix.as_bytes()[0] == b'_';
            let end = put(&mut it.text, start, if counter { name } else { affix });
            let end = put(&mut it.text, end, if counter { affix } else { name });
            it.names[self.own_places() + data] = Span { start, length: end - start };
            it.size.text = end;
            data += 1;
        }
        let mut at = 0;
        while at < self.lines.len() {
            it.lines(at);
            at += 1;
        }
        it.claims();
        it
    }

    const fn event(&self, text: Text, name: &str) -> EventId {
        EventId(signal(text, "event", self.events, name))
    }

    /// A place, flag or counter that a law or an ignored event names.
    const fn place(&self, text: Text, name: &str, meant: Meant) -> PlaceId {
        match self.find(name) {
            Found::Place(place) | Found::Data(place, _) => PlaceId(place as u32),
            Found::Group(_) => text.name(name).with(" is a group; name a place").stop(),
            Found::Nothing => self.nothing(text, name, meant),
        }
    }
}

const SIZE_ZERO: Size =
    Size { places: 0, transitions: 0, arcs: 0, emits: 0, text: 0, ignored: 0, laws: 0 };

/// What the name of a complement adds to that of its flag (before it) or counter (after it).
const fn complement_affix(source: &Source<'_>, at: usize) -> &'static str {
    if source.declared(at).bound == 1 { "not_" } else { "_left" }
}

const fn signal(text: Text, what: &str, signals: &[Signal<'_>], name: &str) -> u32 {
    let mut at = 0;
    while at < signals.len() {
        if same(signals[at].name, name) {
            return at as u32;
        }
        at += 1;
    }
    let mut known = [""; 256];
    let count = if signals.len() < known.len() { signals.len() } else { known.len() };
    let mut at = 0;
    while at < count {
        known[at] = signals[at].name;
        at += 1;
    }
    text.unknown(what, name, known.split_at(count).0)
}

/// Writes a text; where it ends.
const fn put<const N: usize>(text: &mut [u8; N], start: usize, more: &str) -> usize {
    let more = more.as_bytes();
    let mut at = 0;
    while at < more.len() && start + at < N {
        text[start + at] = more[at];
        at += 1;
    }
    start + at
}

const fn put_number<const N: usize>(text: &mut [u8; N], start: usize, number: usize) -> usize {
    let start = if number >= 10 { put_number(text, start, number / 10) } else { start };
    put(text, start, as_str(&[b'0' + (number % 10) as u8]))
}

impl<
    const PLACES: usize,
    const TRANSITIONS: usize,
    const ARCS: usize,
    const EMITS: usize,
    const TEXT: usize,
    const IGNORED: usize,
    const LAWS: usize,
> Lowered<'_, PLACES, TRANSITIONS, ARCS, EMITS, TEXT, IGNORED, LAWS>
{
    /// Adds the transitions of a line.
    const fn lines(&mut self, at: usize) {
        let source = self.source;
        let line = &source.lines[at];
        let emits = self.outputs(line);
        let on = if line.on.is_empty() {
            None
        } else {
            Some(source.event(source.at_line(line), line.on))
        };
        let variants = source.variants(line);
        let mut several = 0;
        let mut number = 0;
        while variants > 1 && number < variants {
            several += source.variant(line, number).possible as usize;
            number += 1;
        }
        let mut number = 0;
        while number < variants {
            let variant = source.variant(line, number);
            if variant.possible {
                let start = self.size.text;
                let length = source.label(line, number, several > 1, &mut self.text, start);
                self.size.text += length;
                let take = self.arcs_of(&variant, 0);
                let read = self.arcs_of(&variant, 1);
                let give = self.arcs_of(&variant, 2);
                self.rows[self.size.transitions] = Row {
                    name: Span { start, length },
                    doc: line.doc,
                    line: at as u32,
                    on,
                    take,
                    read,
                    give,
                    emits,
                    within: match line.within {
                        Some((earliest, Some(latest))) => {
                            Some(Within { earliest: earliest as u32, latest: Some(latest as u32) })
                        }
                        Some((earliest, None)) => {
                            Some(Within { earliest: earliest as u32, latest: None })
                        }
                        None => None,
                    },
                    priority: line.priority as i16,
                };
                self.size.transitions += 1;
            }
            number += 1;
        }
    }

    const fn outputs(&mut self, line: &Line<'_>) -> Span {
        let start = self.size.emits;
        let mut at = 0;
        while at < line.emits.len() {
            let text = self.source.at_line(line);
            self.emits[start + at] =
                OutputId(signal(text, "output", self.source.outputs, line.emits[at]));
            at += 1;
        }
        self.size.emits += line.emits.len();
        Span { start, length: line.emits.len() }
    }

    /// Adds the arcs of one kind: 0 taken, 1 read, 2 given.
    const fn arcs_of(&mut self, variant: &super::variant::Variant, kind: usize) -> Span {
        let start = self.size.arcs;
        let mut at = 0;
        while at < variant.len() {
            let (place, take, read, give) = variant.arcs(at);
            let weight = [take, read, give][kind];
            if weight > 0 {
                self.arcs[self.size.arcs] = Arc { place, weight: weight as u32 };
                self.size.arcs += 1;
            }
            at += 1;
        }
        Span { start, length: self.size.arcs - start }
    }

    /// Adds what is ignored, and the laws.
    const fn claims(&mut self) {
        let source = self.source;
        let text = Text::new().with("net ").name(source.name).with(", ignore: ");
        let mut at = 0;
        while at < source.ignored.len() {
            let (event, place) = source.ignored[at];
            let event = source.event(text, event);
            if let Found::Group(group) = source.find(place) {
                let mut member = 0;
                while member < source.groups[group].members.len() {
                    let place =
                        source.place(text, source.groups[group].members[member], Meant::Place);
                    self.ignored[self.size.ignored] = Ignored { event, place };
                    self.size.ignored += 1;
                    member += 1;
                }
            } else {
                self.ignored[self.size.ignored] =
                    Ignored { event, place: source.place(text, place, Meant::AnyOrGroup) };
                self.size.ignored += 1;
            }
            at += 1;
        }
        let text = Text::new().with("net ").name(source.name).with(", laws: ");
        let mut at = 0;
        while at < source.laws.len() {
            let start = self.size.arcs;
            match source.laws[at] {
                Claim::LeftToChecker => {
                    at += 1;
                    continue;
                }
                Claim::Invariant(sum, _) => {
                    let mut term = 0;
                    while term < sum.len() {
                        let (name, weight) = sum[term];
                        let mut other = 0;
                        while other < term {
                            if same(sum[other].0, name) {
                                text.with("an invariant names ")
                                    .name(name)
                                    .with(" twice; write a weight, as `")
                                    .with(name)
                                    .with(" * 2`")
                                    .stop();
                            }
                            other += 1;
                        }
                        if weight == 0 || weight > MOST {
                            text.with("the weight ")
                                .number(weight)
                                .with(" of ")
                                .name(name)
                                .with(" is not from 1 to 65,535")
                                .stop();
                        }
                        self.arcs[self.size.arcs] = Arc {
                            place: source.place(text, name, Meant::Any),
                            weight: weight as u32,
                        };
                        self.size.arcs += 1;
                        term += 1;
                    }
                }
                _ => {}
            }
            self.laws[self.size.laws] = (Span { start, length: self.size.arcs - start }, at);
            self.size.laws += 1;
            at += 1;
        }
    }

    const fn arcs(&self, span: Span) -> &[Arc] {
        self.arcs.split_at(span.start).1.split_at(span.length).0
    }

    const fn text(&self, span: Span) -> &str {
        as_str(self.text.split_at(span.start).1.split_at(span.length).0)
    }

    /// Its places.
    pub const fn places(&self) -> [Place<'_>; PLACES] {
        let mut places =
            [Place { name: "", doc: "", initial: 0, bound: 0, role: Role::State }; PLACES];
        let (states, own) = (self.source.places.len(), self.source.own_places());
        let shared = own - self.source.shared.len();
        let mut at = 0;
        while at < PLACES {
            let of = if at < own { at } else { states + at - own };
            let it = self.source.declared(of);
            let (initial, bound) = (it.initial as u32, it.bound as u32);
            places[at] = if at < own {
                let role = if at < states {
                    Role::State
                } else if at < shared {
                    Role::Data
                } else {
                    Role::Shared
                };
                Place { name: it.name, doc: it.doc, initial, bound, role }
            } else {
                let role = Role::Complement(PlaceId(of as u32));
                Place {
                    name: self.text(self.names[at]),
                    doc: "",
                    initial: bound - initial,
                    bound,
                    role,
                }
            };
            at += 1;
        }
        places
    }

    /// Its transitions.
    pub const fn transitions(&self) -> [Transition<'_>; TRANSITIONS] {
        let empty = Transition {
            name: "",
            doc: "",
            line: 0,
            on: None,
            take: &[],
            read: &[],
            give: &[],
            emits: &[],
            within: None,
            priority: 0,
        };
        let mut transitions = [empty; TRANSITIONS];
        let mut at = 0;
        while at < TRANSITIONS {
            let row = self.rows[at];
            transitions[at] = Transition {
                name: self.text(row.name),
                doc: row.doc,
                line: row.line,
                on: row.on,
                take: self.arcs(row.take),
                read: self.arcs(row.read),
                give: self.arcs(row.give),
                emits: self.emits.split_at(row.emits.start).1.split_at(row.emits.length).0,
                within: row.within,
                priority: row.priority,
            };
            at += 1;
        }
        transitions
    }

    /// What it ignores on purpose.
    pub const fn ignored(&self) -> &[Ignored] {
        &self.ignored
    }

    /// Its laws.
    pub const fn laws(&self) -> [Law<'_>; LAWS] {
        let text = Text::new().with("net ").name(self.source.name).with(", laws: ");
        let mut laws = [Law::Settles; LAWS];
        let mut at = 0;
        while at < LAWS {
            let (span, claim) = self.laws[at];
            laws[at] = match self.source.laws[claim] {
                Claim::Invariant(_, equals) => {
                    if equals > u32::MAX as u64 {
                        text.with("the sum ")
                            .number(equals)
                            .with(" of an invariant is too large")
                            .stop();
                    }
                    Law::Invariant { sum: self.arcs(span), equals: equals as u32 }
                }
                Claim::NeverBoth(a, b) => Law::NeverBoth(
                    self.source.place(text, a, Meant::Any),
                    self.source.place(text, b, Meant::Any),
                ),
                Claim::Reachable(place) => {
                    Law::Reachable(self.source.place(text, place, Meant::Any))
                }
                Claim::AlwaysCan(place) => {
                    Law::AlwaysCan(self.source.place(text, place, Meant::Any))
                }
                Claim::HandlesAll => Law::HandlesAll,
                Claim::Settles | Claim::LeftToChecker => Law::Settles,
                Claim::DeadlockFree(end) if end.is_empty() => Law::DeadlockFree { end: None },
                Claim::DeadlockFree(end) => {
                    Law::DeadlockFree { end: Some(self.source.place(text, end, Meant::Any)) }
                }
                Claim::Deterministic => Law::Deterministic,
            };
            at += 1;
        }
        laws
    }
}

/// The line of each transition.
pub const fn lines<const N: usize>(net: &super::Net<'_>) -> [u16; N] {
    let mut lines = [0; N];
    let mut at = 0;
    while at < N {
        lines[at] = net.transitions[at].line as u16;
        at += 1;
    }
    lines
}
