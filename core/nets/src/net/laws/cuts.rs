//! Cuts of zones, made only when a law asks for the future of each of their points.

/// The most values at which the phases of clocks are cut.
const VALUES: usize = 64;
/// The most differences of clocks at which zones are cut.
const PAIRS: usize = 128;

/// The cuts of zones, after which all points of a zone have the same future.
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

    /// At which differences zones are cut: of which two clocks, and the most by which the first
    /// exceeds the second in the lower part.
    pub(super) const fn pairs(&self) -> &[(u16, u16, i64)] {
        self.pairs.split_at(self.pair_count).0
    }

    /// How many there are.
    pub(super) const fn count(&self) -> usize {
        self.value_count + self.pair_count
    }

    /// Tells what is less than this value from the rest.
    pub(super) const fn at(&mut self, clock: u16, value: i64) {
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
    pub(super) const fn between(&mut self, a: u16, b: u16, most: i64) {
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
}
