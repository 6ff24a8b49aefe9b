//! A sequential test: runs until it is decided whether a probability is small enough.

use libm::log;
use std::fmt;

/// The sequential probability ratio test (Wald, Ann. Math. Stat. 16, 1945): is the probability of
/// failure at most `low`, or at least `high`? Between both, either answer is right.
///
/// ```
/// use cotama_campaign::statistics::{Decision, Sprt};
/// let mut test = Sprt::new(0.005, 0.01, 0.95).unwrap();
/// let decided = (1..).find(|_| test.add(false).is_some());
/// assert_eq!((decided, test.decision()), (Some(595), Some(Decision::Small)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sprt {
    low: f64,
    high: f64,
    /// Amounts that a failure and a success add to the logarithm of the likelihood ratio, high over
    /// low.
    failure: f64,
    success: f64,
    bound: f64,
    ratio: f64,
    runs: u64,
    decided: Option<Decision>,
}

/// The decision of a sequential test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Decision {
    /// The probability is below `high`: an error, if it is not, is as unlikely as was asked.
    Small,
    /// The probability is above `low`, with the same meaning.
    Large,
}

/// Numbers that no test is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SprtError;

impl fmt::Display for SprtError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a sequential test needs 0 < low < high < 1 and a confidence from 0.5 up to 1")
    }
}

impl std::error::Error for SprtError {}

impl Sprt {
    /// A test whose both errors have a probability of at most 1 less the confidence.
    ///
    /// # Errors
    /// When the numbers make no test.
    pub fn new(low: f64, high: f64, confidence: f64) -> Result<Self, SprtError> {
        if !(0.0 < low && low < high && high < 1.0 && (0.5..1.0).contains(&confidence)) {
            return Err(SprtError);
        }
        Ok(Self {
            low,
            high,
            failure: log(high / low),
            success: log((1.0 - high) / (1.0 - low)),
            // Not Wald's own bounds, which keep the sum of both errors only.
            bound: -log(1.0 - confidence),
            ratio: 0.0,
            runs: 0,
            decided: None,
        })
    }

    /// One more run; what is decided by now.
    pub fn add(&mut self, failed: bool) -> Option<Decision> {
        if self.decided.is_none() {
            self.runs += 1;
            self.ratio += if failed { self.failure } else { self.success };
            self.decided = if self.ratio >= self.bound {
                Some(Decision::Large)
            } else if self.ratio <= -self.bound {
                Some(Decision::Small)
            } else {
                None
            };
        }
        self.decided
    }

    /// Returns the decision, once there is one.
    pub const fn decision(&self) -> Option<Decision> {
        self.decided
    }

    /// After how many runs it was decided, or how many there were.
    pub const fn runs(&self) -> u64 {
        self.runs
    }

    /// Returns the two probabilities.
    pub const fn between(&self) -> (f64, f64) {
        (self.low, self.high)
    }
}
