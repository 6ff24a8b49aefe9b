//! The branches of a step, told apart by the results of its tests: every path through it, with the
//! markings that take it.

use super::{FlatError, MOST_TRANSITIONS};
use cotama_core::net::{Place, PlaceId};
use std::collections::BTreeMap;

/// More tokens than any place holds.
pub(super) const NO_BOUND: i64 = i64::MAX / 4;

/// A weighted sum of tokens that is the same in all reachable markings; weights are positive.
#[derive(Clone, Debug)]
pub(super) struct Sum {
    pub(super) weights: Vec<(PlaceId, i64)>,
    pub(super) total: i64,
}

impl Sum {
    /// Whether it stays the same when tokens change so.
    pub(super) fn stays(&self, change: &BTreeMap<PlaceId, i64>) -> bool {
        let weighed = |it: &(PlaceId, i64)| change.get(&it.0).map_or(0, |change| change * it.1);
        self.weights.iter().map(weighed).sum::<i64>() == 0
    }
}

/// The facts known of all reachable markings.
#[derive(Clone, Debug, Default)]
pub(super) struct Known {
    bounds: Vec<i64>,
    sums: Vec<Sum>,
    /// The sums that count a place, by place.
    counted: Vec<Vec<usize>>,
    /// The range of tokens of each place that follows from bounds and sums alone.
    ranges: Vec<(i64, i64)>,
}

impl Known {
    pub(super) fn new(bounds: impl Iterator<Item = u32>, sums: Vec<Sum>) -> Self {
        let mut known = Self { sums, ..Self::default() };
        bounds.for_each(|it| known.add(it));
        for (at, sum) in known.sums.iter().enumerate() {
            for (place, _) in &sum.weights {
                if let Some(it) = known.counted.get_mut(place.0 as usize) {
                    it.push(at);
                }
            }
        }
        let mut ranges = std::mem::take(&mut known.ranges);
        known.follow(&mut ranges, (0..known.sums.len()).collect());
        Self { ranges, ..known }
    }

    /// A further place.
    pub(super) fn add(&mut self, bound: u32) {
        self.bounds.push(if bound == Place::UNBOUNDED { NO_BOUND } else { i64::from(bound) });
        self.counted.push(Vec::new());
        self.ranges.push((0, self.bounds.last().copied().unwrap_or(NO_BOUND)));
    }

    /// Narrows the ranges by what is held of a place, and by what follows from that.
    fn narrow(&self, ranges: &mut [(i64, i64)], place: PlaceId, (low, high): (i64, i64)) {
        let at = place.0 as usize;
        let Some(range) = ranges.get_mut(at) else { return };
        *range = (range.0.max(low), range.1.min(high));
        self.follow(ranges, self.counted[at].clone());
    }

    /// Narrows the ranges as far as these sums imply it, and those that count what they narrow; a
    /// contradiction is not followed to its end.
    fn follow(&self, ranges: &mut [(i64, i64)], mut sums: Vec<usize>) {
        while let Some(at) = sums.pop() {
            let sum = &self.sums[at];
            let weighed = |ranges: &[(i64, i64)], it: &(PlaceId, i64)| {
                let (low, high) = ranges[it.0.0 as usize];
                (it.1 * low, it.1 * high.min(sum.total))
            };
            let all = sum.weights.iter().map(|it| weighed(ranges, it));
            let (least, most) = all.fold((0, 0), |sum, it| (sum.0 + it.0, sum.1 + it.1));
            for it in &sum.weights {
                let (place, weight) = (it.0.0 as usize, it.1);
                let (own, (low, high)) = (weighed(ranges, it), ranges[place]);
                let new = (
                    low.max((sum.total - (most - own.1) + weight - 1).div_euclid(weight)),
                    high.min((sum.total - (least - own.0)).div_euclid(weight)),
                );
                if new.0 > new.1 {
                    return;
                }
                if new != (low, high) {
                    ranges[place] = new;
                    for &again in &self.counted[place] {
                        if !sums.contains(&again) {
                            sums.push(again);
                        }
                    }
                }
            }
        }
    }

    /// Returns the range of tokens of each place where these tokens are held.
    fn spread(&self, held: &Held) -> Vec<(i64, i64)> {
        let mut ranges = self.ranges.clone();
        held.iter().for_each(|(&place, &range)| self.narrow(&mut ranges, place, range));
        ranges
    }

    /// Returns the results of tests, without those that follow from the others.
    pub(super) fn essential(&self, tests: &Held) -> Held {
        let mut held = tests.clone();
        for (&place, &(low, high)) in tests {
            let (at, bound) = (place.0 as usize, self.bound(place));
            if high < bound {
                held.insert(place, (low, bound));
                if self.spread(&held)[at].1 > high {
                    held.insert(place, (low, high));
                }
            }
            let high = held.get(&place).map_or(high, |it| it.1);
            if low > 0 {
                held.insert(place, (0, high));
                if self.spread(&held)[at].0 < low {
                    held.insert(place, (low, high));
                }
            }
        }
        held.retain(|&place, it| *it != (0, self.bound(place)));
        held
    }

    pub(super) fn bound(&self, place: PlaceId) -> i64 {
        self.bounds.get(place.0 as usize).copied().unwrap_or(NO_BOUND)
    }
}

/// For some places the least and the most tokens at the start of a step.
pub(super) type Held = BTreeMap<PlaceId, (i64, i64)>;

/// One path through a step: what its tests have found so far, and how tokens have changed.
#[derive(Clone, Debug)]
pub(super) struct Branch<'k> {
    known: &'k Known,
    pub(super) held: Held,
    /// The token ranges that follow from `held`, by place.
    ranges: Vec<(i64, i64)>,
    pub(super) change: BTreeMap<PlaceId, i64>,
    /// How tests that can turn out either way turn out.
    script: Vec<bool>,
    next: usize,
}

impl<'k> Branch<'k> {
    pub(super) fn new(known: &'k Known, held: Held) -> Self {
        let ranges = known.spread(&held);
        Self { known, held, ranges, change: BTreeMap::new(), script: Vec::new(), next: 0 }
    }

    pub(super) fn add(&mut self, place: PlaceId, tokens: i64) {
        *self.change.entry(place).or_default() += tokens;
    }

    /// Whether a place holds at least so many tokens by now.
    pub(super) fn holds(&mut self, place: PlaceId, tokens: i64) -> bool {
        let least = tokens - self.change.get(&place).copied().unwrap_or(0);
        let (low, high) = self.at_start(place);
        if low >= least || high < least {
            return low >= least;
        }
        if self.next == self.script.len() {
            self.script.push(true);
        }
        let found = self.script[self.next];
        self.next += 1;
        let held = self.held.entry(place).or_insert((0, self.known.bound(place)));
        if found {
            held.0 = least;
        } else {
            held.1 = least - 1;
        }
        let range = *held;
        self.known.narrow(&mut self.ranges, place, range);
        found
    }

    /// The least and the most tokens that a place can hold by now.
    pub(super) fn range(&self, place: PlaceId) -> (i64, i64) {
        let (low, high) = self.at_start(place);
        let change = self.change.get(&place).copied().unwrap_or(0);
        (low + change, high + change)
    }

    fn at_start(&self, place: PlaceId) -> (i64, i64) {
        self.ranges.get(place.0 as usize).copied().unwrap_or((0, NO_BOUND))
    }
}

/// Hands on every path through a step that starts where these tokens are held, one after the other:
/// no marking takes two of them, and each takes one. None is kept.
///
/// # Errors
/// The errors of the step and of the taker; and more than [`MOST_TRANSITIONS`] paths.
pub(super) fn branches<'k, T>(
    known: &'k Known,
    held: &Held,
    mut step: impl FnMut(&mut Branch<'k>) -> Result<T, FlatError>,
    mut take: impl FnMut(&Branch<'k>, T) -> Result<(), FlatError>,
) -> Result<(), FlatError> {
    let (mut count, mut script) = (0, Vec::new());
    loop {
        let mut branch = Branch { script, ..Branch::new(known, held.clone()) };
        let found = step(&mut branch)?;
        count += 1;
        if count > MOST_TRANSITIONS {
            return Err(FlatError::TooMany);
        }
        take(&branch, found)?;
        // The next path turns at the last test that turned out well.
        script = branch.script;
        while script.last() == Some(&false) {
            script.pop();
        }
        match script.last_mut() {
            Some(last) => *last = false,
            None => return Ok(()),
        }
    }
}
