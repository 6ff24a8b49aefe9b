//! Drawing particles by their weights.

/// Sums of weights, and where to look for them.
#[derive(Clone, Debug)]
pub(crate) struct Sums {
    sums: Vec<f64>,
    /// For each of as many equal parts as there are weights the first sum that is beyond its begin.
    guide: Vec<u32>,
}

impl Sums {
    /// An empty one for up to so many weights.
    pub(crate) fn with_capacity(most: usize) -> Self {
        Self { sums: Vec::with_capacity(most), guide: Vec::with_capacity(most) }
    }

    #[cfg(test)]
    pub(crate) fn capacity(&self) -> Vec<usize> {
        vec![self.sums.capacity(), self.guide.capacity()]
    }

    /// Adds up weights, whose sum is 1 but for rounding.
    pub(crate) fn fill(&mut self, weights: &[f64]) {
        self.sums.clear();
        let mut sum = 0.0;
        self.sums.extend(weights.iter().map(|it| {
            sum += it;
            sum
        }));
    }

    /// Prepares for [`find`](Self::find).
    pub(crate) fn guide(&mut self) {
        self.guide.clear();
        let count = self.sums.len();
        let mut first = 0;
        // A hair less: a search may begin before its weight, but not behind.
        let size = (1.0 - 1e-12) / count as f64;
        for part in 0..count {
            let begin = part as f64 * size;
            while first + 1 < count && self.sums[first] <= begin {
                first += 1;
            }
            self.guide.push(first as u32);
        }
    }

    /// Returns the weight that a number from 0 up to 1 falls on (Chen, Asau, "On generating random
    /// variates from an empirical distribution", AIIE Transactions 6(2), 1974).
    pub(crate) fn find(&self, part: f64) -> usize {
        let count = self.sums.len();
        let guide = self.guide.get((part * count as f64) as usize);
        let mut at = guide.map_or(0, |it| *it as usize);
        while at + 1 < count && self.sums[at] <= part {
            at += 1;
        }
        at
    }

    /// Draws so many at once by one number from 0 up to 1 (low-variance sampling; Thrun, Burgard,
    /// Fox, Probabilistic Robotics, 2005, table 4.4): a weight w is drawn ⌊n w⌋ or ⌈n w⌉ times.
    pub(crate) fn draw(&self, count: usize, part: f64, mut each: impl FnMut(usize)) {
        let total = self.sums.last().copied().unwrap_or(1.0);
        let step = total / count.max(1) as f64;
        let mut at = 0;
        for number in 0..count {
            let reached = (number as f64 + part) * step;
            while at + 1 < self.sums.len() && self.sums[at] <= reached {
                at += 1;
            }
            each(at);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn sums(weights: &[f64]) -> Sums {
        let mut it = Sums::with_capacity(weights.len());
        it.fill(weights);
        it
    }

    proptest! {
        #[test]
        fn a_weight_is_drawn_as_often_as_it_should_rounded_down_or_up(
            weights in proptest::collection::vec(0_u32..1_000, 1..60)
                .prop_filter("a weight", |it| it.iter().any(|it| *it > 0)),
            count in 1_usize..300,
            part in 0.0..1.0,
        ) {
            let total: u32 = weights.iter().sum();
            let even: Vec<f64> =
                weights.iter().map(|it| f64::from(*it) / f64::from(total)).collect();
            let mut drawn = vec![0; weights.len()];
            sums(&even).draw(count, part, |at| drawn[at] += 1);
            prop_assert_eq!(drawn.iter().sum::<usize>(), count);
            for (weight, drawn) in even.iter().zip(drawn) {
                let expected = weight * count as f64;
                let (least, most) = ((expected - 1e-9).floor(), (expected + 1e-9).ceil());
                prop_assert!((least..=most).contains(&(drawn as f64)), "{} {}", drawn, expected);
            }
        }

        #[test]
        fn a_number_falls_on_the_first_sum_beyond_it(
            weights in proptest::collection::vec(0_u32..100, 1..60)
                .prop_filter("a weight", |it| it.iter().any(|it| *it > 0)),
            part in 0.0..1.0,
        ) {
            let total: u32 = weights.iter().sum();
            let even: Vec<f64> =
                weights.iter().map(|it| f64::from(*it) / f64::from(total)).collect();
            let mut sums = sums(&even);
            sums.guide();
            let beyond = sums.sums.iter().position(|it| *it > part);
            prop_assert_eq!(sums.find(part), beyond.unwrap_or(even.len() - 1));
        }
    }

    #[test]
    fn draws_are_exact_in_a_small_case() {
        let mut drawn = Vec::new();
        sums(&[0.125, 0.5, 0.0, 0.375]).draw(4, 0.5, |at| drawn.push(at));
        assert_eq!(drawn, [1, 1, 3, 3]); // 0.125 is on the border: it belongs to the second
    }
}
