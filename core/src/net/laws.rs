//! The laws of a small net, checked while compiling; one that does not hold is a compile error that names the culprit
//! and the shortest way there.

use super::code::Code;
use super::data::{EventId, Law, Net, PlaceId};
use super::explore::{Graph, MARKINGS, marked, said};
use super::text::Text;

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
    /// It has more than [`MARKINGS`] markings; its laws are left to the checker.
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

/// Checks bounds, settling and the laws of a net. Ends the compilation with an explanation when one does not hold, or
/// when the net is too large and does not say that it is left to the checker.
#[must_use]
pub const fn check<const W: usize>(net: &Net<'_>, code: &Code<'_, W>, left_to_checker: bool) -> Known {
    if left_to_checker {
        return Known::LeftToChecker;
    }
    let graph = Graph::of(net, code);
    let check = Check { net, code, graph: &graph };
    if let Some((from, by)) = graph.overflow {
        check.exceeded(from as usize, by as usize);
    }
    if !graph.complete {
        Text::new().with("net ").name(net.name).with(" has more than ").number(MARKINGS as u64)
            .with(" markings, too many to explore while compiling: say `left_to_checker;` in its laws, and check it with the model checker")
            .stop();
    }
    let settle = check.settles();
    let mut at = 0;
    while at < net.laws.len() {
        check.law(&net.laws[at]);
        at += 1;
    }
    let firings = graph.from(graph.count - 1).1;
    Known::Explored { markings: graph.count, firings, settle }
}

struct Check<'c, const W: usize> {
    net: &'c Net<'c>,
    code: &'c Code<'c, W>,
    graph: &'c Graph<W>,
}

impl<const W: usize> Check<'_, W> {
    /// Begins the text of an error.
    const fn says(&self, law: &str) -> Text {
        Text::new().with("net ").name(self.net.name).with(": ").with(law)
    }

    const fn name(&self, place: PlaceId) -> &str {
        self.net.places[place.0 as usize].name
    }

    const fn tokens(&self, place: PlaceId, marking: usize) -> u32 {
        self.code.fields[place.0 as usize].of(&self.graph.markings[marking])
    }

    /// Ends the compilation: this is so in this marking.
    const fn refuted(&self, text: Text, marking: usize) -> ! {
        let text = self.graph.way(self.net, self.code, text.with("\n  "), marking);
        marked(self.net, self.code, text.with("\n  "), &self.graph.markings[marking]).stop()
    }

    const fn exceeded(&self, from: usize, by: usize) -> ! {
        let marking = &self.graph.markings[from];
        let entry = &self.code.entries[by];
        let after = self.code.after(marking, &entry.delta);
        let mut at = 0;
        let mut text = self.says("");
        while at < self.net.places.len() {
            let field = self.code.fields[at];
            // With the guard bit: what a field holds beyond its bound.
            let held = (after[field.word as usize] >> field.shift) & ((2 << field.width) - 1);
            let bound = self.net.places[at].bound as u64;
            if held > bound {
                text = text
                    .with("place ")
                    .name(self.net.places[at].name)
                    .with(" gets ")
                    .number(held)
                    .with(" tokens, and is declared for ")
                    .number(bound);
                break;
            }
            at += 1;
        }
        let text = self.graph.way(self.net, self.code, text.with("\n  "), from);
        let text = said(self.net, self.code, text.with(", then "), by);
        if self.graph.grows(from, &after, self.code) {
            text.with("\n  this can be repeated without end: the net is unbounded").stop()
        }
        text.with("\n  declare a larger bound, as `")
            .with(self.net.places[at].name)
            .with(": 0 of 2`, or let the transition wait for room")
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
                let text = self.says("law `never_both(").with(self.name(a)).with(", ").with(self.name(b));
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
            .with(")` does not hold: none of the ")
            .number(self.graph.count as u64)
            .with(" reachable markings has a token in ")
            .name(self.name(place))
            .stop()
    }

    const fn always_can(&self, place: PlaceId) {
        let mut can = [false; MARKINGS];
        let mut changed = true;
        while changed {
            changed = false;
            let mut marking = self.graph.count;
            while marking > 0 {
                marking -= 1;
                if !can[marking] && (self.tokens(place, marking) > 0 || self.leads_to(marking, &can)) {
                    can[marking] = true;
                    changed = true;
                }
            }
        }
        let mut marking = 0;
        while marking < self.graph.count {
            if !can[marking] {
                let text = self
                    .says("law `always_can(")
                    .with(self.name(place))
                    .with(")` does not hold: from here no firing sequence marks ");
                self.refuted(text.name(self.name(place)), marking);
            }
            marking += 1;
        }
    }

    const fn leads_to(&self, marking: usize, goal: &[bool; MARKINGS]) -> bool {
        let (mut at, end) = self.graph.from(marking);
        while at < end {
            if goal[self.graph.firing(at).0] {
                return true;
            }
            at += 1;
        }
        false
    }

    /// Whether a move is a transition that fires at once by itself.
    const fn immediate(&self, by: usize) -> bool {
        if by >= self.code.entries.len() {
            return false;
        }
        let transition = &self.net.transitions[self.code.entries[by].transition as usize];
        transition.on.is_none() && transition.within.is_none()
    }

    /// How many transitions that fire at once by themselves are enabled, and the first two.
    const fn urgent(&self, marking: usize) -> (usize, usize, usize) {
        let (mut count, mut first, mut second) = (0, 0, 0);
        let (mut at, end) = self.graph.from(marking);
        while at < end {
            let by = self.graph.firing(at).1;
            if self.immediate(by) {
                if count == 0 {
                    first = by;
                } else if count == 1 {
                    second = by;
                }
                count += 1;
            }
            at += 1;
        }
        (count, first, second)
    }

    /// Checks that transitions which fire at once by themselves come to an end; gives back after how many.
    const fn settles(&self) -> u32 {
        let mut depths = [0_u32; MARKINGS];
        let mut changed = true;
        while changed {
            changed = false;
            let mut marking = self.graph.count;
            while marking > 0 {
                marking -= 1;
                let (mut at, end) = self.graph.from(marking);
                while at < end {
                    let (to, by) = self.graph.firing(at);
                    if self.immediate(by) && depths[marking] <= depths[to] {
                        depths[marking] = depths[to] + 1;
                        changed = true;
                        if depths[marking] as usize > self.graph.count {
                            self.endless(marking);
                        }
                    }
                    at += 1;
                }
            }
        }
        let (mut most, mut marking) = (0, 0);
        while marking < self.graph.count {
            most = if depths[marking] > most { depths[marking] } else { most };
            marking += 1;
        }
        most
    }

    /// Ends the compilation: from here transitions fire by themselves for ever.
    const fn endless(&self, from: usize) -> ! {
        // Step until a marking comes back; then once round from there.
        let mut seen = [false; MARKINGS];
        let mut marking = from;
        while !seen[marking] {
            seen[marking] = true;
            marking = self.follow(marking, &[true; MARKINGS]).0;
        }
        let mut first = 0;
        while first < self.graph.count {
            if seen[first] && self.returns(first) {
                break;
            }
            first += 1;
        }
        let start = if first < self.graph.count { first } else { marking };
        let mut text =
            self.says("law `settles` does not hold: transitions without event and interval fire for ever");
        text = self.graph.way(self.net, self.code, text.with("\n  "), start).with("\n  for ever: ");
        let mut at = start;
        let mut steps = 0;
        loop {
            let (to, by) = self.follow(at, &seen);
            text = if steps > 0 { text.with(", ") } else { text };
            text = said(self.net, self.code, text, by);
            at = to;
            steps += 1;
            if at == start || steps > self.graph.count {
                break;
            }
        }
        text.stop()
    }

    /// Whether following the immediate transitions among the deepest leads back.
    const fn returns(&self, start: usize) -> bool {
        let mut at = start;
        let mut steps = 0;
        while steps <= self.graph.count {
            let (to, by) = self.follow(at, &[true; MARKINGS]);
            if by == usize::MAX {
                return false;
            }
            at = to;
            if at == start {
                return true;
            }
            steps += 1;
        }
        false
    }

    /// The first immediate firing from a marking that leads on.
    const fn follow(&self, marking: usize, among: &[bool; MARKINGS]) -> (usize, usize) {
        let (mut at, end) = self.graph.from(marking);
        while at < end {
            let (to, by) = self.graph.firing(at);
            if self.immediate(by) && among[to] && self.urgent(to).0 > 0 {
                return (to, by);
            }
            at += 1;
        }
        (marking, usize::MAX)
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
                    Some(end) => self.says("law `deadlock_free_except(").with(self.name(end)).with(")"),
                    None => self.says("law `deadlock_free"),
                };
                self.refuted(text.with("` does not hold: no transition is enabled"), marking);
            }
            marking += 1;
        }
    }

    const fn any_transition(&self, marking: usize) -> bool {
        let (mut at, end) = self.graph.from(marking);
        while at < end {
            if self.graph.firing(at).1 < self.code.entries.len() {
                return true;
            }
            at += 1;
        }
        false
    }

    const fn on(&self, by: usize) -> Option<EventId> {
        if by < self.code.entries.len() {
            self.net.transitions[self.code.entries[by].transition as usize].on
        } else {
            None
        }
    }

    const fn handles_all(&self) {
        let mut event = 0;
        while event < self.net.events.len() {
            let mut marking = 0;
            while marking < self.graph.count {
                if self.urgent(marking).0 == 0 && !self.handled(event, marking) {
                    let text = self
                        .says("law `handles(all)` does not hold: event ")
                        .name(self.net.events[event].name)
                        .with(" is neither used nor ignored on purpose");
                    let text = self.graph.way(self.net, self.code, text.with("\n  "), marking);
                    let text = marked(self.net, self.code, text.with("\n  "), &self.graph.markings[marking]);
                    text.with("\n  add a transition, or `ignore { ")
                        .with(self.net.events[event].name)
                        .with(" in ")
                        .with(self.first_marked(marking))
                        .with("; }`")
                        .stop();
                }
                marking += 1;
            }
            event += 1;
        }
    }

    const fn first_marked(&self, marking: usize) -> &str {
        let mut at = 0;
        while at < self.net.places.len() {
            if self.tokens(PlaceId(at as u32), marking) > 0 {
                return self.net.places[at].name;
            }
            at += 1;
        }
        "..."
    }

    const fn handled(&self, event: usize, marking: usize) -> bool {
        let (mut at, end) = self.graph.from(marking);
        while at < end {
            if let Some(on) = self.on(self.graph.firing(at).1)
                && on.0 as usize == event
            {
                return true;
            }
            at += 1;
        }
        let mut word = 0;
        while word < W {
            if self.code.ignored[event][word] & self.graph.markings[marking][word] != 0 {
                return true;
            }
            word += 1;
        }
        false
    }

    const fn deterministic(&self) {
        let mut marking = 0;
        while marking < self.graph.count {
            let (urgent, first, second) = self.urgent(marking);
            if urgent > 1 {
                self.conflict(marking, first, second, "by themselves");
            }
            let (begin, end) = self.graph.from(marking);
            let mut at = begin;
            while urgent == 0 && at < end {
                let by = self.graph.firing(at).1;
                let mut other = begin;
                while other < at {
                    let with = self.graph.firing(other).1;
                    if let (Some(a), Some(b)) = (self.on(by), self.on(with))
                        && a.0 == b.0
                    {
                        self.conflict(marking, with, by, self.net.events[a.0 as usize].name);
                    }
                    other += 1;
                }
                at += 1;
            }
            marking += 1;
        }
    }

    const fn conflict(&self, marking: usize, a: usize, b: usize, event: &str) -> ! {
        let a = self.net.transitions[self.code.entries[a].transition as usize].name;
        let b = self.net.transitions[self.code.entries[b].transition as usize].name;
        let text = self
            .says("law `deterministic` does not hold: ")
            .name(a)
            .with(" and ")
            .name(b)
            .with(" are enabled together, on ")
            .with(event);
        self.refuted(text, marking)
    }
}
