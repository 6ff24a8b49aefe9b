//! Reasons why there is no plan: least sets of constraints to lift, and goals that suffice.

use crate::mission::{Ask, Kind, Lifted, Mission, Relation, Sense};
use crate::plan::Problem;
use crate::steps::{Steps, Stop};
use crate::table::{Reason, Table};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

/// Tables, each without other core constraints, are kept up to so many combinations.
const MAX_KEPT: usize = 1 << 18;

/// Causes that no plan meets all constraints.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Infeasible {
    /// All sets of constraints which, lifted together, leave a plan, and of which no part does;
    /// small ones first.
    pub corrections: Vec<Lifted>,
    /// Corrections of one constraint.
    pub single: Vec<Single>,
    /// The constraint to blame, by index: of the single ones with a goal that suffices that with
    /// the least change against its goal, else the first of them.
    pub blame: Option<usize>,
    /// Activities without candidates, by index, with all that removed their combinations.
    pub empty: Vec<(usize, Vec<Reason>)>,
}

/// A constraint that suffices alone.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Single {
    /// By index.
    pub constraint: usize,
    /// The goals nearest to today's with which it suffices, below and above; both are none of a
    /// constraint that is not of the end.
    pub needed: [Option<i64>; 2],
}

impl Single {
    /// The goal that is nearest to this one.
    pub fn nearest(&self, goal: i64) -> Option<i64> {
        self.needed.iter().flatten().copied().min_by_key(|it| it.abs_diff(goal))
    }
}

/// Tables by the core constraints that are lifted.
struct Tables<'m> {
    mission: &'m Mission,
    core: Lifted,
    known: BTreeMap<Lifted, Table>,
    kept: usize,
}

impl Tables<'_> {
    /// Whether there is a plan without these constraints.
    fn has_plan(&mut self, lifted: Lifted, steps: &mut Steps) -> Result<bool, Stop> {
        let mission = self.mission;
        let table = self.table(lifted, steps)?;
        steps.take(1 + candidates(table) as u64)?;
        Ok(Problem::new(mission, table, lifted).best(&[], steps)?.is_some())
    }

    fn table(&mut self, lifted: Lifted, steps: &mut Steps) -> Result<&Table, Stop> {
        let core = Lifted(lifted.0 & self.core.0);
        if self.kept > MAX_KEPT {
            self.known.clear();
            self.kept = 0;
        }
        Ok(match self.known.entry(core) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(place) => {
                let table = Table::new(self.mission, core, steps)?;
                self.kept += candidates(&table);
                place.insert(table)
            }
        })
    }
}

fn candidates(table: &Table) -> usize {
    table.activities.iter().map(crate::table::Activity::before).sum()
}

impl Infeasible {
    /// Finds the causes, given the table with all constraints.
    ///
    /// # Errors
    /// [`Stop::Limit`] if the steps do not suffice; [`Stop::Wrong`] for arithmetic that does not
    /// come out once constraints are lifted.
    pub fn of(mission: &Mission, table: &Table, steps: &mut Steps) -> Result<Self, Stop> {
        let count = mission.constraints.len();
        let is_core =
            |it: &usize| mission.constraints.get(*it).is_some_and(|it| it.kind == Kind::Core);
        let core = (0..count).filter(is_core).fold(Lifted::default(), Lifted::with);
        let known = BTreeMap::from([(Lifted::default(), table.clone())]);
        let mut tables = Tables { mission, core, known, kept: candidates(table) };
        let mut corrections: Vec<Lifted> = Vec::new();
        for size in 1..=count {
            let mut chosen: Vec<usize> = (0..size).collect();
            loop {
                steps.take(1 + corrections.len() as u64)?;
                let lifted = chosen.iter().copied().fold(Lifted::default(), Lifted::with);
                let is_new = !corrections.iter().any(|&it| lifted.covers(it));
                if is_new && tables.has_plan(lifted, steps)? {
                    corrections.push(lifted);
                }
                if !advance(&mut chosen, count) {
                    break;
                }
            }
        }
        let mut single = Vec::new();
        for constraint in 0..count {
            let lifted = Lifted::default().with(constraint);
            if corrections.contains(&lifted) {
                let table = tables.table(lifted, steps)?;
                let needed = needed(mission, table, constraint, steps)?;
                single.push(Single { constraint, needed });
            }
        }
        let blame = blame(mission, &single);
        let empty = table.activities.iter().enumerate().filter(|it| it.1.candidates.is_empty());
        let reasons = |(number, it): (usize, &crate::table::Activity)| {
            let mut by: Vec<_> = it.dropped.iter().flat_map(|it| it.by.iter().copied()).collect();
            by.sort_unstable();
            by.dedup();
            (number, by)
        };
        let empty = empty.map(reasons).collect();
        Ok(Self { corrections, single, blame, empty })
    }
}

/// Goes on to the next choice of so many of `count`, in rising order; false after the last.
fn advance(chosen: &mut [usize], count: usize) -> bool {
    let size = chosen.len();
    let may_grow = |it: &(usize, &usize)| it.1 + size - it.0 < count;
    let Some(place) = chosen.iter().enumerate().rev().find(may_grow).map(|it| it.0) else {
        return false;
    };
    let first = chosen.get(place).map_or(0, |it| it + 1);
    chosen.iter_mut().skip(place).enumerate().for_each(|(more, it)| *it = first + more);
    true
}

/// Returns the goals of a constraint that suffice while all others are kept.
fn needed(
    mission: &Mission,
    table: &Table,
    constraint: usize,
    steps: &mut Steps,
) -> Result<[Option<i64>; 2], Stop> {
    let Some(it) = mission.constraints.get(constraint) else { return Ok([None; 2]) };
    if it.kind != Kind::End {
        return Ok([None; 2]);
    }
    let (indicator, goal) = (it.indicator, it.goal);
    let lifted = Lifted::default().with(constraint);
    let mut reach = |sense: Sense, bound: Option<Relation>| -> Result<Option<i64>, Stop> {
        let mut problem = Problem::new(mission, table, lifted);
        if let Some(relation) = bound {
            problem = problem.and(indicator, relation, goal);
        }
        let plan = problem.best(&[Ask { sense, indicator }], steps)?;
        Ok(plan.and_then(|it| it.totals.get(indicator).copied()))
    };
    Ok(match it.relation {
        Relation::AtMost => [None, reach(Sense::Min, None)?],
        Relation::Below => [None, reach(Sense::Min, None)?.map(|it| it + 1)],
        Relation::AtLeast => [reach(Sense::Max, None)?, None],
        Relation::Above => [reach(Sense::Max, None)?.map(|it| it - 1), None],
        Relation::Equal => {
            [reach(Sense::Max, Some(Relation::Below))?, reach(Sense::Min, Some(Relation::Above))?]
        }
    })
}

/// Returns the single constraint with the least change of its goal, relative to it.
fn blame(mission: &Mission, single: &[Single]) -> Option<usize> {
    let change = |it: &Single| {
        let goal = mission.constraints.get(it.constraint)?.goal;
        let change = it.nearest(goal)?.abs_diff(goal);
        Some((it.constraint, u128::from(change), u128::from(goal.unsigned_abs())))
    };
    let mut least: Option<(usize, u128, u128)> = None;
    for it in single.iter().filter_map(change) {
        // As products: change / goal is less; a goal of zero makes every change large.
        if least.is_none_or(|than| it.1 * than.2 < than.1 * it.2) {
            least = Some(it);
        }
    }
    least.map(|it| it.0).or(single.first().map(|it| it.constraint))
}
