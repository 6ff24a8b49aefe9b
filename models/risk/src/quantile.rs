//! Quantiles of costs, by both conventions.

/// Sums of probabilities as near as this to a level have reached it.
const REACHED: f64 = 1e-12;

/// A convention for the quantile of a distribution function with flat parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Convention {
    /// The least value whose probability of not being passed is at least the level, `inf { x : s <=
    /// F(x) }` (Rohrmueller 2011, eq. 4.20).
    Reached,
    /// The least value for which it is more than the level, `inf { x : s < F(x) }` (eq. 4.21).
    Passed,
}

/// The quantile of values with probabilities, at a level from 0 to 1; none without a value that
/// has some probability.
///
/// ```
/// use cotama_risk::{Convention, quantile};
/// let times = [(10.0, 0.5), (20.0, 0.25), (40.0, 0.25)];
/// assert_eq!(quantile(&times, 0.5, Convention::Reached), Some(10.0));
/// assert_eq!(quantile(&times, 0.5, Convention::Passed), Some(20.0));
/// assert_eq!(quantile(&times, 0.75, Convention::Reached), Some(20.0));
/// assert_eq!(quantile(&times, 1.0, Convention::Passed), Some(40.0)); // the largest there is
/// ```
pub fn quantile(values: &[(f64, f64)], level: f64, convention: Convention) -> Option<f64> {
    let mut sorted: Vec<_> = values.iter().copied().filter(|it| it.1 > 0.0).collect();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let total: f64 = sorted.iter().map(|it| it.1).sum();
    let wanted = level * total;
    let mut sum = 0.0;
    for (at, (value, share)) in sorted.iter().enumerate() {
        sum += share;
        // Equal values are one.
        if sorted.get(at + 1).is_some_and(|next| next.0 <= *value) {
            continue;
        }
        let is_reached = match convention {
            Convention::Reached => sum >= wanted - REACHED,
            Convention::Passed => sum > wanted + REACHED,
        };
        if is_reached {
            return Some(*value);
        }
    }
    sorted.last().map(|it| it.0)
}
