//! A reading as the robot sees it, each coordinate in an array of its own.

use super::mixture::Mixture;
use crate::parameters::Parameters;
use crate::sensor::Sensor;
use cotama_floor::Vector;

/// A ray on the robot: its beam, its start and its way.
#[derive(Clone, Copy, Debug)]
pub(super) struct OnRobot {
    beam: usize,
    from: Vector,
    along: Vector,
    angle: f64,
}

impl OnRobot {
    /// The ray of a number of a beam.
    pub(super) fn of(sensor: &Sensor, beam: usize, ray: usize) -> Option<Self> {
        let pose = sensor.ray(beam, ray)?;
        let (from, along) = (pose.translation.vector, pose.rotation * Vector::x());
        Some(Self { beam, from, along, angle: pose.rotation.angle() })
    }
}

/// Rays of a reading: the first rays of all beams, then the second ones, and so on.
///
/// Invariant: arrays of rays are of `beams` times `rays`, those of beams of `beams` values; those
/// that the likelihood field does not ask for are empty there.
#[derive(Clone, Debug)]
pub(crate) struct Reading {
    rays: usize,
    /// Begins of rays in the beam model, and their ends in the likelihood field, in metres on the
    /// robot.
    pub(super) x: Vec<f32>,
    pub(super) y: Vec<f32>,
    /// The ways of the rays on the robot.
    pub(super) along_x: Vec<f32>,
    pub(super) along_y: Vec<f32>,
    /// Their angles on the robot.
    pub(super) turn: Vec<f32>,
    /// Ranges of the beams in mm.
    pub(super) range: Vec<f32>,
    /// Likelihood that a beam ends early, and that it ends by chance.
    pub(super) short: Vec<f32>,
    pub(super) other: Vec<f32>,
}

impl Reading {
    /// An empty one with room for so many rays, of which a beam has `rays`.
    pub(super) fn with_capacity(all: usize, rays: usize) -> Self {
        let of = |count: usize| Vec::with_capacity(count);
        let beams = all / rays.max(1);
        Self {
            rays,
            x: of(all),
            y: of(all),
            along_x: of(all),
            along_y: of(all),
            turn: of(all),
            range: of(beams),
            short: of(beams),
            other: of(beams),
        }
    }

    #[cfg(test)]
    pub(crate) fn capacity(&self) -> usize {
        let Self { x, y, along_x, along_y, turn, range, short, other, .. } = self;
        [x, y, along_x, along_y, turn, range, short, other].into_iter().map(Vec::capacity).sum()
    }

    /// The number of beams that say something.
    pub(super) fn beams(&self) -> usize {
        self.range.len()
    }

    /// The number of rays of a beam.
    pub(super) fn rays(&self) -> usize {
        self.rays
    }

    /// Reads ranges, one a beam, of which those of `rays` are looked at: the first rays of all
    /// beams, then the second ones. A range that is not a number says nothing; in a likelihood
    /// field, which has no mixture, neither do those at the range of the sensor, as in Nav2.
    pub(super) fn look(
        &mut self,
        ranges: &[f64],
        rays: &[OnRobot],
        parameters: &Parameters,
        range_m: f64,
        mixture: Option<&Mixture>,
    ) {
        let Self { x, y, along_x, along_y, turn, range, short, other, .. } = self;
        for it in [&mut *x, y, along_x, along_y, turn, range, short, other] {
            it.clear();
        }
        let read = |beam: usize| -> Option<f64> {
            let found = ranges.get(beam).copied().filter(|it| !it.is_nan())?;
            let is_near = found <= parameters.laser_min_range;
            let it = if is_near { range_m } else { found.clamp(0.0, range_m) };
            (mixture.is_some() || it < range_m).then_some(it)
        };
        let beams = rays.len() / self.rays.max(1);
        for (number, ray) in rays.iter().enumerate() {
            let Some(found) = read(ray.beam) else { continue };
            if number < beams {
                range.push((found * 1_000.0) as f32);
            }
            let Some(mixture) = mixture else {
                let end = ray.from + ray.along * found;
                x.push(end.x as f32);
                y.push(end.y as f32);
                continue;
            };
            x.push(ray.from.x as f32);
            y.push(ray.from.y as f32);
            along_x.push(ray.along.x as f32);
            along_y.push(ray.along.y as f32);
            turn.push(ray.angle as f32);
            if number < beams {
                let [early, chance] = mixture.beside(found);
                short.push(early);
                other.push(chance);
            }
        }
    }
}
