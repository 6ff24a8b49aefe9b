//! An interval for a probability that holds whenever runs end.

use super::beta::ln_beta;
use super::interval::Interval;
use libm::{log, log1p};

/// The interval for a probability after `hits` of `runs` that were ended for any reason, by what
/// they came to among others: over all numbers of runs at once it misses the truth at most as
/// seldom as its confidence says. It is wider than [`clopper_pearson`](super::clopper_pearson),
/// which holds for a number of runs that was fixed before.
///
/// The likelihood of the runs, averaged over all probabilities with the weight of Jeffreys (a beta
/// law with both parameters 1/2), over that of the truth is a martingale that begins at 1, and
/// comes to 1 / (1 − confidence) with a probability of at most 1 − confidence (Ville 1939). Those
/// probabilities are held for which it has not come there (Robbins, Ann. Math. Stat. 41, 1970).
///
/// ```
/// use cotama_campaign::statistics::{anytime, clopper_pearson};
/// let (stopped, fixed) = (anytime(3, 365, 0.95), clopper_pearson(3, 365, 0.95));
/// assert!(stopped.low < fixed.low && fixed.high < stopped.high);
/// assert!((stopped.high - 0.037_13).abs() < 1e-5, "{stopped:?}");
/// ```
pub fn anytime(hits: u64, runs: u64, confidence: f64) -> Interval {
    let (hit, miss) = (hits as f64, runs.saturating_sub(hits) as f64);
    if runs == 0 {
        return Interval { estimate: 0.0, low: 0.0, high: 1.0, confidence };
    }
    let averaged = ln_beta(hit + 0.5, miss + 0.5) - ln_beta(0.5, 0.5);
    let power = |times: f64, ln: f64| if times == 0.0 { 0.0 } else { times * ln };
    let is_held =
        |p: f64| averaged - power(hit, log(p)) - power(miss, log1p(-p)) < -log(1.0 - confidence);
    let estimate = hit / (hit + miss);
    // The ratio is least at the share and grows to both sides.
    let edge = |outside: f64| {
        let (mut held, mut outside) = (estimate, outside);
        // Halved so often, no two numbers are between them.
        for _ in 0..1_100 {
            let middle = f64::midpoint(held, outside);
            if !(held.min(outside) < middle && middle < held.max(outside)) {
                break;
            }
            if is_held(middle) {
                held = middle;
            } else {
                outside = middle;
            }
        }
        // An undecided run counts as held.
        outside
    };
    let low = if hits == 0 { 0.0 } else { edge(0.0) };
    let high = if hits >= runs { 1.0 } else { edge(1.0) };
    Interval { estimate, low, high, confidence }
}

#[cfg(test)]
mod tests {
    use super::super::{Sprt, clopper_pearson};
    use super::*;

    /// How likely an interval misses `truth` when runs end as a test from `low` to `high` is
    /// decided, but after `most` at the latest: all ways to so many hits, added up.
    fn missed(
        truth: f64,
        low: f64,
        high: f64,
        most: u64,
        by: fn(u64, u64, f64) -> Interval,
    ) -> f64 {
        let (mut going, mut missed) = (vec![1.0], 0.0);
        // After so many runs the test is a function of the hits alone.
        let decided = |hits: u64, runs: u64| {
            let (failure, success) = (log(high / low), log((1.0 - high) / (1.0 - low)));
            let ratio = hits as f64 * failure + (runs - hits) as f64 * success;
            ratio.abs() >= log(20.0)
        };
        for runs in 1..=most {
            let mut next = vec![0.0; going.len() + 1];
            for (hits, likely) in going.iter().enumerate() {
                next[hits] += likely * (1.0 - truth);
                next[hits + 1] += likely * truth;
            }
            for (hits, likely) in next.iter_mut().enumerate() {
                if *likely > 0.0 && (runs == most || decided(hits as u64, runs)) {
                    if !by(hits as u64, runs, 0.95).holds(truth) {
                        missed += *likely;
                    }
                    *likely = 0.0;
                }
            }
            going = next;
        }
        missed
    }

    #[test]
    fn a_stopped_test_leaves_an_interval_that_holds_and_a_fixed_one_does_not() {
        let mut fixed_fails = 0;
        for truth in [0.02, 0.05, 0.1, 0.13, 0.2, 0.3] {
            for (low, high) in [(0.05, 0.1), (0.1, 0.2)] {
                let found = missed(truth, low, high, 300, anytime);
                assert!(found <= 0.05, "{truth} {low} {high}: {found}");
                fixed_fails += u32::from(missed(truth, low, high, 300, clopper_pearson) > 0.05);
            }
        }
        assert!(fixed_fails >= 2, "{fixed_fails}");
    }

    #[test]
    fn the_test_above_is_the_test_that_is_run() {
        let mut test = Sprt::new(0.05, 0.1, 0.95).unwrap();
        let runs = (1..).find(|_| test.add(false).is_some()).unwrap();
        let success = log(0.9 / 0.95);
        assert_eq!(runs, (log(20.0) / -success).ceil() as u64);
    }

    #[test]
    fn ends_are_where_the_ratio_comes_to_its_limit() {
        for (hits, runs) in [(0, 1), (1, 1), (0, 1_000), (17, 1_000), (1_000, 1_000), (5, 1 << 30)]
        {
            let found = anytime(hits, runs, 0.99);
            assert!(0.0 <= found.low && found.low <= found.estimate, "{found:?}");
            assert!(found.estimate <= found.high && found.high <= 1.0, "{found:?}");
            let ratio = |p: f64| {
                let (hit, miss) = (hits as f64, (runs - hits) as f64);
                ln_beta(hit + 0.5, miss + 0.5)
                    - ln_beta(0.5, 0.5)
                    - if hits > 0 { hit * log(p) } else { 0.0 }
                    - if hits < runs { miss * log1p(-p) } else { 0.0 }
            };
            for (end, is_open) in [(found.low, hits > 0), (found.high, hits < runs)] {
                let off = (ratio(end) - log(100.0)).abs();
                assert!(!is_open || off < 1e-4, "{hits} of {runs} at {end}: {off}");
            }
        }
    }
}
