//! The likelihood field: how likely it is that a beam ends in a cell.

use super::{Cells, Reading};
use crate::parameters::{Model, Parameters};
use crate::particles::Particles;
use crate::sensor::Sensor;
use cotama_floor::Surface;

/// So many beams of a particle are looked up together: their places stay in registers and the
/// first cache.
const TOGETHER: usize = 64;
/// With so much added, a number below it is rounded to a whole one, which its lowest bits hold.
const ROUNDS: f32 = 8_388_608.0; // 2²³
/// The lowest bits, with the whole number.
const WHOLE: u32 = (1 << 23) - 1;
/// The least likelihood whose logarithm is taken.
const LEAST: f64 = 1e-30;

/// Cubes of likelihoods of cells, or their logarithms, with a border of what is outside.
#[derive(Clone, Debug)]
pub(super) struct Likelihoods {
    /// The width of a row with its border.
    width: usize,
    height: usize,
    per_metre: f32,
    is_product: bool,
    values: Vec<f32>,
}

impl Likelihoods {
    /// With d the distance to the nearest thing, at most `laser_likelihood_max_dist`, which it is
    /// outside: p = `z_hit` exp(-d² / 2 σ²) + `z_rand` / range (Thrun, Burgard, Fox, Probabilistic
    /// Robotics, 2005, table 6.3; without the factor of the normal distribution, as in Nav2).
    pub(super) fn of(
        surface: &dyn Surface,
        cells: &Cells,
        sensor: &Sensor,
        parameters: &Parameters,
        range_m: f64,
    ) -> Self {
        let Parameters { z_hit, z_rand, sigma_hit, .. } = *parameters;
        let most = parameters.laser_likelihood_max_dist;
        let is_product = parameters.laser_model_type == Model::LikelihoodFieldProb;
        let value = |distance: f64| {
            let off = distance / sigma_hit;
            let it = z_hit * libm::exp(-off * off / 2.0) + z_rand / range_m;
            (if is_product { libm::log(it.max(LEAST)) } else { it * it * it }) as f32
        };
        let (width, height) = (cells.columns + 2, cells.rows + 2);
        let mut values = vec![value(most); width * height];
        for (row, out) in values.chunks_mut(width).skip(1).take(cells.rows).enumerate() {
            for (column, out) in out.iter_mut().skip(1).take(cells.columns).enumerate() {
                let centre = cells.centre(row * cells.columns + column);
                *out = value(surface.distance(centre, most, sensor.sense()));
            }
        }
        debug_assert!(values.len() < WHOLE as usize, "the number of a cell fits in its bits");
        Self { width, height, per_metre: (1.0 / cells.size) as f32, is_product, values }
    }

    /// Sums what the ends of beams find at each particle; of the rays of a cone the best counts.
    pub(super) fn weigh(&self, reading: &Reading, particles: &Particles, out: &mut [f32]) {
        let begin = if self.is_product { 0.0 } else { 1.0 };
        let (beams, rays) = (reading.beams(), reading.rays());
        let mut places = [0_u32; TOGETHER];
        let mut best = [0.0_f32; TOGETHER];
        for (at, out) in out.iter_mut().enumerate().take(particles.len()) {
            let view = self.view(particles, at);
            let mut sum = begin;
            for from in (0..beams).step_by(TOGETHER) {
                let count = (beams - from).min(TOGETHER);
                if rays == 1 {
                    view.find(reading, from, &mut places[..count]);
                    sum += self.sum(&places[..count]);
                    continue;
                }
                best.fill(f32::NEG_INFINITY);
                for ray in 0..rays {
                    view.find(reading, ray * beams + from, &mut places[..count]);
                    for (best, place) in best.iter_mut().zip(&places[..count]) {
                        *best = best.max(self.value(*place));
                    }
                }
                sum += best[..count].iter().sum::<f32>();
            }
            *out = sum;
        }
    }

    /// A particle as it stands on the cells.
    #[inline]
    fn view(&self, particles: &Particles, at: usize) -> View {
        // Half a cell more: a border is before the first, and numbers are rounded to the next.
        View {
            x: particles.x[at] * self.per_metre + 0.5,
            y: particles.y[at] * self.per_metre + 0.5,
            cos: particles.cos[at] * self.per_metre,
            sin: particles.sin[at] * self.per_metre,
            right: (self.width - 1) as f32,
            top: (self.height - 1) as f32,
            width: self.width as f32,
        }
    }

    #[inline]
    fn value(&self, place: u32) -> f32 {
        self.values.get(place as usize).copied().unwrap_or(0.0)
    }

    #[inline]
    fn sum(&self, places: &[u32]) -> f32 {
        let fours = places.chunks_exact(4);
        let rest: f32 = fours.remainder().iter().map(|it| self.value(*it)).sum();
        let mut sums = [0.0_f32; 4];
        for four in fours {
            for (sum, place) in sums.iter_mut().zip(four) {
                *sum += self.value(*place);
            }
        }
        (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
    }
}

/// A particle in cells, and the border of them.
struct View {
    x: f32,
    y: f32,
    cos: f32,
    sin: f32,
    right: f32,
    top: f32,
    width: f32,
}

impl View {
    /// Writes the cells in which rays end. A compiler makes vectors of it.
    #[inline]
    fn find(&self, reading: &Reading, from: usize, places: &mut [u32]) {
        let Self { x, y, cos, sin, right, top, width } = *self;
        let ends_x = &reading.x[from..from + places.len()];
        let ends_y = &reading.y[from..from + places.len()];
        for ((place, end_x), end_y) in places.iter_mut().zip(ends_x).zip(ends_y) {
            let column = x + (cos * end_x - sin * end_y);
            let row = y + (sin * end_x + cos * end_y);
            let column = if column > 0.0 { column } else { 0.0 };
            let column = if column < right { column } else { right };
            let row = if row > 0.0 { row } else { 0.0 };
            let row = if row < top { row } else { top };
            let row = (row + ROUNDS) - ROUNDS;
            // All that is whole is exact; the column is rounded as it is added.
            *place = ((row * width + ROUNDS) + column).to_bits() & WHOLE;
        }
    }
}
