//! All states in which a system rests, and how it gets there.

use super::play::{Play, component, events};
use crate::net::data::EventId;
use crate::player::code::Code;
use crate::system::data::{Of, System};

/// The most states that are explored while compiling.
pub const STATES: usize = 1_024;
const SLOTS: usize = 4 * STATES;
/// No state, or a round instead of an event.
const NONE: u16 = u16::MAX;

/// A step of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// An event is offered from outside.
    Offered(Of<EventId>),
    /// Every net takes its turn.
    Round,
}

/// Why a system does not handle all events, or cannot be explored while compiling.
#[derive(Clone, Copy, Debug)]
pub struct Violation<const W: usize> {
    /// The cause of the violation.
    pub culprit: Culprit,
    /// The marking when the event was delivered.
    pub marking: [u64; W],
    steps: [Step; STATES],
    count: usize,
}

/// The cause of a violation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Culprit {
    /// In the last step of the path this event is neither used nor ignored on purpose.
    Unanswered(Of<EventId>),
    /// In the last step of the path transitions fire for ever without time passing.
    Forever,
    /// The system has intervals.
    Intervals,
    /// The system has more than [`STATES`] states.
    TooLarge,
}

impl<const W: usize> Violation<W> {
    const fn new(culprit: Culprit) -> Self {
        Self { culprit, marking: [0; W], steps: [Step::Round; STATES], count: 0 }
    }

    /// The steps from the start on; none when it is wrong while the system settles at the start.
    pub const fn steps(&self) -> &[Step] {
        self.steps.split_at(self.count).0
    }
}

/// States in which a system rests, in the order in which they are found: by the length of the
/// shortest path there.
struct States<const W: usize> {
    markings: [[u64; W]; STATES],
    /// From which state each was first reached, and by which event or round.
    parents: [(u16, u16); STATES],
    count: usize,
    slots: [u16; SLOTS],
}

impl<const W: usize> States<W> {
    /// Adds a state if it is new; whether there is room.
    const fn reach(&mut self, marking: &[u64; W], parent: (u16, u16)) -> bool {
        let mut hash = 0_u64;
        let mut word = 0;
        while word < W {
            hash = (hash ^ marking[word]).wrapping_mul(0x9E37_79B9_7F4A_7C15);
            hash ^= hash >> 29;
            word += 1;
        }
        let mut slot = hash as usize % SLOTS;
        while self.slots[slot] != NONE {
            let known = &self.markings[self.slots[slot] as usize];
            let mut word = 0;
            while word < W && known[word] == marking[word] {
                word += 1;
            }
            if word == W {
                return true;
            }
            slot = (slot + 1) % SLOTS;
        }
        if self.count == STATES {
            return false;
        }
        self.slots[slot] = self.count as u16;
        self.markings[self.count] = *marking;
        self.parents[self.count] = parent;
        self.count += 1;
        true
    }

    /// Returns the violation after a step from a state, if there is one.
    const fn wrong(
        &self,
        code: &Code<'_, W>,
        after: &Play<W>,
        (from, by): (u16, u16),
    ) -> Violation<W> {
        let mut violation = match after.forgotten {
            Some((event, marking)) => {
                let mut violation = Violation::new(Culprit::Unanswered(of(code, event)));
                violation.marking = marking;
                violation
            }
            None => Violation::new(Culprit::Forever),
        };
        let (mut state, mut by) = (from, by);
        while state != NONE {
            violation.steps[violation.count] =
                if by == NONE { Step::Round } else { Step::Offered(of(code, by)) };
            violation.count += 1;
            (state, by) = self.parents[state as usize];
        }
        let mut at = 0;
        while 2 * at + 1 < violation.count {
            violation.steps.swap(at, violation.count - 1 - at);
            at += 1;
        }
        violation
    }
}

/// See [`judge`](super::judge).
pub(super) const fn explore<const W: usize>(
    system: &System<'_>,
    code: &Code<'_, W>,
) -> Result<usize, Violation<W>> {
    if !code.clocks.is_empty() {
        return Err(Violation::new(Culprit::Intervals));
    }
    let mut states = States {
        markings: [[0; W]; STATES],
        parents: [(NONE, NONE); STATES],
        count: 0,
        slots: [NONE; SLOTS],
    };
    let start = Play::start(code);
    if start.is_wrong() {
        return Err(states.wrong(code, &start, (NONE, NONE)));
    }
    states.reach(&start.marking, (NONE, NONE));
    let mut from = 0;
    while from < states.count {
        let mut event = 0;
        while event <= events(code) {
            let is_round = event == events(code);
            if !is_round && system.delivery(of(code, event as u16)).is_some() {
                event += 1;
                continue;
            }
            let mut after = Play::at(states.markings[from]);
            let by = if is_round {
                after.round(code);
                NONE
            } else {
                after.offer(code, event as u16);
                event as u16
            };
            let way = (from as u16, by);
            if after.is_wrong() {
                return Err(states.wrong(code, &after, way));
            }
            if !states.reach(&after.marking, way) {
                return Err(Violation::new(Culprit::TooLarge));
            }
            event += 1;
        }
        from += 1;
    }
    Ok(states.count)
}

/// The event of a number.
const fn of<const W: usize>(code: &Code<'_, W>, number: u16) -> Of<EventId> {
    let component = component(code.events, number);
    let first = code.events[component as usize];
    Of { component, id: EventId((number - first) as u32) }
}
