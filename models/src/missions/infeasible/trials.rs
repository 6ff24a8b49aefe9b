//! Searches on a mission with something changed: on the same table of candidates, with others left
//! out.

use super::{SHARED, STEPS};
use crate::missions::mission::Unfolded;
use crate::missions::scenario::{Constraint, Dropped, PlannedActivity, Scenario};
use crate::missions::tables::Alternative;
use cotama_core::allocation::{Allocator, Answer};
use cotama_core::exact::{Objective, Workspace};
use cotama_core::hardware::Equipment;
use cotama_core::problem::{Candidate, Problem};
use std::ops::Range;

/// To sort out so many combinations counts as a step.
const COMBINATIONS_A_STEP: u64 = 8;

/// The conditions of a search.
#[derive(Clone)]
pub(super) struct Trial<'t> {
    pub(super) limits: [u64; 2],
    pub(super) available: Equipment,
    /// The constraints that do not count, sorted.
    pub(super) lifted: &'t [(usize, Constraint)],
    /// The objectives left out.
    pub(super) without: Range<usize>,
}

/// A plan, as far as it matters here.
#[derive(Clone)]
pub(super) struct Plan {
    /// Whether none is better for the objective of its search.
    pub(super) best: bool,
    pub(super) cost: [u64; 2],
    /// Activities by index and their costs.
    pub(super) activities: Vec<(usize, [u32; 2])>,
}

/// The outcome of a search.
pub(super) enum Found {
    Plan(Plan),
    /// The proof that there is no plan.
    Nothing,
    Unknown,
}

/// A combination of options, and what keeps it from being an alternative.
struct Way<'m> {
    candidate: Candidate<2>,
    needs: Equipment,
    by: &'m [(usize, Constraint)],
}

/// A mission's combinations by activity, and the steps left for searches.
pub(super) struct Trials<'m> {
    /// For each activity its objective and its combinations.
    activities: Vec<(usize, Vec<Way<'m>>)>,
    each: u64,
    left: u64,
    complete: bool,
}

fn way<'m>(
    activity: &PlannedActivity,
    alternative: &Alternative,
    by: &'m [(usize, Constraint)],
) -> Option<Way<'m>> {
    let candidate = alternative.candidate(activity.table().whole(alternative), 0)?;
    Some(Way { candidate, needs: alternative.needs, by })
}

impl<'m> Trials<'m> {
    /// The combinations that are alternatives; a search has at most `each` steps.
    pub(super) fn new(mission: &'m Unfolded, each: u64) -> Self {
        let ways = |activity: &PlannedActivity| {
            let ways = activity
                .alternatives
                .iter()
                .filter_map(|alternative| way(activity, alternative, &[]));
            (activity.objective, ways.collect())
        };
        let activities = mission.scenario().activities.iter().map(ways).collect();
        // Work outside of searches costs something too, however few steps a search may take.
        Self { activities, each, left: SHARED.saturating_mul(each.max(STEPS)), complete: true }
    }

    /// Adds the combinations that constraints exclude, for trials without these. Returns the
    /// constraints.
    pub(super) fn lift_all(&mut self, mission: &'m Unfolded) -> Vec<(usize, Constraint)> {
        let mut definition = (**mission).clone();
        for zone in &mut definition.zones {
            zone.require_hardware = None;
            zone.require_tio = None;
        }
        let Ok(unconstrained) = Scenario::generate(&definition) else { return vec![] };
        let mut constraints = Vec::new();
        let planned = mission.scenario().activities.iter().zip(&unconstrained.activities);
        for ((planned, all), (_, ways)) in planned.zip(&mut self.activities) {
            // Both are in the order of the combinations, and labels are unique.
            // What axes exclude stays excluded.
            let can_be_lifted = |it: &&Dropped| all.labels.contains(&it.label);
            let mut dropped = planned.dropped.iter().filter(can_be_lifted).peekable();
            for (label, alternative) in all.labels.iter().zip(&all.alternatives) {
                if let Some(dropped) = dropped.next_if(|dropped| dropped.label == *label) {
                    constraints.extend(&dropped.by);
                    ways.extend(way(all, alternative, &dropped.by));
                }
            }
            debug_assert!(
                dropped.next().is_none(),
                "a combination is an alternative without constraints"
            );
        }
        constraints.sort_unstable();
        constraints.dedup();
        constraints
    }

    /// Whether every search came to its end.
    pub(super) fn complete(&self) -> bool {
        self.complete
    }

    /// The candidates of each activity that is left, with its index.
    fn candidates(&self, trial: &Trial<'_>) -> Vec<(usize, Vec<Candidate<2>>)> {
        let counts = |way: &&Way<'_>| {
            trial.available.covers(way.needs)
                && way.by.iter().all(|constraint| trial.lifted.binary_search(constraint).is_ok())
        };
        let kept = self.activities.iter().enumerate();
        kept.filter(|(_, (objective, _))| !trial.without.contains(objective))
            .map(|(index, (_, ways))| {
                (index, ways.iter().filter(counts).map(|way| way.candidate).collect())
            })
            .collect()
    }

    /// The plan of the least total on an axis, and of these the least on the other, whatever the
    /// limits. Every activity is cheapest by itself.
    pub(super) fn cheapest(&self, trial: &Trial<'_>, axis: usize) -> Plan {
        let cheapest = |(index, candidates): (usize, Vec<Candidate<2>>)| {
            let least = candidates.iter().min_by_key(|it| (it.cost[axis], it.cost[1 - axis]));
            (index, least.map_or([0; 2], |least| least.cost))
        };
        Plan::of(self.candidates(trial).into_iter().map(cheapest).collect(), true)
    }

    /// Whether there is surely a plan.
    pub(super) fn feasible(&mut self, trial: &Trial<'_>) -> bool {
        matches!(self.run(trial, None), Found::Plan(_))
    }

    /// Searches a plan, or the best for an objective.
    pub(super) fn run(&mut self, trial: &Trial<'_>, objective: Option<Objective>) -> Found {
        let found = self.search(trial, objective.as_slice());
        self.complete &= !matches!(found, Found::Unknown);
        found
    }

    fn search(&mut self, trial: &Trial<'_>, objectives: &[Objective]) -> Found {
        let ways: usize = self.activities.iter().map(|(_, ways)| ways.len()).sum();
        let Some(left) = self.left.checked_sub(ways as u64 / COMBINATIONS_A_STEP) else {
            return Found::Unknown;
        };
        self.left = left;

        let candidates = self.candidates(trial);
        let lists: Vec<_> = candidates.iter().map(|(_, candidates)| &candidates[..]).collect();
        // Without a candidate for some activity there is no problem, and no plan.
        let Ok(problem) = Problem::new(&lists, trial.limits, [0, 1]) else { return Found::Nothing };
        if [0, 1].into_iter().any(|axis| problem.least(axis) > trial.limits[axis]) {
            return Found::Nothing;
        }
        let (mut workspace, mut choices) = (Workspace::new(), vec![0; lists.len()]);
        let mut exact = workspace.exact(&problem, objectives, self.each.min(self.left), 0);
        let (found, steps) = match exact.allocate(&problem, &mut choices) {
            Ok(Answer::Planned(planned)) => {
                // A plan that is not proven best is one still.
                self.complete &= planned.optimal || objectives.is_empty();
                let cost = |((index, list), &choice): (&(usize, Vec<Candidate<2>>), &u16)| {
                    (*index, list[usize::from(choice)].cost)
                };
                let activities = candidates.iter().zip(&choices).map(cost).collect();
                (Found::Plan(Plan::of(activities, planned.optimal)), planned.steps)
            }
            Ok(Answer::Infeasible { steps, .. }) => (Found::Nothing, steps),
            Ok(Answer::Unknown { steps, .. }) => (Found::Unknown, steps),
            Err(_) => (Found::Unknown, 0),
        };
        self.left = self.left.saturating_sub(steps);
        found
    }
}

impl Plan {
    fn of(activities: Vec<(usize, [u32; 2])>, best: bool) -> Self {
        let total = |axis: usize| activities.iter().map(|(_, cost)| u64::from(cost[axis])).sum();
        Self { best, cost: [total(0), total(1)], activities }
    }
}
