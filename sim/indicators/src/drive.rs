//! A robot that drives from place to place over a floor, among people, and is watched.

use crate::no_drive::{MAX_PEOPLE, MAX_S, NoDrive};
use crate::sample::{OfPath, Sample};
use crate::watch::{RAYS, Watch, chart};
use core::f64::consts::PI;
use cotama_core::units::Millis;
use cotama_devices::{Disc, Habits, People, Routes, Scene};
use cotama_floor::{Footprint, Needs, Path, Planner, Point, Pose, Surface};
use cotama_navigation::{Braking, Choice, Histogram, Limits, LocalMap, Patience, Thresholds};
use cotama_plane::{Command, Drivetrain, Odometry, Vehicle};
use cotama_streams::Streams;

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

/// Time between two commands, two scans and two samples: the last is that of the thesis, 2 Hz.
const PERIOD: Millis = Millis(100);
const SCAN: Millis = Millis(200);
const SAMPLE: Millis = Millis(500);
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
    let chart = chart(charted)?;
    let start = places.first().ok_or(NoDrive::Places)?;
    let pose = Pose::new(start.coords, 0.0);
    let watch = Watch::new(&chart, &charted.bounds(), SCAN, &pose, streams)?;
    let drivetrain = drivetrain();
    let braking = Braking::new(Limits::of(&drivetrain), RADIUS_M, 0.05, 0.1);
    let robot = Robot {
        avoidance: Histogram::new(braking, Thresholds::default()),
        around: LocalMap::new(RAYS, SCAN),
        odometry: Odometry::new(pose),
        vehicle: Vehicle::new(pose),
        drivetrain,
        watch,
    };
    let world = World { real, planner, places, people, goals: streams.stream("goals") };
    Ok(watched(robot, world, options))
}

struct Robot<'c> {
    drivetrain: Drivetrain,
    vehicle: Vehicle,
    odometry: Odometry,
    watch: Watch<'c>,
    avoidance: Histogram,
    around: LocalMap,
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

fn watched(mut robot: Robot<'_>, mut world: World<'_>, options: &Options) -> Vec<Sample> {
    let mut samples = Vec::new();
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
        let believed = robot.watch.localiser.pose_at(&odometry);
        let at = Point::from(believed.translation.vector);
        let goal = path.as_ref().and_then(|it| it.points().last().copied());
        let left = goal.map(|it| (it - at).norm());
        if left.is_none_or(|it| it < NEAR_M || !patience.lasts(it)) {
            path = world.goal(at);
            patience = Patience::new(0.3, 200);
            robot.watch.set_out();
        } else if let Some(goal) = goal.filter(|_| now.0.is_multiple_of(SAMPLE.0)) {
            // Planned anew from where it believes to be; the old path where that finds no room.
            if let Ok(anew) = world.planner.route(at, goal) {
                path = Some(anew);
            }
        }
        if let Some(path) = path.as_ref().filter(|_| now.0.is_multiple_of(SAMPLE.0)) {
            let room = world.planner.room();
            let of_path = OfPath::new(path.points(), &believed, room);
            let speed = robot.vehicle.speeds().speed;
            samples.extend(robot.watch.sample(&of_path, &believed, speed));
        }
        robot.go(path.as_ref(), &believed, &world, &people);
    }
    samples
}

impl Robot<'_> {
    fn sense(&mut self, now: Millis, odometry: &Pose, scene: &Scene<'_>) {
        let ranges = self.watch.sense(now, self.vehicle.pose(), odometry, None, scene);
        if !ranges.is_empty() {
            self.around.take_scan(&Pose::identity(), PI, ranges);
        }
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
