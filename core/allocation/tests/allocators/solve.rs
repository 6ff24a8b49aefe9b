//! Both allocators behind one call each, with their memory.

use cotama_core::allocation::{Allocator, Answer};
use cotama_core::exact::{Objective, Workspace};
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
    let mut plan = vec![0; problem.activities().len()];
    let mut workspace = Workspace::new();
    let answer = workspace.exact(problem, objectives, steps, 0).allocate(problem, &mut plan);
    (answer.unwrap(), plan)
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
