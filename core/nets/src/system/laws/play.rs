//! The [`Player`](crate::player::Player) of a system without intervals, once more in a form that
//! can be evaluated at compile time.

use crate::player::SETTLE;
use crate::player::code::{Code, Mailbox, NONE, Route, plus};
use crate::system::data::DEPTH;

/// A state of a system, and what happened on the path to it.
#[derive(Clone, Copy)]
pub(super) struct Play<const W: usize> {
    pub(super) marking: [u64; W],
    /// The first event that was neither used nor ignored on purpose, and the marking then.
    pub(super) forgotten: Option<(u16, [u64; W])>,
    /// Whether more than [`SETTLE`] transitions fired at once by themselves.
    pub(super) endless: bool,
}

/// The next step of a cascade.
#[derive(Clone, Copy)]
enum Next {
    /// This event is delivered.
    On(u16),
    /// The transition at this position fires by itself.
    With(u16),
    Nothing,
}

impl<const W: usize> Play<W> {
    /// The start, settled.
    pub(super) const fn start(code: &Code<'_, W>) -> Self {
        let mut play = Self { marking: code.initial, forgotten: None, endless: false };
        play.rest(code);
        play
    }

    /// Nothing has happened yet in this state.
    pub(super) const fn at(marking: [u64; W]) -> Self {
        Self { marking, forgotten: None, endless: false }
    }

    /// Whether an event was forgotten, or the system does not settle.
    pub(super) const fn is_wrong(&self) -> bool {
        self.forgotten.is_some() || self.endless
    }

    /// An event is offered from outside, and all nets settle.
    pub(super) const fn offer(&mut self, code: &Code<'_, W>, event: u16) {
        self.whole(code, Next::On(event));
        self.rest(code);
    }

    /// Every net takes its turn, and all nets settle.
    pub(super) const fn round(&mut self, code: &Code<'_, W>) {
        let mut component = 0;
        while component + 1 < code.turns.len() {
            self.turn(code, component);
            component += 1;
        }
        self.rest(code);
    }

    const fn turn(&mut self, code: &Code<'_, W>, component: usize) {
        let row = events(code) + component;
        self.settle(code, row, row + 1);
        let mut at = code.turns[component] as usize;
        while at < code.turns[component + 1] as usize {
            let mailbox = &code.mailboxes[at];
            let mut left = mailbox.waiting.of(&self.marking);
            // An event read before may have emptied it.
            while left > 0 && mailbox.waiting.of(&self.marking) > 0 {
                let before = *self;
                self.count(mailbox, false);
                left -= 1;
                if self.whole(code, Next::On(mailbox.event)).is_none() {
                    *self = before;
                    left = 0;
                }
            }
            at += 1;
        }
    }

    /// Lets all nets settle.
    const fn rest(&mut self, code: &Code<'_, W>) {
        let first = events(code);
        self.settle(code, first, first + code.turns.len() - 1);
    }

    /// Lets transitions of these kinds fire until none is enabled that is not waiting for room.
    const fn settle(&mut self, code: &Code<'_, W>, kind: usize, last: usize) {
        let (first, end) = (begins(code, kind), begins(code, last));
        let (mut from, mut fired) = (first, 0);
        while let Some(at) = self.enabled(code, from, end) {
            if fired >= SETTLE {
                self.endless = true;
                return;
            }
            match self.whole(code, Next::With(at)) {
                Some(more) => (from, fired) = (first, fired + more),
                None => from = at + 1,
            }
        }
    }

    /// Does this, with all that follows from it; how many transitions fired, or `None` when a
    /// mailbox on the way is full and nothing has happened.
    const fn whole(&mut self, code: &Code<'_, W>, mut next: Next) -> Option<u32> {
        let before = *self;
        // For each net under way: its number, and the routes of its outputs that are left.
        let mut said = [(0_u16, 0_u16, 0_u16); DEPTH + 1];
        let (mut depth, mut fired, mut settled) = (0, 0, 0);
        loop {
            let fires = match next {
                Next::On(event) => self.answer(code, event),
                Next::With(at) => Some(at),
                Next::Nothing => None,
            };
            if let Some(at) = fires {
                let entry = &code.entries[at as usize];
                self.marking = plus(&self.marking, &code.deltas[entry.delta as usize]);
                fired += 1;
                let number = entry.transition as usize;
                let (first, end) = if code.says.is_empty() {
                    (0, 0)
                } else {
                    (code.says[number], code.says[number + 1])
                };
                said[depth] = (component(code.transitions, entry.transition), first, end);
                depth += 1;
            }
            if depth == 0 {
                return Some(fired);
            }
            let (component, route, end) = said[depth - 1];
            next = Next::Nothing;
            if route < end {
                said[depth - 1].1 += 1;
                let Route { event, mailbox } = code.routes[route as usize];
                if mailbox == NONE {
                    next = Next::On(event);
                } else {
                    let mailbox = &code.mailboxes[mailbox as usize];
                    if mailbox.waiting.of(&self.marking) >= mailbox.capacity as u32 {
                        *self = before;
                        return None;
                    }
                    self.count(mailbox, true);
                }
                continue;
            }
            // All that the net said has arrived: it settles.
            depth -= 1;
            let row = events(code) + component as usize;
            if let Some(at) = self.enabled(code, begins(code, row), begins(code, row + 1)) {
                if settled < SETTLE {
                    settled += 1;
                    next = Next::With(at);
                } else {
                    self.endless = true;
                }
            }
        }
    }

    /// An event is delivered: the position of the transition that fires on it.
    const fn answer(&mut self, code: &Code<'_, W>, event: u16) -> Option<u16> {
        let mut at = 0;
        while at < code.clears.len() {
            let (on, mailbox) = code.clears[at];
            let mailbox = &code.mailboxes[mailbox as usize];
            while on == event && mailbox.waiting.of(&self.marking) > 0 {
                self.count(mailbox, false);
            }
            at += 1;
        }
        let row = event as usize;
        let fires = self.enabled(code, begins(code, row), begins(code, row + 1));
        if fires.is_none() && self.forgotten.is_none() && !self.ignores(code, event) {
            self.forgotten = Some((event, self.marking));
        }
        fires
    }

    /// Whether some place that ignores this event on purpose is marked, and the guard holds.
    const fn ignores(&self, code: &Code<'_, W>, event: u16) -> bool {
        let mut at = 0;
        while at < code.ignored.len() {
            let (ignored, place) = code.ignored[at];
            if ignored == event && code.fields[place as usize].of(&self.marking) > 0 {
                return true;
            }
            at += 1;
        }
        let mut at = 0;
        while at < code.ignored_where.len() {
            let (ignored, need) = &code.ignored_where[at];
            if *ignored == event && code.holds(&self.marking, need) {
                return true;
            }
            at += 1;
        }
        false
    }

    /// Moves one between what waits in a mailbox and the room in it.
    const fn count(&mut self, mailbox: &Mailbox, more: bool) {
        let waiting = Some(mailbox.waiting);
        let (from, to) = if more { (mailbox.room, waiting) } else { (waiting, mailbox.room) };
        if let Some(from) = from {
            self.marking[from.word as usize] -= from.tokens(1);
        }
        if let Some(to) = to {
            self.marking[to.word as usize] += to.tokens(1);
        }
    }

    /// The position of the first transition from one position on, up to another one, that can fire.
    const fn enabled(&self, code: &Code<'_, W>, first: u16, end: u16) -> Option<u16> {
        let mut at = first;
        while at < end {
            let entry = &code.entries[at as usize];
            let need = &code.needs[entry.need as usize];
            // As `Code::holds`, without its calls: no field borrows from another.
            let mut word = 0;
            while word < W
                && ((self.marking[word] | code.guards[word]) - need[word]) & code.guards[word]
                    == code.guards[word]
            {
                word += 1;
            }
            if word == W
                && code
                    .holds(&code.bounds, &plus(&self.marking, &code.deltas[entry.delta as usize]))
            {
                return Some(at);
            }
            at += 1;
        }
        None
    }
}

/// How many events there are over all nets; the kinds beyond them fire at once by themselves.
pub(super) const fn events<const W: usize>(code: &Code<'_, W>) -> usize {
    code.events[code.events.len() - 1] as usize
}

/// Returns the start of the transitions of a kind: the end of the last row of the kind before.
const fn begins<const W: usize>(code: &Code<'_, W>, kind: usize) -> u16 {
    if kind == 0 { 0 } else { code.rows[2 * code.states as usize * kind - 1] }
}

/// Returns the owner of a number, given the first numbers of all components.
pub(super) const fn component(firsts: &[u16], number: u16) -> u16 {
    let mut at = 0;
    while at + 2 < firsts.len() && firsts[at + 1] <= number {
        at += 1;
    }
    at as u16
}
