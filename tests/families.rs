//! The families of instances that only the benchmark reports.

use crate::instances::{Draw, Instance, Zones, travel};
use cotama_core::problem::Candidate;

/// `activities` stretches with all 21 candidates each.
#[must_use]
pub fn robot_like(activities: usize, zones: Zones, permille: [u64; 2], seed: u64) -> Instance<2> {
    let mut draw = Draw::new(seed);
    let mut one = || {
        let speed = zones.speed(&mut draw);
        travel(&mut draw, speed, |_, _| true)
    };
    Instance::limited((0..activities).map(|_| one()).collect(), permille)
}

/// How quality follows the costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Correlation {
    /// Within 100 of the mean cost.
    Weak,
    /// The mean cost plus 100.
    Strong,
}

/// Costs from 1 to 1000 on both axes; the limits half way from least to largest (Pisinger's
/// classes, two limits).
#[must_use]
pub fn correlated(
    activities: usize,
    candidates: usize,
    correlation: Correlation,
    seed: u64,
) -> Instance<2> {
    let mut draw = Draw::new(seed);
    let mut one = |id: usize| {
        let cost = [draw.between(1, 1000), draw.between(1, 1000)];
        let mean = u64::midpoint(cost[0], cost[1]);
        let quality = match correlation {
            Correlation::Weak => (mean + draw.between(0, 200)).saturating_sub(100).max(1),
            Correlation::Strong => mean + 100,
        };
        Candidate { cost: cost.map(|c| c as u32), quality: quality as u32, id: id as u16 }
    };
    let made = (0..activities).map(|_| (0..candidates).map(&mut one).collect()).collect();
    Instance::limited(made, [500, 500])
}
