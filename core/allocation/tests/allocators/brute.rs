//! Brute force.

use crate::instances::Instance;

/// Every plan's choices, costs and quality.
pub(crate) fn every_plan<const A: usize>(instance: &Instance<A>) -> Vec<(Vec<u16>, [u64; A], u64)> {
    let mut plans = vec![(Vec::new(), [0u64; A], 0u64)];
    for candidates in &instance.activities {
        plans = plans
            .iter()
            .flat_map(|(choices, cost, quality)| {
                candidates.iter().enumerate().map(move |(choice, c)| {
                    let mut choices = choices.clone();
                    choices.push(choice as u16);
                    let cost = core::array::from_fn(|axis| cost[axis] + u64::from(c.cost[axis]));
                    (choices, cost, quality + u64::from(c.quality))
                })
            })
            .collect();
    }
    plans
}
