//! Things around a robot, and orders that keep it away from them.

use crate::devices::Devices;
use crate::sonars::{RANGE_M, ring};
use cotama_core::units::Millis;
use cotama_devices::Ring;
use cotama_floor::{Point, Pose};
use cotama_navigation::{Braking, Histogram, Limits, LocalMap, Progress, Retreat, Thresholds};
use cotama_plane::{Command, Rover};

/// The order of avoidance: the speeds off the path, if it leaves it, and the fastest along it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Order {
    pub(crate) steers: Option<Command>,
    pub(crate) limit_m_s: f64,
}

/// The decider of its motion in a period.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Wants {
    /// The operator leads it.
    Led,
    /// Keeps away from things.
    Avoids,
    /// Goes along its path.
    Goes,
}

/// The things around the robot, and how it keeps away from them.
#[derive(Clone, Debug)]
pub(crate) struct Around {
    map: LocalMap,
    histogram: Histogram,
    /// The odometry of the period before.
    before: Pose,
    /// The motion since then.
    motion: Pose,
    is_avoiding: bool,
    /// The way back on which the operator leads the robot from what it touches.
    retreat: Option<Retreat>,
}

/// The room that the robot keeps ahead, in metres, and how far ahead along its path it looks.
pub(crate) const KEEPS_M: f64 = 0.25;
const AHEAD_M: f64 = 2.0;
/// The room along its path below which it leaves it, and from which it takes it up again; how far
/// ahead on it the place is that it then goes for.
const NEAR_M: f64 = 0.7;
const FREE_M: f64 = 1.2;
const PURSUED_M: f64 = 1.5;
/// The points around it that it keeps: three of each sonar, for 2 s.
const MOST_POINTS: usize = 1_000;
/// The points of a robot with lasers.
const MOST_SCANNED: usize = 6_000;
/// The room that avoidance keeps beside the robot, in metres.
const MARGIN_M: f64 = 0.1;
/// By how much a pose may be wrong: paths have just the room that the robot needs.
const ASIDE_M: f64 = 0.07;
/// The way back from what the robot touches, in metres, at a speed in m/s, in so many periods.
const BACK: [f64; 2] = [0.4, 0.1];
const BACK_PERIODS: u32 = 80;
impl Around {
    pub(crate) fn new(rover: &Rover<'_>, has_lasers: bool) -> Self {
        let points = if has_lasers { MOST_SCANNED } else { MOST_POINTS };
        Self {
            map: LocalMap::new(points, Millis(2_000)),
            histogram: Histogram::new(braking(rover), Thresholds::default()),
            before: *rover.odometry(),
            motion: Pose::identity(),
            is_avoiding: false,
            retreat: None,
        }
    }

    /// Takes in the newest ranges of the sonars, and of the devices under the modules that run.
    pub(crate) fn see(
        &mut self,
        rover: &Rover<'_>,
        sonars: &Ring,
        (devices, under): (&Devices, u64),
        time: Millis,
    ) {
        let odometry = *rover.odometry();
        self.motion = self.before.inverse() * odometry;
        self.before = odometry;
        self.map.advance(&self.motion, time);
        devices.lasers.map(under, rover.now(), &odometry, &mut self.map);
        let settings = ring();
        if let Some(read) = sonars.latest(rover.now()).filter(|_| devices.has_sonars()) {
            self.map.take_ring(&settings.mounts, settings.cone_rad, RANGE_M, read);
        }
    }

    /// Keeps away from things, with so much room along the path in metres: where something is in
    /// the way, VFH+ chooses another one; where it chooses none, the robot brakes before it.
    /// Returns the order of avoidance, where it works.
    pub(crate) fn order(
        &mut self,
        rover: &mut Rover<'_>,
        free: f64,
        wants: Wants,
    ) -> Option<Order> {
        let until = if self.is_avoiding { FREE_M } else { NEAR_M };
        self.is_avoiding = wants == Wants::Avoids && free < until;
        if wants == Wants::Led {
            self.lead(rover);
            return None;
        }
        self.retreat = None;
        if !self.is_avoiding {
            rover.steer(None);
            let room = (free - KEEPS_M).max(0.0);
            let limit_m_s = (2.0 * rover.course().drivetrain().acceleration * room).sqrt();
            return (wants == Wants::Avoids).then_some(Order { steers: None, limit_m_s });
        }
        let (track, along) = (rover.course().track(), rover.along());
        let (near, _) = track.find(rover.believed().translation.vector.into(), along, along + 0.5);
        let there = track.pose(near.piece, near.along + PURSUED_M);
        let target = rover.believed().inverse_transform_point(&there.translation.vector.into());
        let now = rover.vehicle().speeds();
        let speed = rover.course().drivetrain().speed / 2.0;
        let choice = self.histogram.choose(&self.map, now, target, speed);
        let order = Order { steers: Some(choice.command()), limit_m_s: f64::INFINITY };
        rover.steer(order.steers);
        Some(order)
    }

    /// The operator leads the robot back from what it touches, and then along its path.
    fn lead(&mut self, rover: &mut Rover<'_>) {
        if rover.is_pressed() && self.retreat.is_none() {
            let [length_m, speed_m_s] = BACK;
            self.retreat = Some(Retreat::new(braking(rover), length_m, speed_m_s, BACK_PERIODS));
        }
        let (now, motion) = (rover.vehicle().speeds(), self.motion);
        // He sees that the way that the robot came is free.
        let way = LocalMap::new(1, Millis(0));
        let back = self.retreat.as_mut().map(|it| (it.command(&way, now, &motion), it.progress()));
        let going = back.filter(|it| it.1 == Progress::Going);
        if going.is_none() {
            self.retreat = None;
        }
        rover.steer(going.map(|it| it.0));
    }
}

/// Returns the room along the path by the ranges, in metres beyond the robot: up to the first
/// echo so near to the path that the robot would touch what sent it.
pub(crate) fn free(
    rover: &Rover<'_>,
    ranges: &[[f64; 16]; 2],
    (devices, under): (&Devices, u64),
) -> f64 {
    let drivetrain = rover.course().drivetrain();
    let radius = drivetrain.footprint.radius();
    let scanned = devices.lasers.points(under, rover.now(), rover.odometry());
    // As far as it needs to brake, where it sees so far.
    let brakes = drivetrain.speed * drivetrain.speed / (2.0 * drivetrain.acceleration);
    let has_lasers = devices.lasers.count() > 0;
    let ahead = if has_lasers { AHEAD_M.max(brakes + NEAR_M) } else { AHEAD_M };
    let (track, along, pose) = (rover.course().track(), rover.along(), rover.believed());
    let mounts = ring().mounts;
    let both = ranges[0].iter().zip(&ranges[1]);
    let points = mounts.iter().zip(both).filter_map(|(mount, (now, before))| {
        let range = now.max(*before);
        (range < RANGE_M).then(|| mount * Point::new(range, 0.0))
    });
    let ways = points.chain(scanned).filter_map(|it| {
        let (near, aside) = track.find(pose * it, along, along + ahead);
        let is_in_way = aside < radius - ASIDE_M && near.along > along + ASIDE_M;
        is_in_way.then_some(near.along - along - radius)
    });
    ways.fold(RANGE_M, f64::min)
}

fn braking(rover: &Rover<'_>) -> Braking {
    let drivetrain = rover.course().drivetrain();
    let radius_m = drivetrain.footprint.radius();
    Braking::new(Limits::of(drivetrain), radius_m, MARGIN_M, 0.1)
}
