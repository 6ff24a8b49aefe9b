//! Bins of poses: how many are occupied, and which of them belong together.

use crate::particles::Particles;

/// Sides of a bin in metres and radians, as in Nav2: 0.5 m, 0.5 m and 10° (`pf.c`, `pf_alloc`).
const BIN_M: f32 = 0.5;
const HEADINGS: i64 = 36;

/// A place in the table of bins.
#[derive(Clone, Copy, Debug, Default)]
struct Slot {
    key: u32,
    /// The round in which it was written; else it is empty.
    round: u32,
    bin: u32,
}

/// Weights of bins, and the sets that bins form.
#[derive(Clone, Debug)]
pub(crate) struct Histogram {
    slots: Vec<Slot>,
    round: u32,
    keys: Vec<u32>,
    weights: Vec<f64>,
    /// Another bin of the same cluster, or itself: a forest.
    parents: Vec<u32>,
    /// The bin of each particle.
    places: Vec<u32>,
    is_drawn: Vec<bool>,
    /// Bins by their keys.
    order: Vec<(u32, u32)>,
}

/// Bits of a column and of a row.
const BITS: u32 = 13;
/// Steps of the key of a bin for the next row, and for the next heading.
const ROW: i64 = 1 << BITS;
const TURN: i64 = 1 << (2 * BITS);
/// The column of the left border of the map, as particles may be left of it, and the last one.
const BORDER: f32 = 2_048.0;
const LAST: f32 = 8_190.0;
/// With so much added, a number is rounded to a whole one, which its lowest bits hold.
const ROUNDS: f32 = 8_388_608.0; // 2²³

/// The column in the lowest bits, then the row, then the heading. Poses more than 1 km left of the
/// map or below, or 3 km beyond its origin, are in the last bins.
fn key(x: f32, y: f32, heading: f32) -> u32 {
    // Half a bin less, as numbers are rounded to the nearest; none is in the first or behind the
    // last column, so that each has neighbours.
    let cell = |it: f32| {
        let it = it * (1.0 / BIN_M) + (BORDER - 0.5);
        let it = if it > 1.0 { it } else { 1.0 };
        let it = if it < LAST { it } else { LAST };
        (it + ROUNDS).to_bits() & (ROW - 1) as u32
    };
    let turn = heading * (HEADINGS as f32 / core::f32::consts::TAU) + (HEADINGS / 2) as f32 - 0.5;
    let turn = if turn > 0.0 { turn } else { 0.0 };
    let turn = if turn < (HEADINGS - 1) as f32 { turn } else { (HEADINGS - 1) as f32 };
    let turn = (turn + ROUNDS).to_bits() & 0x3f;
    turn << (2 * BITS) | cell(y) << BITS | cell(x)
}

impl Histogram {
    /// An empty one for up to so many poses at a time.
    pub(crate) fn with_capacity(most: usize) -> Self {
        Self {
            slots: vec![Slot::default(); (2 * most).next_power_of_two().max(16)],
            round: 0,
            keys: Vec::with_capacity(most),
            weights: Vec::with_capacity(most),
            parents: Vec::with_capacity(most),
            places: Vec::with_capacity(most),
            is_drawn: Vec::with_capacity(most),
            order: Vec::with_capacity(most),
        }
    }

    #[cfg(test)]
    pub(crate) fn capacity(&self) -> Vec<usize> {
        let Self { slots, keys, weights, parents, places, is_drawn, order, .. } = self;
        let numbers = [keys, parents, places].map(Vec::capacity);
        let others = [slots.capacity(), weights.capacity(), is_drawn.capacity(), order.capacity()];
        [&numbers[..], &others].concat()
    }

    fn clear(&mut self) {
        self.round = self.round.wrapping_add(1);
        if self.round == 0 {
            self.slots.fill(Slot::default());
            self.round = 1;
        }
        self.keys.clear();
        self.weights.clear();
        self.parents.clear();
        self.places.clear();
        self.is_drawn.clear();
    }

    /// Returns the place of a key in the table, or the empty one where it would be.
    #[inline]
    fn slot(&self, key: u32) -> usize {
        let mask = self.slots.len() - 1;
        let mut at = (key.wrapping_mul(0x9e37_79b1) >> 8) as usize & mask;
        // Ends, as half of the table is empty.
        while self.slots[at].round == self.round && self.slots[at].key != key {
            at = (at + 1) & mask;
        }
        at
    }

    #[inline]
    fn bin(&mut self, key: u32, weight: f64) -> usize {
        let at = self.slot(key);
        let slot = &mut self.slots[at];
        if slot.round != self.round {
            *slot = Slot { key, round: self.round, bin: self.keys.len() as u32 };
            self.parents.push(slot.bin);
            self.keys.push(key);
            self.weights.push(0.0);
            self.is_drawn.push(false);
        }
        let bin = slot.bin as usize;
        self.weights[bin] += weight;
        bin
    }

    /// Puts all particles into bins.
    pub(crate) fn fill(&mut self, particles: &Particles) {
        self.clear();
        let Particles { x, y, heading, weight, .. } = particles;
        // A compiler makes vectors of it.
        let poses = x.iter().zip(y).zip(heading);
        self.places.extend(poses.map(|((x, y), heading)| key(*x, *y, *heading)));
        for (at, weight) in weight.iter().enumerate() {
            self.places[at] = self.bin(self.places[at], *weight) as u32;
        }
    }

    /// Returns the number of bins.
    pub(crate) fn bins(&self) -> usize {
        self.keys.len()
    }

    /// Notes that a particle is drawn; returns whether it is its bin's first.
    pub(crate) fn draw(&mut self, particle: usize) -> bool {
        let bin = self.places[particle] as usize;
        !core::mem::replace(&mut self.is_drawn[bin], true)
    }

    /// Notes that another pose is drawn; returns whether it is its bin's first.
    pub(crate) fn draw_at(&mut self, [x, y, heading]: [f32; 3]) -> bool {
        let bin = self.bin(key(x, y, heading), 0.0);
        !core::mem::replace(&mut self.is_drawn[bin], true)
    }

    /// The root of a bin's cluster.
    #[inline]
    fn root(&mut self, mut bin: u32) -> u32 {
        while self.parents[bin as usize] != bin {
            let next = self.parents[self.parents[bin as usize] as usize];
            self.parents[bin as usize] = next;
            bin = next;
        }
        bin
    }

    /// Puts each bin in order from `begin` on together with those whose keys are so far behind its
    /// own, or one more, or one less.
    fn join(&mut self, begin: usize, offset: i64) {
        let mut from = 0;
        for at in begin..self.order.len() {
            let (key, bin) = self.order[at];
            let middle = i64::from(key) + offset;
            while self.order.get(from).is_some_and(|it| i64::from(it.0) < middle - 1) {
                from += 1;
            }
            for other in from..self.order.len() {
                let (key, beside) = self.order[other];
                if i64::from(key) > middle + 1 {
                    break;
                }
                if self.parents[bin as usize] != self.parents[beside as usize] {
                    let (one, two) = (self.root(bin), self.root(beside));
                    self.parents[one.max(two) as usize] = one.min(two);
                }
            }
        }
    }

    /// Puts bins together that touch, also at a corner; returns the heaviest cluster, by the number
    /// of its first bin, its weight, and how many clusters there are.
    pub(crate) fn cluster(&mut self) -> (u32, f64, usize) {
        self.order.clear();
        self.order.extend(self.keys.iter().copied().zip(0..));
        self.order.sort_unstable();
        // Half of the 26 bins around: the others look here. Three that follow each other in a row
        // are found together.
        self.join(0, 0);
        self.join(0, ROW);
        for row in [-ROW, 0, ROW] {
            self.join(0, TURN + row);
        }
        // The last headings touch the first ones.
        let last = (HEADINGS - 1) * TURN;
        let begin = self.order.partition_point(|it| i64::from(it.0) < last);
        for row in [-ROW, 0, ROW] {
            self.join(begin, row - last);
        }
        // A root comes before all others of its cluster.
        let mut clusters = 0;
        for bin in 0..self.keys.len() {
            let root = self.root(bin as u32) as usize;
            clusters += usize::from(root == bin);
            if root != bin {
                self.weights[root] += self.weights[bin];
            }
        }
        let mut best = (0, 0.0);
        for bin in 0..self.keys.len() {
            if self.parents[bin] as usize == bin && self.weights[bin] > best.1 {
                best = (bin as u32, self.weights[bin]);
            }
        }
        (best.0, best.1, clusters)
    }

    /// Whether a particle belongs to a cluster; asked after [`cluster`](Self::cluster).
    pub(crate) fn is_in(&self, particle: usize, cluster: u32) -> bool {
        let mut bin = self.places[particle];
        while self.parents[bin as usize] != bin {
            bin = self.parents[bin as usize];
        }
        bin == cluster
    }
}

/// Returns how many samples keep the Kullback-Leibler distance between their distribution over so
/// many occupied bins and the true one below `error`, with `z` the quantile of the probability that
/// they do: (k - 1) / 2ε · (1 - 2 / 9(k - 1) + √(2 / 9(k - 1)) z)³ (Fox, "Adapting the sample size
/// in particle filters through KLD-sampling", IJRR 22(12), 2003, equation 7).
///
/// One bin needs none: Nav2 takes the most particles then.
pub(crate) fn needed(bins: usize, error: f64, z: f64) -> f64 {
    let free = bins.saturating_sub(1) as f64;
    if free == 0.0 {
        return 0.0;
    }
    let part = 2.0 / (9.0 * free);
    let it = 1.0 - part + part.sqrt() * z;
    (free / (2.0 * error) * it * it * it).ceil()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn filled(poses: &[[f32; 3]]) -> Histogram {
        let mut particles = Particles::with_capacity(poses.len());
        poses.iter().for_each(|it| particles.push(*it));
        particles.settle();
        let mut histogram = Histogram::with_capacity(poses.len());
        histogram.fill(&particles);
        histogram
    }

    #[test]
    fn bins_that_touch_are_one_cluster_also_over_the_turn_and_left_of_the_map() {
        let mut histogram = filled(&[
            [0.2, 0.2, 3.1],
            [-0.3, 0.2, -3.1], // beside, and over the turn
            [5.0, 5.0, 0.0],
            [0.9, 0.9, 3.1],
            [5.0, 5.0, 0.4], // two bins of heading further
        ]);
        assert_eq!(histogram.keys.len(), 5);
        let (best, weight, clusters) = histogram.cluster();
        assert_eq!((best, clusters), (0, 3));
        assert!((weight - 0.6).abs() < 1e-12);
        let members: Vec<bool> = (0..5).map(|it| histogram.is_in(it, best)).collect();
        assert_eq!(members, [true, true, false, true, false]);
    }

    #[test]
    fn poses_of_a_bin_count_once() {
        let mut histogram = filled(&[[0.1, 0.1, 0.0], [0.4, 0.4, 0.1], [0.6, 0.1, 0.0]]);
        let drawn = [0, 1, 0, 2].map(|it| histogram.draw(it));
        assert_eq!(drawn, [true, false, false, true]);
        assert!(!histogram.draw_at([0.7, 0.2, 0.0]) && histogram.draw_at([9.0, 0.2, 0.0]));
    }

    /// Held against quantiles of the chi-square distribution, n = χ²(k - 1; 1 - δ) / 2ε (equation
    /// 6), of tables for δ = 0.01, that is z = 2.326: the formula approximates them.
    #[test]
    fn the_number_of_samples_is_that_of_the_paper() {
        for (bins, quantile) in [(11, 23.209), (31, 50.892), (101, 135.807)] {
            let exact: f64 = quantile / (2.0 * 0.05);
            let found = needed(bins, 0.05, 2.326_347_9);
            assert!((found / exact - 1.0).abs() < 0.005, "{bins}: {found} {exact}");
        }
        assert_eq!([0, 1, 2].map(|it| needed(it, 0.05, 0.99)), [0.0, 0.0, 20.0]);
    }
}
