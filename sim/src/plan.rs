//! The plan of a mission under way, whatever moves the robot: what is left of the limits, what the
//! rest is planned to cost, and new plans where the present one no longer holds.
//!
//! Configurations of a robot's adapter are task implementation options (Lambert et al., J. Intell.
//! Robot. Syst. 110, 2024, Section 6.2.2), modules are their hardware. A lost module removes
//! options, and the rest of the mission is planned again (Section 7.3.2).

use crate::run::{MAX_REPLANS, NoPlan, PlanCause, PlanMade, Reason};
use crate::solver::{Left, Proposal, Solver};
use crate::trace::{Margins, Plan, ReturnMargin};
use cotama_core::hardware::Equipment;
use cotama_core::monitor::{MAX_AMOUNT, Monitor, Request, Trigger, worst};
use cotama_core::units::{Millijoules, Millimetres, MillimetresPerSecond, Millis, Milliwatts};
use cotama_models::missions::tables::{Alternative, ENERGY, Rest};
use cotama_models::missions::{Mission, Remaining};

mod held;
mod plannable;
mod spending;

pub(crate) use plannable::Plannable;
use spending::Spending;

/// Millimetres in units of position, which are nm: a speed in mm/s times a time in µs.
pub(crate) const NM_PER_MM: u64 = 1_000_000;

/// How far a mission has come.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Progress {
    /// The first activity that is not done.
    pub(crate) first: usize,
    /// Rest of it; `None` when it is whole.
    pub(crate) rest: Option<Rest>,
    /// The planned cost of that rest (ms, mJ), where it is known more exactly than by the mm.
    pub(crate) cost: Option<[u64; 2]>,
    /// The planned cost (ms, mJ) of a way beside the path.
    pub(crate) beside: [u64; 2],
    /// When, and where along the path.
    pub(crate) t_us: u64,
    pub(crate) x_nm: u64,
    /// Amounts used, in ms and mJ.
    pub(crate) used: [u64; 2],
}

impl Progress {
    /// A mission that begins at a place of its path.
    pub(crate) const fn start(x: Millimetres) -> Self {
        let x_nm = x.0.saturating_mul(NM_PER_MM);
        Self { first: 0, rest: None, cost: None, beside: [0; 2], t_us: 0, x_nm, used: [0; 2] }
    }
}

/// The fate of the plan in force when it is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Assessed {
    /// The plan goes on.
    Keeps,
    /// A new plan is in force.
    Planned,
    /// The plan does not hold, for this cause, and there is no other.
    Fails(PlanCause, Reason),
}

/// The plan of a run, and what is left of the limits.
#[derive(Clone, Debug)]
pub(crate) struct Planning<'s> {
    of: &'s Plannable<'s>,
    monitor: Monitor<2>,
    /// The alternative of each activity.
    choice: Vec<u16>,
    /// For each activity, the planned cost and the needs from it on; one more element for the end.
    rest: Vec<([u64; 2], Equipment)>,
    solver: Solver,
    /// The most that what is left can cost, of the plan made last.
    worst: [u64; 2],
    pub(crate) made: Vec<PlanMade>,
    /// The axes whose reserve no plan could hold, until the next plan.
    given_up: [bool; 2],
    spending: Spending,
}

impl<'s> Planning<'s> {
    /// Plans a whole mission.
    ///
    /// # Errors
    /// [`NoPlan`] where there is none.
    pub(crate) fn start(
        of: &'s Plannable<'s>,
        at: &Progress,
        available: Equipment,
    ) -> Result<Self, NoPlan> {
        let count = of.activities.len();
        let mut planning = Self {
            of,
            monitor: of.monitor,
            choice: vec![0; count],
            rest: vec![([0; 2], Equipment::NONE); count + 1],
            solver: Solver::default(),
            worst: [0; 2],
            made: Vec::new(),
            given_up: [false; 2],
            spending: Spending::default(),
        };
        planning.plan(PlanCause::Start, at, available)?;
        Ok(planning)
    }

    /// Plans within what is left of the limits, and goes by that plan from now on.
    ///
    /// # Errors
    /// [`NoPlan`] where there is none; the one in force stays.
    pub(crate) fn plan(
        &mut self,
        cause: PlanCause,
        at: &Progress,
        available: Equipment,
    ) -> Result<(), NoPlan> {
        self.reach(at);
        let (proposal, given_up) = self.held_back(at, available)?;
        self.adopt(cause, at, proposal, given_up);
        Ok(())
    }

    /// Looks at the margins, and plans again where they ask for it (rule 5 of the algorithm). With
    /// a cause to name, hardware that the plan needs and that is not there asks for it too.
    pub(crate) fn assess(
        &mut self,
        at: &Progress,
        available: Equipment,
        lost: Option<PlanCause>,
    ) -> Assessed {
        self.reach(at);
        let (rest, needs) = self.remaining(at);
        let rest = self.hold(at).of(&rest);
        let there = if lost.is_some() { available } else { needs };
        let trigger = match self.watch(at).assess(&rest, needs, there) {
            Ok(Request::Keep) | Err(_) => return Assessed::Keeps,
            Ok(_) if at.first == self.choice.len() => return Assessed::Keeps,
            Ok(Request::Up) if self.plans_up(at, available) => return Assessed::Planned,
            Ok(Request::Up) => return Assessed::Keeps,
            Ok(Request::Down(trigger)) => trigger,
        };
        let cause = match (trigger, lost) {
            (Trigger::Margin { axis }, _) => PlanCause::Margin { axis },
            (Trigger::Hardware, lost) => lost.unwrap_or(PlanCause::Start),
        };
        if !self.of.adapts {
            // A margin below zero is borne; lost hardware that is needed ends the mission.
            return match trigger {
                Trigger::Margin { .. } => Assessed::Keeps,
                Trigger::Hardware => {
                    let none = NoPlan::Emptied { activity: at.first };
                    Assessed::Fails(cause, Reason::NoPlan(none))
                }
            };
        }
        if self.made.len() as u64 > MAX_REPLANS {
            return Assessed::Fails(cause, Reason::TooManyReplans);
        }
        match self.plan(cause, at, available) {
            Ok(()) => Assessed::Planned,
            Err(none) => Assessed::Fails(cause, Reason::NoPlan(none)),
        }
    }

    /// Notes that hardware has come back: a reason to look for a better plan.
    pub(crate) const fn hardware_returned(&mut self) {
        self.monitor.hardware_returned();
    }

    /// The margins of the plan in force: limits less used less planned (ms, mJ), with what is held
    /// back for it.
    pub(crate) fn margins(&self, at: &Progress) -> [i64; 2] {
        self.margins_of(at, &self.remaining(at).0)
    }

    fn margins_of(&self, at: &Progress, rest: &[u64; 2]) -> [i64; 2] {
        self.watch(at).margins(&self.hold(at).of(rest)).unwrap_or([i64::MIN; 2])
    }

    /// The monitor, told what was used.
    fn watch(&self, at: &Progress) -> Monitor<2> {
        let (mut monitor, before) = (self.monitor, self.monitor.used());
        let more = |axis: usize| at.used[axis].min(MAX_AMOUNT).saturating_sub(before[axis]);
        // Both sides are at most MAX_AMOUNT, so this cannot be refused.
        let spent = monitor.spend(&std::array::from_fn(more));
        debug_assert!(spent.is_ok(), "amounts used are counted");
        monitor
    }

    /// The planned cost and the needs of what is left.
    fn remaining(&self, at: &Progress) -> ([u64; 2], Equipment) {
        let Some(&(whole, needs)) = self.rest.get(at.first) else {
            return ([0; 2], Equipment::NONE);
        };
        let of_rest = || Some(self.chosen(at.first).cost(at.rest?)?.map(u64::from));
        let current = if at.first < self.choice.len() { at.cost.or_else(of_rest) } else { None };
        let along = current.map_or(whole, |it| add(it, self.rest[at.first + 1].0));
        (add(along, at.beside), needs)
    }

    /// Asks the planner for a plan of what is left within these limits.
    fn propose(
        &mut self,
        at: &Progress,
        limits: [u64; 2],
        available: Equipment,
    ) -> Result<Proposal, NoPlan> {
        let scenario = self.of.mission.scenario();
        let is_start = at.first == 0 && at.rest.is_none() && available == scenario.available;
        let left = Left {
            activities: &self.of.activities,
            first: at.first,
            rest: at.rest,
            available,
            known: self.of.start.as_ref().filter(|_| is_start),
            limits: std::array::from_fn(|axis| limits[axis].saturating_sub(at.beside[axis])),
            order: scenario.order,
        };
        self.solver.propose(self.of.planner, &left)
    }

    /// Plans within the room that an upward plan may use. The new plan comes into force if it has
    /// more quality than the rest of the present one or, at equal quality, if it is higher on the
    /// axis treated last.
    fn plans_up(&mut self, at: &Progress, available: Equipment) -> bool {
        let (rest, monitor) = (self.remaining(at).0, self.watch(at));
        if self.made.len() as u64 <= MAX_REPLANS
            && let Ok(proposal) = self.propose(at, self.hold(at).within(&monitor.room()), available)
        {
            let axis = self.of.mission.scenario().order.last().copied().unwrap_or(ENERGY);
            let present = (self.quality(at), rest[axis]);
            // A replan rounds the rest of the way up to whole mm, which alone is no improvement.
            let differs = proposal.choice != self.choice[at.first..];
            if differs && (proposal.planned.quality, proposal.planned.cost[axis]) > present {
                self.adopt(PlanCause::Room, at, proposal, self.given_up);
                return true;
            }
        }
        // Kept: the margins of now are what must grow before the next request.
        self.monitor = monitor;
        let _ = self.monitor.planned(&self.hold(at).of(&rest));
        false
    }

    /// Goes by a plan from now on.
    fn adopt(&mut self, cause: PlanCause, at: &Progress, proposal: Proposal, given_up: [bool; 2]) {
        let before = (!self.made.is_empty()).then(|| self.margins(at));
        self.given_up = given_up;
        self.replan(at, &proposal.choice);
        self.choice[at.first..].copy_from_slice(&proposal.choice);
        for activity in (at.first..self.choice.len()).rev() {
            let (mut cost, needs) = self.rest[activity + 1];
            let id = usize::from(self.choice[activity]);
            for (sum, &part) in cost.iter_mut().zip(&self.of.whole[activity][id].cost) {
                *sum += u64::from(part);
            }
            self.rest[activity] = (cost, needs.union(self.chosen(activity).needs));
        }
        let cost = add(proposal.planned.cost, at.beside);
        let after = self.margins_of(at, &cost);
        self.monitor = self.watch(at);
        let _ = self.monitor.planned(&self.hold(at).of(&cost));
        self.worst = proposal.worst;
        self.made.push(PlanMade {
            cause,
            t_us: at.t_us,
            x_mm: at.x_nm / NM_PER_MM,
            first_activity: at.first,
            choice: proposal.choice,
            before,
            after,
            used: self.monitor.used(),
            first_cost: proposal.first_cost,
            steps: proposal.planned.steps,
            allocator: proposal.allocator,
        });
    }

    /// The quality of what is left of the present plan.
    fn quality(&self, at: &Progress) -> u64 {
        let of = |activity: usize| {
            let id = usize::from(self.choice[activity]);
            let rest = at.rest.filter(|_| activity == at.first);
            let partial = rest.and_then(|rest| self.chosen(activity).quality_of(rest));
            u64::from(partial.unwrap_or(self.of.whole[activity][id].quality))
        };
        (at.first..self.choice.len()).map(of).sum()
    }

    /// The most that travelling back to the start can cost with the hardware that works; none if
    /// some part of the way has no alternative.
    fn way_back(&self, at: &Progress, available: Equipment) -> Option<[u64; 2]> {
        let mut total = [0u64; 2];
        for activity in &self.of.activities {
            let start_nm = activity.x_start.0 * NM_PER_MM;
            let done_nm = (activity.x_end.0 * NM_PER_MM).min(at.x_nm).saturating_sub(start_nm);
            if done_nm == 0 {
                continue;
            }
            let way = Rest::Travel(Millimetres(done_nm.div_ceil(NM_PER_MM)));
            let ways = Remaining::new(&[*activity], Some(way), available).ok()?;
            total = add(total, worst(&ways.lists()));
        }
        Some(total)
    }

    /// The record of the plan made last, at the moment at which it was made.
    pub(crate) fn record(&self, at: &Progress, available: Equipment) -> Option<Plan> {
        let (plan, mission) = (self.made.last()?, self.of.mission);
        let margins = |way: &[u64; 2]| self.watch(at).return_margin(way).ok().map(Margins::from);
        let activity = mission.scenario().activities.get(plan.first_activity);
        Some(Plan {
            t_us: plan.t_us,
            x_mm: plan.x_mm,
            cause: plan.cause.text(mission),
            first_activity: activity.map_or_else(String::new, |it| it.id.clone()),
            before: plan.before.map(Margins::from),
            after: plan.after.into(),
            used: plan.used.into(),
            plan: plan.rows(mission),
            steps: plan.steps,
            allocator: plan.allocator.into(),
            return_margin: ReturnMargin {
                end: margins(&self.worst),
                start: self.way_back(at, available).and_then(|way| margins(&way)),
            },
        })
    }

    /// The alternative that is planned for an activity.
    pub(crate) fn chosen(&self, activity: usize) -> Alternative {
        self.of.activities[activity].alternatives[usize::from(self.choice[activity])]
    }

    /// The name of the alternative that is planned for an activity.
    pub(crate) fn label(&self, activity: usize) -> &'s str {
        let of = self.of.mission.scenario().activities.get(activity);
        let id = self.choice.get(activity).copied().map_or(0, usize::from);
        of.and_then(|it| it.labels.get(id)).map_or("", String::as_str)
    }

    /// Whether what is left of the plan in force needs no other hardware than this.
    pub(crate) fn needs_no_more(&self, at: &Progress, units: Equipment) -> bool {
        units.covers(self.remaining(at).1)
    }

    /// Returns the pace of an activity in a configuration: speed and power; that of the planned
    /// alternative when none has it.
    pub(crate) fn pace(
        &self,
        activity: usize,
        configuration: Option<usize>,
    ) -> (MillimetresPerSecond, Milliwatts) {
        let alternative = self.driven(activity, configuration);
        (alternative.speed, alternative.power)
    }

    /// Returns the power of standing in a configuration, with its hardware on.
    pub(crate) fn rest_power(&self, activity: usize, configuration: Option<usize>) -> Milliwatts {
        let mission = self.of.mission;
        let standing = mission.motion_power.at(MillimetresPerSecond(0));
        let hardware = mission.power_of(self.driven(activity, configuration).needs);
        Milliwatts(standing.0.saturating_add(hardware.0))
    }

    fn driven(&self, activity: usize, configuration: Option<usize>) -> Alternative {
        let all = &self.of.configurations[activity];
        let with = all.iter().position(|it| it.is_some() && *it == configuration);
        let at = with.unwrap_or_else(|| usize::from(self.choice[activity]));
        self.of.activities[activity].alternatives[at]
    }

    /// Returns how much more (ms, mJ) the rest of the plan in force costs where its configurations
    /// go no faster than this: `left` is the rest of the first activity.
    pub(crate) fn slower(
        &self,
        first: usize,
        left: Millimetres,
        allowed: impl Fn(usize) -> MillimetresPerSecond,
    ) -> [u64; 2] {
        let more = |activity: usize| {
            let (table, planned) = (&self.of.activities[activity], self.chosen(activity));
            let id = usize::from(self.choice[activity]);
            let speed = allowed(self.of.configurations[activity][id]?);
            if speed.0 == 0 || speed >= planned.speed {
                return None;
            }
            let whole = Millimetres(table.x_end.0.saturating_sub(table.x_start.0));
            let way = if activity == first { left } else { whole };
            let time = |speed: MillimetresPerSecond| way.0.saturating_mul(1_000).div_ceil(speed.0);
            let more = Millis(time(speed).saturating_sub(time(planned.speed)));
            Some([more.0, Millijoules::spent(planned.power, more).map_or(MAX_AMOUNT, |it| it.0)])
        };
        (first..self.choice.len()).filter_map(more).fold([0; 2], add)
    }

    /// Returns the mission.
    pub(crate) const fn mission(&self) -> &'s Mission {
        self.of.mission
    }

    /// The activity of an objective that holds a place of the path.
    pub(crate) fn activity(&self, objective: usize, x_mm: u64) -> usize {
        let activities = &self.of.mission.scenario().activities;
        let mut all = (0..activities.len()).filter(|it| activities[*it].objective == objective);
        let first = all.next().unwrap_or(0);
        all.take_while(|&it| activities[it].x_start.0 <= x_mm).last().unwrap_or(first)
    }

    /// How long an activity takes that does not travel.
    pub(crate) fn standing(&self, activity: usize) -> Millis {
        self.chosen(activity).duration
    }
}

const fn add(one: [u64; 2], other: [u64; 2]) -> [u64; 2] {
    [one[0].saturating_add(other[0]), one[1].saturating_add(other[1])]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::options::Options;
    use cotama_models::missions::{Mission, embedded};

    #[test]
    fn a_plan_that_fills_a_limit_to_the_last_unit_keeps_it() {
        let delivery = embedded::mission("delivery").unwrap();
        let mission = Mission::parse(delivery.name, delivery.text).unwrap();
        let of = Plannable::new(&mission, &Options::default()).unwrap();
        let start = Progress::start(Millimetres(0));
        let planning = Planning::start(&of, &start, mission.available()).unwrap();
        let left = planning.margins(&start).map(i64::unsigned_abs);
        let cause = |used| {
            let at = Progress { used, ..start };
            match planning.clone().assess(&at, mission.available(), None) {
                Assessed::Keeps => None,
                Assessed::Fails(cause, _) => Some(cause),
                Assessed::Planned => planning.made.last().map(|it| it.cause),
            }
        };
        assert_eq!(cause(left), None);
        let margin = |axis| Some(PlanCause::Margin { axis });
        assert_eq!(cause(left.map(|it| it + 1)), margin(mission.order[0]));
    }

    #[test]
    fn an_activity_is_under_way_at_its_start() {
        let delivery = embedded::mission("delivery").unwrap();
        let zone = "[[zone]]\nid = \"hall\"\nx_start_mm = 60000\nx_end_mm = 70000\n[run]";
        let text = delivery.text.replacen("[run]", zone, 1);
        let mission = Mission::parse(delivery.name, &text).unwrap();
        let of = Plannable::new(&mission, &Options::default()).unwrap();
        let start = Progress::start(Millimetres(0));
        let planning = Planning::start(&of, &start, mission.available()).unwrap();
        let at = |x_mm: u64| planning.activity(2, x_mm);
        // The first drive, the object, and three parts of the second drive.
        assert_eq!([40_000, 59_999, 60_000, 69_999, 70_000, 80_000].map(at), [2, 2, 3, 3, 4, 4]);
    }
}
