//! Whether a law holds in all classes, and where it does not.

use super::graph::{Graph, Limit, NONE};
use super::moves::{AT_ONCE, IN_TIME, SHARED, id};
use super::way::Way;
use crate::net::data::{EventId, Law, Net, PlaceId, TransitionId};
use crate::player::code::Code;

/// A claim about a net that does not hold, or cannot be checked while compiling.
#[derive(Clone, Copy, Debug)]
pub struct Violation<'n, const W: usize> {
    /// The law; `None` for what is always checked: bounds, settling and size.
    pub law: Option<Law<'n>>,
    /// The cause of the violation.
    pub culprit: Culprit,
    /// How to get there, with the shortest waits; empty where no place is the culprit's.
    pub way: Way,
    /// The marking there.
    pub marking: [u64; W],
}

/// The cause of a violation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Culprit {
    /// The net is too large to be explored.
    TooLarge(Limit),
    /// A place would get more tokens than it is declared for.
    Bound {
        /// The place.
        place: PlaceId,
        /// Tokens that the place would get.
        tokens: u64,
        /// By this transition, the last step of the path.
        transition: TransitionId,
        /// Whether the same can happen again and again.
        grows: bool,
    },
    /// Transitions fire by themselves for ever without time passing.
    Forever {
        /// How many steps at the end of the path are repeated.
        repeats: usize,
    },
    /// The weighted sum of an invariant is another one.
    Sum(u64),
    /// Both places are marked.
    Both,
    /// No run, or no run from there, marks the place.
    Never {
        /// So many markings were explored.
        markings: usize,
    },
    /// No transition fires there any more.
    Stuck {
        /// A transition that has its tokens, and its interval is over.
        closed: Option<TransitionId>,
    },
    /// An event is neither used nor ignored on purpose there.
    Unanswered {
        /// The event.
        event: EventId,
        /// A transition on it that has its tokens, and its interval is not open.
        closed: Option<TransitionId>,
    },
    /// Priorities or the order of lines decide between two transitions.
    Together {
        /// The one that fires.
        first: TransitionId,
        /// The one that does not, or not first.
        second: TransitionId,
    },
}

impl<'n, const W: usize> Violation<'n, W> {
    pub(super) const fn too_large(limit: Limit, law: Option<Law<'n>>) -> Self {
        Self { law, culprit: Culprit::TooLarge(limit), way: Way::NONE, marking: [0; W] }
    }
}

impl<const W: usize> Graph<W> {
    /// Whether a net breaks a law, and where, nearest to the start. It is the net that was
    /// explored, and it [settles](Self::settles).
    pub const fn breaks<'n>(
        &self,
        net: &Net<'n>,
        code: &Code<'_, W>,
        law: &Law<'n>,
    ) -> Option<Violation<'n, W>> {
        let found = match *law {
            Law::Invariant { sum, equals } => self.other_sum(code, sum, equals),
            Law::NeverBoth(a, b) => self.both(code, a, b),
            Law::Reachable(place) => {
                if self.marks(code, place) {
                    None
                } else {
                    let culprit = Culprit::Never { markings: self.sizes().0 };
                    let (law, marking) = (Some(*law), [0; W]);
                    return Some(Violation { law, culprit, way: Way::NONE, marking });
                }
            }
            Law::AlwaysCan(place) => return self.cannot(net, code, law, place),
            Law::HandlesAll => self.unanswered(net, code),
            Law::Settles => None,
            Law::DeadlockFree { end } => self.stuck(code, end),
            Law::Deterministic => self.together(code),
        };
        match found {
            Some((class, culprit)) => Some(self.violation(net, code, law, class, culprit)),
            None => None,
        }
    }

    pub(super) const fn violation<'n>(
        &self,
        net: &Net<'n>,
        code: &Code<'_, W>,
        law: &Law<'n>,
        class: usize,
        culprit: Culprit,
    ) -> Violation<'n, W> {
        let way = self.way(net, code, class);
        Violation { law: Some(*law), culprit, way, marking: self.markings[class] }
    }

    pub(super) const fn tokens(&self, code: &Code<'_, W>, place: PlaceId, class: usize) -> u32 {
        let field = &code.fields[place.0 as usize];
        (self.markings[class][field.word as usize] >> field.shift) as u32 & ((1 << field.width) - 1)
    }

    const fn other_sum(
        &self,
        code: &Code<'_, W>,
        sum: &[crate::net::Arc],
        equals: u32,
    ) -> Option<(usize, Culprit)> {
        let mut class = 0;
        while class < self.count {
            let mut total = 0_u64;
            let mut at = 0;
            while at < sum.len() {
                total += sum[at].weight as u64 * self.tokens(code, sum[at].place, class) as u64;
                at += 1;
            }
            if total != equals as u64 {
                return Some((class, Culprit::Sum(total)));
            }
            class += 1;
        }
        None
    }

    const fn both(&self, code: &Code<'_, W>, a: PlaceId, b: PlaceId) -> Option<(usize, Culprit)> {
        let mut class = 0;
        while class < self.count {
            if self.tokens(code, a, class) > 0 && self.tokens(code, b, class) > 0 {
                return Some((class, Culprit::Both));
            }
            class += 1;
        }
        None
    }

    const fn marks(&self, code: &Code<'_, W>, place: PlaceId) -> bool {
        let mut class = 0;
        while class < self.count {
            if self.tokens(code, place, class) > 0 {
                return true;
            }
            class += 1;
        }
        false
    }

    /// Returns a deadlock: no transition fires any more as long as the shared places stay as they
    /// are, no event makes one fire, and no clock runs towards an interval.
    const fn stuck(&self, code: &Code<'_, W>, end: Option<PlaceId>) -> Option<(usize, Culprit)> {
        let mut class = 0;
        while class < self.count {
            let meant = match end {
                Some(end) => self.tokens(code, end, class) > 0,
                None => false,
            };
            // Events come first, and time last.
            let (first, last) = (self.starts[class] as usize, self.starts[class + 1] as usize);
            let none = first == last
                || self.firings[first].kind == SHARED && self.firings[last - 1].kind == SHARED;
            if !meant && none {
                return Some((class, Culprit::Stuck { closed: self.closed(code, class, NONE) }));
            }
            class += 1;
        }
        None
    }

    /// The first transition on an event, or on any with [`NONE`], that has its tokens in a class
    /// and whose interval is not open.
    const fn closed(&self, code: &Code<'_, W>, class: usize, event: u16) -> Option<TransitionId> {
        if code.clocks.is_empty() {
            return None;
        }
        let zone = self.zone(class);
        let mut at = 0;
        while at < zone.count {
            let clock = &code.clocks[zone.clocks[at] as usize];
            if clock.event
                && (event == NONE || is_on(code, clock.entry, event))
                && !zone.opens(code, zone.clocks[at])
            {
                return Some(id(code, clock.entry));
            }
            at += 1;
        }
        None
    }

    const fn unanswered(&self, net: &Net<'_>, code: &Code<'_, W>) -> Option<(usize, Culprit)> {
        // The first event that is forgotten, in the class nearest to the start.
        let events = net.events.len();
        let (mut event, mut found) = (events, 0);
        let mut class = 0;
        while class < self.count {
            let first = self.forgotten(net, code, class, event);
            if first < event {
                (event, found) = (first, class);
            }
            class += 1;
        }
        if event == events {
            return None;
        }
        let closed = self.closed(code, found, event as u16);
        Some((found, Culprit::Unanswered { event: EventId(event as u32), closed }))
    }

    /// The first event before `most` that nothing answers in a class that rests; `most` if there is
    /// none.
    const fn forgotten(
        &self,
        net: &Net<'_>,
        code: &Code<'_, W>,
        class: usize,
        most: usize,
    ) -> usize {
        let (start, end) = (self.starts[class] as usize, self.starts[class + 1] as usize);
        let mut first = 0;
        while first < most {
            // 64 events at a time.
            let mut answered = 0_u64;
            let mut at = start;
            while at < end {
                let kind = self.firings[at].kind;
                if kind == AT_ONCE || kind == IN_TIME {
                    return most;
                }
                if kind as usize >= first && kind as usize - first < 64 {
                    answered |= 1 << (kind as usize - first);
                }
                at += 1;
            }
            let mut event = first;
            while event < most && event < first + 64 {
                if answered >> (event - first) & 1 == 0 && !self.ignores(net, code, event, class) {
                    return event;
                }
                event += 1;
            }
            first += 64;
        }
        most
    }

    /// Whether some place that ignores this event on purpose is marked, and the guard holds.
    pub(super) const fn ignores(
        &self,
        net: &Net<'_>,
        code: &Code<'_, W>,
        event: usize,
        class: usize,
    ) -> bool {
        let mut at = 0;
        while at < net.ignored.len() {
            // Most are of other events: as little as possible is read of them.
            if net.ignored[at].event.0 as usize == event
                && self.tokens(code, net.ignored[at].place, class) > 0
            {
                let it = &net.ignored[at];
                let mut asked = 0;
                while asked < it.guard.len()
                    && self.tokens(code, it.guard[asked].place, class) >= it.guard[asked].weight
                {
                    asked += 1;
                }
                if asked == it.guard.len() {
                    return true;
                }
            }
            at += 1;
        }
        false
    }

    const fn together(&self, code: &Code<'_, W>) -> Option<(usize, Culprit)> {
        match self.conflict {
            Some((class, a, b)) => {
                let (first, second) = (id(code, a), id(code, b));
                Some((class as usize, Culprit::Together { first, second }))
            }
            None => None,
        }
    }
}

/// Whether an entry is on an event.
const fn is_on<const W: usize>(code: &Code<'_, W>, entry: u16, event: u16) -> bool {
    // An event's first row begins where the last row of the one before ends.
    let width = 2 * code.states as usize;
    let first = if event == 0 { 0 } else { code.rows[width * event as usize - 1] };
    first <= entry && entry < code.rows[width * (event as usize + 1) - 1]
}
