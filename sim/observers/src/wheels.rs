//! Wheels and motors: their signals, their models, and the filters that tell them apart.

mod bank;
#[cfg(test)]
mod confusion;
mod model;
mod observer;
#[cfg(test)]
mod simulated;

use cotama_devices::{SettingsError, within};

pub use bank::Bank;
pub use model::{MODES, Mode, Side};
pub use observer::{Diagnosis, WheelObserver, WheelRates};

/// The signals of two driven wheels over one period: left first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wheels {
    /// The length of the period, in seconds.
    pub dt: f64,
    /// The speeds that the motors were told, in rad/s of the wheel.
    pub commanded: [f64; 2],
    /// The speeds that the encoders read at the end of the period, in rad/s of the wheel.
    pub encoder: [f64; 2],
    /// The currents of the motors at the end of the period, in A.
    pub current: [f64; 2],
    /// The turn of the robot to the left at the end of the period, in rad/s; `None` without gyro.
    pub gyro: Option<f64>,
}

impl Wheels {
    pub(crate) fn is_finite(&self) -> bool {
        let numbers = self.commanded.iter().chain(&self.encoder).chain(&self.current);
        let all = numbers.chain(self.gyro.as_ref()).all(|it| it.abs() < 1e6);
        all && (1e-3..=1.0).contains(&self.dt)
    }
}

/// Properties of wheels and motors that are sound.
///
/// A wheel follows its command u as ω' = (u - ω) / τ; its motor draws
/// `c_v ω + c_c sat(ω / ω_c) + c_a ω'`: viscous and dry friction, and acceleration (Isermann,
/// Fault-Diagnosis Applications, Springer 2011, Chapter 3, a motor with its load, over the torque
/// constant).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelSettings {
    /// The time constant τ of the speed control, in seconds.
    pub lag_s: f64,
    /// Viscous friction `c_v`, in A per rad/s.
    pub viscous: f64,
    /// Dry friction `c_c`, in A.
    pub dry: f64,
    /// The speed `ω_c` above which dry friction is whole, in rad/s.
    pub dry_from: f64,
    /// The current of acceleration `c_a`, in A per rad/s².
    pub acceleration: f64,
    /// The current of a motor whose wheel is blocked, in A.
    pub stalled: f64,
    /// The turn of the robot per difference of the speeds of the wheels: radius over axle.
    pub turn: f64,
    /// Deviation of the speed that the load would add over a second without control, in rad/s.
    pub load: f64,
    /// Deviations of encoder (rad/s), current (A) and gyro (rad/s).
    pub noise: [f64; 3],
    /// Chance that a reading is an outlier, which may be anything over a spread in its unit.
    pub outliers: f64,
    /// The spread of outliers.
    pub spread: f64,
}

impl WheelSettings {
    /// The wheels of a Pioneer 3-DX: radius 0.0975 m, axle 0.33 m (Webots, `Pioneer3dx.proto`).
    ///
    /// Assumed, as no public source has them: all others. The current of acceleration is that of
    /// 4.5 kg on each wheel, with 0.8 N m/A.
    pub const fn pioneer() -> Self {
        Self {
            lag_s: 0.15,
            viscous: 0.03,
            dry: 0.1,
            dry_from: 0.3,
            acceleration: 0.054,
            stalled: 1.5,
            turn: 0.0975 / 0.33,
            load: 0.15,
            noise: [0.03, 0.04, 0.015],
            outliers: 1e-3,
            spread: 10.0,
        }
    }

    fn check(&self) -> Result<(), SettingsError> {
        within("the lag of a wheel in s", self.lag_s, 0.01, 10.0)?;
        within("the viscous friction in A per rad/s", self.viscous, 0.0, 100.0)?;
        within("the dry friction in A", self.dry, 0.0, 100.0)?;
        within("the speed of whole dry friction in rad/s", self.dry_from, 1e-3, 100.0)?;
        within("the current of acceleration in A per rad/s²", self.acceleration, 0.0, 100.0)?;
        within("the current of a blocked wheel in A", self.stalled, 0.0, 1_000.0)?;
        within("the turn per difference of wheels", self.turn, 1e-3, 100.0)?;
        within("the deviation of the load in rad/s", self.load, 1e-6, 100.0)?;
        within("the chance of an outlier", self.outliers, 0.0, 0.5)?;
        within("the spread of outliers", self.spread, 1e-3, 1e6)?;
        self.noise.iter().try_for_each(|it| within("a deviation of a reading", *it, 1e-6, 100.0))
    }

    /// Returns the current of friction at a speed, and how it changes with the speed.
    pub(crate) fn friction(&self, speed: f64) -> [f64; 2] {
        let part = speed / self.dry_from;
        let slope = if part.abs() < 1.0 { self.dry / self.dry_from } else { 0.0 };
        [self.viscous * speed + self.dry * part.clamp(-1.0, 1.0), self.viscous + slope]
    }
}
