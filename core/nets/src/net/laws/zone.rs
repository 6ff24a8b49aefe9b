//! How long transitions have been enabled: all possibilities at once.
//!
//! The clocks of enabled transitions, as differences that are bounded (a difference bound matrix,
//! Dill 1989), in whole milliseconds. A clock that has reached its cap is no number any more, so
//! there are finitely many zones without widening any. Every zone lies within one *phase* of each
//! of its clocks, so in all of it the same intervals are open.

use super::cuts::Cuts;
use crate::player::code::{Clock, Code};

/// The most clocks that run at once.
pub const CLOCKS: usize = 8;
/// Marks a clock of a transition that has been enabled for so long that it makes no difference any
/// more.
pub(super) const CAPPED: i64 = -1;
/// Marks a clock of a transition that fires by itself now.
pub(super) const DUE: i64 = -2;

const SIZE: usize = CLOCKS + 1;

/// A zone: the values that the clocks can have together.
#[derive(Clone, Copy, Debug)]
pub(super) struct Zone {
    /// Number of running clocks.
    pub(super) count: usize,
    /// Which, in the order of [`Code::clocks`].
    pub(super) clocks: [u16; CLOCKS],
    /// The last millisecond of the phase of each, or [`CAPPED`], or [`DUE`].
    pub(super) until: [i64; CLOCKS],
    /// The most by which each, or zero, exceeds each. Zero comes first; zeros for what is no
    /// number.
    pub(super) bounds: [[i64; SIZE]; SIZE],
}

/// The last millisecond of the phase in which this value is, or [`CAPPED`], or [`DUE`].
const fn phase<const W: usize>(clock: &Clock<W>, id: u16, value: i64, cuts: &Cuts) -> i64 {
    let earliest = clock.earliest as i64;
    if !clock.event && value >= earliest {
        return DUE;
    }
    let cap = if clock.latest == u32::MAX { earliest } else { clock.latest as i64 + 1 };
    if value >= cap {
        return CAPPED;
    }
    let next = if value < earliest { earliest } else { cap };
    cuts.next(id, value, next) - 1
}

impl Zone {
    /// Without clocks.
    pub(super) const EMPTY: Self =
        Self { count: 0, clocks: [0; CLOCKS], until: [CAPPED; CLOCKS], bounds: [[0; SIZE]; SIZE] };

    /// After a firing, or a change of a shared place, that left this of the marking before it gave
    /// its tokens; `own` is the clock of what fired. `None` when too many run.
    pub(super) const fn moved<const W: usize>(
        &self,
        code: &Code<'_, W>,
        cuts: &Cuts,
        left: &[u64; W],
        after: &[u64; W],
        own: u16,
    ) -> Option<Self> {
        let mut zone = Self::EMPTY;
        // Which row of the old bounds each clock has: zero when it starts anew.
        let mut old = [0; SIZE];
        let (mut clock, mut known) = (0, 0);
        while clock < code.clocks.len() {
            let it = &code.clocks[clock];
            let ran = known < self.count && self.clocks[known] as usize == clock;
            if code.holds(after, &it.need) {
                if zone.count == CLOCKS {
                    return None;
                }
                let at = zone.count;
                let keeps = ran && clock != own as usize && code.holds(left, &it.need);
                zone.clocks[at] = clock as u16;
                zone.until[at] =
                    if keeps { self.until[known] } else { phase(it, clock as u16, 0, cuts) };
                old[at + 1] = if keeps { known + 1 } else { 0 };
                zone.count += 1;
            }
            known += ran as usize;
            clock += 1;
        }
        let mut a = 0;
        while a <= zone.count {
            let mut b = 0;
            while b <= zone.count {
                if a != b
                    && (a == 0 || zone.until[a - 1] >= 0)
                    && (b == 0 || zone.until[b - 1] >= 0)
                {
                    zone.bounds[a][b] = self.bounds[old[a]][old[b]];
                }
                b += 1;
            }
            a += 1;
        }
        Some(zone)
    }

    /// Whether some clock is a number.
    pub(super) const fn runs(&self) -> bool {
        let mut at = 0;
        while at < self.count {
            if self.until[at] >= 0 {
                return true;
            }
            at += 1;
        }
        false
    }

    /// Whether some transition fires by itself now.
    pub(super) const fn is_due(&self) -> bool {
        let mut at = 0;
        while at < self.count {
            if self.until[at] == DUE {
                return true;
            }
            at += 1;
        }
        false
    }

    /// The position of a clock that runs.
    pub(super) const fn position(&self, clock: u16) -> Option<usize> {
        let mut at = 0;
        while at < self.count {
            if self.clocks[at] == clock {
                return Some(at);
            }
            at += 1;
        }
        None
    }

    /// Adds what is reached when time passes within the phases. Differences stay as they are: those
    /// of the points that were there.
    pub(super) const fn delay(&mut self) {
        let mut a = 0;
        while a < self.count {
            if self.until[a] >= 0 {
                let mut most = self.until[a];
                let mut b = 0;
                while b < self.count {
                    if self.until[b] >= 0 {
                        let other = self.bounds[a + 1][b + 1] + self.until[b];
                        most = if other < most { other } else { most };
                    }
                    b += 1;
                }
                self.bounds[a + 1][0] = most;
            }
            a += 1;
        }
    }

    /// The part where one row exceeds another by at most this; there is one.
    const fn with(mut self, a: usize, b: usize, most: i64) -> Self {
        if self.bounds[a][b] <= most {
            return self;
        }
        let before = self.bounds;
        let mut i = 0;
        while i <= self.count {
            let mut j = 0;
            while j <= self.count {
                let number =
                    (i == 0 || self.until[i - 1] >= 0) && (j == 0 || self.until[j - 1] >= 0);
                let way = before[i][a] + most + before[b][j];
                if i != j && number && way < self.bounds[i][j] {
                    self.bounds[i][j] = way;
                }
                j += 1;
            }
            i += 1;
        }
        self
    }

    /// Whether in one part a clock exceeds another by more than this, and in one it does not.
    pub(super) const fn straddles(&self, a: usize, b: usize, most: i64) -> bool {
        self.until[a] >= 0
            && self.until[b] >= 0
            && self.bounds[a + 1][b + 1] > most
            && self.bounds[b + 1][a + 1] >= -most
    }

    /// The parts where a clock exceeds another by at most this, and by more.
    pub(super) const fn parts(&self, a: usize, b: usize, most: i64) -> (Self, Self) {
        (self.with(a + 1, b + 1, most), self.with(b + 1, a + 1, -most - 1))
    }

    /// Whether the interval of a transition on an event is open.
    pub(super) const fn opens<const W: usize>(&self, code: &Code<'_, W>, clock: u16) -> bool {
        let it = &code.clocks[clock as usize];
        match self.position(clock) {
            Some(at) if self.until[at] == CAPPED => it.latest == u32::MAX,
            // A phase lies on one side of each instant where the interval begins or ends.
            Some(at) => it.earliest as i64 <= self.until[at] && self.until[at] <= it.latest as i64,
            None => false,
        }
    }

    /// The two parts on either side of the first cut from this one on that divides it, and the cut.
    pub(super) const fn divided(&self, cuts: &Cuts, from: usize) -> Option<(Self, Self, usize)> {
        let mut at = from;
        while at < cuts.pairs().len() {
            let (a, b, most) = cuts.pairs()[at];
            if let (Some(a), Some(b)) = (self.position(a), self.position(b))
                && self.straddles(a, b, most)
            {
                let (low, high) = self.parts(a, b, most);
                return Some((low, high, at));
            }
            at += 1;
        }
        None
    }

    /// Cuts where it depends on the point of this zone what happens next; whether there is
    /// anything new to cut.
    pub(super) const fn cut(&self, cuts: &mut Cuts) -> bool {
        let before = cuts.count();
        let mut a = 0;
        while a < self.count {
            let mut b = a + 1;
            while b < self.count {
                if self.until[a] >= 0 && self.until[b] >= 0 {
                    // Which of them ends its phase first, or both do at once.
                    let both = self.until[a] - self.until[b];
                    let mut most = both - 1;
                    while most <= both {
                        if self.straddles(a, b, most) {
                            cuts.between(self.clocks[a], self.clocks[b], most);
                        }
                        most += 1;
                    }
                }
                b += 1;
            }
            a += 1;
        }
        // A cut between a clock that starts anew and one that runs on becomes a cut of the latter
        // alone.
        let mut pair = 0;
        while pair < cuts.pairs().len() {
            let (a, b, most) = cuts.pairs()[pair];
            let mut at = 0;
            while at < self.count {
                let value = if self.clocks[at] == a {
                    most + 1
                } else if self.clocks[at] == b {
                    -most
                } else {
                    0
                };
                let (least, until) = (-self.bounds[0][at + 1], self.until[at]);
                if least < value && value <= until {
                    cuts.at(self.clocks[at], value);
                }
                at += 1;
            }
            pair += 1;
        }
        cuts.count() > before
    }

    /// The part where a clock ends its phase with this millisecond, or where it does not.
    pub(super) const fn ending(&self, at: usize, ends: bool) -> Option<Self> {
        let until = self.until[at];
        if ends {
            if self.bounds[at + 1][0] < until {
                return None;
            }
            Some(self.with(0, at + 1, -until))
        } else {
            if -self.bounds[0][at + 1] >= until {
                return None;
            }
            Some(self.with(at + 1, 0, until - 1))
        }
    }

    /// One millisecond later: in all of it these clocks, and no others, begin a phase.
    pub(super) const fn next<const W: usize>(
        mut self,
        code: &Code<'_, W>,
        cuts: &Cuts,
        ending: u64,
    ) -> Self {
        let mut at = 0;
        while at < self.count {
            if self.until[at] >= 0 {
                self.bounds[at + 1][0] += 1;
                self.bounds[0][at + 1] -= 1;
            }
            at += 1;
        }
        at = 0;
        while at < self.count {
            if ending >> at & 1 == 1 {
                let id = self.clocks[at];
                self.until[at] = phase(&code.clocks[id as usize], id, self.until[at] + 1, cuts);
                let mut other = 0;
                while self.until[at] < 0 && other <= self.count {
                    self.bounds[at + 1][other] = 0;
                    self.bounds[other][at + 1] = 0;
                    other += 1;
                }
            }
            at += 1;
        }
        self
    }

    /// How many numbers [`Zone::write`] writes.
    pub(super) const fn length(count: usize) -> usize {
        1 + 2 * count + (count + 1) * (count + 1)
    }

    /// Stores it.
    pub(super) const fn write(&self, pool: &mut [i64], from: usize) {
        pool[from] = self.count.cast_signed() as i64;
        let mut to = from + 1;
        let mut a = 0;
        while a < self.count {
            pool[to] = self.clocks[a] as i64;
            pool[to + 1] = self.until[a];
            to += 2;
            a += 1;
        }
        a = 0;
        while a <= self.count {
            let mut b = 0;
            while b <= self.count {
                pool[to] = self.bounds[a][b];
                to += 1;
                b += 1;
            }
            a += 1;
        }
    }

    /// Reads a stored zone.
    pub(super) const fn read(pool: &[i64], from: usize) -> Self {
        let mut zone = Self::EMPTY;
        zone.count = pool[from].cast_unsigned() as usize;
        let mut at = from + 1;
        let mut a = 0;
        while a < zone.count {
            zone.clocks[a] = pool[at].cast_unsigned() as u16;
            zone.until[a] = pool[at + 1];
            at += 2;
            a += 1;
        }
        a = 0;
        while a <= zone.count {
            let mut b = 0;
            while b <= zone.count {
                zone.bounds[a][b] = pool[at];
                at += 1;
                b += 1;
            }
            a += 1;
        }
        zone
    }

    /// Whether it lies in the one that was stored, of the same marking and so with the same clocks.
    pub(super) const fn is_in(&self, pool: &[i64], from: usize) -> bool {
        let mut at = from + 2;
        let mut a = 0;
        while a < self.count {
            if pool[at] != self.until[a] {
                return false;
            }
            at += 2;
            a += 1;
        }
        at -= 1;
        a = 0;
        while a <= self.count {
            let mut b = 0;
            while b <= self.count {
                if self.bounds[a][b] > pool[at] {
                    return false;
                }
                at += 1;
                b += 1;
            }
            a += 1;
        }
        true
    }
}
