//! The wheels of a robot, and the shape that they carry.

use crate::battery::Battery;
use crate::motors::Motors;
use cotama_floor::Footprint;
use cotama_models::robots::{Body, Wheels};

/// Two driven wheels on one axle, in SI units.
///
/// ```
/// use cotama_models::robots::Robot;
/// use cotama_plane::Drivetrain;
/// let robot = Robot::shipped("p3dx-delivery").unwrap();
/// let drivetrain = Drivetrain::of(robot.body.as_ref().unwrap());
/// assert_eq!((drivetrain.speed, drivetrain.wheel, drivetrain.axle), (0.3, 0.0975, 0.33));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Drivetrain {
    /// The highest speed, in m/s.
    pub speed: f64,
    /// How fast it speeds up and slows down, in m/s².
    pub acceleration: f64,
    /// How fast it turns, in rad/s.
    pub turn: f64,
    /// How fast it begins and ends to turn, in rad/s².
    pub turn_acceleration: f64,
    /// Radius of the wheels as the robot knows it, in metres.
    pub wheel: f64,
    /// Distance between the wheels as the robot knows it, in metres.
    pub axle: f64,
    /// Radius of the left and of the right wheel, and distance between them, over those known.
    pub real: [f64; 3],
    /// Counts of an encoder in a turn of its wheel.
    pub counts: f64,
    /// The shape that must not touch anything.
    pub footprint: Footprint,
    /// The motors, where they are known.
    pub motors: Option<Motors>,
    /// The battery, full, where it is known.
    pub battery: Option<Battery>,
}

/// The room that paths have to spare, in metres: they keep the radius of the body from all things,
/// and a robot follows them as exactly as that.
pub(crate) const SPARE: f64 = 0.02;

impl Drivetrain {
    /// Returns the wheels of a body.
    pub fn of(body: &Body) -> Self {
        let Wheels { radius_um, axle, turn_mrad_s, turn_acceleration, counts, errors_ppm } =
            body.wheels;
        let milli = |it: u64| it as f64 / 1_000.0;
        Self {
            speed: milli(body.speed_max.0),
            acceleration: milli(body.acceleration),
            turn: milli(turn_mrad_s),
            turn_acceleration: milli(turn_acceleration),
            wheel: radius_um as f64 / 1e6,
            axle: milli(axle.0),
            real: errors_ppm.map(|it| 1.0 + f64::from(it) / 1e6),
            counts: counts as f64,
            footprint: Footprint::disc((milli(body.radius.0) - SPARE).max(0.001)),
            motors: body.motors.as_ref().map(Motors::of),
            battery: body.battery.as_ref().map(Battery::of),
        }
    }
}
