//! A promise that past runs gave, watched while runs go on.

use super::beta::{ln_beta, quantile};
use super::interval::Interval;
use libm::log;

/// A bound, the `rank`-th smallest of `runs` past scores, and how often later runs passed it.
///
/// If later runs are exchangeable with the past ones and no two scores are equal, the next run
/// passes the bound with probability (runs + 1 - rank + missed) / (runs + 1 + seen): Pólya's urn
/// (de Finetti 1937). The probability of the misses that were seen, with one rate of which nothing
/// is known, over that of the urn is a martingale that begins at 1: with probability 1 - error it
/// never comes to 1 / error (Ville 1939), so that it may be looked at after each run. Where scores
/// are equal there are fewer misses, and the alarm is rarer.
///
/// ```
/// use cotama_campaign::statistics::Promise;
/// let mut promise = Promise::new(951, 1_000);
/// for run in 0..1_000 {
///     promise.add(run % 20 == 0); // 5 of 100, as promised
/// }
/// assert!(!promise.is_broken(0.001));
/// for run in 0..400 {
///     promise.add(run % 4 == 0); // 25 of 100
/// }
/// assert!(promise.is_broken(0.001));
/// assert_eq!((promise.missed(), promise.seen()), (150, 1_400));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Promise {
    rank: u64,
    runs: u64,
    missed: u64,
    seen: u64,
}

impl Promise {
    /// A promise that no later run has met; the rank is taken as one from 1 to the number of runs.
    pub fn new(rank: u64, runs: u64) -> Self {
        let runs = runs.max(1);
        Self { rank: rank.clamp(1, runs), runs, missed: 0, seen: 0 }
    }

    /// Counts a later run.
    pub const fn add(&mut self, missed: bool) {
        self.seen += 1;
        if missed {
            self.missed += 1;
        }
    }

    /// How many later runs passed the bound.
    pub const fn missed(&self) -> u64 {
        self.missed
    }

    /// How many later runs there were.
    pub const fn seen(&self) -> u64 {
        self.seen
    }

    /// The share of later runs that keep within the bound: its mean over all sets of past runs, and
    /// the interval that holds it with this confidence given one set, of Beta(k, n + 1 - k) (Vovk,
    /// ACML 2012).
    ///
    /// ```
    /// use cotama_campaign::statistics::Promise;
    /// let it = Promise::new(951, 1_000).coverage(0.95);
    /// assert!((it.estimate - 0.950_05).abs() < 1e-5);
    /// assert!((it.low - 0.935_7).abs() < 1e-4 && (it.high - 0.962_7).abs() < 1e-4, "{it:?}");
    /// ```
    pub fn coverage(&self, confidence: f64) -> Interval {
        let (kept, passed) = self.urn();
        let tail = (1.0 - confidence) / 2.0;
        Interval {
            estimate: kept / (kept + passed),
            low: quantile(kept, passed, tail),
            high: quantile(kept, passed, 1.0 - tail),
            confidence,
        }
    }

    /// Whether more runs passed the bound than exchangeable ones do; wrong with at most this
    /// probability, however often it is asked.
    pub fn is_broken(&self, error: f64) -> bool {
        let (kept, passed) = self.urn();
        let (missed, seen) = (self.missed as f64, self.seen as f64);
        missed * (kept + passed) > passed * seen && self.evidence() >= -log(error)
    }

    /// The logarithm of the probability of what was seen with a rate of which nothing is known,
    /// over that of exchangeable runs.
    pub fn evidence(&self) -> f64 {
        let (kept, passed) = self.urn();
        let (missed, within) = (self.missed as f64, (self.seen - self.missed) as f64);
        ln_beta(1.0 + missed, 1.0 + within) + ln_beta(passed, kept)
            - ln_beta(passed + missed, kept + within)
    }

    fn urn(&self) -> (f64, f64) {
        (self.rank as f64, (self.runs + 1 - self.rank) as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use cotama_sim::streams::Streams;

    #[test]
    fn the_ratio_is_a_martingale_that_begins_at_one() {
        let mut at = Promise::new(18, 19);
        assert!(at.evidence().abs() < 1e-12);
        for missed in [false, true, true, false, true] {
            let (kept, passed) = at.urn();
            let miss = (passed + at.missed as f64) / (kept + passed + at.seen as f64);
            let after = |missed: bool| {
                let mut next = at;
                next.add(missed);
                libm::exp(next.evidence())
            };
            let mean = miss * after(true) + (1.0 - miss) * after(false);
            assert!((mean - libm::exp(at.evidence())).abs() < 1e-9);
            at.add(missed);
        }
    }

    /// 500 calibrations of 99 runs, each watched over 400 more runs of the same law.
    #[test]
    fn exchangeable_runs_are_seldom_called_broken_and_others_soon() {
        let (mut false_alarms, mut found) = (0, Vec::new());
        for seed in 0..500 {
            let streams = Streams::new(seed);
            let mut stream = streams.stream("scores");
            let mut draw = |most: u64| stream.below(most);
            let mut past: Vec<_> = (0..99).map(|_| draw(1 << 40)).collect();
            past.sort_unstable();
            let bound = past[89];
            let mut watch = |most: u64| {
                let mut promise = Promise::new(90, 99);
                (1..=400).find(|_| {
                    promise.add(draw(most) > bound);
                    promise.is_broken(0.01)
                })
            };
            false_alarms += usize::from(watch(1 << 40).is_some());
            // The same scores twice as large: more than half of them are beyond the bound.
            found.extend(watch(1 << 41));
        }
        assert!(false_alarms <= 8, "{false_alarms}");
        found.sort_unstable();
        assert_eq!(found.len(), 500);
        assert!(found[250] <= 12 && found[499] <= 60, "{} {}", found[250], found[499]);
    }
}
