//! Every reachable marking of a small net, while compiling.
//!
//! Explored is the net without time and priorities: from each marking every enabled transition. The places that a net
//! shares with others change as those others please. Breadth first, transitions in their order, so the way to a
//! marking is a shortest one.

use super::code::Code;
use super::data::{Net, Role};
use super::text::Text;

/// The most markings that are explored while compiling.
pub const MARKINGS: usize = 1_024;
/// The most firings between them.
pub(super) const FIRINGS: usize = 16 * MARKINGS;
const SLOTS: usize = 4 * MARKINGS;
const NONE: u16 = u16::MAX;

/// The reachability graph of a small net.
#[derive(Clone, Copy, Debug)]
pub struct Graph<const W: usize> {
    pub(super) markings: [[u64; W]; MARKINGS],
    pub(super) count: usize,
    /// How each marking was first reached: from which, and by which move.
    parents: [(u16, u16); MARKINGS],
    /// Where the firings of each marking begin.
    starts: [u16; MARKINGS + 1],
    firings: [(u16, u16); FIRINGS],
    fired: usize,
    slots: [u16; SLOTS],
    /// Whether all markings were explored.
    pub(super) complete: bool,
    /// A move that exceeds a bound: from which marking, which move.
    pub(super) overflow: Option<(u16, u16)>,
}

/// What can happen in a marking: a transition, by its entry, or a change of a shared place.
///
/// Moves beyond the entries stand for pairs of a complement and whether its place gains or loses a token.
pub(super) const fn moves<const W: usize>(net: &Net<'_>, code: &Code<'_, W>) -> usize {
    code.entries.len() + 2 * net.places.len()
}

impl<const W: usize> Graph<W> {
    /// Explores a net.
    pub const fn of(net: &Net<'_>, code: &Code<'_, W>) -> Self {
        let mut graph = Self {
            markings: [[0; W]; MARKINGS],
            count: 0,
            parents: [(NONE, NONE); MARKINGS],
            starts: [0; MARKINGS + 1],
            firings: [(0, 0); FIRINGS],
            fired: 0,
            slots: [NONE; SLOTS],
            complete: true,
            overflow: None,
        };
        graph.reach(&code.initial, (NONE, NONE));
        // Entries are grouped by event and state; traces and firings follow the order of the net.
        let mut order = [0_u16; FIRINGS];
        let mut at = 0;
        while at < code.entries.len() && at < FIRINGS {
            order[code.entries[at].transition as usize] = at as u16;
            at += 1;
        }
        let all = moves(net, code);
        let mut from = 0;
        while from < graph.count {
            graph.starts[from] = graph.fired as u16;
            let mut at = 0;
            while at < all {
                let by = if at < code.entries.len() { order[at] as usize } else { at };
                match step(net, code, &graph.markings[from], by) {
                    Step::Disabled => {}
                    Step::Exceeds => {
                        if graph.overflow.is_none() {
                            graph.overflow = Some((from as u16, by as u16));
                        }
                    }
                    Step::To(marking) => match graph.reach(&marking, (from as u16, by as u16)) {
                        Some(to) if graph.fired < FIRINGS => {
                            graph.firings[graph.fired] = (to, by as u16);
                            graph.fired += 1;
                        }
                        _ => {
                            graph.complete = false;
                            return graph;
                        }
                    },
                }
                at += 1;
            }
            if graph.overflow.is_some() {
                return graph;
            }
            from += 1;
            graph.starts[from] = graph.fired as u16;
        }
        graph
    }

    /// The number of a marking; `None` when it is new and there is no room for it.
    const fn reach(&mut self, marking: &[u64; W], parent: (u16, u16)) -> Option<u16> {
        let mut hash = 0_u64;
        let mut word = 0;
        while word < W {
            hash = (hash ^ marking[word]).wrapping_mul(0x9E37_79B9_7F4A_7C15);
            hash ^= hash >> 29;
            word += 1;
        }
        let mut slot = hash as usize % SLOTS;
        while self.slots[slot] != NONE {
            if equal(&self.markings[self.slots[slot] as usize], marking) {
                return Some(self.slots[slot]);
            }
            slot = (slot + 1) % SLOTS;
        }
        if self.count == MARKINGS {
            return None;
        }
        let number = self.count as u16;
        self.slots[slot] = number;
        self.markings[self.count] = *marking;
        self.parents[self.count] = parent;
        self.count += 1;
        Some(number)
    }

    /// The firings from a marking: their positions in `firing`.
    pub(super) const fn from(&self, marking: usize) -> (usize, usize) {
        (self.starts[marking] as usize, self.starts[marking + 1] as usize)
    }

    /// Where a firing leads, and its move.
    pub(super) const fn firing(&self, at: usize) -> (usize, usize) {
        (self.firings[at].0 as usize, self.firings[at].1 as usize)
    }

    /// Adds the shortest way to a marking to a text, as "a, b on Event, c".
    pub(super) const fn way(&self, net: &Net<'_>, code: &Code<'_, W>, text: Text, to: usize) -> Text {
        let mut path = [0_u16; MARKINGS];
        let mut length = 0;
        let mut at = to;
        while self.parents[at].0 != NONE {
            path[length] = self.parents[at].1;
            at = self.parents[at].0 as usize;
            length += 1;
        }
        if length == 0 {
            return text.with("at the start");
        }
        let mut text = text.with("after: ");
        // A very long way is told by its beginning and its end.
        let total = length;
        while length > 0 {
            length -= 1;
            if total > 24 && length == total - 13 {
                text = text.with("... (").number((total - 24) as u64).with(" more), ");
                length = 11;
            }
            text = said(net, code, text, path[length] as usize);
            if length > 0 {
                text = text.with(", ");
            }
        }
        text
    }

    /// Whether a marking that covers this one and has more in one place was reached from it; then the same way can be
    /// gone again and again.
    pub(super) const fn grows(&self, last: usize, marking: &[u64; W], code: &Code<'_, W>) -> bool {
        let mut at = last;
        loop {
            if code.holds(marking, &self.markings[at]) && !equal(marking, &self.markings[at]) {
                return true;
            }
            if self.parents[at].0 == NONE {
                return false;
            }
            at = self.parents[at].0 as usize;
        }
    }
}

/// Adds what a move is called to a text.
pub(super) const fn said<const W: usize>(net: &Net<'_>, code: &Code<'_, W>, text: Text, by: usize) -> Text {
    if by < code.entries.len() {
        let transition = &net.transitions[code.entries[by].transition as usize];
        return match transition.on {
            Some(event) => text.with(transition.name).with(" on ").with(net.events[event.0 as usize].name),
            None => text.with(transition.name),
        };
    }
    let (complement, gains) = shared(code.entries.len(), by);
    let name = match net.places[complement].role {
        Role::Complement(of) => net.places[of.0 as usize].name,
        _ => "",
    };
    text.with("(").with(name).with(if gains { " comes true)" } else { " becomes false)" })
}

/// The complement of a shared place that a move changes, and whether the place gains a token.
const fn shared(entries: usize, by: usize) -> (usize, bool) {
    ((by - entries) / 2, (by - entries).is_multiple_of(2))
}

/// What a move does.
pub(super) enum Step<const W: usize> {
    /// Nothing.
    Disabled,
    /// It would exceed a bound.
    Exceeds,
    /// It leads to this marking.
    To([u64; W]),
}

pub(super) const fn step<const W: usize>(
    net: &Net<'_>,
    code: &Code<'_, W>,
    marking: &[u64; W],
    by: usize,
) -> Step<W> {
    if by < code.entries.len() {
        let entry = &code.entries[by];
        if !code.holds(marking, &entry.need) {
            return Step::Disabled;
        }
        let after = code.after(marking, &entry.delta);
        return if code.holds(&code.bounds, &after) { Step::To(after) } else { Step::Exceeds };
    }
    let (complement, gains) = shared(code.entries.len(), by);
    let Role::Complement(of) = net.places[complement].role else { return Step::Disabled };
    if !matches!(net.places[of.0 as usize].role, Role::Shared) {
        return Step::Disabled;
    }
    let (from, to) = if gains { (complement, of.0 as usize) } else { (of.0 as usize, complement) };
    let (from, to) = (code.fields[from], code.fields[to]);
    if from.of(marking) == 0 {
        return Step::Disabled;
    }
    let mut after = *marking;
    after[from.word as usize] -= from.tokens(1);
    after[to.word as usize] += to.tokens(1);
    Step::To(after)
}

pub(super) const fn equal<const W: usize>(a: &[u64; W], b: &[u64; W]) -> bool {
    let mut word = 0;
    while word < W {
        if a[word] != b[word] {
            return false;
        }
        word += 1;
    }
    true
}

/// Adds the marked places to a text, as "`a`, 2 `b`".
pub(super) const fn marked<const W: usize>(
    net: &Net<'_>,
    code: &Code<'_, W>,
    text: Text,
    marking: &[u64; W],
) -> Text {
    let mut text = text.with("marked: ");
    let mut first = true;
    let mut at = 0;
    while at < net.places.len() {
        let tokens = code.fields[at].of(marking);
        if tokens > 0 && !matches!(net.places[at].role, Role::Complement(_)) {
            text = if first { text } else { text.with(", ") };
            text = if tokens == 1 { text } else { text.number(tokens as u64).with(" ") };
            text = text.name(net.places[at].name);
            first = false;
        }
        at += 1;
    }
    if first { text.with("nothing") } else { text }
}
