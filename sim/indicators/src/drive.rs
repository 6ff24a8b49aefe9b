//! A robot that drives from place to place over a floor, among people, and is watched.

use crate::map::Map;
use crate::sample::{OfPath, Sample, WINDOW, variance};
use core::f64::consts::{PI, TAU};
use cotama_core::units::Millis;
use cotama_devices::{Disc, Habits, Laser, LaserSettings, People, Rate, Routes, Scene};
use cotama_floor::{Footprint, Needs, Path, Planner, Point, Pose, Surface};
use cotama_localisation::{Chart, Localiser, Parameters, Sensor};
use cotama_navigation::{Braking, Choice, Histogram, Limits, LocalMap, Patience, Thresholds};
use cotama_plane::{Command, Drivetrain, Odometry, Vehicle};
use cotama_streams::Streams;
use std::collections::VecDeque;
use std::fmt;

/// Options of a drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// The seed of people, noise and goals.
    pub seed: u64,
    /// How many people walk between the places.
    pub people: usize,
    /// How long it lasts, in seconds, up to [`MAX_S`].
    pub seconds: u64,
}

/// The longest drive: two hours.
pub const MAX_S: u64 = 7_200;
/// The most people.
pub const MAX_PEOPLE: usize = 200;

/// Reasons why a robot cannot drive there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoDrive {
    /// The floor is too large for a map of 0.1 m, or for localisation.
    Large,
    /// Less than two places, or more than there may be, or none that leads to another.
    Places,
    /// More people than [`MAX_PEOPLE`], or longer than [`MAX_S`].
    Options,
}

impl fmt::Display for NoDrive {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Large => f.write_str("the floor is too large for a robot's map"),
            Self::Places => f.write_str("no two places of the floor have a way between them"),
            Self::Options => write!(f, "at most {MAX_PEOPLE} people, and {MAX_S} s"),
        }
    }
}

impl std::error::Error for NoDrive {}

/// Time between two commands, two scans and two samples: the last is that of the thesis, 2 Hz.
const PERIOD: Millis = Millis(100);
const SCAN: Millis = Millis(200);
const SAMPLE: Millis = Millis(500);
/// Range of the laser in metres, and its rays.
const RANGE_M: f64 = 8.0;
const RAYS: usize = 91;
/// Distance in metres at which a waypoint, and a goal, are reached.
const NEAR_M: f64 = 0.5;
/// Radius of the robot, in metres.
const RADIUS_M: f64 = 0.26;

/// A robot of the size of a Pioneer 3-DX with wheels a little other than it knows.
fn drivetrain() -> Drivetrain {
    Drivetrain {
        speed: 0.5,
        acceleration: 0.5,
        turn: 0.8,
        turn_acceleration: 2.0,
        wheel: 0.0975,
        axle: 0.33,
        real: [1.01, 0.995, 1.005],
        counts: 2_048.0,
        footprint: Footprint::disc(RADIUS_M - 0.02),
        motors: None,
        battery: None,
    }
}

/// Drives between places of a floor that the robot knows, and samples its indicators twice a
/// second.
///
/// The robot begins at the first place and knows it. It localises itself by its odometry and a
/// laser (180°, 8 m), maps what it sees where it believes to be, plans over the floor that it knows
/// and avoids what it sees by VFH+. A goal that it does not come nearer to in 20 s is given up for
/// another one.
///
/// # Errors
/// When the floor, its places or the options do not make a drive.
pub fn drive(
    real: &dyn Surface,
    charted: &dyn Surface,
    places: &[Point],
    options: &Options,
) -> Result<Vec<Sample>, NoDrive> {
    if options.people > MAX_PEOPLE || options.seconds > MAX_S {
        return Err(NoDrive::Options);
    }
    let streams = Streams::new(options.seed);
    let planner = Planner::new(charted, Needs { cell_m: 0.2, ..Needs::default() });
    let planner = planner.map_err(|_| NoDrive::Large)?;
    let walks = Needs { radius_m: 0.25, cell_m: 0.2, ..Needs::default() };
    let walks = Planner::new(real, walks).map_err(|_| NoDrive::Large)?;
    let routes = Routes::plan(&walks, places).map_err(|_| NoDrive::Places)?;
    if !(1..places.len()).any(|it| routes.way(0, it).is_some()) {
        return Err(NoDrive::Places);
    }
    let habits = Habits { stays: Millis(1_000)..=Millis(15_000), ..Habits::default() };
    let people = People::new(options.people, &habits, routes.clone(), &streams, "people");
    let people = people.map_err(|_| NoDrive::Options)?;
    let settings = LaserSettings {
        range_m: RANGE_M,
        rays: RAYS,
        rate: Rate { period: SCAN, latency: Millis(0) },
        ..LaserSettings::sick_lms200()
    };
    let sensor = Sensor::laser(&settings.mount, settings.view_rad, RAYS, RANGE_M);
    let sensor = sensor.map_err(|_| NoDrive::Large)?;
    let parameters = Parameters { max_beams: 60, max_particles: 1_000, ..Parameters::default() };
    let chart = Chart::new(charted, 0.1, &sensor, &parameters).map_err(|_| NoDrive::Large)?;
    let map = Map::new(&charted.bounds()).ok_or(NoDrive::Large)?;
    let laser = Laser::new(&settings, &streams, "laser").map_err(|_| NoDrive::Large)?;
    let start = places.first().ok_or(NoDrive::Places)?;
    let pose = Pose::new(start.coords, 0.0);
    let mut localiser = Localiser::new(&chart, &streams, "robot");
    let sure = nalgebra::Matrix3::from_diagonal(&nalgebra::Vector3::new(0.01, 0.01, 0.01));
    localiser.start_at(&pose, &sure).map_err(|_| NoDrive::Places)?;
    let drivetrain = drivetrain();
    let braking = Braking::new(Limits::of(&drivetrain), RADIUS_M, 0.05, 0.1);
    let robot = Robot {
        avoidance: Histogram::new(braking, Thresholds::default()),
        around: LocalMap::new(RAYS, SCAN),
        odometry: Odometry::new(pose),
        vehicle: Vehicle::new(pose),
        drivetrain,
        localiser,
        laser,
        map,
    };
    let world = World { real, planner, places, people, goals: streams.stream("goals") };
    Ok(watched(robot, world, options))
}

struct Robot<'c> {
    drivetrain: Drivetrain,
    vehicle: Vehicle,
    odometry: Odometry,
    localiser: Localiser<'c>,
    laser: Laser,
    avoidance: Histogram,
    around: LocalMap,
    map: Map,
}

struct World<'w> {
    real: &'w dyn Surface,
    planner: Planner<'w>,
    places: &'w [Point],
    people: People,
    goals: cotama_streams::Stream,
}

impl World<'_> {
    /// Draws a goal that a way leads to from a place; the last one if there is no other.
    fn goal(&mut self, from: Point) -> Option<Path> {
        for _ in 0..32 {
            let at = self.goals.below(self.places.len() as u64) as usize;
            let to = self.places[at];
            if (to - from).norm() > 2.0
                && let Ok(path) = self.planner.route(from, to)
            {
                return Some(path);
            }
        }
        None
    }
}

/// Memory between samples.
struct Log {
    /// Sum of the entropies of the pose on the way to this goal, and how many they are.
    entropy: (f64, u32),
    angles: VecDeque<f64>,
    headings: VecDeque<f64>,
}

fn watched(mut robot: Robot<'_>, mut world: World<'_>, options: &Options) -> Vec<Sample> {
    let mut samples = Vec::new();
    let mut log = Log { entropy: (0.0, 0), angles: VecDeque::new(), headings: VecDeque::new() };
    let mut path: Option<Path> = None;
    let mut patience = Patience::new(0.3, 200);
    let mut odometry_before = *robot.odometry.pose();
    for period in 0..options.seconds * 1_000 / PERIOD.0 {
        let now = Millis(period * PERIOD.0);
        let own = Disc { centre: robot.vehicle.pose().translation.vector.into(), radius: RADIUS_M };
        if period == 0 {
            world.people.make_room(&own);
        }
        let people = world.people.advance(now, &[own]).to_vec();
        let is_scan = now.0.is_multiple_of(SCAN.0);
        let odometry = *robot.odometry.pose();
        robot.around.advance(&(odometry_before.inverse() * odometry), PERIOD);
        odometry_before = odometry;
        if is_scan {
            robot.sense(now, &odometry, &Scene::of(world.real, &people));
        }
        let believed = robot.localiser.pose_at(&odometry);
        let at = Point::from(believed.translation.vector);
        let goal = path.as_ref().and_then(|it| it.points().last().copied());
        let left = goal.map(|it| (it - at).norm());
        if left.is_none_or(|it| it < NEAR_M || !patience.lasts(it)) {
            path = world.goal(at);
            patience = Patience::new(0.3, 200);
            log.entropy = (0.0, 0);
        } else if let Some(goal) = goal.filter(|_| now.0.is_multiple_of(SAMPLE.0)) {
            // Planned anew from where it believes to be; the old path where that finds no room.
            if let Ok(anew) = world.planner.route(at, goal) {
                path = Some(anew);
            }
        }
        if let Some(path) = path.as_ref().filter(|_| now.0.is_multiple_of(SAMPLE.0)) {
            let room = world.planner.room();
            let of_path = OfPath::new(path, &believed, room);
            samples.extend(robot.sample(&mut log, &of_path, &believed));
        }
        robot.go(path.as_ref(), &believed, &world, &people);
    }
    samples
}

impl Robot<'_> {
    fn sense(&mut self, now: Millis, odometry: &Pose, scene: &Scene<'_>) {
        self.laser.sense(now, self.vehicle.pose(), scene);
        let Some(scan) = self.laser.latest(now) else { return };
        self.localiser.update(odometry, scan.value);
        let believed = self.localiser.pose_at(odometry);
        self.around.take_scan(&Pose::identity(), PI, scan.value);
        self.map.take(&believed, PI, RANGE_M, scan.value);
    }

    /// The indicators; none until variances have their samples.
    fn sample(&mut self, log: &mut Log, of_path: &OfPath, believed: &Pose) -> Option<Sample> {
        let around = self.map.around(believed.translation.vector.into());
        log.entropy.0 += entropy(&self.localiser.estimate().covariance);
        log.entropy.1 += 1;
        let heading = believed.rotation.angle();
        let last = log.headings.back().copied().unwrap_or(heading);
        // Unwrapped, so that a variance has no jump.
        let heading = heading - TAU * ((heading - last) / TAU).round();
        for (all, it) in [(&mut log.angles, of_path.angle), (&mut log.headings, heading)] {
            all.push_back(it);
            if all.len() > WINDOW {
                all.pop_front();
            }
        }
        (log.angles.len() == WINDOW).then(|| {
            Sample([
                around.entropy,
                log.entropy.0 / f64::from(log.entropy.1),
                around.information,
                of_path.length,
                of_path.waypoints,
                variance(log.angles.iter().copied()),
                of_path.angle_sum,
                of_path.voronoi,
                self.vehicle.speeds().speed,
                variance(log.headings.iter().copied()),
            ])
        })
    }

    /// Goes a period: along the path if there is one, unless a person is in the way.
    fn go(&mut self, path: Option<&Path>, believed: &Pose, world: &World<'_>, people: &[Disc]) {
        let at = Point::from(believed.translation.vector);
        let target = path.and_then(|it| {
            let later = it.points().iter().skip(1);
            later.clone().find(|it| (**it - at).norm() > NEAR_M).or(later.last()).copied()
        });
        let command = match target {
            None => Command::default(),
            Some(to) => {
                let to = believed.inverse() * to;
                let now = self.vehicle.speeds();
                match self.avoidance.choose(&self.around, now, to, self.drivetrain.speed) {
                    Choice::Go(it) => it,
                    Choice::Stand => Command::default(),
                }
            }
        };
        for _ in 0..2 {
            let before = self.vehicle.clone();
            self.vehicle.step(&self.drivetrain, world.real, command, 0.05);
            let centre = Point::from(self.vehicle.pose().translation.vector);
            let own = Disc { centre, radius: RADIUS_M };
            if people.iter().any(|it| it.gap(&own) < 0.0) {
                self.vehicle = before;
                self.vehicle.stand();
            }
        }
        let counts = self.vehicle.counts(&self.drivetrain);
        self.odometry.read(&self.drivetrain, counts);
    }
}

/// Entropy of a normal distribution with this covariance, in nats; a millimetre and a milliradian
/// are as sure as it gets.
fn entropy(covariance: &nalgebra::Matrix3<f64>) -> f64 {
    let least = nalgebra::Matrix3::from_diagonal_element(1e-6);
    let volume = (covariance + least).determinant().max(1e-18);
    1.5 * (1.0 + libm::log(TAU)) + libm::log(volume) / 2.0
}
