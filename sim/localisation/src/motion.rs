//! The motion of a robot on two wheels, as odometry tells it, and its noise.

use crate::angle::{sincos, wrap, wrapped};
use crate::parameters::Parameters;
use crate::particles::Particles;
use core::f64::consts::PI;
use cotama_floor::Pose;
use cotama_streams::Stream;

/// A turn, a way and another turn, with the deviation of each (Thrun, Burgard, Fox, Probabilistic
/// Robotics, 2005, table 5.6).
///
/// As in Nav2, a turn counts as the smaller one of driving ahead and backwards, and a way of less
/// than 1 cm has no direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Motion {
    steps: [f64; 3],
    deviations: [f64; 3],
}

/// So many particles have their errors drawn before they are moved.
const TOGETHER: usize = 64;

/// Ways below have no direction, in metres.
const SHORT: f64 = 0.01;

impl Motion {
    /// The motion from a pose of the odometry to the next.
    pub(crate) fn between(before: &Pose, after: &Pose, parameters: &Parameters) -> Self {
        let moved = before.inverse() * after;
        let way = moved.translation.vector;
        let ahead = way.norm();
        let first = if ahead < SHORT { 0.0 } else { libm::atan2(way.y, way.x) };
        let last = wrap(moved.rotation.angle() - first);
        let turned = |it: f64| it.abs().min(wrap(it - PI).abs());
        let squares = [first, last].map(|it| turned(it) * turned(it));
        let Parameters { alpha1, alpha2, alpha3, alpha4, .. } = *parameters;
        let square = ahead * ahead;
        let variances = [
            alpha1 * squares[0] + alpha2 * square,
            alpha3 * square + alpha4 * (squares[0] + squares[1]),
            alpha1 * squares[1] + alpha2 * square,
        ];
        Self { steps: [first, ahead, last], deviations: variances.map(f64::sqrt) }
    }

    /// Moves all particles, each with errors of its own.
    pub(crate) fn apply(&self, particles: &mut Particles, stream: &mut Stream) {
        let [first, way, last] = self.steps.map(|it| it as f32);
        let mut errors = [[0.0_f32; TOGETHER]; 3];
        let Particles { x, y, heading, cos, sin, .. } = particles;
        let xs = x.chunks_mut(TOGETHER).zip(y.chunks_mut(TOGETHER));
        let turns = cos.chunks_mut(TOGETHER).zip(sin.chunks_mut(TOGETHER));
        for (((x, y), heading), (cos, sin)) in xs.zip(heading.chunks_mut(TOGETHER)).zip(turns) {
            for at in 0..x.len().min(TOGETHER) {
                for (errors, deviation) in errors.iter_mut().zip(self.deviations) {
                    errors[at] = (stream.error() * deviation) as f32;
                }
            }
            let [turns, ways, ends] = &errors;
            let drawn = turns.iter().zip(ways).zip(ends);
            let places = x.iter_mut().zip(y).zip(heading);
            for ((((x, y), heading), (cos, sin)), ((turn, ahead), end)) in
                places.zip(cos.iter_mut().zip(sin)).zip(drawn)
            {
                let along = *heading + (first - turn);
                let (s, c) = sincos(along);
                let ahead = way - ahead;
                *x += ahead * c;
                *y += ahead * s;
                *heading = wrapped(along + (last - end));
                (*sin, *cos) = sincos(*heading);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use cotama_floor::Vector;
    use cotama_streams::Streams;

    fn moved(motion: &Motion, count: usize) -> Particles {
        let mut particles = Particles::with_capacity(count);
        (0..count).for_each(|_| particles.push([2.0, 3.0, 0.5]));
        particles.settle();
        motion.apply(&mut particles, &mut Streams::new(3).stream("motion"));
        particles
    }

    fn mean_and_deviation(all: impl Iterator<Item = f64>) -> (f64, f64) {
        let all: Vec<f64> = all.collect();
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        let square = all.iter().map(|it| (it - mean) * (it - mean)).sum::<f64>();
        (mean, (square / all.len() as f64).sqrt())
    }

    /// A way of 1 m to the left of ahead by 0.3 rad, and then a turn of 0.4 rad in all.
    #[test]
    fn particles_spread_as_the_formula_says() {
        let parameters = Parameters {
            alpha1: 0.01,
            alpha2: 0.0004,
            alpha3: 0.0009,
            alpha4: 0.0016,
            ..Parameters::default()
        };
        let before = Pose::new(Vector::new(7.0, -2.0), 1.2);
        let way = Vector::new(libm::cos(0.3), libm::sin(0.3));
        let motion = Motion::between(&before, &(before * Pose::new(way, 0.4)), &parameters);
        for (found, expected) in motion.steps.iter().zip([0.3, 1.0, 0.1]) {
            assert!((found - expected).abs() < 1e-12, "{found}");
        }
        let expected =
            [0.01 * 0.09 + 0.0004, 0.0009 + 0.0016 * (0.09 + 0.01), 0.01 * 0.01 + 0.0004]
                .map(f64::sqrt);
        for (found, expected) in motion.deviations.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        }
        let all = moved(&motion, 100_000);
        let from = |at: usize| (f64::from(all.x[at]) - 2.0, f64::from(all.y[at]) - 3.0);
        let ways = (0..all.len()).map(|at| libm::hypot(from(at).0, from(at).1));
        let firsts = (0..all.len()).map(|at| libm::atan2(from(at).1, from(at).0) - 0.5);
        let turns = all.heading.iter().map(|it| f64::from(*it) - 0.5);
        let both = libm::hypot(expected[0], expected[2]);
        for ((mean, deviation), (of, spread)) in [
            (mean_and_deviation(firsts), (0.3, expected[0])),
            (mean_and_deviation(ways), (1.0, expected[1])),
            (mean_and_deviation(turns), (0.4, both)),
        ] {
            assert!((mean - of).abs() < 0.015 * spread, "{mean} {of}");
            assert!((deviation / spread - 1.0).abs() < 0.01, "{deviation} {spread}");
        }
    }

    #[test]
    fn driving_backwards_is_as_exact_as_driving_ahead() {
        let parameters = Parameters::default();
        let by = |x: f64| {
            let after = Pose::new(Vector::new(x, 0.0), 0.0);
            Motion::between(&Pose::identity(), &after, &parameters)
        };
        let (ahead, back) = (by(0.5), by(-0.5));
        for (a, b) in ahead.deviations.iter().zip(back.deviations) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
        let there = moved(&Motion { deviations: [0.0; 3], ..back }, 1);
        let (sin, cos) = libm::sincos(0.5);
        assert!((f64::from(there.x[0]) - (2.0 - 0.5 * cos)).abs() < 1e-6);
        assert!((f64::from(there.y[0]) - (3.0 - 0.5 * sin)).abs() < 1e-6);
        assert!((there.heading[0] - 0.5).abs() < 1e-6);
    }

    #[test]
    fn a_turn_on_the_spot_has_no_direction() {
        let after = Pose::new(Vector::new(0.002, 0.003), 1.0);
        let motion = Motion::between(&Pose::identity(), &after, &Parameters::default());
        assert_eq!([motion.steps[0], motion.steps[2]], [0.0, 1.0]);
    }
}
