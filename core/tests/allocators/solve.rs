//! Both allocators behind one call each, with their memory.

use cotama_core::allocation::{Allocator, Answer};
use cotama_core::exact::{Exact, Item, Objective, Stage};
use cotama_core::panorama::Panorama;
use cotama_core::problem::Problem;

/// The answer of the exact allocator within so many steps, and the plan it wrote.
///
/// # Panics
/// When the memory, which is sized for the problem, is too small for it.
pub fn exact<const A: usize>(
    problem: &Problem<A>,
    objectives: &[Objective],
    steps: u64,
) -> (Answer<A>, Vec<u16>) {
    let count = problem.activities().iter().map(|c| c.len()).sum();
    let (mut items, mut stages) =
        (vec![Item::EMPTY; count], vec![Stage::EMPTY; problem.activities().len()]);
    let mut plan = vec![0; problem.activities().len()];
    let answer = Exact::new(objectives, steps, &mut items, &mut stages)
        .allocate(problem, &mut plan)
        .unwrap();
    (answer, plan)
}

/// The plan of the paper's rule, if it finds one.
///
/// # Panics
/// When the plan is not one within the limits, with the totals that the answer says.
pub fn panorama<const A: usize>(problem: &Problem<A>) -> Option<Vec<u16>> {
    let activities = problem.activities().len();
    let (mut caps, mut plan) = (vec![[0; A]; activities], vec![0; activities]);
    match Panorama::new(&mut caps).allocate(problem, &mut plan).unwrap() {
        Answer::Planned(planned) => {
            assert_eq!(problem.totals(&plan), Some((planned.cost, planned.quality)));
            assert!(problem.within_limits(&planned.cost));
            Some(plan)
        }
        Answer::Infeasible { shortfall: Some(_), .. } => None,
        other => panic!("the rule has no budget, and knows where it fails: {other:?}"),
    }
}
