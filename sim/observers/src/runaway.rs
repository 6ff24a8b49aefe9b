//! Wheels that turn faster than they are told.

use crate::flag::Flag;
use crate::promise::{FalseAlarms, Run};
use crate::quantile::normal_quantile;
use cotama_core::units::Millis;
use cotama_devices::{Sensed, SettingsError, within};

/// An observer of motors that run away.
///
/// *Assumption.* Wheels follow the speed that is told with at most an acceleration, and reach it at
/// most one period late; the measured speed has a normal error of deviation σ.
///
/// *Threshold.* The fastest speed that the told ones allow, and zσ more; z is exceeded with a
/// chance of a thousandth, and so many periods in a row raise the flag as the promise asks for.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_devices::Sensed;
/// use cotama_observers::{FalseAlarms, Flag, Runaway};
/// let promise = FalseAlarms::per_hour(0.01).unwrap();
/// let mut runaway = Runaway::new(0.3, 0.02, Millis(100), promise).unwrap();
/// let mut look = |period: u64, told, measured| {
///     runaway.observe(Some(Sensed { taken: Millis(period * 100), value: [told, measured] }))
/// };
/// assert_eq!(look(0, 0.3, 0.30), Flag::Clear);
/// assert_eq!(look(1, 0.0, 0.28), Flag::Clear); // it brakes
/// let flags = [2, 3, 4, 5].map(|period| look(period, 0.0, 0.5));
/// assert_eq!(flags, [Flag::Clear, Flag::Clear, Flag::Raised, Flag::Raised]);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Runaway {
    acceleration: f64,
    margin: f64,
    run: Run,
    /// The fastest speed that is allowed, the speed told before, and when it was.
    last: Option<([f64; 2], Millis)>,
}

/// The chance with which the error of a speed alone passes the margin.
const CHANCE: f64 = 0.001;

impl Runaway {
    /// An observer of speeds in m/s, with the acceleration in m/s² and the error's deviation.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn new(
        acceleration: f64,
        deviation: f64,
        period: Millis,
        promise: FalseAlarms,
    ) -> Result<Self, SettingsError> {
        within("an acceleration in m/s²", acceleration, 1e-3, 100.0)?;
        within("the deviation of a speed in m/s", deviation, 0.0, 10.0)?;
        within("a period in ms", period.0 as f64, 1.0, 60_000.0)?;
        let margin = normal_quantile(CHANCE) * deviation;
        let run = Run::new(CHANCE, promise.per_decision(period));
        Ok(Self { acceleration, margin, run, last: None })
    }

    /// Looks at the speed that is told and the one that is measured, in m/s without a sign.
    pub fn observe(&mut self, speeds: Option<Sensed<[f64; 2]>>) -> Flag {
        let is_finite = |it: &Sensed<[f64; 2]>| it.value.iter().all(|it| it.is_finite());
        let Some(Sensed { taken, value }) = speeds.filter(is_finite) else { return Flag::Missing };
        let [told, measured] = value;
        let ([allowed, before], at) = self.last.unwrap_or(([told, told], taken));
        if taken > at || self.last.is_none() {
            let slower = taken.0.saturating_sub(at.0) as f64 / 1_000.0 * self.acceleration;
            let allowed = told.max(before).max(allowed - slower);
            self.run.add(measured > allowed + self.margin);
            self.last = Some(([allowed, told], taken));
        }
        Flag::raised_if(self.run.is_long())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns whether the flag is up after each speed, told and measured, a tenth of a second
    /// apart.
    fn raised(speeds: &[[f64; 2]]) -> Vec<bool> {
        let promise = FalseAlarms::per_hour(0.01).unwrap();
        let mut runaway = Runaway::new(0.3, 0.01, Millis(100), promise).unwrap();
        let each = speeds.iter().zip(0..);
        let sensed = each.map(|(value, it)| Sensed { taken: Millis(it * 100), value: *value });
        sensed.map(|it| runaway.observe(Some(it)) == Flag::Raised).collect()
    }

    /// From 0.6 m/s at 0.3 m/s²: two seconds.
    #[test]
    fn a_robot_that_brakes_as_it_can_does_not_run_away() {
        let brakes = (0..20).map(|it| [0.0, 0.6 - 0.03 * f64::from(it)]);
        let speeds: Vec<_> = [[0.6, 0.6]].into_iter().chain(brakes).collect();
        assert!(raised(&speeds).iter().all(|it| !it));
    }

    #[test]
    fn a_robot_that_brakes_half_as_hard_runs_away() {
        let brakes = (0..20).map(|it| [0.0, 0.6 - 0.015 * f64::from(it)]);
        let speeds: Vec<_> = [[0.6, 0.6]].into_iter().chain(brakes).collect();
        assert_eq!(raised(&speeds).iter().position(|it| *it), Some(6));
    }
}
