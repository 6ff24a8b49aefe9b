//! The laws of a small net, checked while compiling; one that does not hold is a compile error that
//! names the culprit and the shortest way there.

use super::data::{Law, Net, PlaceId, Role};
use super::explore::{AT_ONCE, FIRINGS, Graph, MARKINGS, NONE, SHARED, held, marked, said};
use super::text::Text;
use crate::player::code::Code;

/// What is known of a net when it is compiled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Known {
    /// All its laws hold: so many markings, and firings between them, were explored.
    Explored {
        /// Reachable markings.
        markings: usize,
        /// Firings.
        firings: usize,
        /// The most transitions that fire at once by themselves one after another.
        settle: u32,
    },
    /// It says that its laws are left to the checker; it was not explored.
    LeftToChecker,
}

impl Known {
    /// The most transitions that fire at once one after another: proven, or a limit.
    pub const fn settle(self) -> u32 {
        match self {
            Self::Explored { settle, .. } => settle,
            Self::LeftToChecker => 1_000,
        }
    }

    /// Whether the bounds of the places are proven.
    pub const fn bounded(self) -> bool {
        matches!(self, Self::Explored { .. })
    }
}

/// Checks bounds, settling and the laws of a net. Ends the compilation with an explanation when one
/// does not hold, or when the net is too large and does not say that it is left to the checker.
#[must_use]
pub const fn check<const W: usize>(
    net: &Net<'_>,
    code: &Code<'_, W>,
    left_to_checker: bool,
) -> Known {
    if left_to_checker {
        return Known::LeftToChecker;
    }
    let graph = Graph::of(net, code);
    let check = Check { net, code, graph: &graph };
    if let Some((from, by)) = graph.overflow {
        check.exceeded(from as usize, by as usize);
    }
    if !graph.complete {
        let text = Text::new().with("net ").name(net.name).with(" has more than ");
        let text = if graph.fired < FIRINGS {
            text.number(MARKINGS as u64).with(" markings")
        } else {
            text.number(FIRINGS as u64).with(" firings between its markings")
        };
        text.with(", too many to explore while compiling: say `left_to_checker;` in its laws, ")
            .with("and check it with the model checker")
            .stop();
    }
    let settle = check.settles();
    let mut at = 0;
    while at < net.laws.len() {
        check.law(&net.laws[at]);
        at += 1;
    }
    Known::Explored { markings: graph.count, firings: graph.fired, settle }
}

pub(super) struct Check<'c, const W: usize> {
    pub(super) net: &'c Net<'c>,
    pub(super) code: &'c Code<'c, W>,
    pub(super) graph: &'c Graph<W>,
}

impl<const W: usize> Check<'_, W> {
    /// Begins the text of an error.
    pub(super) const fn says(&self, law: &str) -> Text {
        Text::new().with("net ").name(self.net.name).with(": ").with(law)
    }

    const fn name(&self, place: PlaceId) -> &str {
        self.net.places[place.0 as usize].name
    }

    const fn tokens(&self, place: PlaceId, marking: usize) -> u32 {
        let field = &self.code.fields[place.0 as usize];
        (self.graph.markings[marking][field.word as usize] >> field.shift) as u32
            & ((1 << field.width) - 1)
    }

    /// Adds where it is so: the way to a marking, and what is marked there.
    const fn found(&self, text: Text, marking: usize) -> Text {
        let text = self.graph.way(self.net, self.code, text.with("\n  "), marking);
        marked(self.net, self.code, text.with("\n  "), &self.graph.markings[marking])
    }

    /// Ends the compilation: this is so in this marking.
    const fn refuted(&self, text: Text, marking: usize) -> ! {
        self.found(text, marking).stop()
    }

    const fn exceeded(&self, from: usize, by: usize) -> ! {
        let entry = &self.code.entries[by];
        let after = crate::player::code::plus(&self.graph.markings[from], &entry.delta);
        let mut at = 0;
        while held(self.code, &after, at) <= self.net.places[at].bound as u64 {
            at += 1;
        }
        let (place, tokens) = (&self.net.places[at], held(self.code, &after, at));
        let text = self
            .says("place ")
            .name(place.name)
            .with(" gets ")
            .number(tokens)
            .with(" tokens, and is declared for ");
        let text = text.number(place.bound as u64).with("\n  ");
        let text = if from == 0 {
            text.with("after: ")
        } else {
            self.graph.way(self.net, self.code, text, from).with(", then ")
        };
        let text = said(self.net, self.code, text, by);
        let text = if self.graph.grows(from, &after, self.code) {
            text.with("\n  this can be repeated without end, so no bound is large enough: let ")
        } else {
            text.with("\n  declare a larger bound, as `")
                .with(place.name)
                .with(": ")
                .digits(place.initial as u64)
                .with(" of ")
                .digits(tokens)
                .with("`, or let ")
        };
        text.name(self.net.transitions[entry.transition as usize].name)
            .with(" wait for room, by taking a token from a place that stands for it")
            .stop()
    }

    const fn law(&self, law: &Law<'_>) {
        match *law {
            Law::Invariant { sum, equals } => self.invariant(sum, equals),
            Law::NeverBoth(a, b) => self.never_both(a, b),
            Law::Reachable(place) => self.reachable(place),
            Law::AlwaysCan(place) => self.always_can(place),
            Law::HandlesAll => self.handles_all(),
            Law::Settles => {}
            Law::DeadlockFree { end } => self.deadlock_free(end),
            Law::Deterministic => self.deterministic(),
        }
    }

    const fn invariant(&self, sum: &[super::Arc], equals: u32) {
        let mut marking = 0;
        while marking < self.graph.count {
            let mut total = 0_u64;
            let mut at = 0;
            while at < sum.len() {
                total += sum[at].weight as u64 * self.tokens(sum[at].place, marking) as u64;
                at += 1;
            }
            if total != equals as u64 {
                let mut text = self.says("law `invariant(");
                let mut at = 0;
                while at < sum.len() {
                    text = if at > 0 { text.with(" & ") } else { text };
                    text = text.with(self.name(sum[at].place));
                    text = if sum[at].weight > 1 {
                        text.with(" * ").number(sum[at].weight as u64)
                    } else {
                        text
                    };
                    at += 1;
                }
                let text = text
                    .with(" = ")
                    .number(equals as u64)
                    .with(")` does not hold: the sum is ")
                    .number(total);
                self.refuted(text, marking);
            }
            marking += 1;
        }
    }

    const fn never_both(&self, a: PlaceId, b: PlaceId) {
        let mut marking = 0;
        while marking < self.graph.count {
            if self.tokens(a, marking) > 0 && self.tokens(b, marking) > 0 {
                let text =
                    self.says("law `never_both(").with(self.name(a)).with(", ").with(self.name(b));
                self.refuted(text.with(")` does not hold: both are marked"), marking);
            }
            marking += 1;
        }
    }

    const fn reachable(&self, place: PlaceId) {
        let mut marking = 0;
        while marking < self.graph.count {
            if self.tokens(place, marking) > 0 {
                return;
            }
            marking += 1;
        }
        self.says("law `reachable(")
            .with(self.name(place))
            .with(")` does not hold: no firing sequence puts a token into ")
            .name(self.name(place))
            .with(" (markings explored: ")
            .number(self.graph.count as u64)
            .with(")")
            .stop()
    }

    const fn always_can(&self, place: PlaceId) {
        // Backwards from the markings where it is marked.
        let mut can = [false; MARKINGS];
        let mut queue = [0_u16; MARKINGS];
        let mut found = 0;
        let mut marking = 0;
        while marking < self.graph.count {
            if self.tokens(place, marking) > 0 {
                can[marking] = true;
                queue[found] = marking as u16;
                found += 1;
            }
            marking += 1;
        }
        let mut next = 0;
        while next < found {
            let mut firing = self.graph.arrivals[queue[next] as usize];
            while firing != NONE {
                let from = self.graph.firings[firing as usize].from;
                if !can[from as usize] {
                    can[from as usize] = true;
                    queue[found] = from;
                    found += 1;
                }
                firing = self.graph.earlier[firing as usize];
            }
            next += 1;
        }
        if found < self.graph.count {
            let mut marking = 0;
            while can[marking] {
                marking += 1;
            }
            let text = self
                .says("law `always_can(")
                .with(self.name(place))
                .with(")` does not hold: no firing sequence puts a token into ");
            self.refuted(text.name(self.name(place)), marking);
        }
    }

    const fn deadlock_free(&self, end: Option<PlaceId>) {
        let mut marking = 0;
        while marking < self.graph.count {
            let meant = match end {
                Some(end) => self.tokens(end, marking) > 0,
                None => false,
            };
            if !meant && !self.any_transition(marking) {
                let text = match end {
                    Some(end) => {
                        self.says("law `deadlock_free_except(").with(self.name(end)).with(")")
                    }
                    None => self.says("law `deadlock_free"),
                };
                let text =
                    self.found(text.with("` does not hold: no transition is enabled"), marking);
                match (end, self.first_marked(marking)) {
                    (None, Some(place)) => text
                        .with("\n  if it is meant to end there, say `deadlock_free_except(")
                        .with(place)
                        .with(")`")
                        .stop(),
                    _ => text.stop(),
                }
            }
            marking += 1;
        }
    }

    const fn any_transition(&self, marking: usize) -> bool {
        // Changes of shared places come last.
        let first = self.graph.starts[marking];
        first < self.graph.starts[marking + 1] && self.graph.firings[first as usize].kind != SHARED
    }

    const fn handles_all(&self) {
        // The first event that is forgotten, with the marking nearest to the start.
        let (mut event, mut place) = (self.net.events.len(), 0);
        let mut marking = 0;
        while marking < self.graph.count {
            let first = self.forgotten(marking, event);
            if first < event {
                (event, place) = (first, marking);
            }
            marking += 1;
        }
        if event == self.net.events.len() {
            return;
        }
        let text = self
            .says("law `handles(all)` does not hold: event ")
            .name(self.net.events[event].name)
            .with(" is neither used nor ignored on purpose");
        let text = self.found(text, place).with("\n  add a transition on it");
        match self.first_marked(place) {
            Some(place) => text
                .with(", or `ignore { ")
                .with(self.net.events[event].name)
                .with(" in ")
                .with(place)
                .with("; }`")
                .stop(),
            None => text.stop(),
        }
    }

    /// The first event before `most` that nothing answers in a marking where the net has settled;
    /// `most` if there is none.
    const fn forgotten(&self, marking: usize, most: usize) -> usize {
        let (start, end) =
            (self.graph.starts[marking] as usize, self.graph.starts[marking + 1] as usize);
        let mut first = 0;
        while first < most {
            // 64 events at a time.
            let mut answered = 0_u64;
            let mut at = start;
            while at < end {
                let kind = self.graph.firings[at].kind;
                if kind == AT_ONCE {
                    return most;
                }
                if kind as usize >= first && kind as usize - first < 64 {
                    answered |= 1 << (kind as usize - first);
                }
                at += 1;
            }
            let mut event = first;
            while event < most && event < first + 64 {
                if answered >> (event - first) & 1 == 0 && !self.ignores(event, marking) {
                    return event;
                }
                event += 1;
            }
            first += 64;
        }
        most
    }

    /// Whether some place that ignores this event on purpose is marked.
    const fn ignores(&self, event: usize, marking: usize) -> bool {
        let mut at = 0;
        while at < self.net.ignored.len() {
            let it = self.net.ignored[at];
            if it.event.0 as usize == event && self.tokens(it.place, marking) > 0 {
                return true;
            }
            at += 1;
        }
        false
    }

    /// The first marked place that `net!` has a name for.
    const fn first_marked(&self, marking: usize) -> Option<&str> {
        let mut at = 0;
        while at < self.net.places.len() {
            let named = !matches!(self.net.places[at].role, Role::Complement(_));
            if named && self.tokens(PlaceId(at as u32), marking) > 0 {
                return Some(self.net.places[at].name);
            }
            at += 1;
        }
        None
    }

    const fn deterministic(&self) {
        let mut marking = 0;
        while marking < self.graph.count {
            let (start, end) =
                (self.graph.starts[marking] as usize, self.graph.starts[marking + 1] as usize);
            // Before the net has settled, it is not offered events.
            let mut at_once = 0;
            let mut at = start;
            while at < end {
                at_once += (self.graph.firings[at].kind == AT_ONCE) as usize;
                at += 1;
            }
            // Kinds that were met, some of them sharing a bit.
            let mut met = 0_u64;
            at = start;
            while at < end && at_once != 1 {
                let kind = self.graph.firings[at].kind;
                if kind == AT_ONCE || kind < SHARED && at_once == 0 {
                    let bit = 1 << (kind % 64);
                    let mut other = if met & bit == 0 { at } else { start };
                    while other < at {
                        if self.graph.firings[other].kind == kind {
                            self.conflict(marking, other, at);
                        }
                        other += 1;
                    }
                    met |= bit;
                }
                at += 1;
            }
            marking += 1;
        }
    }

    const fn conflict(&self, marking: usize, a: usize, b: usize) -> ! {
        let (a, b) = (&self.graph.firings[a], &self.graph.firings[b]);
        let text = self
            .says("law `deterministic` does not hold: ")
            .name(self.net.transitions[self.code.entries[a.by as usize].transition as usize].name)
            .with(" and ")
            .name(self.net.transitions[self.code.entries[b.by as usize].transition as usize].name)
            .with(" are enabled together, both ");
        let text = if a.kind == AT_ONCE {
            text.with("without event and interval")
        } else {
            text.with("on ").name(self.net.events[a.kind as usize].name)
        };
        self.found(text, marking)
            .with("\n  tell them apart by their guards or the places they need")
            .stop()
    }
}
