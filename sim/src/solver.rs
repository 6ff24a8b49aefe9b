//! The allocators behind one door, with their memory: every command asks them here, so that all
//! find the same plan in the same steps.

use crate::options::{Aim, Planner};
use crate::run::NoPlan;
use cotama_core::allocation::{Allocator, Answer, MemoryError, Planned};
use cotama_core::exact::{Objective, Workspace};
use cotama_core::hardware::Equipment;
use cotama_core::monitor::worst;
use cotama_core::panorama::Panorama;
use cotama_core::problem::Problem;
use cotama_models::missions::Remaining;
use cotama_models::missions::tables::{Activity, ENERGY, RemainingError, Rest};

/// How many nodes a complete search may remember at first, 160 KiB, and how many when it is not
/// done after [`FIRST`] steps: 10 MiB.
const SEEN: [usize; 2] = [1 << 12, 1 << 18];
/// The steps of the search with the smaller memory, which nearly all plans are proven in.
const FIRST: u64 = 20_000;

/// Objectives of a complete search: the most quality, and the least energy.
pub const QUALITY: [Objective; 2] = [Objective::MostQuality, Objective::Least(ENERGY)];
/// The least energy, and the most quality.
pub const MIN_ENERGY: [Objective; 2] = [Objective::Least(ENERGY), Objective::MostQuality];

/// Memory of the allocators; it grows to what a problem needs and is kept for the next.
///
/// ```
/// use cotama_core::{allocation::Answer, problem::{Candidate, Problem}};
/// use cotama_sim::solver::{QUALITY, Solver};
/// let c = |time, energy, quality| Candidate { cost: [time, energy], quality, id: 0 };
/// let ways = [c(5, 1, 1), c(1, 2, 3)];
/// let activities = [&ways[..]];
/// let problem = Problem::new(&activities, [6, 6], [0, 1]).unwrap();
/// let mut solver = Solver::default();
/// let Ok(Answer::Planned(found)) = solver.exact(&problem, &QUALITY, 1_000) else { panic!() };
/// assert_eq!((found.quality, solver.plan()), (3, &[1][..]));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Solver {
    caps: Vec<[u32; 2]>,
    workspace: Workspace<2>,
    plan: Vec<u16>,
    activities: usize,
}

/// A plan, in [`Solver::plan`], and who found it.
pub(crate) struct Found {
    pub(crate) planned: Planned<2>,
    pub(crate) allocator: &'static str,
}

/// A mission from an activity on.
pub(crate) struct Left<'a> {
    /// All activities of the mission.
    pub(crate) activities: &'a [Activity<'a>],
    /// The first one that is not done.
    pub(crate) first: usize,
    /// Rest of that one; `None` when it is whole.
    pub(crate) rest: Option<Rest>,
    /// Hardware that works.
    pub(crate) available: Equipment,
    /// The candidates of just that, where they are known already.
    pub(crate) known: Option<&'a Remaining>,
    /// Amounts that the plan may cost, and the order of their axes.
    pub(crate) limits: [u64; 2],
    pub(crate) order: [usize; 2],
}

/// A plan for what is left, not yet in force.
pub(crate) struct Proposal {
    /// The alternative of each activity from the first on.
    pub(crate) choice: Vec<u16>,
    /// The cost of the first activity.
    pub(crate) first_cost: [u32; 2],
    pub(crate) planned: Planned<2>,
    pub(crate) allocator: &'static str,
    /// The most that any plan of what is left can cost.
    pub(crate) worst: [u64; 2],
}

impl Solver {
    /// Plans what is left of a mission.
    pub(crate) fn propose(
        &mut self,
        planner: Planner,
        left: &Left<'_>,
    ) -> Result<Proposal, NoPlan> {
        let activities = left.activities.get(left.first..).unwrap_or_default();
        let made;
        let remaining = if let Some(known) = left.known {
            known
        } else {
            made = Remaining::new(activities, left.rest, left.available)
                .map_err(|why| none(why, left.first))?;
            &made
        };
        let lists = remaining.lists();
        // No list is empty, the order was checked when the mission was read, the counts are those
        // of its limits.
        let problem = Problem::new(&lists, left.limits, left.order)
            .map_err(|_| NoPlan::Unknown { steps: 0 })?;
        let Found { planned, allocator } = self.solve(planner, &problem)?;
        let picked: Vec<_> = lists
            .iter()
            .zip(self.plan())
            .filter_map(|(list, &index)| list.get(usize::from(index)))
            .collect();
        debug_assert_eq!(picked.len(), lists.len());
        let total = |axis: usize| picked.iter().map(|it| u64::from(it.cost[axis])).sum::<u64>();
        debug_assert!((0..2).all(|axis| total(axis) <= left.limits[axis]), "a plan keeps limits");
        Ok(Proposal {
            choice: picked.iter().map(|it| it.id).collect(),
            first_cost: picked.first().map_or([0; 2], |it| it.cost),
            planned,
            allocator,
            worst: worst(&lists),
        })
    }

    /// The plan found last: the position of the chosen candidate of each activity.
    pub fn plan(&self) -> &[u16] {
        self.plan.get(..self.activities).unwrap_or_default()
    }

    /// Looks for a plan.
    pub(crate) fn solve(
        &mut self,
        planner: Planner,
        problem: &Problem<'_, 2>,
    ) -> Result<Found, NoPlan> {
        let exact = |solver: &mut Self, objectives: &[Objective], steps| {
            found("exact", solver.exact(problem, objectives, steps))
        };
        match planner {
            Planner::Panorama => found("panorama", self.rule(problem)),
            Planner::PanoramaThenExact { steps } => match found("panorama", self.rule(problem)) {
                Ok(found) => Ok(found),
                Err(_) => exact(self, &[Objective::Most(problem.order()[1])], steps),
            },
            Planner::Exact { aim: Aim::Quality, steps } => exact(self, &QUALITY, steps),
            Planner::Exact { aim: Aim::MinEnergy, steps } => exact(self, &MIN_ENERGY, steps),
        }
    }

    /// The rule of PANORAMA.
    ///
    /// # Errors
    /// As those of the [`Allocator`]; none for want of memory.
    pub fn rule(&mut self, problem: &Problem<'_, 2>) -> Result<Answer<2>, MemoryError> {
        self.activities = problem.activities().len();
        at_least(&mut self.caps, self.activities, [0; 2]);
        at_least(&mut self.plan, self.activities, 0);
        Panorama::new(&mut self.caps).allocate(problem, &mut self.plan)
    }

    /// A complete search of at most so many steps.
    ///
    /// # Errors
    /// As those of the [`Allocator`]; none for want of memory.
    pub fn exact(
        &mut self,
        problem: &Problem<'_, 2>,
        objectives: &[Objective],
        steps: u64,
    ) -> Result<Answer<2>, MemoryError> {
        let more = steps.saturating_sub(FIRST);
        // With few steps left there is nothing to be gained by beginning again.
        let first = if more > 3 * FIRST { FIRST } else { steps };
        let answer = self.search(problem, objectives, first, SEEN[0])?;
        if first == steps || is_proven(&answer) {
            return Ok(answer);
        }
        let kept = self.plan().to_vec();
        let again = self.search(problem, objectives, more, SEEN[1])?;
        Ok(match (answer, again) {
            (Answer::Planned(it), Answer::Unknown { steps, .. }) => {
                self.plan[..kept.len()].copy_from_slice(&kept);
                Answer::Planned(Planned { steps: it.steps + steps, ..it })
            }
            (_, Answer::Planned(it)) => {
                Answer::Planned(Planned { steps: it.steps + it_took(&answer), ..it })
            }
            (_, Answer::Infeasible { shortfall, steps }) => {
                Answer::Infeasible { shortfall, steps: steps + it_took(&answer) }
            }
            (_, Answer::Unknown { bound, steps }) => {
                Answer::Unknown { bound, steps: steps + it_took(&answer) }
            }
        })
    }

    fn search(
        &mut self,
        problem: &Problem<'_, 2>,
        objectives: &[Objective],
        steps: u64,
        seen: usize,
    ) -> Result<Answer<2>, MemoryError> {
        self.activities = problem.activities().len();
        at_least(&mut self.plan, self.activities, 0);
        let mut exact = self.workspace.exact(problem, objectives, steps, seen);
        exact.allocate(problem, &mut self.plan)
    }
}

fn at_least<T: Clone>(memory: &mut Vec<T>, needed: usize, empty: T) {
    if memory.len() < needed {
        memory.resize(needed, empty);
    }
}

/// Whether more steps would change nothing.
const fn is_proven(answer: &Answer<2>) -> bool {
    match answer {
        Answer::Planned(it) => it.optimal,
        Answer::Infeasible { shortfall, .. } => shortfall.is_some(),
        Answer::Unknown { .. } => false,
    }
}

const fn it_took(answer: &Answer<2>) -> u64 {
    match answer {
        Answer::Planned(it) => it.steps,
        Answer::Infeasible { steps, .. } | Answer::Unknown { steps, .. } => *steps,
    }
}

/// The reason that there is no plan without candidates, of activities from the first on.
fn none(why: RemainingError, first: usize) -> NoPlan {
    match why {
        RemainingError::NoCandidates { activity } => NoPlan::Emptied { activity: first + activity },
        RemainingError::TooLarge { .. } | RemainingError::BufferTooSmall => {
            NoPlan::Unknown { steps: 0 }
        }
    }
}

fn found(allocator: &'static str, answer: Result<Answer<2>, MemoryError>) -> Result<Found, NoPlan> {
    match answer {
        Ok(Answer::Planned(planned)) => Ok(Found { planned, allocator }),
        Ok(Answer::Infeasible { shortfall: None, .. }) => Err(NoPlan::Infeasible),
        Ok(Answer::Infeasible { shortfall: Some(short), .. }) => {
            Err(NoPlan::Limit { axis: short.axis(), short: short.gap() })
        }
        Ok(Answer::Unknown { steps, .. }) => Err(NoPlan::Unknown { steps }),
        // The memory was sized for this problem above.
        Err(_) => Err(NoPlan::Unknown { steps: 0 }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::streams::Streams;
    use cotama_core::problem::Candidate;

    #[test]
    fn a_search_finds_the_highest_on_the_last_axis_if_the_rule_finds_nothing() {
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
