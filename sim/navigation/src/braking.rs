//! Motions from which a robot can stop before anything that it knows of.

use crate::local_map::LocalMap;
use crate::work::Work;
use cotama_floor::{Point, Pose};
use cotama_plane::{Command, Drivetrain};

/// Limits of the wheels, in m/s, m/s², rad/s and rad/s².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The highest speed.
    pub speed: f64,
    /// Acceleration, also of slowing down.
    pub acceleration: f64,
    /// Highest speed of turning.
    pub turn: f64,
    /// Acceleration of turning.
    pub turn_acceleration: f64,
}

impl Limits {
    /// Returns the limits of a drivetrain as the robot knows it.
    pub const fn of(it: &Drivetrain) -> Self {
        let Drivetrain { speed, acceleration, turn, turn_acceleration, .. } = *it;
        Self { speed, acceleration, turn, turn_acceleration }
    }
}

/// The most periods of a motion that is looked at, with the braking: longer ones are refused.
pub const MAX_PERIODS: usize = 400;

/// The braking law of a robot, on which all avoidance here rests.
///
/// A motion is admissible if the robot goes a period with it, then tells its wheels to stand, and
/// until it does keeps its radius and a margin away from all known points. (The condition of D.
/// Fox, W. Burgard, S. Thrun, "The dynamic window approach to collision avoidance", IEEE Robotics &
/// Automation Magazine 4(1), 1997; there `v ≤ √(2 d a)` on the arc, here with the ramp of both
/// speeds as the wheels make it.) Also the straight line from the robot to each place of the motion
/// keeps that room: so a robot that senses all around knows the whole area that it needs, and
/// nothing hides there behind a corner.
///
/// While it follows admissible motions, and brakes where there is none, a robot among static things
/// touches nothing, if the margin is more than the largest error of its readings, of its wheels
/// over a braking, and half the gap between two readings of one thing.
#[derive(Clone, Debug, PartialEq)]
pub struct Braking {
    /// Limits of the wheels.
    pub limits: Limits,
    /// Radius of the disc that holds the robot, in metres.
    pub radius_m: f64,
    /// Room beyond it, in metres.
    pub margin_m: f64,
    /// Time from one command to the next, in seconds.
    pub period_s: f64,
    /// Points within reach of a braking in this period.
    near: Vec<Point>,
}

impl Braking {
    /// A braking law. The margin is in metres, the period in seconds, from 1 ms.
    pub fn new(limits: Limits, radius_m: f64, margin_m: f64, period_s: f64) -> Self {
        let near = Vec::with_capacity(crate::local_map::MAX_POINTS);
        Self { limits, radius_m, margin_m, period_s: period_s.max(1e-3), near }
    }

    /// Returns the speeds after a period in which the wheels are told others.
    pub fn reached(&self, now: Command, told: Command) -> Command {
        let Limits { speed, acceleration, turn, turn_acceleration } = self.limits;
        let towards = |from: f64, to: f64, most: f64| from + (to - from).clamp(-most, most);
        let (ahead, aside) = (acceleration * self.period_s, turn_acceleration * self.period_s);
        Command {
            speed: towards(now.speed, told.speed.clamp(-speed, speed), ahead),
            turn: towards(now.turn, told.turn.clamp(-turn, turn), aside),
        }
    }

    /// Looks which points a braking could come near to in the next period.
    pub fn look(&mut self, now: Command, map: &LocalMap, work: &mut Work) {
        let Limits { speed, acceleration, .. } = self.limits;
        let fast = (now.speed.abs() + acceleration * self.period_s).min(speed.max(now.speed.abs()));
        // Two periods more than √(2 d a): ramps are rounded up to whole periods.
        let reach = fast * fast / (2.0 * acceleration) + 2.0 * fast * self.period_s;
        let most = reach + self.radius_m + self.margin_m;
        self.near.clear();
        self.near.extend(map.points().map(|it| it.at).filter(|it| it.coords.norm() <= most));
        work.operations += map.points().count() as u64;
    }

    /// Returns the room beyond radius and margin that the robot keeps from all points looked at,
    /// while it goes a period as told and then brakes; `None` if that is less than 0. No points
    /// leave infinite room.
    pub fn room(&self, now: Command, told: Command, work: &mut Work) -> Option<f64> {
        let (mut at, mut speeds, mut told) = (Pose::identity(), now, told);
        let mut least = f64::INFINITY;
        work.nodes += 1;
        for _ in 0..MAX_PERIODS {
            let next = self.reached(speeds, told);
            at *= moved(speeds, next, self.period_s);
            (speeds, told) = (next, Command::default());
            let to = at.translation.vector;
            let square = to.norm_squared();
            work.operations += self.near.len() as u64;
            for point in &self.near {
                let part = if square > 0.0 { point.coords.dot(&to) / square } else { 0.0 };
                least = least.min((point.coords - to * part.clamp(0.0, 1.0)).norm_squared());
            }
            let room = least.sqrt() - self.radius_m - self.margin_m;
            if room < 0.0 {
                return None;
            }
            if speeds == Command::default() {
                return Some(room);
            }
        }
        None
    }

    /// Returns the pose, as the robot sees it now, where it stands after a period as told and the
    /// braking, or after [`MAX_PERIODS`].
    pub fn stands_at(&self, now: Command, told: Command) -> Pose {
        let (mut at, mut speeds, mut told) = (Pose::identity(), now, told);
        for _ in 0..MAX_PERIODS {
            let next = self.reached(speeds, told);
            at *= moved(speeds, next, self.period_s);
            (speeds, told) = (next, Command::default());
            if speeds == Command::default() {
                break;
            }
        }
        at
    }
}

/// Returns the change of pose in a time in which speeds change evenly, at their mean as
/// `cotama_plane::Vehicle` goes.
fn moved(from: Command, to: Command, time: f64) -> Pose {
    let way = f64::midpoint(from.speed, to.speed) * time;
    let turn = f64::midpoint(from.turn, to.turn) * time;
    cotama_plane::arc(way, turn)
}
