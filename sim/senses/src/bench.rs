//! The common part of the robots of a mission: the map, and what a sound robot shows on its course.

use crate::lasers::{self, Lasers};
use crate::sonars::{RANGE_M, ring, short};
use cotama_core::units::{Millimetres, MillimetresPerSecond, Millis};
use cotama_devices::{MAX_ACCESS_POINTS, QrMark, Ring, Scene, SettingsError, Streams};
use cotama_floor::{Bounds, Floor, Point, Vector};
use cotama_localisation::{Chart, Model, Parameters, Sensor};
use cotama_models::robots::{Body, Robot};
use cotama_observers::{Jumps, LastingSurvey, SonarSurvey, Survey, Tail};
use cotama_plane::{Course, Rover};
use std::fmt;

/// All that the senses of a mission's runs share.
#[derive(Clone, Debug)]
pub struct Bench {
    pub(crate) chart: Chart,
    pub(crate) far: SonarSurvey,
    pub(crate) near: SonarSurvey,
    pub(crate) behind: Tail,
    pub(crate) waits: Tail,
    pub(crate) jumps: Tail,
    /// The access points of the link to the operator.
    pub(crate) access: Vec<Point>,
    /// The lasers by which the robot localises, a bit each; where there are none, by its sonars.
    pub(crate) localising: u64,
    /// Tails of each laser: how long it sees nothing, and how long it does not match the map.
    pub(crate) scans: Vec<[Tail; 2]>,
    pub(crate) marks: Vec<QrMark>,
}

/// Why a robot has no senses.
#[derive(Clone, Debug, PartialEq)]
pub enum NoBench {
    /// The floor cannot be charted.
    Chart(String),
    /// A number of a device or an observer.
    Settings(SettingsError),
}

impl fmt::Display for NoBench {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Chart(why) => write!(f, "the floor cannot be charted: {why}"),
            Self::Settings(why) => write!(f, "a device or an observer cannot be: {why}"),
        }
    }
}

impl std::error::Error for NoBench {}

impl From<SettingsError> for NoBench {
    fn from(it: SettingsError) -> Self {
        Self::Settings(it)
    }
}

/// Cells of the chart, in metres.
const CELL_M: f64 = 0.1;
/// Spells at the largest range, and at a short one, that a survey notes, in metres of way.
const FAR_BEYOND_M: f64 = 0.25;
const NEAR_BEYOND_M: f64 = 0.3;
/// The most of a tile of the floor that one access point serves, in metres.
const TILE_M: f64 = 10.0;
/// Spells in which a scan sees nothing, or does not match the map, that a survey notes, in s.
const SCAN_BEYOND_S: f64 = 0.3;
/// Times in which ranges jump that a survey notes, in seconds: shorter ones are edges that pass,
/// and longer ones, along rows of things, have a tail of their own.
const JUMPY_BEYOND_S: f64 = 1.0;
/// The longest survey.
const LONGEST: Millis = Millis(3_600_000);

/// Parameters of the filter: 100 to 500 particles; the ring is one reading of 16 beams.
fn parameters() -> Parameters {
    Parameters {
        min_particles: 100,
        max_particles: 500,
        max_beams: 16,
        update_min_d: 0.05,
        update_min_a: 0.05,
        resample_interval: 2,
        // Few beams: their likelihoods are multiplied, as a sum of cubes makes too little of them.
        laser_model_type: Model::LikelihoodFieldProb,
        ..Parameters::default()
    }
}

impl Bench {
    /// Charts the floor of a course, and lets a sound robot drive it once.
    ///
    /// # Errors
    /// A [`NoBench`] for a floor that is too large, or numbers that make no sense.
    pub fn of(course: &Course, robot: &Robot, body: &Body) -> Result<Self, NoBench> {
        let why = |it: &dyn fmt::Display| NoBench::Chart(it.to_string());
        let settings = ring();
        let sensing = &body.sensing;
        let localising = lasers::localising(robot, sensing);
        let (sensor, parameters) = if localising == 0 {
            let ring = Sensor::sonars(&settings.mounts, settings.cone_rad, 3, RANGE_M);
            (ring, parameters())
        } else {
            (lasers::sensor(&sensing.lasers, localising), lasers::parameters())
        };
        let sensor = sensor.map_err(|it| why(&it))?;
        let charted = course.charted();
        let chart = Chart::new(charted, CELL_M, &sensor, &parameters).map_err(|it| why(&it))?;
        let mut far = SonarSurvey::new(RANGE_M, FAR_BEYOND_M)?;
        let mut near = SonarSurvey::new(RANGE_M, NEAR_BEYOND_M)?;
        let mut behind = Survey::beyond(2.0)?;
        let mut waits = Survey::beyond(2.0)?;
        let mut jumps = Survey::beyond(JUMPY_BEYOND_S)?;
        let (mut jumping, mut jumping_s) = (Jumps::default(), 0.0);
        let streams = Streams::new(0x5EED);
        let mut ring = Ring::new(&settings, &streams, "survey")?;
        let mut scanners = Lasers::new(sensing, streams)?;
        let beyond = || LastingSurvey::beyond(SCAN_BEYOND_S);
        let scans = (0..scanners.count()).map(|_| Ok([beyond()?, beyond()?]));
        let mut scans = scans.collect::<Result<Vec<_>, SettingsError>>()?;
        let mut rover = Rover::new(course, 0);
        let end = Millimetres((course.track().length() * 1_000.0) as u64);
        let (period, mut way_m) = (body.period, 0.0);
        while rover.x() < end && rover.now() < LONGEST {
            let before = *rover.pose();
            rover.go(MillimetresPerSecond(body.speed_max.0), end, period);
            way_m += (rover.pose().translation.vector - before.translation.vector).norm();
            let scene = Scene::of(course.surface(), &[]);
            ring.sense(rover.now(), rover.pose(), &scene);
            scanners.sense(rover.now(), rover.pose(), rover.odometry(), &scene);
            let origin = rover.pose() * rover.odometry().inverse();
            for (at, [blind, apart]) in scans.iter_mut().enumerate() {
                let is_blind = scanners.is_blind(at, rover.now());
                is_blind.into_iter().for_each(|it| blind.look(it));
                let is_apart = scanners.is_apart(at, rover.now(), &origin, charted);
                is_apart.into_iter().for_each(|it| apart.look(it));
            }
            if let Some(read) = ring.latest(rover.now()) {
                far.look(read, way_m, period);
                if jumping.look(read) {
                    jumping_s += period.0 as f64 / 1_000.0;
                } else {
                    jumps.add(core::mem::take(&mut jumping_s));
                }
                let shorts: Vec<_> = read.iter().map(|it| it.map(short)).collect();
                near.look(&shorts, way_m, period);
            }
        }
        behind.watch(rover.now());
        waits.watch(rover.now());
        jumps.watch(rover.now());
        let (behind, waits, jumps) = (behind.tail()?, waits.tail()?, jumps.tail()?);
        let access = access_points(&course.surface().bounds());
        let scans = scans.iter().map(|[blind, apart]| Ok([blind.tail()?, apart.tail()?]));
        let scans = scans.collect::<Result<_, SettingsError>>()?;
        let way = course.way();
        let marks = Floor::parse(&way.source, &way.text).map(|it| QrMark::of(&it));
        let marks = marks.unwrap_or_default();
        Ok(Self { chart, far, near, behind, waits, jumps, access, localising, scans, marks })
    }
}

/// Returns the access points of a floor, as none says where they are: one in the middle of each of
/// equal tiles of at most 10 m, or of more where that were too many (assumed).
fn access_points(floor: &Bounds) -> Vec<Point> {
    let size = floor.most - floor.least;
    let mut tile = TILE_M;
    let count = |tile: f64| size.map(|it| (it / tile).ceil().max(1.0) as usize);
    while count(tile).product() > MAX_ACCESS_POINTS {
        tile *= 2.0;
    }
    let [columns, rows] = count(tile).into();
    let place = |column: usize, row: usize| {
        let part = |at: usize, of: usize| (at as f64 + 0.5) / of as f64;
        let parts = Vector::new(part(column, columns), part(row, rows));
        floor.least + size.component_mul(&parts)
    };
    (0..columns).flat_map(|column| (0..rows).map(move |row| place(column, row))).collect()
}
