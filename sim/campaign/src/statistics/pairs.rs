//! Two policies over the same fault plans.

use super::interval::{Interval, clopper_pearson, mean_interval};

/// The change from one policy to another, over the same plans.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// How often only the first succeeds.
    pub only_first: u64,
    /// How often only the second succeeds.
    pub only_second: u64,
    /// The difference of the probabilities of success, second less first.
    pub success: Interval,
    /// How likely so unequal a number of changes is, or a more unequal one, if both are alike:
    /// the exact test of `McNemar` (Psychometrika 12, 1947), two-sided.
    pub p_value: f64,
}

/// The exact comparison of two policies that ran the same plans: plans on which both come to the
/// same say nothing of the difference. The interval takes those that differ as drawn by Clopper and
/// Pearson, half of its doubt for each policy, and is thus wider than it must be.
///
/// ```
/// use cotama_campaign::statistics::mcnemar;
/// let found = mcnemar(2, 12, 1_000, 0.95);
/// assert_eq!(found.success.estimate, 0.01);
/// assert!((found.p_value - 0.012_939).abs() < 1e-6);
/// ```
pub fn mcnemar(only_first: u64, only_second: u64, runs: u64, confidence: f64) -> Difference {
    let half = 1.0 - (1.0 - confidence) / 2.0;
    let (first, second) =
        (clopper_pearson(only_first, runs, half), clopper_pearson(only_second, runs, half));
    let success = Interval {
        estimate: second.estimate - first.estimate,
        low: second.low - first.high,
        high: second.high - first.low,
        confidence,
    };
    let (least, all) = (only_first.min(only_second), only_first + only_second);
    let p_value = (2.0 * at_most(least, all)).min(1.0);
    Difference { only_first, only_second, success, p_value }
}

/// How likely at most so many of all fair coins show heads.
fn at_most(heads: u64, all: u64) -> f64 {
    if heads >= all {
        return 1.0;
    }
    super::beta::incomplete_beta((all - heads) as f64, heads as f64 + 1.0, 0.5)
}

/// The mean difference of a number over the same plans, second less first, with its interval.
pub fn paired_difference(pairs: &[(f64, f64)], confidence: f64) -> Interval {
    let differences: Vec<_> = pairs.iter().map(|(first, second)| second - first).collect();
    mean_interval(&differences, confidence)
}
