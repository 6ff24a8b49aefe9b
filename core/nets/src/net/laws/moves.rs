//! The moves of a net.

use crate::net::data::{Net, PlaceId, Role, Transition, TransitionId};
use crate::player::code::Code;

/// The most moves of a net, and the most edges between its classes.
pub(super) const FIRINGS: usize = 16 * 1_024;

/// The kind of transitions without event and interval.
pub(super) const AT_ONCE: u16 = u16::MAX;
/// The kind of transitions without event, in an interval.
pub(super) const IN_TIME: u16 = AT_ONCE - 1;
/// The kind of changes of shared places.
pub(super) const SHARED: u16 = AT_ONCE - 2;
/// Time passes.
pub(super) const TIME: u16 = AT_ONCE - 3;

/// All moves of a net in the order in which they are tried: transitions that fire at once by
/// themselves, transitions on events, changes of shared places.
pub(super) struct Moves {
    pub(super) by: [u16; FIRINGS],
    pub(super) kind: [u16; FIRINGS],
    pub(super) count: usize,
    /// How many fire at once by themselves.
    pub(super) at_once: usize,
}

impl Moves {
    /// Transitions by priority, then in the order of the net, then for each shared place that it
    /// gains or loses a token. `None` when there are too many.
    pub(super) const fn of<const W: usize>(net: &Net<'_>, code: &Code<'_, W>) -> Option<Self> {
        let entries = code.entries.len();
        if entries + 2 * net.places.len() > FIRINGS || net.events.len() > FIRINGS {
            return None;
        }
        let mut moves = Self { by: [0; FIRINGS], kind: [SHARED; FIRINGS], count: 0, at_once: 0 };
        // The position of each transition among the entries, and then by priority.
        let mut order = [0_u16; FIRINGS];
        let mut at = 0;
        while at < entries {
            order[code.entries[at].transition as usize] = at as u16;
            at += 1;
        }
        sort(net, code, &mut order);
        at = 0;
        while at < entries {
            let it = transition(net, code, order[at]);
            if it.on.is_none() && it.within.is_none() {
                moves.add(order[at] as usize, AT_ONCE);
            }
            at += 1;
        }
        moves.at_once = moves.count;
        at = 0;
        while at < entries {
            if let Some(event) = transition(net, code, order[at]).on {
                moves.add(order[at] as usize, event.0 as u16);
            }
            at += 1;
        }
        at = 0;
        while at < net.places.len() {
            if let Role::Complement(of) = net.places[at].role
                && matches!(net.places[of.0 as usize].role, Role::Shared)
            {
                moves.add(entries + 2 * at, SHARED);
                moves.add(entries + 2 * at + 1, SHARED);
            }
            at += 1;
        }
        Some(moves)
    }

    const fn add(&mut self, by: usize, kind: u16) {
        self.by[self.count] = by as u16;
        self.kind[self.count] = kind;
        self.count += 1;
    }

    /// Whether no transition without event and interval is enabled.
    pub(super) const fn rests<const W: usize>(
        &self,
        code: &Code<'_, W>,
        marking: &[u64; W],
    ) -> bool {
        let mut at = 0;
        while at < self.at_once {
            let need = code.entries[self.by[at] as usize].need;
            if code.holds(marking, &code.needs[need as usize]) {
                return false;
            }
            at += 1;
        }
        true
    }
}

/// The transition of an entry.
pub(super) const fn id<const W: usize>(code: &Code<'_, W>, entry: u16) -> TransitionId {
    TransitionId(code.entries[entry as usize].transition as u32)
}

const fn transition<'n, const W: usize>(
    net: &Net<'n>,
    code: &Code<'_, W>,
    entry: u16,
) -> &'n Transition<'n> {
    &net.transitions[code.entries[entry as usize].transition as usize]
}

/// Sorts entries by priority and leaves those of one priority in their order.
const fn sort<const W: usize>(net: &Net<'_>, code: &Code<'_, W>, order: &mut [u16; FIRINGS]) {
    let mut at = 1;
    while at < code.entries.len() {
        let (this, mut place) = (order[at], at);
        let priority = transition(net, code, this).priority;
        while place > 0 && transition(net, code, order[place - 1]).priority < priority {
            order[place] = order[place - 1];
            place -= 1;
        }
        order[place] = this;
        at += 1;
    }
}

/// The shared place that a move changes, its complement, and whether the place gains a token.
pub(super) const fn shared(net: &Net<'_>, entries: usize, by: usize) -> (PlaceId, usize, bool) {
    let (complement, gains) = ((by - entries) / 2, (by - entries).is_multiple_of(2));
    match net.places[complement].role {
        Role::Complement(of) => (of, complement, gains),
        _ => (PlaceId(complement as u32), complement, gains),
    }
}

/// The marking after a change of a shared place, if it can change so.
pub(super) const fn changed<const W: usize>(
    net: &Net<'_>,
    code: &Code<'_, W>,
    marking: &[u64; W],
    by: usize,
) -> Option<[u64; W]> {
    let (place, complement, gains) = shared(net, code.entries.len(), by);
    let place = place.0 as usize;
    let (from, to) = if gains { (complement, place) } else { (place, complement) };
    let (from, to) = (code.fields[from], code.fields[to]);
    if from.of(marking) == 0 {
        return None;
    }
    let mut after = *marking;
    after[from.word as usize] -= from.tokens(1);
    after[to.word as usize] += to.tokens(1);
    Some(after)
}
