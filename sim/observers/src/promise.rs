//! Promised rates of false alarms, and what they leave to one decision.

use cotama_core::units::Millis;
use cotama_devices::{SettingsError, within};

/// Rate at which an observer may raise its flag though all is sound.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_observers::FalseAlarms;
/// let rare = FalseAlarms::per_hour(0.36).unwrap();
/// assert_eq!(format!("{:.3e}", rare.per_decision(Millis(100))), "1.000e-5");
/// assert!(FalseAlarms::per_hour(0.0).is_err()); // nothing decides without errors
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FalseAlarms {
    per_hour: f64,
}

impl FalseAlarms {
    /// False alarms per hour, from 10⁻⁹ to 3,600.
    ///
    /// # Errors
    /// A rate that is out of range.
    pub fn per_hour(rate: f64) -> Result<Self, SettingsError> {
        within("the false alarms per hour", rate, 1e-9, 3_600.0)?;
        Ok(Self { per_hour: rate })
    }

    /// Returns the false alarms per hour.
    pub const fn rate(self) -> f64 {
        self.per_hour
    }

    /// Returns the chance of a false alarm that is left to each decision, if there is one in each
    /// period T: 1 - exp(-λT), as alarms at the rate λ come by Poisson's law.
    pub fn per_decision(self, period: Millis) -> f64 {
        -libm::expm1(-self.per_hour * period.0 as f64 / 3_600_000.0)
    }

    /// Returns an equal share of the rate, for each of some tests. The sum of their rates bounds
    /// the rate at which any of them alarms (Bonferroni), however they depend on each other.
    #[must_use]
    pub fn shared_by(self, tests: u32) -> Self {
        Self { per_hour: self.per_hour / f64::from(tests.max(1)) }
    }
}

/// Returns how many bad periods in a row a sound thing has so seldom that it may be an alarm.
///
/// Periods are bad with the chance `bad`, independently. An alarm of `k` in a row begins in a
/// period if that and the `k` - 1 before are bad and the one before is good: (1 - bad) badᵏ. The
/// result is the least `k` at which this is at most `chance`, and at most 1,000,000.
///
/// ```
/// use cotama_observers::in_a_row;
/// // One job in a hundred is late: 3 late ones in a row come once in 1,010,101 periods.
/// assert_eq!(in_a_row(0.01, 1e-6), 3);
/// assert_eq!(in_a_row(0.5, 1e-5), 16);
/// assert_eq!(in_a_row(0.0, 1e-5), 1);
/// ```
pub fn in_a_row(bad: f64, chance: f64) -> u32 {
    let bad = bad.clamp(0.0, 1.0);
    let mut rate = 1.0 - bad;
    for length in 1..1_000_000 {
        rate *= bad;
        if rate <= chance {
            return length;
        }
    }
    1_000_000
}

/// Bad periods in a row, and how many are too many.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Run {
    length: u32,
    most: u32,
}

impl Run {
    /// A run whose alarms begin no more often than with a chance per period.
    pub(crate) fn new(bad: f64, chance: f64) -> Self {
        Self { length: 0, most: in_a_row(bad, chance) }
    }

    pub(crate) const fn most(&self) -> u32 {
        self.most
    }

    pub(crate) fn add(&mut self, is_bad: bool) {
        self.length = if is_bad { self.length.saturating_add(1) } else { 0 };
    }

    pub(crate) const fn is_long(&self) -> bool {
        self.length >= self.most
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_is_as_short_as_the_promise_allows() {
        for (bad, chance) in [(0.3_f64, 1e-4), (0.05, 1e-7), (0.9, 1e-3)] {
            let length = f64::from(in_a_row(bad, chance));
            let begins = |it| (1.0 - bad) * libm::pow(bad, it);
            assert!(begins(length) <= chance && begins(length - 1.0) > chance, "{bad}");
        }
        // A thing that is always bad never begins to be.
        assert_eq!(in_a_row(1.0, 1e-3), 1);
    }

    #[test]
    fn a_share_is_the_rate_over_the_number_of_tests() {
        let all = FalseAlarms::per_hour(16.0).unwrap();
        assert_eq!(all.shared_by(16).rate(), 1.0);
        assert_eq!(all.shared_by(0), all);
        assert_eq!(FalseAlarms::per_hour(f64::NAN).unwrap_err().name, "the false alarms per hour");
    }
}
