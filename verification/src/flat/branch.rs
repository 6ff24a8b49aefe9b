//! What a step does, told apart by what its tests find: every way through it, with the markings that take that way.

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

/// What is known of all reachable markings.
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

/// One way through a step: what its tests have found so far, and how tokens have changed.
#[derive(Clone, Debug)]
pub(super) struct Branch<'k> {
    known: &'k Known,
    pub(super) held: Held,
    pub(super) change: BTreeMap<PlaceId, i64>,
    /// How tests that can turn out either way turn out.
    script: Vec<bool>,
    next: usize,
}

impl<'k> Branch<'k> {
    pub(super) fn new(known: &'k Known, held: Held) -> Self {
        Self { known, held, change: BTreeMap::new(), script: Vec::new(), next: 0 }
    }

    pub(super) fn add(&mut self, place: PlaceId, tokens: i64) {
        *self.change.entry(place).or_default() += tokens;
    }

    /// Whether a place holds at least so many tokens by now.
    pub(super) fn holds(&mut self, place: PlaceId, tokens: i64) -> bool {
        let least = tokens - self.change.get(&place).copied().unwrap_or(0);
        let (low, high) = range(self.known, &self.held, place);
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
        found
    }

    /// The least and the most tokens that a place can hold by now.
    pub(super) fn range(&self, place: PlaceId) -> (i64, i64) {
        let (low, high) = range(self.known, &self.held, place);
        let change = self.change.get(&place).copied().unwrap_or(0);
        (low + change, high + change)
    }

    /// What the tests have found, without what follows from the rest of it.
    pub(super) fn essential(&self) -> Held {
        let mut held = self.held.clone();
        for &place in self.held.keys() {
            let bound = self.known.bound(place);
            for side in [|it: &mut (i64, i64), bound| it.1 = bound, |it: &mut (i64, i64), _| it.0 = 0] {
                let mut fewer = held.clone();
                fewer.entry(place).and_modify(|it| side(it, bound));
                if range(self.known, &fewer, place) == range(self.known, &held, place) {
                    held = fewer;
                }
            }
        }
        held.retain(|&place, it| *it != (0, self.known.bound(place)));
        held
    }
}

/// What a place can hold, as far as this is known of it and of others.
fn range(known: &Known, held: &Held, place: PlaceId) -> (i64, i64) {
    let own = |place| held.get(&place).copied().unwrap_or((0, known.bound(place)));
    let (mut low, mut high) = own(place);
    for sum in &known.sums {
        let Some(&(_, weight)) = sum.weights.iter().find(|it| it.0 == place) else { continue };
        let (mut least, mut most) = (0, 0);
        for &(other, weight) in sum.weights.iter().filter(|it| it.0 != place) {
            let (low, high) = own(other);
            least += weight * low;
            most += (weight * high.min(sum.total)).min(sum.total);
        }
        high = high.min((sum.total - least) / weight);
        low = low.max((sum.total - most + weight - 1).div_euclid(weight));
    }
    (low, high)
}

/// Every way through a step that starts where these tokens are held: no marking takes two of them, and each takes one.
///
/// # Errors
/// Those of the step; and when there are more than [`MOST_TRANSITIONS`] ways.
pub(super) fn branches<'k, T>(
    known: &'k Known,
    held: &Held,
    mut step: impl FnMut(&mut Branch<'k>) -> Result<T, FlatError>,
) -> Result<Vec<(Branch<'k>, T)>, FlatError> {
    let (mut ways, mut script) = (Vec::new(), Vec::new());
    loop {
        let mut branch = Branch { script, ..Branch::new(known, held.clone()) };
        let found = step(&mut branch)?;
        script = branch.script.clone();
        ways.push((branch, found));
        if ways.len() > MOST_TRANSITIONS {
            return Err(FlatError::TooMany);
        }
        // The next way turns at the last test that turned out well.
        while script.last() == Some(&false) {
            script.pop();
        }
        match script.last_mut() {
            Some(last) => *last = false,
            None => return Ok(ways),
        }
    }
}
