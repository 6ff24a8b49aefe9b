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
use cotama_core::units::{Millimetres, Millis};
use cotama_models::missions::tables::{Alternative, ENERGY, Rest};
use cotama_models::missions::{Mission, Remaining};

mod further;
mod held;
mod pace;
mod plannable;
mod slowed;
mod spending;

use further::Further;
pub(crate) use plannable::Plannable;
use slowed::Slowed;
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
    /// The configuration that runs, where supervisors take one; else the planned one does.
    pub(crate) runs: Option<usize>,
}

impl Progress {
    /// A mission that begins at a place of its path.
    pub(crate) const fn start(x: Millimetres) -> Self {
        let x_nm = x.0.saturating_mul(NM_PER_MM);
        let (cost, beside, used) = (None, [0; 2], [0; 2]);
        Self { first: 0, rest: None, cost, beside, t_us: 0, x_nm, used, runs: None }
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

/// A request for a plan.
enum Asks {
    Nothing,
    Up,
    Down(PlanCause),
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
    /// Alternatives with the speeds that the hardware allows which works now, where some is lost
    /// and speeds follow from it.
    slowed: Option<Slowed>,
    /// Sums beyond duration and energy.
    further: Further,
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
        let by_wishes = of.mission.plans_by_wishes();
        let ends = if by_wishes { of.mission.scenario().ends.len() } else { 0 };
        let mut planning = Self {
            of,
            monitor: of.monitor,
            choice: vec![0; count],
            rest: vec![([0; 2], Equipment::NONE); count + 1],
            solver: Solver::default(),
            slowed: None,
            further: Further::new(ends, at),
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
        self.look(at);
        self.slow_down(available);
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
        self.look(at);
        let cause = match self.asks(at, available, lost) {
            Asks::Up if self.plans_up(at, available) => return Assessed::Planned,
            Asks::Nothing | Asks::Up => return Assessed::Keeps,
            Asks::Down(cause) => cause,
        };
        if !self.of.adapts {
            // A margin below zero is borne; lost hardware that is needed ends the mission.
            if matches!(cause, PlanCause::Margin { .. } | PlanCause::End { .. }) {
                return Assessed::Keeps;
            }
            let none = NoPlan::Emptied { activity: at.first };
            return Assessed::Fails(cause, Reason::NoPlan(none));
        }
        if self.made.len() as u64 > MAX_REPLANS {
            return Assessed::Fails(cause, Reason::TooManyReplans);
        }
        match self.plan(cause, at, available) {
            Ok(()) => Assessed::Planned,
            Err(none) => Assessed::Fails(cause, Reason::NoPlan(none)),
        }
    }

    /// Returns what margins and hardware ask for; the ones that the simulator counts come first.
    fn asks(&mut self, at: &Progress, available: Equipment, lost: Option<PlanCause>) -> Asks {
        let (rest, needs) = self.remaining(at);
        let rest = self.hold(at).of(&rest);
        let there = if lost.is_some() { available } else { needs };
        let is_too_fast = lost.is_some() && self.is_too_fast(at, available);
        let asked = self.watch(at).assess(&rest, needs, there);
        if at.first == self.choice.len() {
            return Asks::Nothing;
        }
        match asked {
            Ok(Request::Down(Trigger::Margin { axis })) => {
                return Asks::Down(PlanCause::Margin { axis });
            }
            Ok(Request::Down(Trigger::Hardware)) => {
                return Asks::Down(lost.unwrap_or(PlanCause::Start));
            }
            Ok(Request::Keep | Request::Up) | Err(_) => {}
        }
        match (lost, self.further_broken(at)) {
            (Some(lost), _) if is_too_fast => Asks::Down(lost),
            (_, Some(end)) => Asks::Down(PlanCause::End { end }),
            _ if asked == Ok(Request::Up) && !self.has_further() => Asks::Up,
            _ => Asks::Nothing,
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
        if self.has_further() {
            return self.propose_further(at, available);
        }
        let scenario = self.of.mission.scenario();
        let is_start = at.first == 0 && at.rest.is_none() && available == scenario.available;
        let slowed = self.slowed.as_ref().map(|it| it.activities(&self.of.activities));
        let activities = slowed.as_deref().unwrap_or(&self.of.activities);
        let left = Left {
            activities,
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
            let whole = self.whole(activity, id).map_or([0; 2], |it| it.cost);
            for (sum, part) in cost.iter_mut().zip(whole) {
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
            slowed_by: self.slowed.as_ref().map(Slowed::available),
        });
    }

    /// The quality of what is left of the present plan.
    fn quality(&self, at: &Progress) -> u64 {
        let of = |activity: usize| {
            let id = usize::from(self.choice[activity]);
            let rest = at.rest.filter(|_| activity == at.first);
            let partial = rest.and_then(|rest| self.chosen(activity).quality_of(rest));
            let whole = || self.whole(activity, id).map_or(0, |it| it.quality);
            u64::from(partial.unwrap_or_else(whole))
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
            further: self.further_record(at),
        })
    }

    /// The alternative that is planned for an activity.
    pub(crate) fn chosen(&self, activity: usize) -> Alternative {
        self.alternatives(activity)[usize::from(self.choice[activity])]
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
mod tests;
