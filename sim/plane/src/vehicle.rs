//! A robot on two driven wheels: speeds that change by and by, arcs, and contact that stops it.

use crate::drivetrain::Drivetrain;
use cotama_floor::{Pose, Surface, Vector};

/// The speeds that a robot is told.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Command {
    /// Ahead, in m/s.
    pub speed: f64,
    /// To the left, in rad/s.
    pub turn: f64,
}

/// Effect of faults and of the supply on the speeds of the wheels, left and right, in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effect {
    /// The part of the speed told with which a wheel turns.
    pub turns: [f64; 2],
    /// The fastest that wheels turn, in rad/s; at least 0.
    pub most: f64,
    /// The part of a wheel's way that the robot goes.
    pub grips: [f64; 2],
    /// The part of a wheel's way that its encoder counts.
    pub reads: [f64; 2],
}

impl Default for Effect {
    /// No effect.
    fn default() -> Self {
        Self { turns: [1.0; 2], most: f64::INFINITY, grips: [1.0; 2], reads: [1.0; 2] }
    }
}

/// A step of the wheels, left and right.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Step {
    /// The mean speeds that they were told, in rad/s.
    pub told: [f64; 2],
    /// Mean speeds that they had, in rad/s.
    pub turned: [f64; 2],
    /// Accelerations that the robot was told, in m/s² and rad/s².
    pub gained: Command,
}

/// A robot in the plane.
///
/// ```
/// use cotama_floor::{Pose, Version, embedded::OFFICE};
/// use cotama_models::robots::Robot;
/// use cotama_plane::{Command, Drivetrain, Vehicle};
/// let floor = OFFICE.floor().unwrap();
/// let surface = floor.surface(Version::Real, &[]).unwrap();
/// let robot = Robot::shipped("p3dx-delivery").unwrap();
/// let drivetrain = Drivetrain::of(robot.body.as_ref().unwrap());
/// let mut vehicle = Vehicle::new(Pose::new([11.0, 10.0].into(), 0.0));
/// let ahead = Command { speed: 0.3, turn: 0.0 };
/// for _ in 0..20 {
///     vehicle.step(&drivetrain, &surface, ahead, 0.1); // a second to speed up, one evenly
/// }
/// assert_eq!(format!("{:.2}", vehicle.pose().translation.x), "11.45");
/// assert!(!vehicle.touches());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Vehicle {
    pose: Pose,
    now: Command,
    /// The turn at last, which slip makes other than it was told.
    turns: f64,
    /// The angles of the wheels that the encoders have counted, left and right.
    wheels: [f64; 2],
    /// How far the centre can still go before anything is so near that it could touch it.
    room: f64,
    touches: bool,
}

/// How far the surroundings are looked at, in metres beyond the shape.
const VIEW: f64 = 2.0;
/// The size of steps near to things, in metres of way of the outermost point.
const NEAR: f64 = 0.005;

impl Vehicle {
    /// A robot that stands at a pose.
    pub fn new(pose: Pose) -> Self {
        Self {
            pose,
            now: Command::default(),
            turns: 0.0,
            wheels: [0.0; 2],
            room: 0.0,
            touches: false,
        }
    }

    /// Returns the position and the heading.
    pub const fn pose(&self) -> &Pose {
        &self.pose
    }

    /// Returns the speeds.
    pub const fn speeds(&self) -> Command {
        self.now
    }

    /// Returns how fast it turned at last, in rad/s to the left: a gyro reads this.
    pub const fn turns(&self) -> f64 {
        self.turns
    }

    /// Whether it moved against something in its last step.
    pub const fn touches(&self) -> bool {
        self.touches
    }

    /// Returns the whole counts of the encoders, left and right.
    #[allow(clippy::cast_possible_truncation)] // more than 10^9 km are not driven
    pub fn counts(&self, drivetrain: &Drivetrain) -> [i64; 2] {
        self.wheels.map(|it| (it * drivetrain.counts / core::f64::consts::TAU).floor() as i64)
    }

    /// Stands at once.
    pub fn stand(&mut self) {
        self.now = Command::default();
        self.turns = 0.0;
    }

    /// Goes on for a time in seconds: speeds change evenly to those that are told, as fast as the
    /// drivetrain allows. Contact stops it where it is.
    ///
    /// The wheels turn as it was told, v ± w b / 2 over r; the robot goes the way that the real
    /// wheels make of it (Siegwart, Nourbakhsh, Scaramuzza, Introduction to Autonomous Mobile
    /// Robots, 2nd ed., Section 3.2.2). The arc of a step is exact.
    pub fn step(
        &mut self,
        drivetrain: &Drivetrain,
        surface: &dyn Surface,
        command: Command,
        time: f64,
    ) {
        self.step_under(drivetrain, surface, command, time, &Effect::default());
    }

    /// Goes on as [`Vehicle::step`] does, under the effect of faults and of the supply; returns
    /// what the wheels did.
    pub fn step_under(
        &mut self,
        drivetrain: &Drivetrain,
        surface: &dyn Surface,
        command: Command,
        time: f64,
        effect: &Effect,
    ) -> Step {
        let Drivetrain { speed, acceleration, turn, turn_acceleration, wheel, axle, .. } =
            *drivetrain;
        let before = self.now;
        self.now = Command {
            speed: towards(before.speed, command.speed.clamp(-speed, speed), acceleration * time),
            turn: towards(before.turn, command.turn.clamp(-turn, turn), turn_acceleration * time),
        };
        let mean = Command {
            speed: f64::midpoint(before.speed, self.now.speed),
            turn: f64::midpoint(before.turn, self.now.turn),
        };
        self.touches = false;
        self.turns = 0.0;
        if mean == Command::default() || time <= 0.0 {
            return Step::default();
        }
        let gained = Command {
            speed: (self.now.speed - before.speed) / time,
            turn: (self.now.turn - before.turn) / time,
        };
        let Effect { turns, most, grips, reads } = *effect;
        let told = [-0.5, 0.5].map(|side| (mean.speed + side * mean.turn * axle) / wheel);
        let rates = [told[0] * turns[0], told[1] * turns[1]].map(|it| it.max(-most).min(most));
        let angles = rates.map(|it| it * time);
        let [left, right, between] = drivetrain.real;
        let ways = [angles[0] * wheel * left * grips[0], angles[1] * wheel * right * grips[1]];
        let way = f64::midpoint(ways[0], ways[1]);
        let turned = (ways[1] - ways[0]) / (axle * between);
        let part = self.go(drivetrain, surface, way, turned);
        self.turns = turned * part / time;
        for ((wheel, angle), read) in self.wheels.iter_mut().zip(angles).zip(reads) {
            *wheel += angle * part * read;
        }
        if part < 1.0 {
            self.touches = true;
            self.stand();
        }
        Step { told, turned: rates.map(|it| it * part), gained }
    }

    /// Goes an arc, as far as nothing is in the way; returns the part that it went.
    ///
    /// No part is skipped: a disc around the centre holds the shape, so the centre goes freely as
    /// far as the distance to the nearest thing beyond that disc; nearer to things steps are small.
    fn go(&mut self, drivetrain: &Drivetrain, surface: &dyn Surface, way: f64, turn: f64) -> f64 {
        let radius = drivetrain.footprint.radius();
        let size = way.abs() + radius * turn.abs();
        let mut done = 0.0;
        while done < 1.0 {
            if self.room < NEAR {
                let at = self.pose.translation.vector.into();
                self.room = surface.clearance(at, radius + VIEW) - radius;
            }
            let left = 1.0 - done;
            if self.room >= NEAR {
                let part = if way.abs() * left > self.room { self.room / way.abs() } else { left };
                self.pose *= arc(way * part, turn * part);
                self.room -= way.abs() * part;
                done += part;
                continue;
            }
            let part = left.min(NEAR / size);
            let next = self.pose * arc(way * part, turn * part);
            if surface.is_free(&drivetrain.footprint, &next) {
                self.pose = next;
                self.room = 0.0;
                done += part;
                continue;
            }
            let (mut free, mut taken) = (0.0, part);
            for _ in 0..10 {
                let middle = f64::midpoint(free, taken);
                let next = self.pose * arc(way * middle, turn * middle);
                if surface.is_free(&drivetrain.footprint, &next) {
                    free = middle;
                } else {
                    taken = middle;
                }
            }
            self.pose *= arc(way * free, turn * free);
            return done + free;
        }
        1.0
    }
}

fn towards(from: f64, to: f64, most: f64) -> f64 {
    from + (to - from).clamp(-most, most)
}

/// Returns the change of pose on an arc: its way in metres, its turn to the left in radians.
pub fn arc(way: f64, turn: f64) -> Pose {
    let ahead = if turn.abs() < 1e-9 {
        Vector::new(way, way * turn / 2.0)
    } else {
        let (sin, cos) = libm::sincos(turn);
        Vector::new(sin, 1.0 - cos) * (way / turn)
    };
    Pose::new(ahead, turn)
}
