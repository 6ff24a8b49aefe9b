//! A motor and its wheel, simulated: the plant of the tests.

use super::{Mode, Side, WheelSettings, Wheels};
use crate::measured::normal;
use cotama_devices::{Stream, Streams};

/// The steps of a period.
const STEPS: usize = 10;
/// The time in which the current of a blocked motor rises, in seconds.
const RISES: f64 = 0.15;

/// Two wheels with motors, one of which may be broken.
#[derive(Clone)]
pub(crate) struct Plant {
    settings: WheelSettings,
    speeds: [f64; 2],
    blocked_for: f64,
    noise: Stream,
    pub(crate) fault: Mode,
    /// Size of the fault: the share that is lost.
    pub(crate) size: f64,
    /// Chance of a period with an encoder reading that is anything.
    pub(crate) outliers: f64,
}

impl Plant {
    pub(crate) fn new(settings: WheelSettings, seed: u64, name: &str) -> Self {
        let noise = Streams::new(seed).stream(name);
        let (speeds, fault) = ([0.0; 2], Mode::Nominal);
        Self { settings, speeds, blocked_for: 0.0, noise, fault, size: 0.0, outliers: 0.0 }
    }

    /// Drives for a period of 100 ms. A slip takes the share from the way of the left wheel.
    pub(crate) fn step(&mut self, commanded: [f64; 2]) -> Wheels {
        let (it, dt) = (self.settings, 0.1);
        let small = dt / STEPS as f64;
        let stay = libm::exp(-small / it.lag_s);
        let load = it.load * libm::sqrt(it.lag_s / 2.0 * (1.0 - stay * stay));
        let mut wheels = Wheels { dt, commanded, encoder: [0.0; 2], current: [0.0; 2], gyro: None };
        for (at, side) in [Side::Left, Side::Right].into_iter().enumerate() {
            let is = |fault: Mode| self.fault == fault;
            let weak = is(Mode::MotorWeak(side));
            let target = if weak { 1.0 - self.size } else { 1.0 } * commanded[at];
            for _ in 0..STEPS {
                let error = load * normal(&mut self.noise);
                self.speeds[at] = stay * self.speeds[at] + (1.0 - stay) * target + error;
            }
            let mut current = it.friction(self.speeds[at])[0]
                + it.acceleration * (target - self.speeds[at]) / it.lag_s;
            if is(Mode::Blocked(side)) {
                self.speeds[at] = 0.0;
                self.blocked_for += dt;
                current = it.stalled * (1.0 - libm::exp(-self.blocked_for / RISES));
                current *= (commanded[at] / it.dry_from).clamp(-1.0, 1.0);
            }
            wheels.encoder[at] = self.speeds[at] + it.noise[0] * normal(&mut self.noise);
            if is(Mode::EncoderLossy(side)) {
                wheels.encoder[at] *= 1.0 - self.size;
            }
            if is(Mode::EncoderDead(side)) {
                wheels.encoder[at] = 0.0;
            }
            wheels.current[at] = current + it.noise[1] * normal(&mut self.noise);
        }
        if self.outliers > 0.0 && self.noise.part() < self.outliers {
            let at = self.noise.below(2) as usize;
            wheels.encoder[at] = 10.0 * self.noise.part() - 5.0;
        }
        let kept = if self.fault == Mode::Slip { 1.0 - self.size } else { 1.0 };
        let turn = it.turn * (self.speeds[1] - kept * self.speeds[0]);
        wheels.gyro = Some(turn + it.noise[2] * normal(&mut self.noise));
        wheels
    }
}

/// Returns what a robot tells its wheels, in rad/s: speeds that change evenly from time to time.
pub(crate) struct Course {
    luck: Stream,
    speeds: [f64; 2],
    goal: [f64; 2],
    left: u64,
}

impl Course {
    pub(crate) fn new(seed: u64) -> Self {
        let luck = Streams::new(seed).stream("course");
        Self { luck, speeds: [0.0; 2], goal: [0.0; 2], left: 0 }
    }

    /// Goes on by a period: straight or in a turn, at 0.1 to 0.3 m/s, for 3 to 10 s.
    pub(crate) fn step(&mut self) -> [f64; 2] {
        if self.left == 0 {
            self.left = 30 + self.luck.below(70);
            let ahead = 1.0 + 2.0 * self.luck.part();
            let aside = if self.luck.below(2) == 0 { 0.0 } else { 2.0 * self.luck.part() - 1.0 };
            self.goal = [ahead - aside, ahead + aside];
        }
        self.left -= 1;
        for (speed, goal) in self.speeds.iter_mut().zip(self.goal) {
            *speed += (goal - *speed).clamp(-0.308, 0.308); // 0.3 m/s²
        }
        self.speeds
    }
}
