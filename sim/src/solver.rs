//! The allocators behind one door, with their memory.

use crate::options::{Aim, Planner};
use crate::run::NoPlan;
use cotama_core::allocation::{Allocator, Answer, Planned};
use cotama_core::exact::{Exact, Item, Objective, Seen, Stage};
use cotama_core::panorama::Panorama;
use cotama_core::problem::Problem;
use cotama_models::missions::tables::ENERGY;

/// How many nodes a complete search may remember: 160 KiB.
const SEEN: usize = 1 << 12;

/// Memory of the allocators; it grows to what a problem needs and is kept for the next.
#[derive(Clone, Debug, Default)]
pub(crate) struct Solver {
    caps: Vec<[u32; 2]>,
    items: Vec<Item<2>>,
    stages: Vec<Stage<2>>,
    seen: Vec<Seen<2>>,
    /// The plan found: the position of the chosen candidate of each activity.
    pub(crate) plan: Vec<u16>,
}

/// A plan, in [`Solver::plan`], and who found it.
pub(crate) struct Found {
    pub(crate) planned: Planned<2>,
    pub(crate) allocator: &'static str,
}

impl Solver {
    /// Looks for a plan.
    pub(crate) fn solve(
        &mut self,
        planner: Planner,
        problem: &Problem<'_, 2>,
    ) -> Result<Found, NoPlan> {
        match planner {
            Planner::Panorama => self.panorama(problem),
            Planner::PanoramaThenExact { steps } => match self.panorama(problem) {
                Ok(found) => Ok(found),
                Err(_) => self.exact(problem, &[Objective::Most(problem.order()[1])], steps),
            },
            Planner::Exact { aim: Aim::Quality, steps } => {
                self.exact(problem, &[Objective::MostQuality, Objective::Least(ENERGY)], steps)
            }
            Planner::Exact { aim: Aim::MinEnergy, steps } => {
                self.exact(problem, &[Objective::Least(ENERGY), Objective::MostQuality], steps)
            }
        }
    }

    fn panorama(&mut self, problem: &Problem<'_, 2>) -> Result<Found, NoPlan> {
        let activities = problem.activities();
        at_least(&mut self.caps, activities.len(), [0; 2]);
        at_least(&mut self.plan, activities.len(), 0);
        let mut rule = Panorama::new(&mut self.caps);
        found(&mut rule, "panorama", problem, &mut self.plan)
    }

    fn exact(
        &mut self,
        problem: &Problem<'_, 2>,
        objectives: &[Objective],
        steps: u64,
    ) -> Result<Found, NoPlan> {
        let activities = problem.activities();
        let candidates = activities.iter().map(|candidates| candidates.len()).sum();
        at_least(&mut self.items, candidates, Item::EMPTY);
        at_least(&mut self.stages, activities.len(), Stage::EMPTY);
        at_least(&mut self.plan, activities.len(), 0);
        at_least(&mut self.seen, SEEN, Seen::EMPTY);
        let mut search = Exact::new(objectives, steps, &mut self.items, &mut self.stages)
            .with_memory(&mut self.seen);
        found(&mut search, "exact", problem, &mut self.plan)
    }
}

fn at_least<T: Clone>(memory: &mut Vec<T>, needed: usize, empty: T) {
    if memory.len() < needed {
        memory.resize(needed, empty);
    }
}

fn found<A: Allocator<2>>(
    rule: &mut A,
    allocator: &'static str,
    problem: &Problem<'_, 2>,
    plan: &mut [u16],
) -> Result<Found, NoPlan> {
    match rule.allocate(problem, plan) {
        Ok(Answer::Planned(planned)) => Ok(Found { planned, allocator }),
        Ok(Answer::Infeasible { shortfall: None, .. }) => Err(NoPlan::Infeasible),
        Ok(Answer::Infeasible { shortfall: Some(short), .. }) => {
            Err(NoPlan::Limit { axis: short.axis(), short: short.gap() })
        }
        Ok(Answer::Unknown { steps, .. }) => Err(NoPlan::Unknown { steps }),
        // Its memory was sized for this problem above.
        Err(_) => Err(NoPlan::Unknown { steps: 0 }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::streams::Streams;
    use cotama_core::problem::Candidate;

    #[test]
    fn where_the_rule_finds_nothing_a_search_finds_the_highest_on_the_axis_treated_last() {
        let (mut stream, mut solver) = (Streams::new(1).stream("solver"), Solver::default());
        let (mut searched, mut none) = (0, 0);
        for _ in 0..3_000 {
            let mut cost = || [0, 1].map(|_| 1 + stream.below(6) as u32);
            let lists = [0, 1, 2].map(|_| {
                [0, 1, 2].map(|id| Candidate { cost: cost(), quality: u32::from(id), id })
            });
            let lists = lists.each_ref().map(<[_; 3]>::as_slice);
            let limits = [0, 1].map(|_| 6 + stream.below(8));
            let order = if stream.below(2) == 0 { [0, 1] } else { [1, 0] };
            let problem = Problem::new(&lists, limits, order).unwrap();
            let all = (0..27).map(|it| [it / 9, it / 3 % 3, it % 3]).map(|choice: [usize; 3]| {
                let chosen = choice.iter().zip(lists).map(|(&it, list)| list[it].cost);
                chosen.fold([0; 2], |sum, it| [0, 1].map(|axis| sum[axis] + u64::from(it[axis])))
            });
            let kept = all.filter(|it| (0..2).all(|axis| it[axis] <= limits[axis]));
            let most = kept.map(|it| it[order[1]]).max();
            match solver.solve(Planner::PanoramaThenExact { steps: 1_000 }, &problem) {
                Ok(found) if found.allocator == "exact" => {
                    assert_eq!(Some(found.planned.cost[order[1]]), most);
                    searched += 1;
                }
                Ok(found) => assert!(Some(found.planned.cost[order[1]]) <= most),
                Err(_) => {
                    assert_eq!(most, None);
                    none += 1;
                }
            }
        }
        assert!(searched > 50 && none > 50, "{searched} {none}");
    }
}
