//! The allocators behind one call, with their memory.

use crate::answers::Status;
use cotama_core::allocation::{Answer, MemoryError, Planned, Shortfall};
use cotama_core::exact::Objective;
use cotama_core::problem::Problem;
use cotama_sim::solver::Solver;

/// How a plan is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Method<'o> {
    /// By the rule of PANORAMA.
    Rule,
    /// By the rule, and by a complete search where it finds nothing.
    RuleThenExact,
    /// By a complete search.
    Exact(&'o [Objective]),
}

/// The outcome of a solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    /// A plan.
    Planned {
        planned: Planned<2>,
        /// Allocator that found the plan.
        allocator: &'static str,
    },
    /// No plan exists, which is proven.
    Infeasible {
        /// Which limit cannot be met, if the steps sufficed to know.
        shortfall: Option<Shortfall>,
    },
    /// The rule says that there is none, but a complete search finds one.
    Missed,
    /// Not known within the steps.
    Unknown {
        /// No plan has more of the objective (less, for a least), if there is an objective.
        bound: Option<u64>,
    },
}

/// A verdict, its plan if there is one, and the work done.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Solution {
    pub(crate) verdict: Verdict,
    /// For each activity the position of its candidate; empty without a plan.
    pub(crate) plan: Vec<u16>,
    pub(crate) steps: u64,
}

impl Solution {
    /// The verdict in a word.
    pub(crate) fn status(&self) -> Status {
        match self.verdict {
            Verdict::Planned { planned, .. } if planned.optimal => Status::Optimal,
            Verdict::Planned { .. } => Status::Feasible,
            // The answer of the rule was asked for; the reason says that the rule is wrong.
            Verdict::Infeasible { .. } | Verdict::Missed => Status::Infeasible,
            Verdict::Unknown { .. } => Status::Unknown,
        }
    }

    /// The plan found, if there is one.
    pub(crate) fn planned(&self) -> Option<&Planned<2>> {
        match &self.verdict {
            Verdict::Planned { planned, .. } => Some(planned),
            _ => None,
        }
    }

    /// A bound that is proven, if there is one.
    pub(crate) fn bound(&self) -> Option<u64> {
        match self.verdict {
            Verdict::Planned { planned, .. } => planned.bound,
            Verdict::Unknown { bound } => bound,
            Verdict::Infeasible { .. } | Verdict::Missed => None,
        }
    }
}

/// Looks for a plan, with at most so many steps of complete search.
pub(crate) fn solve(
    problem: &Problem<'_, 2>,
    method: Method<'_>,
    steps: u64,
) -> Result<Solution, MemoryError> {
    if let Method::Exact(objectives) = method {
        let (answer, plan) = exact(problem, objectives, steps)?;
        return Ok(match answer {
            Answer::Planned(planned) => Solution {
                verdict: Verdict::Planned { planned, allocator: "exact" },
                plan,
                steps: planned.steps,
            },
            Answer::Infeasible { shortfall, steps } => {
                without(Verdict::Infeasible { shortfall }, steps)
            }
            Answer::Unknown { bound, steps } => {
                without(Verdict::Unknown { bound: Some(bound) }, steps)
            }
        });
    }
    let (answer, plan) = panorama(problem)?;
    let rule_steps = match answer {
        Answer::Planned(planned) => {
            let verdict = Verdict::Planned { planned, allocator: "panorama" };
            return Ok(Solution { verdict, plan, steps: planned.steps });
        }
        Answer::Infeasible { steps, .. } | Answer::Unknown { steps, .. } => steps,
    };
    // The rule can miss a plan: only a complete search tells.
    let highest = [Objective::Most(problem.order()[1])];
    let objectives = if method == Method::Rule { &[][..] } else { &highest };
    let (answer, plan) = exact(problem, objectives, steps)?;
    Ok(match answer {
        Answer::Planned(planned) if method == Method::Rule => {
            without(Verdict::Missed, rule_steps + planned.steps)
        }
        Answer::Planned(planned) => {
            let verdict = Verdict::Planned { planned, allocator: "exact" };
            Solution { verdict, plan, steps: rule_steps + planned.steps }
        }
        Answer::Infeasible { shortfall, steps } => {
            without(Verdict::Infeasible { shortfall }, rule_steps + steps)
        }
        Answer::Unknown { steps, .. } => {
            without(Verdict::Unknown { bound: None }, rule_steps + steps)
        }
    })
}

fn without(verdict: Verdict, steps: u64) -> Solution {
    Solution { verdict, plan: Vec::new(), steps }
}

fn panorama(problem: &Problem<'_, 2>) -> Result<(Answer<2>, Vec<u16>), MemoryError> {
    let mut solver = Solver::default();
    let answer = solver.rule(problem)?;
    Ok((answer, solver.plan().to_vec()))
}

fn exact(
    problem: &Problem<'_, 2>,
    objectives: &[Objective],
    steps: u64,
) -> Result<(Answer<2>, Vec<u16>), MemoryError> {
    let mut solver = Solver::default();
    let answer = solver.exact(problem, objectives, steps)?;
    Ok((answer, solver.plan().to_vec()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use cotama_core::problem::Candidate;

    /// Takes duration from the second activity, and then has no way to save energy there.
    fn missed(story: impl Fn(&Problem<'_, 2>)) {
        let c = |duration, energy| Candidate { cost: [duration, energy], quality: 0, id: 0 };
        let (a, b, more) = ([c(5, 1), c(1, 2)], [c(5, 1), c(1, 10)], [c(0, 0), c(0, 3)]);
        let activities = [&a[..], &b, &more];
        story(&Problem::new(&activities, [6, 6], [0, 1]).unwrap());
    }

    fn steps(answer: &Answer<2>) -> u64 {
        match answer {
            Answer::Planned(it) => it.steps,
            Answer::Infeasible { steps, .. } | Answer::Unknown { steps, .. } => *steps,
        }
    }

    #[test]
    fn a_search_finds_the_plan_that_fills_the_last_limit_if_the_rule_fails() {
        missed(|problem| {
            let rule = steps(&panorama(problem).unwrap().0);
            let (most, _) = exact(problem, &[Objective::Most(1)], 1_000).unwrap();
            let found = solve(problem, Method::RuleThenExact, 1_000).unwrap();
            let Verdict::Planned { planned, allocator } = found.verdict else {
                panic!("{found:?}")
            };
            assert_eq!(
                (planned.cost, allocator, &found.plan[..]),
                ([6, 6], "exact", &[1, 0, 1][..])
            );
            assert_eq!(
                (rule, found.steps, found.status()),
                (20, 20 + steps(&most), Status::Optimal)
            );
        });
    }

    #[test]
    fn a_plan_with_a_bound_above_it_is_feasible_and_no_more() {
        let status = |optimal| {
            let planned = Planned { cost: [1, 1], quality: 5, bound: Some(7), optimal, steps: 9 };
            let verdict = Verdict::Planned { planned, allocator: "exact" };
            Solution { verdict, plan: vec![0], steps: 9 }.status()
        };
        assert_eq!([false, true].map(status), [Status::Feasible, Status::Optimal]);
    }

    #[test]
    fn a_plan_that_the_rule_misses_is_not_given_as_its_own() {
        missed(|problem| {
            let (any, _) = exact(problem, &[], 1_000).unwrap();
            let found = solve(problem, Method::Rule, 1_000).unwrap();
            assert_eq!((found.verdict, found.steps), (Verdict::Missed, 20 + steps(&any)));
            assert!(found.plan.is_empty());
        });
    }

    #[test]
    fn the_steps_of_the_rule_count_whatever_the_search_says() {
        missed(|problem| {
            let unknown = solve(problem, Method::RuleThenExact, 1).unwrap();
            let search = steps(&exact(problem, &[Objective::Most(1)], 1).unwrap().0);
            assert_eq!(unknown.verdict, Verdict::Unknown { bound: None });
            assert_eq!(unknown.steps, 20 + search);
            let none = problem.with_limits([6, 2]);
            let rule = steps(&panorama(&none).unwrap().0);
            let search = steps(&exact(&none, &[], 1_000).unwrap().0);
            let infeasible = solve(&none, Method::Rule, 1_000).unwrap();
            let shortfall = Shortfall::new(1, 2, 3);
            assert_eq!(infeasible.verdict, Verdict::Infeasible { shortfall });
            assert_eq!(infeasible.steps, rule + search);
        });
    }
}
