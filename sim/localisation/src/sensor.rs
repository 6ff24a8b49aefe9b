//! Beams of a sensor, and those of a reading that are looked at.

use core::f64::consts::{PI, TAU};
use cotama_floor::{Pose, Sense};

/// The most beams of a sensor.
pub const MAX_BEAMS: usize = 1 << 14;
/// The most rays that stand for the cone of a sonar.
pub const MAX_CONE_RAYS: usize = 16;

/// Reasons why there is no such sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorError {
    /// The number that is out of range.
    pub name: &'static str,
    /// The number.
    pub found: f64,
    /// The range.
    pub range: [f64; 2],
}

impl core::fmt::Display for SensorError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { name, found, range: [least, most] } = self;
        write!(f, "{name} is {found}; give a number from {least} to {most}")
    }
}

impl core::error::Error for SensorError {}

fn within(name: &'static str, found: f64, least: f64, most: f64) -> Result<(), SensorError> {
    let is_good = (least..=most).contains(&found);
    if is_good { Ok(()) } else { Err(SensorError { name, found, range: [least, most] }) }
}

/// A sensor of ranges on a robot: a laser, or a ring of sonars.
///
/// A beam is a ray, or a cone of a few rays. The range of a cone is that of the nearest thing in
/// it, which may lie anywhere across: the likelihood field takes the likeliest of the end points on
/// the arc, the beam model compares with the shortest of the rays.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensor {
    mounts: Vec<Pose>,
    /// The angles of a beam's rays as the beam sees them.
    across: Vec<f64>,
    range_m: f64,
    sense: Sense,
}

impl Sensor {
    /// A laser: `view_rad` is the angle from the first ray, on the right, to the last; all around,
    /// the last ray is a step before the first. Nothing beyond `range_m` is seen.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn laser(
        mount: &Pose,
        view_rad: f64,
        rays: usize,
        range_m: f64,
    ) -> Result<Self, SensorError> {
        Self::lasers(&[(*mount, view_rad, rays)], range_m)
    }

    /// Several lasers as one: each with its mount, field of view and rays, as for
    /// [`laser`](Self::laser). A reading has the ranges of the first one, then those of the second,
    /// and so on; nothing beyond `range_m` is seen by any of them.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn lasers(all: &[(Pose, f64, usize)], range_m: f64) -> Result<Self, SensorError> {
        let beams: usize = all.iter().map(|it| it.2).sum();
        within("the number of rays", beams as f64, 1.0, MAX_BEAMS as f64)?;
        let mut mounts = Vec::with_capacity(beams);
        for &(mount, view_rad, rays) in all {
            within("the field of view in radians", view_rad, 0.0, TAU)?;
            let gaps = if view_rad < TAU { rays.saturating_sub(1).max(1) } else { rays };
            let angle = |at: usize| {
                let twice = 2.0 * at as f64 - rays.saturating_sub(1) as f64;
                view_rad * twice / (2.0 * gaps as f64)
            };
            mounts.extend((0..rays).map(|at| mount * Pose::rotation(angle(at))));
        }
        Self { mounts, across: vec![0.0], range_m, sense: Sense::Light }.checked()
    }

    /// Sonars that look along the x axes of their poses on the robot, each with a cone of an angle,
    /// for which `rays` rays stand. They read `range_m` where nothing is heard.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn sonars(
        mounts: &[Pose],
        cone_rad: f64,
        rays: usize,
        range_m: f64,
    ) -> Result<Self, SensorError> {
        within("the number of sonars", mounts.len() as f64, 1.0, MAX_BEAMS as f64)?;
        within("the number of rays of a cone", rays as f64, 1.0, MAX_CONE_RAYS as f64)?;
        within("the cone in radians", cone_rad, 0.0, PI)?;
        let gaps = rays.saturating_sub(1).max(1) as f64;
        let angle = |at: usize| cone_rad * (at as f64 - (rays - 1) as f64 / 2.0) / gaps;
        let across = (0..rays).map(angle).collect();
        Self { mounts: mounts.to_vec(), across, range_m, sense: Sense::Sound }.checked()
    }

    fn checked(self) -> Result<Self, SensorError> {
        within("the range in m", self.range_m, 0.01, 1_000.0)?;
        for mount in &self.mounts {
            within("the place on the robot in m", mount.translation.vector.norm(), 0.0, 100.0)?;
        }
        Ok(self)
    }

    /// Returns the number of beams: a reading has as many ranges.
    pub fn beams(&self) -> usize {
        self.mounts.len()
    }

    /// Returns the rays of a beam.
    pub fn rays(&self) -> usize {
        self.across.len()
    }

    /// Returns the range in metres.
    pub fn range_m(&self) -> f64 {
        self.range_m
    }

    /// Returns what the sensor notices.
    pub fn sense(&self) -> Sense {
        self.sense
    }

    /// Returns the pose of a ray on the robot; rays of a beam are numbered from the right.
    pub(crate) fn ray(&self, beam: usize, ray: usize) -> Option<Pose> {
        Some(self.mounts.get(beam)? * Pose::rotation(*self.across.get(ray)?))
    }
}

/// The beam of a number, of so many that are evenly taken from a reading, first and last with them.
pub(crate) fn evenly(at: usize, taken: usize, of: usize) -> usize {
    let gaps = taken.saturating_sub(1).max(1);
    (at * of.saturating_sub(1) + gaps / 2) / gaps
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn beams_are_taken_evenly_from_the_first_to_the_last() {
        let taken = |taken: usize, of: usize| -> Vec<usize> {
            (0..taken).map(|at| evenly(at, taken, of)).collect()
        };
        assert_eq!(taken(4, 10), [0, 3, 6, 9]);
        assert_eq!(taken(3, 180), [0, 90, 179]);
        assert_eq!(taken(5, 5), [0, 1, 2, 3, 4]);
        let many = taken(100, 180);
        assert!(many.windows(2).all(|it| (1..=2).contains(&(it[1] - it[0]))), "{many:?}");
    }

    #[test]
    fn a_laser_has_its_first_ray_on_the_right() {
        let laser = Sensor::laser(&Pose::identity(), PI, 3, 8.0).unwrap();
        let angle = |at: usize| laser.ray(at, 0).unwrap().rotation.angle();
        assert_eq!([0, 1, 2].map(angle), [-PI / 2.0, 0.0, PI / 2.0]);
        let back = Sensor::lasers(&[(Pose::identity(), PI, 2), (Pose::rotation(PI), PI, 3)], 8.0);
        assert_eq!(back.unwrap().ray(3, 0).unwrap().rotation.angle().abs(), PI);
        let refused = Sensor::laser(&Pose::identity(), PI, 0, 8.0).unwrap_err();
        assert_eq!(refused.to_string(), "the number of rays is 0; give a number from 1 to 16384");
    }
}
