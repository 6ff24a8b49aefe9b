//! Motors on the wheels: the current that a torque takes, and the speed that a voltage allows.

use cotama_core::units::Millis;
use cotama_models::robots;

/// A motor with its gear on each wheel, in SI units at the wheel.
///
/// A direct-current motor: torque is `k` times the current, the voltage of a turning motor `k`
/// times its speed, and the rest of the supply falls at the winding (Siciliano, Sciavicco, Villani,
/// Oriolo, Robotics, 2009, without the inductance, which is quick).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motors {
    /// Torque for a current, in Nm/A, and voltage for a speed, in Vs.
    pub constant: f64,
    /// The voltage for which they are made.
    pub voltage: f64,
    /// The resistance of a winding, in Ω.
    pub resistance: f64,
    /// The current that a motor never exceeds, in A.
    pub limit: f64,
    /// The force that rolling takes, over the weight.
    pub rolling: f64,
    /// The mass of the robot, in kg.
    pub mass: f64,
    /// Time for which a wheel is held before its motor counts as stalled.
    pub stall: Millis,
}

/// The acceleration of free fall, in m/s² (ISO 80000-3).
const FALL: f64 = 9.806_65;

/// The wheels as a load of the motors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Load {
    /// The mass that is moved, in kg.
    pub(crate) mass: f64,
    /// Radius of the body, of the wheels, and distance between these, in metres.
    pub(crate) radius: f64,
    pub(crate) wheel: f64,
    pub(crate) axle: f64,
}

impl Motors {
    /// Returns the motors of a file.
    pub fn of(file: &robots::Motors) -> Self {
        let milli = |it: u64| it as f64 / 1_000.0;
        Self {
            constant: milli(file.voltage_mv) / milli(file.no_load_mrad_s),
            voltage: milli(file.voltage_mv),
            resistance: milli(file.resistance_mohm),
            limit: milli(file.limit_ma),
            rolling: milli(file.rolling_permille),
            mass: milli(file.mass_g),
            stall: file.stall,
        }
    }

    /// Returns how fast a wheel turns at most, in rad/s, while it rolls evenly.
    pub(crate) fn fastest(&self, voltage: f64, load: &Load) -> f64 {
        let current = self.rolls(load) / self.constant;
        ((voltage - current * self.resistance) / self.constant).max(0.0)
    }

    /// Returns the torques that two wheels need: half of the force of the mass and of rolling each,
    /// and apart what turns a disc of even mass. Speeds are gained in m/s² and rad/s².
    pub(crate) fn torques(&self, load: &Load, rates: [f64; 2], gained: [f64; 2]) -> [f64; 2] {
        let [gained, turns] = gained;
        let inertia = load.mass * load.radius * load.radius / 2.0;
        let ahead = load.mass * gained / 2.0 * load.wheel;
        let apart = inertia * turns / load.axle * load.wheel;
        let rolls = rates.map(|it| if it == 0.0 { 0.0 } else { self.rolls(load).copysign(it) });
        let [left, right] = rolls;
        [left + (ahead - apart), right + (ahead + apart)]
    }

    /// Returns current and power, in A and W, of a motor that turns a wheel; braking gives nothing
    /// back.
    pub(crate) fn turning(&self, rate: f64, torque: f64) -> (f64, f64) {
        let current = (torque / self.constant).clamp(-self.limit, self.limit);
        let power = self.constant * current * rate + self.resistance * current * current;
        (current.abs(), power.max(0.0))
    }

    /// Returns current and power of a motor whose wheel cannot turn: all that limit and supply
    /// give.
    pub(crate) fn held(&self, voltage: f64) -> (f64, f64) {
        let current = self.limit.min(voltage / self.resistance);
        (current, self.resistance * current * current)
    }

    /// Returns the torque of a wheel for half of the force that rolling takes.
    fn rolls(&self, load: &Load) -> f64 {
        self.rolling * load.mass * FALL / 2.0 * load.wheel
    }
}
