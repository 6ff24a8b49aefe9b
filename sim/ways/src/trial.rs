//! One trial: a robot goes one way among moving discs, until it arrives or touches something.

use crate::ring::{Ring, Way};
use cotama_core::units::Millis;
use cotama_devices::{Disc, Laser, LaserSettings, Rate, Scene};
use cotama_floor::{Footprint, Path, Point, Pose};
use cotama_navigation::{Braking, Choice, Histogram, Limits, LocalMap, Thresholds};
use cotama_plane::{Command, Drivetrain, Vehicle};
use cotama_streams::Streams;

/// Speeds of discs in m/s (Rohrmueller 2011, table 4.2).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ObjectSpeed {
    /// 0.15 m/s.
    Slow,
    /// 0.3 m/s.
    Medium,
    /// 0.6 m/s.
    Fast,
}

impl ObjectSpeed {
    /// All speeds.
    pub const ALL: [Self; 3] = [Self::Slow, Self::Medium, Self::Fast];

    /// The speed in m/s.
    pub const fn m_s(self) -> f64 {
        match self {
            Self::Slow => 0.15,
            Self::Medium => 0.3,
            Self::Fast => 0.6,
        }
    }

    /// The name of the speed.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Slow => "slow",
            Self::Medium => "medium",
            Self::Fast => "fast",
        }
    }
}

/// The end of a trial.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// At the goal.
    Arrived,
    /// Against a disc.
    Disc,
    /// Against a wall.
    Wall,
    /// Neither, after [`MAX_S`]: it counts as failed.
    Late,
}

/// A trial that was made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trial {
    /// End of the trial.
    pub end: End,
    /// How long it took, in ms.
    pub time: Millis,
    /// The length that the robot went, in metres.
    pub length_m: f64,
}

impl Trial {
    /// Whether the goal was reached.
    pub const fn is_success(&self) -> bool {
        matches!(self.end, End::Arrived)
    }

    /// The cost: its time in seconds.
    pub fn cost(&self) -> f64 {
        self.time.0 as f64 / 1_000.0
    }
}

/// The longest trial, in seconds.
pub const MAX_S: f64 = 120.0;
/// Time between two commands, and two scans.
const PERIOD: Millis = Millis(100);
/// Steps of the bodies in a period.
const STEPS: u32 = 5;
/// Distances in metres at which a waypoint, and the goal, are reached.
const NEAR_M: f64 = 0.6;
const GOAL_M: f64 = 0.3;
/// View of the laser in metres (section 4.5.2).
const VIEW_M: f64 = 1.7;
/// Half the length and half the width of the robot in metres (section 4.5.2).
const HALF_M: [f64; 2] = [0.2, 0.15];
/// Room that the robot keeps beyond the disc that holds it, in metres.
const MARGIN_M: f64 = 0.03;

/// The robot: 0.4 m by 0.3 m, up to 1 m/s as the thesis says; the rest is assumed.
fn drivetrain() -> Option<Drivetrain> {
    let [long, wide] = HALF_M;
    let corners = [[long, wide], [-long, wide], [-long, -wide], [long, -wide]].map(Point::from);
    Some(Drivetrain {
        speed: 1.0,
        acceleration: 0.5,
        turn: core::f64::consts::PI * 2.0 / 9.0,
        turn_acceleration: 3.0,
        wheel: 0.0975,
        axle: 0.33,
        real: [1.0; 3],
        counts: 2_048.0,
        footprint: Footprint::polygon(corners.to_vec())?,
        motors: None,
        battery: None,
    })
}

/// Makes a trial: the discs begin at phases that are drawn from the streams, each by its number, so
/// that a trial on the other way meets the same discs.
///
/// The robot knows its pose. It goes from waypoint to waypoint, the corners of the way, by
/// [`Histogram`] (VFH+) on the last scan of a laser that sees 180° and 1.7 m; it knows nothing of
/// the speeds of discs, and discs do not wait for it.
///
/// # Panics
/// When built-in numbers are out of range, which tests exclude.
pub fn trial(
    ring: &Ring,
    way: Way,
    speed: ObjectSpeed,
    streams: &Streams,
    mut seen: impl FnMut(&Pose, &[Disc]),
) -> Trial {
    let drivetrain = drivetrain().unwrap_or_else(|| unreachable!("a rectangle has four corners"));
    let path = ring.path(way);
    let laser = LaserSettings {
        range_m: VIEW_M,
        rays: 91,
        rate: Rate { period: PERIOD, latency: Millis(0) },
        ..LaserSettings::sick_lms200()
    };
    let laser = Laser::new(&laser, streams, "laser");
    let mut laser = laser.unwrap_or_else(|_| unreachable!("the numbers are within their ranges"));
    let crossings: Vec<_> = ring.all().copied().collect();
    let phases: Vec<f64> =
        (0..crossings.len()).map(|it| streams.stream(&format!("disc {it}")).part()).collect();
    let discs = |ms: u64| {
        let discs = crossings.iter().zip(&phases);
        let disc =
            |it: (&crate::ring::Crossing, &f64)| it.0.disc(*it.1, speed.m_s(), ms as f64 / 1_000.0);
        discs.map(disc).collect::<Vec<_>>()
    };
    let size = drivetrain.footprint.radius();
    let braking = Braking::new(Limits::of(&drivetrain), size, MARGIN_M, 0.1);
    let thresholds = Thresholds { range_m: VIEW_M, ..Thresholds::default() };
    let mut avoidance = Histogram::new(braking, thresholds);
    // A scan is forgotten when the next one comes, as by the driver of Player.
    let mut map = LocalMap::new(91, PERIOD);
    let mut robot = Vehicle::new(path.pose(0.0));
    let (mut next, mut length, mut now) = (1, 0.0, 0_u64);
    let mut before = *robot.pose();
    while now < (MAX_S * 1_000.0) as u64 {
        let around = discs(now);
        seen(robot.pose(), &around);
        laser.sense(Millis(now), robot.pose(), &Scene::of(&ring.surface, &around));
        map.advance(&(before.inverse() * robot.pose()), PERIOD);
        before = *robot.pose();
        if let Some(scan) = laser.latest(Millis(now)) {
            map.take_scan(&Pose::identity(), core::f64::consts::PI, scan.value);
        }
        let target = robot.pose().inverse() * waypoint(path, &mut next, robot.pose());
        let chosen = avoidance.choose(&map, robot.speeds(), target, drivetrain.speed);
        let command = match chosen {
            Choice::Go(it) => it,
            Choice::Stand => Command::default(),
        };
        let step = PERIOD.0 / u64::from(STEPS);
        for _ in 0..STEPS {
            let from = *robot.pose();
            robot.step(&drivetrain, &ring.surface, command, step as f64 / 1_000.0);
            now += step;
            length += (robot.pose().translation.vector - from.translation.vector).norm();
            let ended = |end| Trial { end, time: Millis(now), length_m: length };
            if robot.touches() {
                return ended(End::Wall);
            }
            if discs(now).iter().any(|it| touches(robot.pose(), it)) {
                return ended(End::Disc);
            }
            let left = path.points().last().map(|it| distance(robot.pose(), *it));
            if left.is_some_and(|it| it < GOAL_M) {
                return ended(End::Arrived);
            }
        }
    }
    Trial { end: End::Late, time: Millis(now), length_m: length }
}

/// The waypoint that the robot goes to: the next one as soon as it is near to one, and the goal
/// last.
fn waypoint(path: &Path, next: &mut usize, pose: &Pose) -> Point {
    let points = path.points();
    while *next + 1 < points.len() && distance(pose, points[*next]) < NEAR_M {
        *next += 1;
    }
    points.get(*next).copied().unwrap_or_else(Point::origin)
}

fn distance(pose: &Pose, to: Point) -> f64 {
    (pose.translation.vector - to.coords).norm()
}

/// Whether the robot's rectangle and a disc overlap.
fn touches(pose: &Pose, disc: &Disc) -> bool {
    let at = pose.inverse() * disc.centre;
    let [long, wide] = HALF_M;
    let (x, y) = ((at.x.abs() - long).max(0.0), (at.y.abs() - wide).max(0.0));
    x * x + y * y < disc.radius * disc.radius
}
