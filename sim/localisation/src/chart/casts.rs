//! The beam model: ranges that are cast once, from the centre of each cell in some directions.

use super::mixture::Mixture;
use super::{Cells, Reading};
use crate::parameters::Parameters;
use crate::particles::Particles;
use crate::sensor::Sensor;
use core::f64::consts::TAU;
use cotama_floor::{Ray, Surface};

/// Directions of a cell.
const DIRECTIONS: usize = 128;
/// The mark of a ray that hits nothing; ranges are in mm.
const NOTHING: u16 = u16::MAX;
/// So many beams of a particle are looked up together.
const TOGETHER: usize = 64;
const ROUNDS: f32 = 8_388_608.0; // 2²³
const WHOLE: u32 = (1 << 23) - 1;

/// Ranges of cells, and the mixture of the beam model.
#[derive(Clone, Debug)]
pub(super) struct Casts {
    columns: usize,
    rows: usize,
    per_metre: f32,
    cell_mm: f32,
    range_m: f64,
    /// Ranges by cell and direction.
    ranges: Vec<u16>,
    mixture: Mixture,
}

impl Casts {
    pub(super) fn of(
        surface: &dyn Surface,
        cells: &Cells,
        free: &[u32],
        sensor: &Sensor,
        parameters: &Parameters,
        range_m: f64,
    ) -> Self {
        let mut ranges = vec![0; cells.count() * DIRECTIONS];
        let ways: Vec<Ray> = (0..DIRECTIONS)
            .map(|it| Ray::at(cells.origin, TAU * it as f64 / DIRECTIONS as f64))
            .collect();
        let mut rays = ways.clone();
        let mut found = vec![0.0; DIRECTIONS];
        for at in free {
            let centre = cells.centre(*at as usize);
            rays.iter_mut().for_each(|it| it.from = centre);
            surface.distances(&rays, range_m, sensor.sense(), &mut found);
            let begin = *at as usize * DIRECTIONS;
            for (out, found) in ranges.iter_mut().skip(begin).zip(&found) {
                let mm = (found * 1_000.0).round();
                *out = if mm < f64::from(NOTHING) { mm as u16 } else { NOTHING };
            }
        }
        Self {
            columns: cells.columns,
            rows: cells.rows,
            per_metre: (1.0 / cells.size) as f32,
            cell_mm: (cells.size * 1_000.0) as f32,
            range_m,
            ranges,
            mixture: Mixture::of(parameters, range_m),
        }
    }

    /// Returns the mixture.
    pub(super) fn mixture(&self) -> &Mixture {
        &self.mixture
    }

    /// Sums the cubes of likelihoods of beams at each particle, and 1 (Thrun, Burgard, Fox,
    /// Probabilistic Robotics, 2005, table 6.1, with the sum of Nav2 in place of the product).
    ///
    /// The range of the nearest cell in the nearest direction is taken, less the way that the
    /// particle stands ahead of the cell's centre: exact where a wall is met straight on.
    pub(super) fn weigh(&self, reading: &Reading, particles: &Particles, out: &mut [f32]) {
        let (beams, rays) = (reading.beams(), reading.rays());
        let mut places = [0_u32; TOGETHER];
        let mut ahead = [0.0_f32; TOGETHER];
        let mut nearest = [0.0_f32; TOGETHER];
        for (at, out) in out.iter_mut().enumerate().take(particles.len()) {
            let mut sum = 1.0;
            for from in (0..beams).step_by(TOGETHER) {
                let count = (beams - from).min(TOGETHER);
                nearest.fill((self.range_m * 1_000.0) as f32);
                for ray in 0..rays {
                    let (places, ahead) = (&mut places[..count], &mut ahead[..count]);
                    self.find(particles, at, reading, ray * beams + from, (places, ahead));
                    for ((nearest, place), ahead) in nearest.iter_mut().zip(places).zip(ahead) {
                        let range = self.ranges.get(*place as usize).copied().unwrap_or(NOTHING);
                        let far = if range == NOTHING { f32::INFINITY } else { f32::from(range) };
                        *nearest = nearest.min(far - *ahead);
                    }
                }
                sum += self.sum(reading, from, &nearest[..count]);
            }
            *out = sum;
        }
    }

    /// Writes cells and directions of rays, and how far ahead of the cell's centre they begin, in
    /// mm. A compiler makes vectors of it.
    #[inline]
    fn find(
        &self,
        particles: &Particles,
        at: usize,
        reading: &Reading,
        from: usize,
        (places, ahead): (&mut [u32], &mut [f32]),
    ) {
        let to = from + places.len();
        let (cos, sin) = (particles.cos[at], particles.sin[at]);
        let heading = particles.heading[at];
        let per_radian = DIRECTIONS as f32 / core::f32::consts::TAU;
        let per_metre = self.per_metre;
        let (x, y) = (particles.x[at] * per_metre - 0.5, particles.y[at] * per_metre - 0.5);
        let (right, top) = ((self.columns - 1) as f32, (self.rows - 1) as f32);
        let width = self.columns as f32;
        let xs = reading.x[from..to].iter().zip(&reading.y[from..to]);
        let ways = reading.along_x[from..to].iter().zip(&reading.along_y[from..to]);
        let turns = &reading.turn[from..to];
        let all = xs.zip(ways).zip(turns);
        for ((place, ahead), (((on_x, on_y), (way_x, way_y)), turn)) in
            places.iter_mut().zip(ahead).zip(all)
        {
            let column = x + (cos * on_x - sin * on_y) * per_metre;
            let row = y + (sin * on_x + cos * on_y) * per_metre;
            let near = |it: f32, most: f32| {
                let it = if it > 0.0 { it } else { 0.0 };
                (if it < most { it } else { most } + ROUNDS) - ROUNDS
            };
            let (whole, line) = (near(column, right), near(row, top));
            let cell = ((line * width + whole) + ROUNDS).to_bits() & WHOLE;
            let direction =
                ((heading + turn) * per_radian + (4 * DIRECTIONS) as f32 + ROUNDS).to_bits();
            *place = cell * DIRECTIONS as u32 + (direction & (DIRECTIONS as u32 - 1));
            let (off_x, off_y) = (column - whole, row - line);
            let along_x = cos * way_x - sin * way_y;
            let along_y = sin * way_x + cos * way_y;
            *ahead = (off_x * along_x + off_y * along_y) * self.cell_mm;
        }
    }

    #[inline]
    fn sum(&self, reading: &Reading, from: usize, expected: &[f32]) -> f32 {
        let to = from + expected.len();
        let others = reading.short[from..to].iter().zip(&reading.other[from..to]);
        let mut sum = 0.0;
        for ((expected, range), (short, other)) in
            expected.iter().zip(&reading.range[from..to]).zip(others)
        {
            let off = range - expected;
            let early = if off < 0.0 { *short } else { 0.0 };
            let it = self.mixture.hit(off) + early + other;
            sum += it * it * it;
        }
        sum
    }
}
