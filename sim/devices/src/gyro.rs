//! Gyros.

use crate::faults::Faults;
use crate::sensed::{Clock, Pipe, Rate, Sensed};
use crate::settings::{SettingsError, within};
use cotama_core::units::Millis;
use cotama_streams::{Stream, Streams};

/// Properties of a gyro.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GyroSettings {
    /// Deviation of its bias, in rad/s: the bias is drawn once.
    pub bias: f64,
    /// Deviation of a reading, in rad/s.
    pub noise: f64,
    /// Times of readings.
    pub rate: Rate,
}

/// A gyro: it reads how fast the robot turns to the left, with a bias and noise (the constant and
/// the white part of the errors of Woodman, "An introduction to inertial navigation", University
/// of Cambridge, UCAM-CL-TR-696, 2007, Section 3.2).
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_devices::{Gyro, GyroSettings, Rate, Streams};
/// let rate = Rate { period: Millis(100), latency: Millis(20) };
/// let settings = GyroSettings { bias: 0.001, noise: 0.0, rate };
/// let mut gyro = Gyro::new(&settings, &Streams::new(7), "gyro").unwrap();
/// let mut read = |now: u64, turn| {
///     gyro.sense(Millis(now), turn);
///     gyro.latest(Millis(now + 20)).unwrap().value
/// };
/// let bias = read(0, 0.0);
/// assert!(bias != 0.0 && bias.abs() < 0.005);
/// assert_eq!(read(100, 0.5), 0.5 + bias);
/// ```
#[derive(Clone, Debug)]
pub struct Gyro {
    bias: f64,
    noise: f64,
    clock: Clock,
    stream: Stream,
    faults: Faults,
    pipe: Pipe<f64>,
}

impl Gyro {
    /// A gyro of a name, after which its random numbers are named.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn new(
        settings: &GyroSettings,
        streams: &Streams,
        name: &str,
    ) -> Result<Self, SettingsError> {
        let GyroSettings { bias, noise, rate } = *settings;
        within("the deviation of the bias in rad/s", bias, 0.0, 10.0)?;
        within("the deviation of a turn in rad/s", noise, 0.0, 10.0)?;
        let mut stream = streams.stream(name);
        let bias = stream.error() * bias;
        let (clock, pipe) = (Clock::new(rate.period), Pipe::new(1, 0.0, rate)?);
        Ok(Self { bias, noise, clock, stream, faults: Faults::none(1, rate.period), pipe })
    }

    /// Returns the faults of its readings, to be replaced.
    pub fn faults(&mut self) -> &mut Faults {
        &mut self.faults
    }

    /// Takes a reading if one is due, of a robot that turns so fast, in rad/s to the left.
    pub fn sense(&mut self, now: Millis, turn: f64) {
        if !self.clock.strikes(now) {
            return;
        }
        let mut frame = [turn + self.bias + self.stream.error() * self.noise];
        if self.faults.apply(now, &mut frame) {
            self.pipe.push(now, &frame);
        }
    }

    /// Returns the newest reading that has arrived, in rad/s.
    pub fn latest(&self, now: Millis) -> Option<Sensed<f64>> {
        let Sensed { taken, value } = self.pipe.latest(now)?;
        value.first().map(|it| Sensed { taken, value: *it })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fault::{Fault, Mode};

    const RATE: Rate = Rate { period: Millis(100), latency: Millis(0) };

    #[test]
    fn a_gyro_that_drifts_reads_more_and_more_and_a_dead_one_nothing_new() {
        let settings = GyroSettings { bias: 0.0, noise: 0.0, rate: RATE };
        let streams = Streams::new(3);
        let mut gyro = Gyro::new(&settings, &streams, "gyro").unwrap();
        let drift = Fault::new(Mode::Drift { per_s: 0.01, most: 0.02 }).unwrap();
        gyro.faults().replace(&[drift.from(Millis(1_000))], &streams, "gyro").unwrap();
        let read = |gyro: &mut Gyro, now: u64| {
            gyro.sense(Millis(now), 0.0);
            gyro.latest(Millis(now)).unwrap()
        };
        assert_eq!(
            [0, 1_000, 2_000, 9_000].map(|now| read(&mut gyro, now).value),
            [0.0, 0.0, 0.01, 0.02]
        );
        let dead = Fault::new(Mode::DropOut(1.0)).unwrap();
        gyro.faults().replace(&[dead], &streams, "gyro").unwrap();
        assert_eq!(read(&mut gyro, 9_500).taken, Millis(9_000));
    }
}
