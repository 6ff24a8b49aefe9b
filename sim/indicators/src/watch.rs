//! Estimates that a robot makes by its sensors: where it is, how sure of that and of its map.

use crate::map::Map;
use crate::no_drive::NoDrive;
use crate::sample::{OfPath, Sample, WINDOW, variance};
use core::f64::consts::{PI, TAU};
use cotama_core::units::Millis;
use cotama_devices::{Laser, LaserSettings, Rate, Scene};
use cotama_floor::{Bounds, Pose, Surface};
use cotama_localisation::{Chart, Localiser, Parameters, Sensor};
use cotama_streams::Streams;
use std::collections::VecDeque;

/// Range of the laser in metres, and its rays.
const RANGE_M: f64 = 8.0;
pub(crate) const RAYS: usize = 91;

/// A laser of 180° and 8 m, a map of its scans, and a pose by odometry and scans.
pub(crate) struct Watch<'c> {
    pub(crate) localiser: Localiser<'c>,
    laser: Laser,
    map: Map,
    log: Log,
}

/// Memory between samples.
struct Log {
    /// Sum of the entropies of the pose on the way to this goal, and how many they are.
    entropy: (f64, u32),
    angles: VecDeque<f64>,
    headings: VecDeque<f64>,
}

/// Returns the settings of a laser that scans once a period.
fn settings(period: Millis) -> LaserSettings {
    LaserSettings {
        range_m: RANGE_M,
        rays: RAYS,
        rate: Rate { period, latency: Millis(0) },
        ..LaserSettings::sick_lms200()
    }
}

/// Returns the floor that a robot knows, prepared for its laser.
pub(crate) fn chart(charted: &dyn Surface) -> Result<Chart, NoDrive> {
    let settings = settings(Millis(1));
    let sensor = Sensor::laser(&settings.mount, settings.view_rad, RAYS, RANGE_M);
    let sensor = sensor.map_err(|_| NoDrive::Large)?;
    let parameters = Parameters { max_beams: 60, max_particles: 1_000, ..Parameters::default() };
    Chart::new(charted, 0.1, &sensor, &parameters).map_err(|_| NoDrive::Large)
}

impl<'c> Watch<'c> {
    /// Begins at a pose that the robot knows to about 10 cm.
    pub(crate) fn new(
        chart: &'c Chart,
        bounds: &Bounds,
        period: Millis,
        pose: &Pose,
        streams: Streams,
    ) -> Result<Self, NoDrive> {
        let map = Map::new(bounds).ok_or(NoDrive::Large)?;
        let laser = Laser::new(&settings(period), &streams, "laser").map_err(|_| NoDrive::Large)?;
        let mut localiser = Localiser::new(chart, &streams, "robot");
        let sure = nalgebra::Matrix3::from_diagonal(&nalgebra::Vector3::new(0.01, 0.01, 0.01));
        localiser.start_at(pose, &sure).map_err(|_| NoDrive::Places)?;
        let log = Log { entropy: (0.0, 0), angles: VecDeque::new(), headings: VecDeque::new() };
        Ok(Self { localiser, laser, map, log })
    }

    /// Takes a scan where the robot is, and localises it; it is believed to be at a pose, or where
    /// that says. Returns the ranges.
    pub(crate) fn sense(
        &mut self,
        now: Millis,
        pose: &Pose,
        odometry: &Pose,
        believed: Option<&Pose>,
        scene: &Scene<'_>,
    ) -> &[f64] {
        self.laser.sense(now, pose, scene);
        let Some(scan) = self.laser.latest(now) else { return &[] };
        self.localiser.update(odometry, scan.value);
        let own = self.localiser.pose_at(odometry);
        self.map.take(believed.unwrap_or(&own), PI, RANGE_M, scan.value);
        scan.value
    }

    /// Another goal: the uncertainty of the pose is averaged anew.
    pub(crate) fn set_out(&mut self) {
        self.log.entropy = (0.0, 0);
    }

    /// The indicators; none until variances have their samples.
    pub(crate) fn sample(
        &mut self,
        of_path: &OfPath,
        believed: &Pose,
        speed: f64,
    ) -> Option<Sample> {
        let log = &mut self.log;
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
                speed,
                variance(log.headings.iter().copied()),
            ])
        })
    }
}

/// Entropy of a normal distribution with this covariance, in nats; a millimetre and a milliradian
/// are as sure as it gets.
fn entropy(covariance: &nalgebra::Matrix3<f64>) -> f64 {
    let least = nalgebra::Matrix3::from_diagonal_element(1e-6);
    let volume = (covariance + least).determinant().max(1e-18);
    1.5 * (1.0 + libm::log(TAU)) + libm::log(volume) / 2.0
}
