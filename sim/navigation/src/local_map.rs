//! A map of what was sensed around a robot, in its own frame.

use crate::work::Work;
use core::f64::consts::TAU;
use cotama_core::units::Millis;
use cotama_devices::Sensed;
use cotama_floor::{Point, Pose};
use std::collections::VecDeque;

/// The most points that a map keeps.
pub const MAX_POINTS: usize = 1 << 14;

/// A place where something was sensed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Obstacle {
    /// The place as the robot sees it now, in metres: x ahead, y to the left.
    pub at: Point,
    /// The time since it was sensed.
    pub age: Millis,
}

/// Points around a robot that fade with time, of a fixed number.
///
/// Readings come in at the robot's frame, and the map moves with what odometry says. A point is
/// forgotten after a time, or as the oldest when there is no room. Points are not cleared by rays
/// that pass: what went away is believed until it fades.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_floor::Pose;
/// use cotama_navigation::LocalMap;
/// let mut map = LocalMap::new(100, Millis(1_000));
/// map.take_scan(&Pose::identity(), 0.0, &[2.0]);
/// map.advance(&Pose::new([0.5, 0.0].into(), 0.0), Millis(400)); // half a metre ahead
/// let seen = map.points().next().unwrap();
/// assert_eq!((seen.at.x, seen.age, map.weight(seen)), (1.5, Millis(400), 0.6));
/// map.advance(&Pose::identity(), Millis(600));
/// assert_eq!(map.points().count(), 0);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct LocalMap {
    /// Invariant: the oldest first, at most `most`.
    points: VecDeque<Obstacle>,
    most: usize,
    keep: Millis,
    work: Work,
}

impl LocalMap {
    /// An empty map that keeps so many points, from 1 to [`MAX_POINTS`], each for a time.
    pub fn new(most: usize, keep: Millis) -> Self {
        let most = most.clamp(1, MAX_POINTS);
        Self { points: VecDeque::with_capacity(most), most, keep, work: Work::default() }
    }

    /// Moves the robot by what its odometry says, and lets time pass.
    pub fn advance(&mut self, motion: &Pose, time: Millis) {
        let back = motion.inverse();
        for it in &mut self.points {
            it.at = back * it.at;
            it.age = Millis(it.age.0.saturating_add(time.0));
        }
        self.work.operations += self.points.len() as u64;
        while self.points.front().is_some_and(|it| it.age >= self.keep) {
            self.points.pop_front();
        }
    }

    /// Takes the ranges of a scan: rays spread evenly over the view, in radians, from the right to
    /// the left; all around, the last ray is a step before the first. What is not finite is left
    /// out.
    pub fn take_scan(&mut self, mount: &Pose, view_rad: f64, ranges: &[f64]) {
        let gaps = if view_rad >= TAU { ranges.len() } else { ranges.len().saturating_sub(1) };
        let step = view_rad / gaps.max(1) as f64;
        for (at, range) in ranges.iter().enumerate().filter(|it| it.1.is_finite()) {
            let (sin, cos) = libm::sincos(at as f64 * step - view_rad / 2.0);
            self.add(mount * Point::new(range * cos, range * sin));
        }
    }

    /// Takes the readings of a ring of sonars: each within the range stands for something on the
    /// arc of its cone, as three points there.
    pub fn take_ring(
        &mut self,
        mounts: &[Pose],
        cone_rad: f64,
        range_m: f64,
        readings: &[Option<Sensed<f64>>],
    ) {
        for (mount, read) in mounts.iter().zip(readings) {
            let Some(range) = read.map(|it| it.value).filter(|it| *it < range_m) else { continue };
            for part in [-0.5, 0.0, 0.5] {
                let (sin, cos) = libm::sincos(part * cone_rad);
                self.add(mount * Point::new(range * cos, range * sin));
            }
        }
    }

    fn add(&mut self, at: Point) {
        if self.points.len() == self.most {
            self.points.pop_front();
        }
        self.points.push_back(Obstacle { at, age: Millis(0) });
        self.work.operations += 1;
        debug_assert!(self.points.len() <= self.most);
    }

    /// Returns the points, the oldest first.
    pub fn points(&self) -> impl Iterator<Item = Obstacle> + '_ {
        self.points.iter().copied()
    }

    /// Returns how much of a point has not faded, from 1 to 0.
    pub fn weight(&self, of: Obstacle) -> f64 {
        1.0 - of.age.0 as f64 / self.keep.0.max(1) as f64
    }

    /// Returns the work that was done since the map was made.
    pub const fn work(&self) -> Work {
        self.work
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_map_forgets_its_oldest_point() {
        let mut map = LocalMap::new(2, Millis(1_000));
        map.take_scan(&Pose::identity(), 0.0, &[1.0]);
        map.take_scan(&Pose::identity(), 0.0, &[2.0]);
        map.take_scan(&Pose::identity(), 0.0, &[f64::INFINITY]);
        map.take_scan(&Pose::identity(), 0.0, &[3.0]);
        assert_eq!(map.points().map(|it| it.at.x).collect::<Vec<_>>(), [2.0, 3.0]);
        assert_eq!(map.work().operations, 3);
    }

    #[test]
    fn a_sonar_that_hears_nothing_leaves_no_point() {
        let mut map = LocalMap::new(9, Millis(1_000));
        let read = |value| Some(Sensed { value, taken: Millis(0) });
        let mounts = [Pose::identity(); 3];
        map.take_ring(&mounts, 0.5, 5.0, &[read(5.0), None, read(1.0)]);
        assert_eq!(map.points().count(), 3);
        assert!(map.points().all(|it| (it.at.coords.norm() - 1.0).abs() < 1e-12));
    }
}
