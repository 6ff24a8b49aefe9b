//! From what was written to a [`Net`](super::Net): names are looked up, lines become transitions.

use super::data::{Arc, EventId, Ignored, Law, OutputId, Place, PlaceId, Role, Transition, Within};
use super::lookup::{Meant, position, signal};
use super::size::{Size, complement_affix, put};
use super::source::{Claim, Ignore, Line, Source};
use super::text::{Text, as_str, same};
use super::variant::MOST;

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
    ignored: [(EventId, PlaceId, Span); IGNORED],
    laws: [(Span, usize); LAWS],
    size: Size,
}

impl<
    'n,
    const PLACES: usize,
    const TRANSITIONS: usize,
    const ARCS: usize,
    const EMITS: usize,
    const TEXT: usize,
    const IGNORED: usize,
    const LAWS: usize,
> Lowered<'n, PLACES, TRANSITIONS, ARCS, EMITS, TEXT, IGNORED, LAWS>
{
    /// Looks every name up.
    #[track_caller]
    pub const fn of(source: &Source<'n>) -> Self {
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
            source: *source,
            names: [EMPTY; PLACES],
            rows: [row; TRANSITIONS],
            arcs: [Arc { place: PlaceId(0), weight: 0 }; ARCS],
            emits: [OutputId(0); EMITS],
            text: [0; TEXT],
            ignored: [(EventId(0), PlaceId(0), EMPTY); IGNORED],
            laws: [(EMPTY, 0); LAWS],
            size: Size::ZERO,
        };
        let mut data = 0;
        while data < source.data() {
            let at = source.places.len() + data;
            let start = it.size.text;
            let affix = complement_affix(source, at);
            let name = source.declared(at).name;
            let counter = affix.as_bytes()[0] == b'_';
            let end = put(&mut it.text, start, if counter { name } else { affix });
            let end = put(&mut it.text, end, if counter { affix } else { name });
            it.names[source.own_places() + data] = Span { start, length: end - start };
            it.size.text = end;
            data += 1;
        }
        let mut at = 0;
        while at < source.lines.len() {
            it.lines(at);
            at += 1;
        }
        it.claims();
        it
    }

    /// Adds the transitions of a line.
    #[track_caller]
    const fn lines(&mut self, at: usize) {
        let source = self.source;
        let line = &source.lines[at];
        let emits = self.outputs(line);
        // The text of an error is made for an error alone.
        let on = match position(source.events, line.on) {
            Some(event) => Some(EventId(event)),
            None if line.on.is_empty() => None,
            None => Some(source.event(source.at_line(line), line.on)),
        };
        let variants = source.variants(line);
        let mut several = 0;
        let mut number = 0;
        while variants > 1 && several < 2 && number < variants {
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

    #[track_caller]
    const fn outputs(&mut self, line: &Line<'_>) -> Span {
        let start = self.size.emits;
        let mut at = 0;
        while at < line.emits.len() {
            let (outputs, name) = (self.source.outputs, line.emits[at]);
            self.emits[start + at] = OutputId(match position(outputs, name) {
                Some(output) => output,
                None => signal(self.source.at_line(line), "output", outputs, name),
            });
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

    /// Adds what a line of `ignore` asks besides the token in this place.
    #[track_caller]
    const fn asked(&mut self, line: &Ignore<'_>, place: PlaceId) -> Span {
        let variant = self.source.ignoring(line, place);
        let start = self.size.arcs;
        let mut at = 0;
        while at < variant.len() {
            if let Some(arc) = variant.asks(at) {
                self.arcs[self.size.arcs] = arc;
                self.size.arcs += 1;
            }
            at += 1;
        }
        Span { start, length: self.size.arcs - start }
    }

    /// Adds what is ignored, and the laws.
    #[track_caller]
    const fn claims(&mut self) {
        let source = self.source;
        let text = Text::new().with("net ").name(source.name).with(", ignore: ");
        let mut at = 0;
        while at < source.ignored.len() {
            let line = &source.ignored[at];
            let event = source.event(text, line.event);
            let mut named = 0;
            while named < line.places.len() {
                let pairs = source.pairs(line.places[named]);
                let mut pair = 0;
                while pair < pairs {
                    let place = source.ignored_in(line, named, pair);
                    let guard = if line.guard.is_empty() { EMPTY } else { self.asked(line, place) };
                    self.ignored[self.size.ignored] = (event, place, guard);
                    self.size.ignored += 1;
                    pair += 1;
                }
                named += 1;
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

    /// Returns the places of the net.
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

    /// Returns the transitions of the net.
    pub const fn transitions(&self) -> [Transition<'_>; TRANSITIONS] {
        let mut transitions = [Transition::NOTHING; TRANSITIONS];
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

    /// Returns the pairs ignored on purpose.
    pub const fn ignored(&self) -> [Ignored<'_>; IGNORED] {
        let mut ignored = [Ignored { event: EventId(0), place: PlaceId(0), guard: &[] }; IGNORED];
        let mut at = 0;
        while at < IGNORED {
            let (event, place, guard) = self.ignored[at];
            ignored[at] = Ignored { event, place, guard: self.arcs(guard) };
            at += 1;
        }
        ignored
    }

    /// Returns the laws of the net.
    #[track_caller]
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

/// Copies the value of each line to its transitions.
#[track_caller]
pub const fn by_line<T: Copy, const N: usize>(of: &[T], lines: &[u16; N]) -> [T; N] {
    let mut all = match (of, of.first_chunk::<N>()) {
        ([first, ..], _) => [*first; N],
        ([], Some(none)) => *none,
        ([], None) => Text::new().with("a transition comes from no line").stop(),
    };
    let mut at = 0;
    while at < N {
        all[at] = of[lines[at] as usize];
        at += 1;
    }
    all
}
