//! Sums beyond duration and energy that a mission with axes limits at its end: what was used of
//! them, their margins (Lambert et al. 2024, equation 7), and plans within all limits.

use super::{Planning, Progress};
use crate::run::NoPlan;
use crate::solver::Proposal;
use crate::trace::FurtherMargin;
use cotama_axes::{Lifted, Mission, Problem, Relation, Steps, Stop, Table};
use cotama_core::allocation::Planned;
use cotama_core::hardware::Equipment;
use cotama_core::monitor::worst;
use cotama_core::problem::Candidate;
use cotama_models::missions::tables::{DURATION, Rest};
use cotama_models::missions::{End, Grows, Remaining};

/// Amounts are counted in parts of a unit.
const PARTS: i128 = 1_000_000;

/// The most steps of a search for the best plan, and of each one with fewer wishes.
const STEPS: u64 = 10_000_000;

/// Amounts used of all sums, by end constraint, up to a look.
#[derive(Clone, Debug)]
pub(super) struct Further {
    /// In parts; of sums that the simulator counts nothing.
    used: Vec<i128>,
    last: Progress,
}

impl Further {
    pub(super) fn new(ends: usize, start: &Progress) -> Self {
        Self { used: vec![0; ends], last: *start }
    }
}

impl Planning<'_> {
    /// Whether plans are chosen by wishes, within all end constraints.
    pub(super) fn has_further(&self) -> bool {
        self.of.mission.plans_by_wishes()
    }

    fn ends(&self) -> &[End] {
        &self.of.mission.scenario().ends
    }

    /// Counts what was used since the last look.
    pub(super) fn look(&mut self, at: &Progress) {
        if self.has_further() {
            self.further = Further { used: self.used_at(at), last: *at };
        }
    }

    /// Returns what was used of each sum, in parts.
    fn used_at(&self, at: &Progress) -> Vec<i128> {
        let last = &self.further.last;
        let more = |end: &End| match end.grows {
            _ if last.first >= self.choice.len() => 0,
            Grows::Counted(_) => 0,
            Grows::WithTime => self.in_time(last, at, end.indicator),
            Grows::WithWay => self.on_the_way(last, at, end.indicator),
        };
        self.further.used.iter().zip(self.ends()).map(|(used, end)| used + more(end)).collect()
    }

    /// Returns the first end constraint beyond duration and energy that does not hold when nothing
    /// more is done, and by how much; of a mission that is not done those `at least` are not asked.
    pub(crate) fn missed(&self, at: &Progress, is_done: bool) -> Option<(usize, u64)> {
        let used = self.used_at(at);
        let mut margins = used.iter().zip(self.ends()).enumerate().map(|(number, (used, end))| {
            let is_asked = is_done || !matches!(end.relation, Relation::AtLeast | Relation::Above);
            let counts = is_asked && !matches!(end.grows, Grows::Counted(_));
            let value = in_units(*used, end.relation);
            (number, if counts { end.relation.margin(value, end.goal) } else { 0 })
        });
        margins.find(|it| it.1 < 0).map(|(number, margin)| (number, margin.unsigned_abs()))
    }

    /// Returns the value of an activity as planned, in parts.
    fn value(&self, activity: usize, indicator: usize) -> i128 {
        self.value_of(activity, usize::from(self.choice[activity]), indicator)
    }

    fn value_of(&self, activity: usize, id: usize, indicator: usize) -> i128 {
        let value = self.derived(activity).get(id).map_or(0, |it| it.value(indicator));
        i128::from(value) * PARTS
    }

    /// Returns what the time since a look takes at the rate of what ran then.
    fn in_time(&self, last: &Progress, at: &Progress, indicator: usize) -> i128 {
        let id = self.driven_id(last.first, last.runs);
        let lasts_ms = self.whole(last.first, id).map_or(0, |it| it.cost[DURATION]);
        let passed_us = at.t_us.saturating_sub(last.t_us);
        let value = self.value_of(last.first, id, indicator) * i128::from(passed_us);
        value.checked_div(i128::from(lasts_ms) * 1_000).unwrap_or(0)
    }

    /// Returns what was done since a look, in the way that ran then.
    fn on_the_way(&self, last: &Progress, at: &Progress, indicator: usize) -> i128 {
        let id = self.driven_id(last.first, last.runs);
        let of = |[left, all]: [i128; 2]| {
            (self.value_of(last.first, id, indicator) * left).checked_div(all).unwrap_or(0)
        };
        let before = of(self.left_of(last).map(i128::from));
        if at.first == last.first {
            return (before - of(self.left_of(at).map(i128::from))).max(0);
        }
        let between: i128 = (last.first + 1..at.first).map(|it| self.value(it, indicator)).sum();
        let begun = at.first < self.choice.len() && at.first > last.first;
        let now =
            if begun { self.value(at.first, indicator) - self.begun(at, indicator) } else { 0 };
        before + between + now
    }

    /// Returns what is left of the activity under way, as planned.
    fn begun(&self, at: &Progress, indicator: usize) -> i128 {
        let [left, all] = self.left_of(at).map(i128::from);
        (self.value(at.first, indicator) * left).checked_div(all).unwrap_or(0)
    }

    /// Returns what the plan in force takes of an indicator from here to the end, in parts.
    fn left(&self, at: &Progress, indicator: usize) -> i128 {
        let whole = |it: usize| self.value(it, indicator);
        let later: i128 = (at.first + 1..self.choice.len()).map(whole).sum();
        if at.first >= self.choice.len() {
            return 0;
        }
        later + self.begun(at, indicator)
    }

    /// Returns the margins of the end constraints with the plan in force, in units; those that the
    /// simulator counts are `None`.
    pub(super) fn further_margins(&self, at: &Progress) -> Vec<Option<i64>> {
        let margin = |(used, end): (&i128, &End)| {
            if matches!(end.grows, Grows::Counted(_)) {
                return None;
            }
            let sum = used + self.left(at, end.indicator);
            Some(end.relation.margin(in_units(sum, end.relation), end.goal))
        };
        self.further.used.iter().zip(self.ends()).map(margin).collect()
    }

    /// Returns the margins with the names of their constraints.
    pub(super) fn further_record(&self, at: &Progress) -> Vec<FurtherMargin> {
        let constraints = self.of.mission.axes.as_ref().map(|it| &it.mission.constraints);
        let named = |(margin, end): (Option<i64>, &End)| {
            let it = constraints.and_then(|it| it.get(end.constraint))?;
            Some(FurtherMargin { constraint: it.id.clone(), margin: margin? })
        };
        self.further_margins(at).into_iter().zip(self.ends()).filter_map(named).collect()
    }

    /// Returns the first end constraint beyond duration and energy whose margin is below zero.
    pub(super) fn further_broken(&self, at: &Progress) -> Option<usize> {
        self.further_margins(at).iter().position(|it| it.is_some_and(|it| it < 0))
    }

    /// Plans what is left within all end constraints, by the wishes of the mission. A task that is
    /// under way goes on as planned.
    pub(super) fn propose_further(
        &mut self,
        at: &Progress,
        available: Equipment,
    ) -> Result<Proposal, NoPlan> {
        let mission = self.of.mission;
        let Some(case) = &mission.axes else { return Err(NoPlan::Infeasible) };
        let stays = matches!(at.rest, Some(Rest::Time(_)));
        let first = at.first + usize::from(stays);
        let mut goals: Mission = case.mission.clone();
        for (end, used) in self.ends().iter().zip(&self.further.used) {
            let task = if stays { self.task_left(at, end) } else { 0 };
            let spent = match end.grows {
                Grows::Counted(axis) => {
                    let used = at.used[axis].saturating_add(at.beside[axis]);
                    i64::try_from(used).unwrap_or(i64::MAX / 4)
                }
                Grows::WithTime | Grows::WithWay => in_units(*used, end.relation),
            };
            if let Some(it) = goals.constraints.get_mut(end.constraint) {
                it.goal = end.goal.saturating_sub(spent).saturating_sub(task);
            }
        }
        let (table, ids) = self.table(first, at, available);
        if let Some(empty) = ids.iter().position(Vec::is_empty) {
            return Err(NoPlan::Emptied { activity: first + empty });
        }
        let problem = Problem::new(&goals, &table, Lifted::default());
        let (mut spent, mut found, mut is_best) = (0, Err(Stop::Limit), true);
        // A robot on its way needs a plan soon: with fewer wishes where all take too long.
        for wishes in [&case.ask[..], case.ask.get(..1).unwrap_or_default(), &[]] {
            let mut steps = Steps::new(STEPS);
            found = problem.best(wishes, &mut steps);
            spent += steps.used();
            is_best = wishes.len() == case.ask.len();
            if found.is_ok() {
                break;
            }
        }
        let plan = match found {
            Ok(Some(it)) => it,
            Ok(None) => return Err(NoPlan::Infeasible),
            Err(Stop::Limit | Stop::Wrong(_)) => return Err(NoPlan::Unknown { steps: spent }),
        };
        let picked = ids.iter().zip(&plan.choices).filter_map(|(ids, it)| ids.get(*it)).copied();
        let choice = stays.then(|| self.choice[at.first]).into_iter().chain(picked).collect();
        let proposal = self.proposal(at, available, choice, spent)?;
        Ok(Proposal { planned: Planned { optimal: is_best, ..proposal.planned }, ..proposal })
    }

    /// Returns what the task under way still takes of a sum, in units.
    fn task_left(&self, at: &Progress, end: &End) -> i64 {
        in_units(self.begun(at, end.indicator), end.relation)
    }

    /// Returns the activities from one on with the candidates that the hardware covers, and for
    /// each candidate its alternative.
    fn table(&self, first: usize, at: &Progress, available: Equipment) -> (Table, Vec<Vec<u16>>) {
        let (mut table, mut all) = (Table::default(), Vec::new());
        for activity in first..self.choice.len() {
            let own = self.of.activities[activity];
            let rows = self.alternatives(activity).iter().zip(self.derived(activity)).zip(0u16..);
            let kept = rows.filter(|((it, _), _)| available.covers(it.needs));
            let share = (activity == at.first && at.rest.is_some())
                .then(|| self.left_of(at).map(i128::from));
            let (mut candidates, mut ids) = (Vec::new(), Vec::new());
            for ((_, derived), id) in kept {
                let mut candidate = derived.clone();
                if let Some([left, all]) = share {
                    for (indicator, it) in candidate.values.iter_mut().enumerate() {
                        let Some(it) = it else { continue };
                        let part = i128::from(*it) * PARTS * left;
                        *it =
                            in_units(part.checked_div(all).unwrap_or(0), self.relation(indicator));
                    }
                }
                candidates.push(candidate);
                ids.push(id);
            }
            table.activities.push(cotama_axes::Activity {
                objective: 0,
                x_start_mm: i64::try_from(own.x_start.0).unwrap_or(0),
                x_end_mm: i64::try_from(own.x_end.0).unwrap_or(0),
                zones: Vec::new(),
                candidates,
                dropped: Vec::new(),
            });
            all.push(ids);
        }
        (table, all)
    }

    /// Returns the relation of the first end constraint on an indicator: parts are rounded against
    /// it.
    fn relation(&self, indicator: usize) -> Relation {
        let own = self.ends().iter().find(|it| it.indicator == indicator);
        own.map_or(Relation::AtMost, |it| it.relation)
    }

    /// Returns a plan as the simulator carries it.
    fn proposal(
        &self,
        at: &Progress,
        available: Equipment,
        choice: Vec<u16>,
        steps: u64,
    ) -> Result<Proposal, NoPlan> {
        let own = self.slowed.as_ref().map(|it| it.activities(&self.of.activities));
        let activities = own.as_deref().unwrap_or(&self.of.activities);
        let rest = activities.get(at.first..).unwrap_or_default();
        let left = Remaining::new(rest, at.rest, available)
            .map_err(|_| NoPlan::Emptied { activity: at.first })?;
        let lists = left.lists();
        let rows = lists.iter().zip(&choice);
        let picked = rows.filter_map(|(list, id)| list.iter().find(|it| it.id == *id));
        let picked: Vec<&Candidate<2>> = picked.collect();
        if picked.len() != choice.len() {
            // A task goes on with hardware that was lost: it cannot.
            return Err(NoPlan::Emptied { activity: at.first });
        }
        let sum = |axis: usize| picked.iter().map(|it| u64::from(it.cost[axis])).sum();
        let planned = Planned {
            cost: [sum(0), sum(1)],
            quality: picked.iter().map(|it| u64::from(it.quality)).sum(),
            bound: None,
            optimal: false,
            steps,
        };
        let first_cost = picked.first().map_or([0; 2], |it| it.cost);
        Ok(Proposal { choice, first_cost, planned, allocator: "axes", worst: worst(&lists) })
    }
}

/// Returns an amount in units, rounded against its limit.
fn in_units(parts: i128, relation: Relation) -> i64 {
    let down = parts.div_euclid(PARTS);
    let is_up = !matches!(relation, Relation::AtLeast | Relation::Above);
    let up = i128::from(is_up && parts.rem_euclid(PARTS) > 0);
    i64::try_from(down + up).unwrap_or(i64::MAX / 4)
}
