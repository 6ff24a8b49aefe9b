//! A robot that drives over the office, with odometry that errs, and what it reads.
#![allow(dead_code, clippy::unwrap_used, clippy::cast_precision_loss, clippy::cast_sign_loss)]

use cotama_core::units::Millis;
use cotama_devices::{Laser, LaserSettings, Rate, Ring, RingSettings, Scene};
use cotama_floor::{
    Needs, Path, Planner, Point, Pose, Segments, Surface, Vector, Version, embedded, metres,
};
use cotama_localisation::{Localiser, Sensor};
use cotama_streams::{Stream, Streams};
use std::f64::consts::PI;

/// A moment: where the robot is, where its odometry says it is, and what it reads.
#[derive(Clone, Debug)]
pub(crate) struct Moment {
    pub(crate) truth: Pose,
    pub(crate) odometry: Pose,
    pub(crate) ranges: Vec<f64>,
}

pub(crate) const RAYS: usize = 180;
pub(crate) const RANGE_M: f64 = 8.0;
const TICK: u64 = 40;
const SPEED: f64 = 0.3;
const TURN: f64 = 0.6;

/// The office: as it is, with a parcel and a bucket, or as robots know it.
pub(crate) fn office(version: Version) -> Segments {
    embedded::OFFICE.floor().unwrap().surface(version, &[]).unwrap()
}

pub(crate) fn laser() -> Sensor {
    Sensor::laser(&Pose::identity(), PI, RAYS, RANGE_M).unwrap()
}

pub(crate) fn sonars() -> Sensor {
    let it = RingSettings::pioneer();
    Sensor::sonars(&it.mounts, it.cone_rad, 5, it.range_m).unwrap()
}

/// Poses each 40 ms on the way from place to place: 0.3 m/s, and 0.6 rad/s on the spot at corners.
pub(crate) fn route(places: &[&str]) -> Vec<Pose> {
    let floor = embedded::OFFICE.floor().unwrap();
    let points: Vec<_> = places.iter().map(|it| metres(floor.place(it).unwrap().at)).collect();
    route_on(&office(Version::Real), &points)
}

/// Such poses on any floor.
pub(crate) fn route_on(floor: &dyn Surface, points: &[Point]) -> Vec<Pose> {
    let planner = Planner::new(floor, Needs::default()).unwrap();
    let mut poses: Vec<Pose> = Vec::new();
    for ends in points.windows(2) {
        along(&planner.route(ends[0], ends[1]).unwrap(), &mut poses);
    }
    poses
}

fn along(path: &Path, poses: &mut Vec<Pose>) {
    let tick = TICK as f64 / 1_000.0;
    let steps = (path.length() / (SPEED * tick)) as usize;
    for step in 0..=steps {
        let next = path.pose(step as f64 * SPEED * tick);
        if let Some(last) = poses.last().copied() {
            let turn = last.rotation.angle_to(&next.rotation);
            let turns = (turn.abs() / (TURN * tick)) as usize;
            for part in 1..=turns {
                let angle = turn * part as f64 / (turns + 1) as f64;
                poses.push(last * Pose::rotation(angle));
            }
        }
        poses.push(next);
    }
}

/// Errors of the encoders: 2 % too far and 3 % too much turn, a drift of 0.01 rad/m, and noise.
pub(crate) fn odometry(truth: &[Pose], streams: Streams) -> Vec<Pose> {
    let mut noise: Stream = streams.stream("odometry");
    let mut at = Pose::identity();
    let mut last = truth[0];
    let mut step = |now: &Pose| {
        let moved = last.inverse() * now;
        last = *now;
        let way = moved.translation.vector.norm();
        let turn = moved.rotation.angle();
        let spread = way.sqrt() * 0.02;
        let ahead = moved.translation.vector * 1.02 + Vector::new(noise.error() * spread, 0.0);
        let turned = turn * 1.03 + 0.01 * way + noise.error() * (spread + 0.02 * turn.abs().sqrt());
        at *= Pose::new(ahead, turned);
        at
    };
    truth.iter().map(&mut step).collect()
}

/// Drives with a laser of 180 rays that is read five times a second.
pub(crate) fn with_laser(truth: &[Pose], streams: Streams) -> Vec<Moment> {
    with_laser_on(&office(Version::Real), truth, streams)
}

/// Drives so on any floor.
pub(crate) fn with_laser_on(floor: &dyn Surface, truth: &[Pose], streams: Streams) -> Vec<Moment> {
    let rate = Rate { period: Millis(5 * TICK), latency: Millis(0) };
    let settings =
        LaserSettings { rays: RAYS, range_m: RANGE_M, rate, ..LaserSettings::sick_lms200() };
    let mut laser = Laser::new(&settings, &streams, "laser").unwrap();
    let odometry = odometry(truth, streams);
    let all = truth.iter().zip(odometry).enumerate().step_by(5);
    all.map(|(tick, (truth, odometry))| {
        let now = Millis(tick as u64 * TICK);
        laser.sense(now, truth, &Scene::of(floor, &[]));
        let ranges = laser.latest(now).unwrap().value.to_vec();
        Moment { truth: *truth, odometry, ranges }
    })
    .collect()
}

/// Drives with the 16 sonars of a Pioneer, of which two fire each 40 ms; read after each sweep.
pub(crate) fn with_sonars(truth: &[Pose], streams: Streams) -> Vec<Moment> {
    let real = office(Version::Real);
    let it = RingSettings::pioneer();
    let settings = RingSettings { rate: Rate { latency: Millis(0), ..it.rate }, ..it };
    let mut ring = Ring::new(&settings, &streams, "sonar").unwrap();
    let odometry = odometry(truth, streams);
    let mut moments = Vec::new();
    for (tick, (truth, odometry)) in truth.iter().zip(odometry).enumerate() {
        let now = Millis(tick as u64 * TICK);
        ring.sense(now, truth, &Scene::of(&real, &[]));
        if tick % 8 == 7 {
            let read = ring.latest(now).unwrap();
            let ranges = read.iter().map(|it| it.map_or(f64::NAN, |it| it.value)).collect();
            moments.push(Moment { truth: *truth, odometry, ranges });
        }
    }
    moments
}

/// Returns how far a pose is from another, in metres.
pub(crate) fn off(a: &Pose, b: &Pose) -> f64 {
    (a.translation.vector - b.translation.vector).norm()
}

/// Follows a robot; returns how far off the localisation is at each moment.
pub(crate) fn follow(localiser: &mut Localiser<'_>, moments: &[Moment]) -> Vec<f64> {
    let step = |it: &Moment| {
        localiser.update(&it.odometry, &it.ranges);
        off(&localiser.pose_at(&it.odometry), &it.truth)
    };
    moments.iter().map(step).collect()
}

/// Returns the value that a part of all is at most.
pub(crate) fn quantile(values: &[f64], part: f64) -> f64 {
    let mut values = values.to_vec();
    values.sort_by(f64::total_cmp);
    values[((values.len() - 1) as f64 * part).round() as usize]
}
