//! Where zones are cut further: only when a law asks for the future of each of their points.

use super::zone::Zone;

/// The most values at which the phases of clocks are cut.
const VALUES: usize = 64;
/// The most differences of clocks at which zones are cut.
const PAIRS: usize = 128;

/// Where zones are cut, so that all of a zone has the same future.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cuts {
    values: [(u16, i64); VALUES],
    value_count: usize,
    pairs: [(u16, u16, i64); PAIRS],
    pair_count: usize,
    /// Whether there was no room for one.
    pub(super) full: bool,
}

impl Cuts {
    pub(super) const NONE: Self = Self {
        values: [(0, 0); VALUES],
        value_count: 0,
        pairs: [(0, 0, 0); PAIRS],
        pair_count: 0,
        full: false,
    };

    /// The first value after this one, up to `next`, at which a clock is cut.
    pub(super) const fn next(&self, clock: u16, value: i64, mut next: i64) -> i64 {
        let mut at = 0;
        while at < self.value_count {
            let (of, cut) = self.values[at];
            if of == clock && value < cut && cut < next {
                next = cut;
            }
            at += 1;
        }
        next
    }

    /// The two parts of a zone on either side of the first cut from this one on that divides it,
    /// and the cut.
    pub(super) const fn divide(&self, zone: &Zone, from: usize) -> Option<(Zone, Zone, usize)> {
        let mut at = from;
        while at < self.pair_count {
            let (a, b, most) = self.pairs[at];
            if let (Some(a), Some(b)) = (zone.position(a), zone.position(b))
                && zone.straddles(a, b, most)
            {
                let (low, high) = zone.parts(a, b, most);
                return Some((low, high, at));
            }
            at += 1;
        }
        None
    }

    /// Tells what is less than this value from the rest.
    const fn at(&mut self, clock: u16, value: i64) {
        let mut at = 0;
        while at < self.value_count {
            if self.values[at].0 == clock && self.values[at].1 == value {
                return;
            }
            at += 1;
        }
        if at == VALUES {
            self.full = true;
            return;
        }
        self.values[at] = (clock, value);
        self.value_count += 1;
    }

    /// Tells where `a` exceeds `b` by more than this from the rest.
    const fn between(&mut self, a: u16, b: u16, most: i64) {
        let mut at = 0;
        while at < self.pair_count {
            let it = self.pairs[at];
            if it.0 == a && it.1 == b && it.2 == most {
                return;
            }
            at += 1;
        }
        if at == PAIRS {
            self.full = true;
            return;
        }
        self.pairs[at] = (a, b, most);
        self.pair_count += 1;
    }

    /// Cuts where it depends on the point of this zone what happens next; whether there is
    /// anything new to cut.
    pub(super) const fn refine(&mut self, zone: &Zone) -> bool {
        let before = self.value_count + self.pair_count;
        let mut a = 0;
        while a < zone.count {
            let mut b = a + 1;
            while b < zone.count {
                if zone.until[a] >= 0 && zone.until[b] >= 0 {
                    // Which of them ends its phase first, or both do at once.
                    let both = zone.until[a] - zone.until[b];
                    let mut most = both - 1;
                    while most <= both {
                        if zone.straddles(a, b, most) {
                            self.between(zone.clocks[a], zone.clocks[b], most);
                        }
                        most += 1;
                    }
                }
                b += 1;
            }
            a += 1;
        }
        // Where the other clock starts anew, a cut between them is one of the clock that runs on.
        let mut pair = 0;
        while pair < self.pair_count {
            let (a, b, most) = self.pairs[pair];
            let mut at = 0;
            while at < zone.count {
                let value = if zone.clocks[at] == a {
                    most + 1
                } else if zone.clocks[at] == b {
                    -most
                } else {
                    0
                };
                let (least, until) = (-zone.bounds[0][at + 1], zone.until[at]);
                if least < value && value <= until {
                    self.at(zone.clocks[at], value);
                }
                at += 1;
            }
            pair += 1;
        }
        self.value_count + self.pair_count > before
    }
}
