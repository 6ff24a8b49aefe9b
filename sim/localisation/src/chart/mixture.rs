//! The mixture of the beam model.

use crate::parameters::Parameters;

/// From so many deviations on a hit has no likelihood.
const NEVER: f64 = 6.0;

/// Likelihood that a beam of a range hits, ends early, sees nothing or is there by chance.
#[derive(Clone, Debug)]
pub(super) struct Mixture {
    /// Likelihood of a hit by the difference in mm.
    hits: Vec<f32>,
    z_short: f64,
    lambda_short: f64,
    z_max: f64,
    z_rand: f64,
    range_m: f64,
}

impl Mixture {
    pub(super) fn of(parameters: &Parameters, range_m: f64) -> Self {
        let Parameters { z_hit, z_short, z_max, z_rand, sigma_hit, lambda_short, .. } = *parameters;
        let hit = |mm: usize| {
            let off = mm as f64 / 1_000.0 / sigma_hit;
            (z_hit * libm::exp(-off * off / 2.0)) as f32
        };
        let most = (NEVER * sigma_hit * 1_000.0) as usize + 1;
        let hits = (0..most).map(hit).chain([0.0]).collect();
        Self { hits, z_short, lambda_short, z_max, z_rand, range_m }
    }

    /// Returns the likelihood that a beam of a range ends early, `z_short` λ exp(-λ range), and
    /// that it sees nothing, `z_max`, or is there by chance, `z_rand` / range of the sensor.
    pub(super) fn beside(&self, range: f64) -> [f32; 2] {
        let Self { z_short, lambda_short, z_max, z_rand, range_m, .. } = *self;
        let early = z_short * lambda_short * libm::exp(-lambda_short * range);
        let other = if range >= range_m { z_max } else { z_rand / range_m };
        [early as f32, other as f32]
    }

    /// Returns the likelihood of a hit, `z_hit` exp(-d² / 2 σ²), by the difference in mm.
    #[inline]
    pub(super) fn hit(&self, off_mm: f32) -> f32 {
        let at = (off_mm.abs() as usize).min(self.hits.len() - 1);
        self.hits.get(at).copied().unwrap_or(0.0)
    }
}
