//! Readings that sonars should give, from the map and the believed pose.

use crate::work::Work;
use cotama_devices::RingSettings;
use cotama_floor::{Pose, Ray, Sense, Surface, Vector};

/// The ring of sonars as a robot computes it: "hardware in the loop" where sonars are simulated
/// (Durand et al., TAROS 2010, Section IV.B.2), and what an observer holds readings against.
///
/// The rays of each cone are those of `cotama_devices::Ring`; an echo comes back where the chance
/// of it is at least a half. There is no noise, no cross talk and no latency.
///
/// ```
/// use cotama_devices::RingSettings;
/// use cotama_floor::{Point, Pose, Version, embedded};
/// use cotama_navigation::Expected;
/// let office = embedded::OFFICE.floor().unwrap();
/// let charted = office.surface(Version::Charted, &[]).unwrap();
/// let mut expected = Expected::new(&RingSettings::pioneer());
/// let believed = Pose::new(Point::new(10.5, 10.0).coords, 0.0);
/// // To the left a wall, 1 m away from the middle; along the corridor nothing.
/// let ranges = expected.look(&charted, &believed);
/// assert_eq!(((ranges[0] * 1_000.0).round(), ranges[3]), (864.0, 5.0));
/// assert_eq!(expected.work().rays, 16 * 5);
/// ```
#[derive(Clone, Debug)]
pub struct Expected {
    mounts: Vec<Pose>,
    /// The ways of the rays of a cone.
    ways: Vec<Vector>,
    least_m: f64,
    range_m: f64,
    /// The least cosine of an angle of incidence from which an echo comes back.
    cosine: f64,
    ranges: Vec<f64>,
    work: Work,
}

impl Expected {
    /// A ring of settings, as it is fitted to the robot.
    pub fn new(settings: &RingSettings) -> Self {
        let RingSettings { mounts, cone_rad, rays, least_m, range_m, .. } = settings;
        let step = cone_rad / rays.saturating_sub(1).max(1) as f64;
        let first = if *rays > 1 { -cone_rad / 2.0 } else { 0.0 };
        let way = |at: usize| {
            let (sin, cos) = libm::sincos(first + at as f64 * step);
            Vector::new(cos, sin)
        };
        let (sure, never) = (libm::cos(settings.echo_rad), libm::cos(settings.mirror_rad));
        Self {
            mounts: mounts.clone(),
            ways: (0..*rays).map(way).collect(),
            least_m: *least_m,
            range_m: *range_m,
            cosine: f64::midpoint(sure, never),
            ranges: vec![*range_m; mounts.len()],
            work: Work::default(),
        }
    }

    /// Returns the range of each sonar in metres, for a believed pose on a charted floor.
    pub fn look(&mut self, charted: &dyn Surface, believed: &Pose) -> &[f64] {
        for (range, mount) in self.ranges.iter_mut().zip(&self.mounts) {
            let sonar = believed * mount;
            *range = self.range_m;
            for way in &self.ways {
                let from = sonar.translation.vector.into();
                let ray = Ray { from, along: sonar.rotation * way };
                self.work.rays += 1;
                if let Some(hit) = charted.hit(&ray, self.range_m, Sense::Sound)
                    && hit.cosine >= self.cosine
                {
                    *range = range.min(hit.distance);
                }
            }
            *range = range.max(self.least_m);
        }
        &self.ranges
    }

    /// Returns the work that was done since it was made.
    pub const fn work(&self) -> Work {
        self.work
    }
}
