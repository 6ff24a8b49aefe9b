//! Models of sound and of faulty wheels: prediction of a state, expectation of its readings.

use super::{WheelSettings, Wheels};
use nalgebra::{Matrix2, RowVector2, Vector2};

/// The models, in the order of their numbers.
pub const MODES: [Mode; 10] = [
    Mode::Nominal,
    Mode::EncoderDead(Side::Left),
    Mode::EncoderDead(Side::Right),
    Mode::EncoderLossy(Side::Left),
    Mode::EncoderLossy(Side::Right),
    Mode::MotorWeak(Side::Left),
    Mode::MotorWeak(Side::Right),
    Mode::Blocked(Side::Left),
    Mode::Blocked(Side::Right),
    Mode::Slip,
];

/// A side of the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The left wheel.
    Left,
    /// The right wheel.
    Right,
}

/// A state of the wheels and motors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// All is sound.
    Nominal,
    /// The encoder reads 0.
    EncoderDead(Side),
    /// The encoder loses a part of its counts: 5 to 30 %.
    EncoderLossy(Side),
    /// The motor reaches a part of the speed that it is told: 50 to 80 %.
    MotorWeak(Side),
    /// The wheel stands though its motor pushes.
    Blocked(Side),
    /// The ground does not follow the wheels: the robot turns otherwise than they do.
    Slip,
}

/// The share of counts that a lossy encoder keeps, and its deviation.
const KEPT: [f64; 2] = [0.88, 0.06];
/// The share of its speed that a weak motor reaches, and its deviation.
const REACHED: [f64; 2] = [0.65, 0.1];
/// The deviation of the current of a blocked wheel, as a share of it: it rises by and by.
const STALLED: f64 = 0.4;
/// The deviation of the turn that slip adds, in rad/s.
const SLIP: f64 = 0.3;

/// A period as all models see it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Period {
    pub(crate) command: Vector2<f64>,
    /// The part of a difference that stays over it: exp(-T/τ).
    pub(crate) stay: f64,
    /// The variance that the load adds over it: white acceleration of density q², which the speed
    /// control damps, makes q² τ / 2 (1 - exp(-2T/τ)).
    load: f64,
}

impl Period {
    pub(crate) fn of(settings: &WheelSettings, wheels: &Wheels) -> Self {
        let stay = libm::exp(-wheels.dt / settings.lag_s);
        let load = settings.load * settings.load * settings.lag_s / 2.0 * (1.0 - stay * stay);
        Self { command: Vector2::from(wheels.commanded), stay, load }
    }
}

/// A reading as a model expects it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Expected {
    pub(crate) value: f64,
    /// Slope of the reading over the speeds of the wheels.
    pub(crate) slope: RowVector2<f64>,
    pub(crate) variance: f64,
}

impl Mode {
    /// Returns the state of one side: that of its fault, or nominal if the fault is elsewhere.
    fn at(self, side: Side) -> Self {
        let hit = match self {
            Self::EncoderDead(it)
            | Self::EncoderLossy(it)
            | Self::MotorWeak(it)
            | Self::Blocked(it) => Some(it),
            Self::Nominal | Self::Slip => None,
        };
        if hit == Some(side) { self } else { Self::Nominal }
    }

    /// Returns the speed that a motor goes for, and the deviation of that as the model is rough.
    fn target(self, side: Side, command: f64) -> [f64; 2] {
        match self.at(side) {
            Self::MotorWeak(_) => [REACHED[0] * command, REACHED[1] * command],
            Self::Blocked(_) => [0.0, 0.0],
            _ => [command, 0.0],
        }
    }

    /// Returns the speeds and their covariance after a period, from those before it.
    pub(crate) fn predict(
        self,
        period: &Period,
        state: Vector2<f64>,
        covariance: Matrix2<f64>,
    ) -> (Vector2<f64>, Matrix2<f64>) {
        let Period { command, stay, load } = *period;
        let (mut next, mut keep) = (state, Matrix2::identity() * stay);
        let mut noise = Matrix2::identity() * load;
        for (at, side) in [Side::Left, Side::Right].into_iter().enumerate() {
            let [target, rough] = self.target(side, command[at]);
            next[at] = stay * state[at] + (1.0 - stay) * target;
            noise[(at, at)] += (1.0 - stay) * (1.0 - stay) * rough * rough;
            if let Self::Blocked(_) = self.at(side) {
                next[at] = 0.0;
                keep[(at, at)] = 0.0;
                noise[(at, at)] = 1e-6;
            }
        }
        (next, keep * covariance * keep + noise)
    }

    /// Returns the reading of an encoder.
    pub(crate) fn encoder(
        self,
        settings: &WheelSettings,
        side: Side,
        state: &Vector2<f64>,
    ) -> Expected {
        let at = side as usize;
        let noise = settings.noise[0] * settings.noise[0];
        let (share, rough) = match self.at(side) {
            Self::EncoderDead(_) => (0.0, 0.0),
            Self::EncoderLossy(_) => (KEPT[0], KEPT[1] * state[at]),
            _ => (1.0, 0.0),
        };
        let mut slope = RowVector2::zeros();
        slope[at] = share;
        Expected { value: share * state[at], slope, variance: noise + rough * rough }
    }

    /// Returns the reading of a current.
    pub(crate) fn current(
        self,
        settings: &WheelSettings,
        side: Side,
        state: &Vector2<f64>,
        command: Vector2<f64>,
    ) -> Expected {
        let at = side as usize;
        let noise = settings.noise[1] * settings.noise[1];
        let mut slope = RowVector2::zeros();
        if let Self::Blocked(_) = self.at(side) {
            // A controller that is told to stand pushes less the slower it was told to go.
            let value = settings.stalled * (command[at] / settings.dry_from).clamp(-1.0, 1.0);
            let rough = STALLED * value;
            return Expected { value, slope, variance: noise + rough * rough };
        }
        let [target, rough] = self.target(side, command[at]);
        let [friction, change] = settings.friction(state[at]);
        let lag = settings.acceleration / settings.lag_s;
        slope[at] = change - lag;
        let rough = lag * rough;
        let value = friction + lag * (target - state[at]);
        Expected { value, slope, variance: noise + rough * rough }
    }

    /// Returns the reading of the gyro.
    pub(crate) fn gyro(self, settings: &WheelSettings, state: &Vector2<f64>) -> Expected {
        let slope = RowVector2::new(-settings.turn, settings.turn);
        let slips = if self == Self::Slip { SLIP * SLIP } else { 0.0 };
        let variance = settings.noise[2] * settings.noise[2] + slips;
        Expected { value: (slope * state).x, slope, variance }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SETTINGS: WheelSettings = WheelSettings::pioneer();

    fn after(mode: Mode, from: [f64; 2], command: [f64; 2], periods: usize) -> Vector2<f64> {
        let mut state = (Vector2::from(from), Matrix2::identity() * 0.01);
        for _ in 0..periods {
            let wheels = Wheels {
                dt: 0.1,
                commanded: command,
                encoder: [0.0; 2],
                current: [0.0; 2],
                gyro: None,
            };
            state = mode.predict(&Period::of(&SETTINGS, &wheels), state.0, state.1);
        }
        state.0
    }

    #[test]
    fn a_wheel_is_63_percent_there_after_its_lag() {
        let now = after(Mode::Nominal, [0.0, 3.0], [3.0, 3.0], 1);
        let part = 1.0 - libm::exp(-0.1 / 0.15);
        assert_eq!([now.x, now.y], [part * 3.0, 3.0]);
    }

    #[test]
    fn a_fault_of_a_side_leaves_the_other_side() {
        let weak = after(Mode::MotorWeak(Side::Left), [0.0; 2], [2.0, 2.0], 50);
        assert_eq!(format!("{:.3} {:.3}", weak.x, weak.y), "1.300 2.000");
        let blocked = after(Mode::Blocked(Side::Right), [2.0; 2], [2.0, 2.0], 1);
        assert_eq!([blocked.x, blocked.y], [2.0, 0.0]);
    }

    #[test]
    fn readings_of_each_model_are_those_of_its_fault() {
        let (state, command) = (Vector2::new(2.0, 1.0), Vector2::new(2.0, 1.0));
        let encoder = |mode: Mode| mode.encoder(&SETTINGS, Side::Left, &state).value;
        let current = |mode: Mode| {
            format!("{:.3}", mode.current(&SETTINGS, Side::Left, &state, command).value)
        };
        assert_eq!(encoder(Mode::Nominal), 2.0);
        assert_eq!(encoder(Mode::EncoderDead(Side::Left)), 0.0);
        assert_eq!(encoder(Mode::EncoderDead(Side::Right)), 2.0);
        assert_eq!(encoder(Mode::EncoderLossy(Side::Left)), 1.76);
        assert_eq!(current(Mode::Nominal), "0.160"); // 0.03 · 2 + 0.1
        assert_eq!(current(Mode::Blocked(Side::Left)), "1.500");
        assert_eq!(current(Mode::MotorWeak(Side::Left)), "-0.092"); // it slows down
        // The right wheel is slower: it turns to the right.
        assert_eq!(Mode::Nominal.gyro(&SETTINGS, &state).value, -0.0975 / 0.33);
    }
}
