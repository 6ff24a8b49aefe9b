//! Crowded ways: the delays of drives, and what bids take them to be.

use super::{Floor, Scenario, Spot};
use std::collections::BTreeMap;

/// The most delays of a way that a file lists, and the most that a robot remembers of it.
pub const MOST_DELAYS: usize = 1_000;
/// The most values of a way, and of a sum, that are kept: of more, neighbours become the larger
/// one.
const MOST_VALUES: usize = 64;
const MOST_SUMS: usize = 256;
/// Weights of a sum are exact up to this; beyond it they are rounded up.
const MOST_WEIGHT: u128 = 1 << 100;

/// A way on which drives are delayed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Crowd {
    /// The numbers of its places, the smaller one first.
    pub between: (usize, usize),
    /// The delay of a drive over it, in ms: each of these is equally likely.
    pub delays_ms: Vec<u64>,
    /// The delays of earlier drives, in ms, which bids know; `None` where they know all that may
    /// happen.
    pub seen_ms: Option<Vec<u64>>,
}

impl Crowd {
    /// Returns the delays that bids know at the start of a run, in ms.
    pub fn seen(&self) -> &[u64] {
        self.seen_ms.as_deref().unwrap_or(&self.delays_ms)
    }
}

/// The delay of a drive, as bids take it to be.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Travel {
    /// A drive is never delayed.
    #[default]
    Plain,
    /// A drive takes as long as on average.
    Mean,
    /// A drive takes no longer in so many of a thousand cases (Rohrmueller, TUM 2011, 4.5: the
    /// quantile reward).
    Quantile(u16),
}

impl Travel {
    /// Returns the delay of a drive over ways with these delays in ms, each equally likely and
    /// independent of those of other ways; an empty list delays nothing. The mean of each way is
    /// rounded up. The quantile is the least sum that is reached by so many of a thousand:
    /// quantiles do not add, so all ways of a drive are summed first. Of more than 64 different
    /// delays of a way, or 256 sums, neighbours count as the larger one.
    ///
    /// ```
    /// use cotama_models::team::scenario::Travel;
    /// let way: &[u64] = &[0, 0, 0, 40_000];
    /// assert_eq!(Travel::Plain.of(&[way]), 0);
    /// assert_eq!(Travel::Mean.of(&[way, way]), 20_000);
    /// assert_eq!([700, 800].map(|it| Travel::Quantile(it).of(&[way])), [0, 40_000]);
    /// // Two such ways: 0 ms in 9 of 16 cases, 40 s in 6, 80 s in 1.
    /// assert_eq!([700, 950].map(|it| Travel::Quantile(it).of(&[way, way])), [40_000, 80_000]);
    /// ```
    pub fn of(self, ways: &[&[u64]]) -> u64 {
        match self {
            Self::Plain => 0,
            Self::Mean => ways.iter().map(|it| mean(it)).fold(0, u64::saturating_add),
            Self::Quantile(permille) => quantile(&sums(ways), permille),
        }
    }
}

fn mean(delays: &[u64]) -> u64 {
    let sum: u128 = delays.iter().map(|it| u128::from(*it)).sum();
    let mean = sum.div_ceil((delays.len() as u128).max(1));
    u64::try_from(mean).unwrap_or(u64::MAX)
}

/// The sums of one delay of each way, with their weights.
fn sums(ways: &[&[u64]]) -> BTreeMap<u64, u128> {
    let mut all = BTreeMap::from([(0_u64, 1_u128)]);
    for way in ways.iter().filter(|it| !it.is_empty()) {
        let mut own: BTreeMap<u64, u128> = BTreeMap::new();
        way.iter().for_each(|it| *own.entry(*it).or_default() += 1);
        let own = coarse(own, MOST_VALUES);
        let mut next: BTreeMap<u64, u128> = BTreeMap::new();
        for (sum, weight) in &all {
            for (delay, count) in &own {
                *next.entry(sum.saturating_add(*delay)).or_default() += weight * count;
            }
        }
        let total: u128 = next.values().sum();
        let part = total.div_ceil(MOST_WEIGHT);
        next.values_mut().for_each(|it| *it = it.div_ceil(part));
        all = coarse(next, MOST_SUMS);
    }
    all
}

/// The same with fewer values: neighbours count as the larger one, so no sum becomes less.
fn coarse(sums: BTreeMap<u64, u128>, most: usize) -> BTreeMap<u64, u128> {
    let joined = sums.len().div_ceil(most);
    if joined == 1 {
        return sums;
    }
    let sums: Vec<_> = sums.into_iter().collect();
    let join = |it: &[(u64, u128)]| Some((it.last()?.0, it.iter().map(|it| it.1).sum()));
    sums.chunks(joined).filter_map(join).collect()
}

fn quantile(sums: &BTreeMap<u64, u128>, permille: u16) -> u64 {
    let total: u128 = sums.values().sum();
    let mut reached = 0;
    for (sum, weight) in sums {
        reached += weight;
        if reached * 1_000 >= total * u128::from(permille) {
            return *sum;
        }
    }
    sums.keys().last().copied().unwrap_or(0)
}

impl Scenario {
    /// Returns the numbers of the crowded ways that a drive enters, in their order: a way on which
    /// it begins was entered before.
    pub fn crowds_on(&self, from: Spot, to: Spot) -> Vec<usize> {
        if self.crowds.is_empty() {
            return Vec::new();
        }
        let number = |(a, b): (usize, usize)| {
            self.crowds.iter().position(|it| it.between == (a.min(b), a.max(b)))
        };
        entered(&self.floor, from, to).into_iter().filter_map(number).collect()
    }

    /// Returns the delays that bids know of each crowded way at the start of a run, in ms.
    pub fn delays_seen(&self) -> Vec<Vec<u64>> {
        self.crowds.iter().map(|it| it.seen().to_vec()).collect()
    }

    /// Returns the delays of two drives, one after the other, as bids take them to be, in ms; those
    /// of both together are what [`Travel`] says of all ways.
    pub(super) fn delays(&self, drives: [(Spot, Spot); 2], seen: &[Vec<u64>]) -> [u64; 2] {
        if self.travel == Travel::Plain {
            return [0; 2];
        }
        let list = |it: usize| seen.get(it).map_or(&[][..], Vec::as_slice);
        let lists = |(from, to)| self.crowds_on(from, to).into_iter().map(list);
        let [first, second] = drives.map(lists);
        let mut ways: Vec<&[u64]> = first.collect();
        let first = self.travel.of(&ways);
        ways.extend(second);
        let both = self.travel.of(&ways);
        [first.min(both), both.saturating_sub(first)]
    }

    /// Returns the delay of one drive as bids take it to be, in ms.
    pub fn delay(&self, from: Spot, to: Spot, seen: &[Vec<u64>]) -> u64 {
        self.delays([(from, to), (to, to)], seen)[0]
    }
}

/// The ways that a drive enters at one of their places.
fn entered(floor: &Floor, from: Spot, to: Spot) -> Vec<(usize, usize)> {
    let mut road = floor.road(from, to).unwrap_or_default();
    // A drive that begins between two places is on its first way already.
    if from.from != from.to && !road.is_empty() {
        road.remove(0);
    }
    road.iter().map(|it| (it.from.0, it.to.0)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// All sums of one delay of each way.
    fn enumerated(ways: &[Vec<u64>]) -> Vec<u64> {
        let mut all = vec![0];
        for way in ways {
            all = all.iter().flat_map(|sum| way.iter().map(move |it| sum + it)).collect();
        }
        all.sort_unstable();
        all
    }

    proptest! {
        #[test]
        fn a_quantile_is_that_of_all_sums(
            ways in prop::collection::vec(prop::collection::vec(0_u64..50, 1..6), 0..5),
            permille in 1_u16..=1_000,
        ) {
            let all = enumerated(&ways);
            let rank = (all.len() * usize::from(permille)).div_ceil(1_000).max(1);
            let lists: Vec<&[u64]> = ways.iter().map(Vec::as_slice).collect();
            prop_assert_eq!(Travel::Quantile(permille).of(&lists), all[rank - 1]);
        }
    }

    #[test]
    fn many_delays_on_many_ways_are_never_understated() {
        let way: Vec<u64> = (0..1_000).map(|it| it * it).collect();
        let ways = [&way[..]; 30];
        let found = [500, 900, 1_000].map(|it| Travel::Quantile(it).of(&ways));
        // The mean of the sum is 9,985,005, its deviation 1.6 million, its most 29,940,030.
        assert!(found[0] > 9_900_000 && found[0] < 11_500_000, "{found:?}");
        assert!(found[1] > 12_000_000 && found[1] < 14_000_000, "{found:?}");
        assert_eq!(found[2], 30 * 998_001);
    }
}
