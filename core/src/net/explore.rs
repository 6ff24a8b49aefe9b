//! Every reachable marking of a small net, while compiling.
//!
//! Explored is the net without time and priorities: from each marking every enabled transition. The
//! places that a net shares with others change as those others please. Breadth first, transitions
//! in their order, so the way to a marking is a shortest one.

use super::data::{Net, Role};
use super::text::Text;
use crate::player::code::Code;

/// The most markings that are explored while compiling.
pub const MARKINGS: usize = 1_024;
/// The most firings between them.
pub(super) const FIRINGS: usize = 16 * MARKINGS;
const SLOTS: usize = 4 * MARKINGS;
/// No marking, or no firing.
pub(super) const NONE: u16 = u16::MAX;

/// A way from one marking to another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Firing {
    pub(super) from: u16,
    pub(super) to: u16,
    /// The move: an entry, or beyond them a change of a shared place.
    pub(super) by: u16,
    /// The event, or [`AT_ONCE`], [`IN_TIME`] or [`SHARED`].
    pub(super) kind: u16,
}

/// The kind of transitions without event and interval.
pub(super) const AT_ONCE: u16 = u16::MAX;
/// The kind of transitions without event, in an interval.
pub(super) const IN_TIME: u16 = AT_ONCE - 1;
/// The kind of changes of shared places.
pub(super) const SHARED: u16 = AT_ONCE - 2;

/// The reachability graph of a small net.
///
/// An interpreter evaluates what makes it, and calls cost it most: the inner loops call nothing.
#[derive(Clone, Copy, Debug)]
pub struct Graph<const W: usize> {
    pub(super) markings: [[u64; W]; MARKINGS],
    pub(super) count: usize,
    /// How each marking was first reached: from which, and by which move.
    parents: [(u16, u16); MARKINGS],
    /// Where the firings of each marking begin.
    pub(super) starts: [u16; MARKINGS + 1],
    pub(super) firings: [Firing; FIRINGS],
    pub(super) fired: usize,
    /// The last firing to each marking; [`NONE`] when there is none.
    pub(super) arrivals: [u16; MARKINGS],
    /// The firing before each one to the same marking.
    pub(super) earlier: [u16; FIRINGS],
    slots: [u16; SLOTS],
    /// Whether all markings were explored.
    pub(super) complete: bool,
    /// A move that exceeds a bound: from which marking, which move.
    pub(super) overflow: Option<(u16, u16)>,
}

/// What can happen, in the order in which it is tried.
struct Moves {
    by: [u16; FIRINGS],
    kind: [u16; FIRINGS],
    count: usize,
}

impl Moves {
    /// The transitions in the order of the net, then for each shared place that it gains or loses a
    /// token.
    const fn of<const W: usize>(net: &Net<'_>, code: &Code<'_, W>) -> Self {
        let entries = code.entries.len();
        let mut moves = Self { by: [0; FIRINGS], kind: [SHARED; FIRINGS], count: entries };
        if entries + 2 * net.places.len() > FIRINGS {
            Text::new()
                .with("net ")
                .name(net.name)
                .with(" has more than ")
                .number(FIRINGS as u64)
                .with(" transitions and places, too many to explore while compiling: say `left_to_checker;` in its laws")
                .stop();
        }
        let mut at = 0;
        while at < entries {
            let number = code.entries[at].transition as usize;
            let transition = &net.transitions[number];
            moves.by[number] = at as u16;
            moves.kind[number] = match (transition.on, transition.within) {
                (Some(event), _) => event.0 as u16,
                (None, Some(_)) => IN_TIME,
                (None, None) => AT_ONCE,
            };
            at += 1;
        }
        let mut at = 0;
        while at < net.places.len() {
            if let Role::Complement(of) = net.places[at].role
                && matches!(net.places[of.0 as usize].role, Role::Shared)
            {
                moves.by[moves.count] = (entries + 2 * at) as u16;
                moves.by[moves.count + 1] = (entries + 2 * at + 1) as u16;
                moves.count += 2;
            }
            at += 1;
        }
        moves
    }
}

impl<const W: usize> Graph<W> {
    /// Explores a net.
    pub const fn of(net: &Net<'_>, code: &Code<'_, W>) -> Self {
        let mut graph = Self {
            markings: [[0; W]; MARKINGS],
            count: 0,
            parents: [(NONE, NONE); MARKINGS],
            starts: [0; MARKINGS + 1],
            firings: [Firing { from: 0, to: 0, by: 0, kind: 0 }; FIRINGS],
            fired: 0,
            arrivals: [NONE; MARKINGS],
            earlier: [NONE; FIRINGS],
            slots: [NONE; SLOTS],
            complete: true,
            overflow: None,
        };
        graph.reach(&code.initial, (NONE, NONE));
        let moves = Moves::of(net, code);
        let mut from = 0;
        while from < graph.count {
            let marking = graph.markings[from];
            let mut at = 0;
            while at < moves.count {
                let (by, kind) = (moves.by[at], moves.kind[at]);
                at += 1;
                let after = if kind == SHARED {
                    match changed(net, code, &marking, by as usize) {
                        Some(after) => after,
                        None => continue,
                    }
                } else {
                    // As `Code::holds` and `Code::after`: no field borrows from another, so nothing
                    // wraps.
                    let entry = &code.entries[by as usize];
                    let mut word = 0;
                    while word < W
                        && ((marking[word] | code.guards[word]) - entry.need[word])
                            & code.guards[word]
                            == code.guards[word]
                    {
                        word += 1;
                    }
                    if word < W {
                        continue;
                    }
                    let mut after = marking;
                    let mut fits = true;
                    word = 0;
                    while word < W {
                        after[word] = (marking[word] as u128 + entry.delta[word] as u128) as u64;
                        let guards = code.guards[word];
                        fits =
                            fits && ((code.bounds[word] | guards) - after[word]) & guards == guards;
                        word += 1;
                    }
                    if !fits {
                        if graph.overflow.is_none() {
                            graph.overflow = Some((from as u16, by));
                        }
                        continue;
                    }
                    after
                };
                match graph.reach(&after, (from as u16, by)) {
                    Some(to) if graph.fired < FIRINGS => {
                        graph.firings[graph.fired] = Firing { from: from as u16, to, by, kind };
                        graph.earlier[graph.fired] = graph.arrivals[to as usize];
                        graph.arrivals[to as usize] = graph.fired as u16;
                        graph.fired += 1;
                    }
                    _ => {
                        graph.complete = false;
                        return graph;
                    }
                }
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
            // Multiplied without a call: the product of two words fits.
            hash = ((hash ^ marking[word]) as u128 * 0x9E37_79B9_7F4A_7C15) as u64;
            hash ^= hash >> 29;
            word += 1;
        }
        let mut slot = hash as usize % SLOTS;
        while self.slots[slot] != NONE {
            let known = self.slots[slot];
            let mut word = 0;
            while word < W && self.markings[known as usize][word] == marking[word] {
                word += 1;
            }
            if word == W {
                return Some(known);
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

    /// Adds the shortest way to a marking to a text, as "a, b on Event, c".
    pub(super) const fn way(
        &self,
        net: &Net<'_>,
        code: &Code<'_, W>,
        text: Text,
        to: usize,
    ) -> Text {
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

    /// Whether a marking that is covered by this one, and has less in one place, led to it; then
    /// the same way can be gone again and again.
    pub(super) const fn grows(&self, last: usize, marking: &[u64; W], code: &Code<'_, W>) -> bool {
        let mut at = last;
        loop {
            let mut place = 0;
            while place < code.fields.len()
                && held(code, marking, place) >= held(code, &self.markings[at], place)
            {
                place += 1;
            }
            if place == code.fields.len() && !equal(marking, &self.markings[at]) {
                return true;
            }
            if self.parents[at].0 == NONE {
                return false;
            }
            at = self.parents[at].0 as usize;
        }
    }
}

/// What a field holds, beyond its bound if need be: its guard bit counts.
pub(super) const fn held<const W: usize>(
    code: &Code<'_, W>,
    marking: &[u64; W],
    place: usize,
) -> u64 {
    let field = code.fields[place];
    (marking[field.word as usize] >> field.shift) & ((2 << field.width) - 1)
}

/// Adds what a move is called to a text.
pub(super) const fn said<const W: usize>(
    net: &Net<'_>,
    code: &Code<'_, W>,
    text: Text,
    by: usize,
) -> Text {
    if by < code.entries.len() {
        let transition = &net.transitions[code.entries[by].transition as usize];
        return match transition.on {
            Some(event) => {
                text.with(transition.name).with(" on ").with(net.events[event.0 as usize].name)
            }
            None => text.with(transition.name),
        };
    }
    let (complement, gains) = shared(code.entries.len(), by);
    let name = match net.places[complement].role {
        Role::Complement(of) => net.places[of.0 as usize].name,
        _ => "",
    };
    text.with(if gains { "(another net raises " } else { "(another net lowers " })
        .with(name)
        .with(")")
}

/// The complement of a shared place that a move changes, and whether the place gains a token.
const fn shared(entries: usize, by: usize) -> (usize, bool) {
    ((by - entries) / 2, (by - entries).is_multiple_of(2))
}

/// The marking after a change of a shared place, if it can change so.
const fn changed<const W: usize>(
    net: &Net<'_>,
    code: &Code<'_, W>,
    marking: &[u64; W],
    by: usize,
) -> Option<[u64; W]> {
    let (complement, gains) = shared(code.entries.len(), by);
    let Role::Complement(of) = net.places[complement].role else { return None };
    let (from, to) = if gains { (complement, of.0 as usize) } else { (of.0 as usize, complement) };
    let (from, to) = (code.fields[from], code.fields[to]);
    if from.of(marking) == 0 {
        return None;
    }
    let mut after = *marking;
    after[from.word as usize] -= from.tokens(1);
    after[to.word as usize] += to.tokens(1);
    Some(after)
}

const fn equal<const W: usize>(a: &[u64; W], b: &[u64; W]) -> bool {
    let mut word = 0;
    while word < W {
        if a[word] != b[word] {
            return false;
        }
        word += 1;
    }
    true
}

/// Adds the marked places to a text, as "marked: `a`, 2 `b`; false or 0: `c`".
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
    let mut text = if first { text.with("nothing") } else { text };
    let mut first = true;
    let mut at = 0;
    while at < net.places.len() {
        if code.fields[at].of(marking) == 0
            && matches!(net.places[at].role, Role::Data | Role::Shared)
        {
            text = text.with(if first { "; false or 0: " } else { ", " }).name(net.places[at].name);
            first = false;
        }
        at += 1;
    }
    text
}
