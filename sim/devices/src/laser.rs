//! Laser scanners.

use crate::faults::Faults;
use crate::scene::Scene;
use crate::sensed::{Clock, Pipe, Rate, Sensed};
use crate::settings::{SettingsError, within};
use core::f64::consts::{PI, TAU};
use cotama_core::units::Millis;
use cotama_floor::{Point, Pose, Ray, Sense, Vector};
use cotama_streams::{Stream, Streams};

/// Properties of a laser scanner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaserSettings {
    /// The scanner on the robot, in metres and radians: x ahead, y to the left.
    pub mount: Pose,
    /// The angle from the first ray to the last, in radians; all around, the last ray is a step
    /// before the first.
    pub view_rad: f64,
    /// The number of rays.
    pub rays: usize,
    /// Things that are nearer read this, in metres.
    pub least_m: f64,
    /// Nothing further away is seen, in metres.
    pub range_m: f64,
    /// Deviation of a range, in metres.
    pub noise_m: f64,
    /// Times of scans.
    pub rate: Rate,
}

impl LaserSettings {
    /// A Hokuyo URG-04LX at the robot's origin: 240°, 0.02 to 5.6 m, 10 Hz (SCIP 2.0 specification,
    /// answer PP: AMIN 44, AMAX 725, DMIN 20, DMAX 5600, SCAN 600), with a deviation of 1 cm as its
    /// accuracy up to 1 m is, and a scan of latency.
    pub fn hokuyo_urg(rays: usize) -> Self {
        Self {
            mount: Pose::identity(),
            view_rad: TAU * 681.0 / 1024.0,
            rays,
            least_m: 0.02,
            range_m: 5.6,
            noise_m: 0.01,
            rate: Rate { period: Millis(100), latency: Millis(100) },
        }
    }

    /// A SICK LMS200 at the robot's origin: 180° in 181 rays up to 8 m, 5 scans a second over its
    /// serial line, a deviation of 5 mm (its technical description).
    pub fn sick_lms200() -> Self {
        Self {
            mount: Pose::identity(),
            view_rad: PI,
            rays: 181,
            least_m: 0.0,
            range_m: 8.0,
            noise_m: 0.005,
            rate: Rate { period: Millis(200), latency: Millis(100) },
        }
    }
}

/// The most rays of a scan.
pub const MAX_RAYS: usize = 1 << 14;

/// A laser scanner: it looks through glass, and takes all ranges of a scan at one moment.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_devices::{Laser, LaserSettings, Scene, Streams};
/// use cotama_floor::{Point, Pose, Version, embedded};
/// let office = embedded::OFFICE.floor().unwrap();
/// let surface = office.surface(Version::Real, &[]).unwrap();
/// let settings = LaserSettings { noise_m: 0.0, ..LaserSettings::sick_lms200() };
/// let mut laser = Laser::new(&settings, &Streams::new(7), "laser").unwrap();
/// // In the corridor, which is 2 m wide, on the way to the east.
/// let pose = Pose::new(Point::new(4.0, 10.0).coords, 0.0);
/// laser.sense(Millis(0), &pose, &Scene::of(&surface, &[]));
/// assert!(laser.latest(Millis(99)).is_none()); // on its way
/// let scan = laser.latest(Millis(100)).unwrap();
/// assert_eq!((scan.taken, scan.value.len()), (Millis(0), 181));
/// let near = |at: usize| (scan.value[at] * 1_000.0).round();
/// assert_eq!([near(0), near(30), near(150)], [1_000.0, 1_155.0, 1_155.0]);
/// assert_eq!(scan.value[90], f64::INFINITY);
/// ```
#[derive(Clone, Debug)]
pub struct Laser {
    mount: Pose,
    least_m: f64,
    range_m: f64,
    noise_m: f64,
    clock: Clock,
    /// The ways of the rays as the scanner sees them.
    ways: Vec<Vector>,
    rays: Vec<Ray>,
    ranges: Vec<f64>,
    noise: Stream,
    faults: Faults,
    pipe: Pipe<f64>,
}

impl Laser {
    /// A scanner of a name, after which its random numbers are named.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn new(
        settings: &LaserSettings,
        streams: &Streams,
        name: &str,
    ) -> Result<Self, SettingsError> {
        let LaserSettings { mount, view_rad, rays, least_m, range_m, noise_m, rate } = *settings;
        within("the number of rays", rays as f64, 1.0, MAX_RAYS as f64)?;
        within("the field of view in radians", view_rad, 0.0, TAU)?;
        within("the range in m", range_m, 0.01, 1_000.0)?;
        within("the least range in m", least_m, 0.0, range_m)?;
        within("the deviation in m", noise_m, 0.0, 100.0)?;
        let ways = fan(view_rad, rays);
        Ok(Self {
            mount,
            least_m,
            range_m,
            noise_m,
            clock: Clock::new(rate.period),
            rays: vec![Ray { from: Point::origin(), along: Vector::x() }; rays],
            ranges: vec![f64::INFINITY; rays],
            ways,
            noise: streams.stream(name),
            faults: Faults::none(rays, rate.period),
            pipe: Pipe::new(rays, f64::INFINITY, rate)?,
        })
    }

    /// Returns the faults of its ranges, to be replaced.
    pub fn faults(&mut self) -> &mut Faults {
        &mut self.faults
    }

    /// The time of the next scan.
    pub fn due(&self) -> Millis {
        self.clock.due()
    }

    /// The angle of a ray on the scanner, in radians: 0 straight ahead, positive to the left.
    pub fn angle(&self, ray: usize) -> f64 {
        self.ways.get(ray).map_or(0.0, |it| libm::atan2(it.y, it.x))
    }

    /// Takes a scan if one is due, for a robot at a pose.
    pub fn sense(&mut self, now: Millis, robot: &Pose, scene: &Scene<'_>) {
        if !self.clock.strikes(now) {
            return;
        }
        let at = robot * self.mount;
        let from = Point::from(at.translation.vector);
        for (ray, way) in self.rays.iter_mut().zip(&self.ways) {
            *ray = Ray { from, along: at.rotation * way };
        }
        scene.distances((from, 0.0), &self.rays, self.range_m, Sense::Light, &mut self.ranges);
        for range in &mut self.ranges {
            // Drawn for each ray, so that what one sees does not change the noise of another.
            let error = self.noise.error() * self.noise_m;
            *range = (*range + error).max(self.least_m);
            if *range > self.range_m {
                *range = f64::INFINITY;
            }
        }
        if self.faults.apply(now, &mut self.ranges) {
            self.pipe.push(now, &self.ranges);
        }
    }

    /// Returns the newest scan that has arrived: ranges in metres from the rightmost ray to the
    /// leftmost, infinity where nothing was seen.
    pub fn latest(&self, now: Millis) -> Option<Sensed<&[f64]>> {
        self.pipe.latest(now)
    }
}

/// Returns ways from the right to the left, as evenly as mirrors: the n-th from either side have
/// the same numbers but for the sign of y.
pub(crate) fn fan(view_rad: f64, rays: usize) -> Vec<Vector> {
    let gaps = if view_rad < TAU { rays.saturating_sub(1).max(1) } else { rays };
    let angle = |at: usize| {
        let twice = 2.0 * at as f64 - rays.saturating_sub(1) as f64;
        view_rad * twice / (2.0 * gaps as f64)
    };
    let way = |at: usize| {
        let (sin, cos) = libm::sincos(angle(at));
        Vector::new(cos, sin)
    };
    (0..rays).map(way).collect()
}
