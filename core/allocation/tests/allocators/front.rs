//! The front against brute force.

use crate::brute::every_plan;
use crate::instances::small;
use cotama_core::front::{Front, Node};

#[test]
fn the_front_is_every_undominated_plan_of_5_000_small_problems() {
    for seed in 0..5_000 {
        let instance = small::<2>(seed);
        let slices = instance.slices();
        let problem = instance.problem(&slices);
        let mut feasible: Vec<([u64; 2], u64)> = every_plan(&instance)
            .into_iter()
            .map(|(_, cost, quality)| (cost, quality))
            .filter(|(cost, _)| problem.within_limits(cost))
            .collect();
        feasible.sort_unstable();
        feasible.dedup();
        let beats = |a: &([u64; 2], u64), b: &([u64; 2], u64)| {
            a != b && a.0[0] <= b.0[0] && a.0[1] <= b.0[1] && a.1 >= b.1
        };
        let expected: Vec<_> = feasible
            .iter()
            .copied()
            .filter(|plan| !feasible.iter().any(|other| beats(other, plan)))
            .collect();
        let mut nodes = vec![Node::EMPTY; 20_000];
        let mut front = Front::new(&mut nodes);
        let plans = front.find(&problem).unwrap();
        let mut found: Vec<_> = (0..plans.len()).filter_map(|index| plans.totals(index)).collect();
        assert_eq!(plans.is_empty(), expected.is_empty(), "seed {seed}");
        let mut plan = vec![0; slices.len()];
        for (index, totals) in found.iter().enumerate() {
            assert!(plans.plan(index, &mut plan));
            assert_eq!(problem.totals(&plan).as_ref(), Some(totals), "seed {seed}");
        }
        found.sort_unstable();
        assert_eq!(found, expected, "seed {seed}");
    }
}
