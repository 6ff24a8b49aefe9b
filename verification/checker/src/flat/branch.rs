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
}

impl Known {
    pub(super) fn new(bounds: impl Iterator<Item = u32>, sums: Vec<Sum>) -> Self {
        let mut known = Self { bounds: Vec::new(), sums };
        bounds.for_each(|it| known.add(it));
        known
    }

    /// A further place.
    pub(super) fn add(&mut self, bound: u32) {
        self.bounds.push(if bound == Place::UNBOUNDED { NO_BOUND } else { i64::from(bound) });
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
        let ranges = spread(known, &held);
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
        self.ranges = spread(self.known, &self.held);
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

    /// Returns the results of the tests, without those that follow from the others.
    pub(super) fn essential(&self) -> Held {
        let mut held = self.held.clone();
        for &place in self.held.keys() {
            let bound = self.known.bound(place);
            for side in
                [|it: &mut (i64, i64), bound| it.1 = bound, |it: &mut (i64, i64), _| it.0 = 0]
            {
                let mut fewer = held.clone();
                fewer.entry(place).and_modify(|it| side(it, bound));
                if spread(self.known, &fewer) == spread(self.known, &held) {
                    held = fewer;
                }
            }
        }
        held.retain(|&place, it| *it != (0, self.known.bound(place)));
        held
    }
}

/// Returns the range of tokens of each place where these tokens are held, as far as bounds and sums
/// imply it; a contradiction is not followed to its end.
fn spread(known: &Known, held: &Held) -> Vec<(i64, i64)> {
    let mut ranges: Vec<(i64, i64)> = known.bounds.iter().map(|&bound| (0, bound)).collect();
    for (place, &range) in held {
        if let Some(it) = ranges.get_mut(place.0 as usize) {
            *it = range;
        }
    }
    let mut goes_on = true;
    while goes_on {
        goes_on = false;
        for sum in &known.sums {
            let weighed = |it: &(PlaceId, i64)| {
                let (low, high) = ranges[it.0.0 as usize];
                (it.1 * low, it.1 * high.min(sum.total))
            };
            let (least, most) = sum
                .weights
                .iter()
                .map(weighed)
                .fold((0, 0), |sum, it| (sum.0 + it.0, sum.1 + it.1));
            let before: Vec<_> = sum.weights.iter().map(weighed).collect();
            for (&(place, weight), own) in sum.weights.iter().zip(before) {
                let (low, high) = ranges[place.0 as usize];
                let (least, most) = (least - own.0, most - own.1);
                let new = (
                    low.max((sum.total - most + weight - 1).div_euclid(weight)),
                    high.min((sum.total - least).div_euclid(weight)),
                );
                if new.0 > new.1 {
                    return ranges;
                }
                goes_on |= new != (low, high);
                ranges[place.0 as usize] = new;
            }
        }
    }
    ranges
}

/// Every path through a step that starts where these tokens are held: no marking takes two of them,
/// and each takes one.
///
/// # Errors
/// The errors of the step; and more than [`MOST_TRANSITIONS`] paths.
pub(super) fn branches<'k, T>(
    known: &'k Known,
    held: &Held,
    mut step: impl FnMut(&mut Branch<'k>) -> Result<T, FlatError>,
) -> Result<Vec<(Branch<'k>, T)>, FlatError> {
    let (mut ways, mut script) = (Vec::new(), Vec::new());
    loop {
        let mut branch = Branch { script, ..Branch::new(known, held.clone()) };
        let found = step(&mut branch)?;
        let mut next = branch.script.clone();
        ways.push((branch, found));
        if ways.len() > MOST_TRANSITIONS {
            return Err(FlatError::TooMany);
        }
        // The next path turns at the last test that turned out well.
        while next.last() == Some(&false) {
            next.pop();
        }
        match next.last_mut() {
            Some(last) => *last = false,
            None => return Ok(ways),
        }
        script = next;
    }
}
