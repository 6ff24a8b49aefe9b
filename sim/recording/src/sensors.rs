//! Sensors along the poses of a run.

use crate::messages::Cone;
use cotama_core::units::Millis;
use cotama_devices::{
    Laser, LaserSettings, Rate, Ring, RingSettings, Scene, SettingsError, Streams,
};
use cotama_floor::{Pose, Surface};

/// The rays of a scan.
const RAYS: usize = 180;

/// A laser and a ring of sonars, which read at each pose as if the robot stood there.
#[derive(Debug)]
pub(crate) struct Sensors {
    pub(crate) laser: Laser,
    pub(crate) laser_mount: Pose,
    pub(crate) laser_m: [f64; 2],
    sonars: RingSettings,
    ring: Ring,
    /// The time of the sensors, which counts readings.
    now: Millis,
}

impl Sensors {
    /// Sensors whose noise follows from a seed: the laser of a Hokuyo URG-04LX, the sonars of a
    /// Pioneer 3-DX.
    pub(crate) fn new(seed: u64) -> Result<Self, SettingsError> {
        let streams = Streams::new(seed);
        let rate = Rate { period: Millis(1), latency: Millis(0) };
        let settings = LaserSettings { rate, ..LaserSettings::hokuyo_urg(RAYS) };
        let sonars = RingSettings { rate, ..RingSettings::pioneer() };
        Ok(Self {
            laser: Laser::new(&settings, &streams, "recording laser")?,
            laser_mount: settings.mount,
            laser_m: [settings.least_m, settings.range_m],
            ring: Ring::new(&sonars, &streams, "recording sonar")?,
            sonars,
            now: Millis(0),
        })
    }

    /// Returns the frame of each sonar on the robot.
    pub(crate) fn sonar_mounts(&self) -> &[Pose] {
        &self.sonars.mounts
    }

    /// Takes a scan, and a whole sweep of the sonars.
    pub(crate) fn sense(&mut self, robot: &Pose, floor: &dyn Surface) -> (Vec<f64>, Vec<Cone>) {
        let scene = Scene::of(floor, &[]);
        self.laser.sense(self.now, robot, &scene);
        for _ in 0..self.sonars.mounts.len() / self.sonars.banks.max(1) {
            self.ring.sense(self.now, robot, &scene);
            self.now.0 += 1;
        }
        let scan = self.laser.latest(self.now).map_or_else(Vec::new, |it| it.value.to_vec());
        let RingSettings { cone_rad, least_m, range_m, .. } = self.sonars;
        let read = self.ring.latest(self.now).unwrap_or_default().iter();
        let cone = |(mount, read): (&Pose, &Option<cotama_devices::Sensed<f64>>)| Cone {
            mount: *mount,
            view_rad: cone_rad,
            least_m,
            most_m: range_m,
            range_m: read.map_or(range_m, |it| it.value),
        };
        (scan, self.sonars.mounts.iter().zip(read).map(cone).collect())
    }
}
