//! The pose of the robot, as the particles say.

use crate::angle::wrap;
use crate::histogram::Histogram;
use crate::particles::Particles;
use cotama_floor::{Point, Pose, Vector};
use nalgebra::Matrix3;

/// The pose of a robot as the particles say, and how sure it is.
///
/// Invariant: the weight is from 0 to 1, and the covariance symmetric.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// The mean of the heaviest cluster, as in AMCL: particles whose bins of 0.5 m, 0.5 m and 10°
    /// touch. Its heading is that of the mean direction.
    pub pose: Pose,
    /// The covariance of that cluster, of x and y in metres and the heading in radians. (Nav2 tells
    /// that of all particles.)
    pub covariance: Matrix3<f64>,
    /// The part of the weight that is in the cluster.
    pub weight: f64,
    /// The number of clusters.
    pub clusters: usize,
    /// The number of particles.
    pub particles: usize,
    /// The effective number of particles before they were drawn anew, 1 / Σ w².
    pub effective: f64,
    /// The mean likelihood of the last reading, up to a factor that the model has: for models that
    /// sum cubes 1 + Σ p³, for products the geometric mean of a beam.
    pub likelihood: f64,
    /// The short-term mean of it; 0 without recovery, and before the first reading.
    pub likelihood_short: f64,
    /// The long-term mean of it; 0 likewise.
    pub likelihood_long: f64,
}

/// The heaviest cluster of particles that are in bins: pose, covariance, weight, clusters.
pub(crate) fn heaviest(
    particles: &Particles,
    histogram: &mut Histogram,
    origin: Point,
) -> (Pose, Matrix3<f64>, f64, usize) {
    let (cluster, _, clusters) = histogram.cluster();
    let mut sums = [0.0; 5];
    let is_all = clusters <= 1;
    for (at, weight) in particles.weight.iter().enumerate() {
        if is_all || histogram.is_in(at, cluster) {
            let of = |it: &[f32]| weight * f64::from(it[at]);
            let Particles { x, y, cos, sin, .. } = particles;
            let each = [*weight, of(x), of(y), of(cos), of(sin)];
            sums.iter_mut().zip(each).for_each(|(sum, it)| *sum += it);
        }
    }
    let weight = if sums[0] > 0.0 { sums[0] } else { 1.0 };
    let (x, y, heading) = (sums[1] / weight, sums[2] / weight, libm::atan2(sums[4], sums[3]));
    let mut squares = [0.0; 6];
    for (at, part) in particles.weight.iter().enumerate() {
        if is_all || histogram.is_in(at, cluster) {
            let of = |it: &[f32]| f64::from(it[at]);
            let off_x = of(&particles.x) - x;
            let off_y = of(&particles.y) - y;
            let turn = wrap(of(&particles.heading) - heading);
            let (part_x, part_y) = (part * off_x, part * off_y);
            squares[0] += part_x * off_x;
            squares[1] += part_x * off_y;
            squares[2] += part_y * off_y;
            squares[3] += part_x * turn;
            squares[4] += part_y * turn;
            squares[5] += part * turn * turn;
        }
    }
    let [xx, xy, yy, xt, yt, tt] = squares.map(|it| it / weight);
    let covariance = Matrix3::new(xx, xy, xt, xy, yy, yt, xt, yt, tt);
    let pose = Pose::new(Vector::new(x, y) + origin.coords, heading);
    (pose, covariance, weight.min(1.0), clusters)
}
