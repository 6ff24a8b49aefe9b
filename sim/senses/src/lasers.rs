//! Laser scanners: their scans, the map as they see it, and how well a scan matches it.

use core::f64::consts::TAU;
use cotama_core::units::Millis;
use cotama_devices::{Fault, Laser, LaserSettings, Mode, Rate, Scene, Sensed};
use cotama_devices::{SettingsError, Streams};
use cotama_floor::{Point, Pose, Ray, Sense, Surface, Vector};
use cotama_localisation::{Model, Parameters, Sensor, SensorError};
use cotama_models::robots::sensing::{LaserScanner, Mount};
use cotama_models::robots::{Harm, Harmed, Robot, Role, Sensing};
use cotama_navigation::LocalMap;
use std::collections::VecDeque;

/// Beams of a reading that localisation looks at, and that are held against the map.
pub(crate) const BEAMS: usize = 60;
/// Points of a scan that avoidance keeps, and how far away they may be, in metres.
const POINTS: usize = 90;
pub(crate) const NEAR_M: f64 = 5.0;
/// A range is off that differs from what the map says by more than this, in metres, and by this
/// part of it: the pose may be wrong by a few centimetres and degrees.
const OFF_M: f64 = 0.25;
const OFF_PART: f64 = 0.04;
/// The part of the beams that may be off: people, doors, and what is on no map.
const MOST_OFF: f64 = 0.4;
/// The part of the rays that see nothing, of a scanner that is blind.
const BLIND: f64 = 0.99;
/// The time for which the robot knows where it was when a scan was taken.
const HISTORY: usize = 32;

/// The scanners of a robot.
#[derive(Clone, Debug)]
pub(crate) struct Lasers {
    all: Vec<Scanner>,
    /// The odometry of the last periods, the oldest first.
    history: VecDeque<(Millis, Pose)>,
}

#[derive(Clone, Debug)]
struct Scanner {
    laser: Laser,
    settings: LaserSettings,
    /// The hardware that it is, as a bit.
    hardware: u64,
    name: String,
}

/// A scan: where the robot was by its odometry, and ranges.
pub(crate) struct Reading {
    pub(crate) odometry: Pose,
    pub(crate) ranges: Vec<f64>,
}

/// Returns where a device is on the robot.
pub(crate) fn mount(of: &Mount) -> Pose {
    let at = Vector::new(f64::from(of.x_mm), f64::from(of.y_mm)) / 1_000.0;
    Pose::new(at, f64::from(of.heading_deg).to_radians())
}

fn settings(of: &LaserScanner) -> LaserSettings {
    let metres = |it: u64| it as f64 / 1_000.0;
    let [least, range] = of.range;
    let view_rad = if of.view_deg == 360 { TAU } else { f64::from(of.view_deg).to_radians() };
    LaserSettings {
        mount: mount(&of.mount),
        view_rad,
        rays: usize::from(of.rays),
        least_m: metres(least.0),
        range_m: metres(range.0),
        noise_m: metres(of.noise.0),
        rate: Rate { period: of.times[0], latency: of.times[1] },
    }
}

/// Returns the scanners, a bit each by number, by which a robot localises: those that the first of
/// its modules stands on that localises by any.
pub(crate) fn localising(robot: &Robot, sensing: &Sensing) -> u64 {
    let all = robot.modules.iter().enumerate();
    let all = all.filter(|it| it.1.roles.contains(&Role::Localisation));
    let of = |it: usize| under(&sensing.lasers, robot.hardware_under(1 << it));
    all.map(|it| of(it.0)).find(|it| *it != 0).unwrap_or(0)
}

/// Returns the scanners that are among hardware.
pub(crate) fn under(lasers: &[LaserScanner], hardware: u64) -> u64 {
    let is_of = |it: &LaserScanner| hardware >> it.hardware & 1 == 1;
    let all = lasers.iter().enumerate().filter(|it| is_of(it.1));
    all.fold(0, |set, it| set | 1 << it.0)
}

/// Returns the scanners of a set as one sensor, with the shortest of their ranges.
pub(crate) fn sensor(lasers: &[LaserScanner], set: u64) -> Result<Sensor, SensorError> {
    let of = lasers.iter().enumerate().filter(|it| set >> it.0 & 1 == 1);
    let all: Vec<_> = of.map(|it| settings(it.1)).collect();
    let range_m = all.iter().fold(f64::INFINITY, |least, it| least.min(it.range_m));
    let all: Vec<_> = all.iter().map(|it| (it.mount, it.view_rad, it.rays)).collect();
    Sensor::lasers(&all, range_m)
}

/// Parameters of the filter: 100 to 500 particles, 60 beams, whose likelihoods are multiplied.
pub(crate) fn parameters() -> Parameters {
    Parameters {
        min_particles: 100,
        max_particles: 500,
        max_beams: BEAMS,
        update_min_d: 0.1,
        update_min_a: 0.1,
        resample_interval: 2,
        laser_model_type: Model::LikelihoodFieldProb,
        ..Parameters::default()
    }
}

impl Lasers {
    pub(crate) fn new(sensing: &Sensing, streams: Streams) -> Result<Self, SettingsError> {
        let of = |(number, it): (usize, &LaserScanner)| {
            let settings = settings(it);
            let name = format!("laser {number}");
            let laser = Laser::new(&settings, &streams, &name)?;
            Ok(Scanner { laser, settings, hardware: 1 << it.hardware, name })
        };
        let all: Result<_, _> = sensing.lasers.iter().enumerate().map(of).collect();
        Ok(Self { all: all?, history: VecDeque::with_capacity(HISTORY) })
    }

    /// Harms the scanners, or mends them.
    pub(crate) fn harm(&mut self, harms: &[Harmed], now: Millis, streams: Streams) {
        for (number, it) in self.all.iter_mut().enumerate() {
            let own = |harm: &&Harmed| usize::from(harm.unit) == number;
            let mode = |harm: &Harmed| match harm.harm {
                Harm::LaserSilent => Some(Mode::DropOut(1.0)),
                Harm::LaserBlind => Some(Mode::Stuck(it.settings.range_m)),
                Harm::LaserBiased => Some(Mode::Bias(f64::from(harm.permille) / 1_000.0)),
                _ => None,
            };
            let modes = harms.iter().filter(own).filter_map(mode);
            let faults: Vec<_> =
                modes.filter_map(|it| Fault::new(it).ok()).map(|it| it.from(now)).collect();
            let set = it.laser.faults().replace(&faults, &streams, &it.name);
            debug_assert!(set.is_ok(), "faults of ranges");
        }
    }

    /// Takes the scans that are due.
    pub(crate) fn sense(&mut self, now: Millis, pose: &Pose, odometry: &Pose, scene: &Scene<'_>) {
        if self.all.is_empty() {
            return;
        }
        if self.history.len() == HISTORY {
            self.history.pop_front();
        }
        self.history.push_back((now, *odometry));
        self.all.iter_mut().for_each(|it| it.laser.sense(now, pose, scene));
    }

    /// Returns the odometry at a time of the last periods.
    fn then(&self, taken: Millis) -> Option<Pose> {
        self.history.iter().find(|it| it.0 == taken).map(|it| it.1)
    }

    pub(crate) fn count(&self) -> usize {
        self.all.len()
    }

    /// Returns when the newest scan of a scanner was taken.
    pub(crate) fn taken(&self, number: usize, now: Millis) -> Option<Millis> {
        Some(self.all.get(number)?.laser.latest(now)?.taken)
    }

    /// Whether the newest scan of a scanner sees nothing.
    pub(crate) fn is_blind(&self, number: usize, now: Millis) -> Option<Sensed<bool>> {
        let it = self.all.get(number)?;
        let Sensed { taken, value } = it.laser.latest(now)?;
        let far = value.iter().filter(|range| **range >= it.settings.range_m).count();
        Some(Sensed { taken, value: far as f64 >= BLIND * value.len() as f64 })
    }

    /// Whether too many beams of the newest scan of a scanner are off by the map, for a robot that
    /// believes the origin of its odometry to be there.
    pub(crate) fn is_apart(
        &self,
        number: usize,
        now: Millis,
        origin: &Pose,
        charted: &dyn Surface,
    ) -> Option<Sensed<bool>> {
        let Scanner { laser, settings, .. } = self.all.get(number)?;
        let Sensed { taken, value } = laser.latest(now)?;
        let at = origin * self.then(taken)? * settings.mount;
        let from = Point::from(at.translation.vector);
        let step = value.len().div_ceil(BEAMS).max(1);
        let rays: Vec<_> = (0..value.len()).step_by(step).collect();
        let off = rays.iter().filter(|ray| {
            let (sin, cos) = libm::sincos(laser.angle(**ray));
            let ray_m = settings.range_m;
            let way = Ray { from, along: at.rotation * Vector::new(cos, sin) };
            let expected = charted.hit(&way, ray_m, Sense::Light).map_or(ray_m, |it| it.distance);
            let read = value.get(**ray).map_or(ray_m, |it| it.min(ray_m));
            (read - expected).abs() > OFF_M + OFF_PART * expected
        });
        Some(Sensed { taken, value: off.count() as f64 > MOST_OFF * rays.len() as f64 })
    }

    /// Returns the newest scans of a set as one reading; `None` unless all were taken at one time.
    pub(crate) fn reading(&self, set: u64, now: Millis) -> Option<Reading> {
        let mut ranges = Vec::new();
        let mut taken = None;
        for (_, it) in self.all.iter().enumerate().filter(|it| set >> it.0 & 1 == 1) {
            let scan = it.laser.latest(now)?;
            if *taken.get_or_insert(scan.taken) != scan.taken {
                return None;
            }
            let seen =
                |range: &f64| if *range < it.settings.range_m { *range } else { f64::INFINITY };
            ranges.extend(scan.value.iter().map(seen));
        }
        Some(Reading { odometry: self.then(taken?)?, ranges })
    }

    /// Returns the scans that have arrived of scanners among hardware, thinned and near alone: the
    /// pose of the scanner as the robot sees it now, the field of view, and ranges.
    fn near(&self, hardware: u64, now: Millis, odometry: &Pose) -> Vec<(Pose, f64, Vec<f64>)> {
        let back = odometry.inverse();
        let of = |it: &Scanner| {
            let Sensed { taken, value } = it.laser.latest(now)?;
            let step = value.len().div_ceil(POINTS).max(1);
            let last = (value.len().saturating_sub(1) / step) * step;
            let [right, left] = [0, last].map(|ray| it.laser.angle(ray));
            let at = back * self.then(taken)? * it.settings.mount;
            let most = it.settings.range_m.min(NEAR_M);
            let near = |range: &f64| if *range < most { *range } else { f64::INFINITY };
            let ranges = value.iter().step_by(step).map(near).collect();
            Some((at * Pose::rotation(f64::midpoint(right, left)), left - right, ranges))
        };
        self.all.iter().filter(|it| it.hardware & hardware != 0).filter_map(of).collect()
    }

    /// Adds what scanners see to the map of what is around.
    pub(crate) fn map(&self, hardware: u64, now: Millis, odometry: &Pose, map: &mut LocalMap) {
        for (at, view, ranges) in self.near(hardware, now, odometry) {
            map.take_scan(&at, view, &ranges);
        }
    }

    /// Returns what scanners see, as the robot sees it now.
    pub(crate) fn points(&self, hardware: u64, now: Millis, odometry: &Pose) -> Vec<Point> {
        let mut points = Vec::new();
        for (at, view, ranges) in self.near(hardware, now, odometry) {
            let step = view / ranges.len().saturating_sub(1).max(1) as f64;
            for (ray, range) in ranges.iter().enumerate().filter(|it| it.1.is_finite()) {
                let (sin, cos) = libm::sincos(ray as f64 * step - view / 2.0);
                points.push(at * Point::new(range * cos, range * sin));
            }
        }
        points
    }
}
