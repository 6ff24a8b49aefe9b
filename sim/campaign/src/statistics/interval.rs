//! Intervals for a probability and for a mean.

use super::beta::quantile;
use serde::{Deserialize, Serialize};

/// An estimate with its interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Interval {
    /// The estimate.
    pub estimate: f64,
    /// The least that is believed.
    pub low: f64,
    /// The most that is believed.
    pub high: f64,
    /// How often such an interval holds the truth, at least: from 0 to 1.
    pub confidence: f64,
}

impl Interval {
    /// Whether it holds a value.
    pub fn holds(&self, value: f64) -> bool {
        (self.low..=self.high).contains(&value)
    }
}

/// The exact interval for a probability after `hits` of `runs` (Clopper, Pearson, Biometrika 26,
/// 1934): it holds the truth at least as often as its confidence says, whatever the truth is.
///
/// ```
/// use cotama_campaign::statistics::clopper_pearson;
/// let none = clopper_pearson(0, 1_000, 0.95);
/// assert_eq!((none.estimate, none.low), (0.0, 0.0));
/// assert!((none.high - 0.003_682).abs() < 1e-6); // 3.7 in a thousand, though none was seen
/// ```
pub fn clopper_pearson(hits: u64, runs: u64, confidence: f64) -> Interval {
    let (hit, run, tail) = (hits as f64, runs as f64, (1.0 - confidence) / 2.0);
    let low = if hits == 0 { 0.0 } else { quantile(hit, run - hit + 1.0, tail) };
    let high = if hits >= runs { 1.0 } else { quantile(hit + 1.0, run - hit, 1.0 - tail) };
    let estimate = if runs == 0 { 0.0 } else { hit / run };
    Interval { estimate, low, high, confidence }
}

/// How many runs make the estimate of a probability miss it by `error` or more with a probability
/// of at most 1 less the confidence, whatever it is (Okamoto, Ann. Inst. Stat. Math. 10, 1958):
/// ln(2 / (1 − confidence)) / (2 error²), rounded up.
///
/// ```
/// use cotama_campaign::statistics::okamoto_runs;
/// assert_eq!(okamoto_runs(0.01, 0.95), 18_445);
/// ```
pub fn okamoto_runs(error: f64, confidence: f64) -> u64 {
    let runs = libm::log(2.0 / (1.0 - confidence)) / (2.0 * error * error);
    // A cast of a float keeps to the ends of the type.
    #[allow(clippy::cast_sign_loss, reason = "neither factor is below zero")]
    let whole = runs.ceil() as u64;
    whole
}

/// The interval for the mean of values that are independent and alike, by Student's distribution:
/// exact for values with a normal distribution, else the better the more values there are.
///
/// ```
/// use cotama_campaign::statistics::mean_interval;
/// let found = mean_interval(&[1.0, 2.0, 3.0, 4.0, 5.0], 0.95);
/// assert_eq!(found.estimate, 3.0);
/// assert!((found.high - 4.963_243).abs() < 1e-5);
/// ```
pub fn mean_interval(values: &[f64], confidence: f64) -> Interval {
    let count = values.len() as f64;
    let estimate = values.iter().sum::<f64>() / count;
    if values.len() < 2 {
        return Interval { estimate, low: f64::MIN, high: f64::MAX, confidence };
    }
    let squares: f64 = values.iter().map(|it| (it - estimate) * (it - estimate)).sum();
    let error = (squares / (count - 1.0) / count).sqrt();
    let half = student(count - 1.0, confidence) * error;
    Interval { estimate, low: estimate - half, high: estimate + half, confidence }
}

/// How many standard errors an interval of Student's distribution reaches to either side: t² is an
/// odds ratio of a beta variable.
fn student(freedom: f64, confidence: f64) -> f64 {
    let x = quantile(0.5, freedom / 2.0, confidence);
    (freedom * x / (1.0 - x)).sqrt()
}
