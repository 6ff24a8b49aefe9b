//! The turn of a robot by its gyro against that by its encoders.

use crate::flag::Flag;
use crate::pose::OdometryErrors;
use crate::promise::FalseAlarms;
use crate::quantile::normal_quantile;
use cotama_core::units::Millis;
use cotama_devices::{Sensed, SettingsError, within};
use nalgebra::Isometry2;

/// Two estimates of the turn at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// The turn of the robot by its gyro, in rad/s to the left.
    pub gyro: f64,
    /// The pose by the encoders.
    pub odometry: Isometry2<f64>,
}

/// An observer of the angle by which gyro and encoders have turned the robot over a window.
///
/// *Assumption.* The gyro has a normal bias of deviation β, and independent errors of deviation σ
/// in each reading; encoders err by a normal angle of variance d² s + t² |φ| over a way s and a
/// turn φ ([`OdometryErrors`]). The angle by the gyro is summed by the trapezoid rule.
///
/// *Threshold.* Over a window W of readings each T, the difference is normal, of variance
/// β² W² + σ² T W + d² s + t² |φ|, and exceeds z(p/2) deviations with the chance p of a decision;
/// there is one decision a window.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_devices::Sensed;
/// use cotama_observers::{FalseAlarms, Flag, OdometryErrors, Turn, Turns};
/// use nalgebra::Isometry2;
/// let promise = FalseAlarms::per_hour(0.36).unwrap();
/// let errors = OdometryErrors::pioneer();
/// let mut turns = Turns::new(errors, [0.001, 0.002], Millis(2_000), promise).unwrap();
/// // Wheels that slip: by them it turns at 0.5 rad/s, by the gyro at 0.3.
/// let slips = |step: u64| {
///     let odometry = Isometry2::rotation(0.05 * step as f64);
///     Some(Sensed { taken: Millis(step * 100), value: Turn { gyro: 0.3, odometry } })
/// };
/// let flags: Vec<_> = (0..=20).map(|it| turns.observe(slips(it))).collect();
/// assert_eq!(flags[19..], [Flag::Clear, Flag::Raised]);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Turns {
    errors: OdometryErrors,
    /// Deviations of the gyro: its bias, and a reading.
    gyro: [f64; 2],
    window: u64,
    z: f64,
    began: Option<Millis>,
    last: Option<Sensed<Turn>>,
    /// The difference of the angles so far, and the variance of the errors.
    apart: f64,
    variance: f64,
    flag: Flag,
}

impl Turns {
    /// An observer of a gyro whose bias and readings have these deviations, in rad/s.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn new(
        errors: OdometryErrors,
        gyro: [f64; 2],
        window: Millis,
        promise: FalseAlarms,
    ) -> Result<Self, SettingsError> {
        errors.check()?;
        within("the deviation of the bias in rad/s", gyro[0], 0.0, 10.0)?;
        within("the deviation of a turn in rad/s", gyro[1], 0.0, 10.0)?;
        within("a window in ms", window.0 as f64, 1.0, 600_000.0)?;
        let z = normal_quantile(promise.per_decision(window) / 2.0);
        let (began, last, flag) = (None, None, Flag::Clear);
        let window = window.0;
        Ok(Self { errors, gyro, window, z, began, last, apart: 0.0, variance: 0.0, flag })
    }

    /// Looks at the newest turn; one that was seen before counts once. Readings that stop end the
    /// window: what was between them is not known.
    pub fn observe(&mut self, turn: Option<Sensed<Turn>>) -> Flag {
        let Some(now) = turn.filter(|it| it.value.gyro.abs() < 1e6) else {
            (self.began, self.last) = (None, None);
            return Flag::Missing;
        };
        let Some(last) = self.last.replace(now) else {
            self.begin(now.taken);
            return self.flag;
        };
        if now.taken <= last.taken {
            return self.flag;
        }
        let seconds = (now.taken.0 - last.taken.0) as f64 / 1_000.0;
        let step = last.value.odometry.inv_mul(&now.value.odometry);
        let (turned, way) = (step.rotation.angle(), step.translation.vector.norm());
        self.apart += f64::midpoint(last.value.gyro, now.value.gyro) * seconds - turned;
        let [_, noise] = self.gyro;
        let OdometryErrors { drift, turn, .. } = self.errors;
        self.variance += noise * noise * seconds * seconds;
        self.variance += drift * drift * way + turn * turn * turned.abs();
        let began = self.began.unwrap_or(last.taken);
        let lasts = now.taken.0.saturating_sub(began.0);
        if lasts >= self.window {
            let bias = self.gyro[0] * lasts as f64 / 1_000.0;
            let deviation = libm::sqrt(self.variance + bias * bias);
            self.flag = Flag::raised_if(self.apart.abs() > self.z * deviation);
            self.begin(now.taken);
        }
        self.flag
    }

    fn begin(&mut self, now: Millis) {
        (self.began, self.apart, self.variance) = (Some(now), 0.0, 0.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measured::{Measured, normal};
    use cotama_devices::Streams;

    /// A robot that drives at 0.4 m/s and turns at 0.3 rad/s, each window with another bias.
    #[test]
    fn turns_of_gyro_and_encoders_are_apart_as_often_as_promised() {
        let often = FalseAlarms::per_hour(36.0).unwrap();
        let (errors, gyro) = (OdometryErrors::pioneer(), [0.01, 0.02]);
        let mut turns = Turns::new(errors, gyro, Millis(2_000), often).unwrap();
        let mut noise = Streams::new(5).stream("turns");
        let mut measured = Measured::of(often.per_decision(Millis(2_000)));
        let (mut odometry, mut bias) = (Isometry2::identity(), 0.0);
        for step in 0..=2_000_000_u64 {
            if step > 0 {
                let err = errors.drift * errors.drift * 0.04 + errors.turn * errors.turn * 0.03;
                let turned = 0.03 + libm::sqrt(err) * normal(&mut noise);
                odometry *= Isometry2::new([0.04, 0.0].into(), turned);
            }
            let value = Turn { gyro: 0.3 + bias + 0.02 * normal(&mut noise), odometry };
            let flag = turns.observe(Some(Sensed { taken: Millis(step * 100), value }));
            if step > 0 && step % 20 == 0 {
                measured.decision(flag);
                bias = 0.01 * normal(&mut noise);
            }
        }
        measured.tell("turns");
        measured.is_at_most_promised("turns");
    }

    #[test]
    fn a_gyro_that_is_silent_says_nothing_and_begins_anew() {
        let often = FalseAlarms::per_hour(36.0).unwrap();
        let errors = OdometryErrors::pioneer();
        let mut turns = Turns::new(errors, [0.0, 0.001], Millis(1_000), often).unwrap();
        let mut at = |now: u64, gyro: Option<f64>| {
            let value = gyro.map(|gyro| Turn { gyro, odometry: Isometry2::identity() });
            turns.observe(value.map(|value| Sensed { taken: Millis(now), value }))
        };
        assert_eq!(at(0, Some(1.0)), Flag::Clear);
        assert_eq!(at(900, None), Flag::Missing);
        assert_eq!([at(1_000, Some(1.0)), at(1_900, Some(1.0))], [Flag::Clear; 2]);
        assert_eq!(at(2_000, Some(1.0)), Flag::Raised);
    }
}
