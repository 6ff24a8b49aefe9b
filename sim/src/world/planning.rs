//! How the robot plans what is left of its mission (rules 4 and 5 of the paper's algorithm).

use super::World;
use crate::record::Recorder;
use crate::run::{MAX_REPLANS, NoPlan, PlanCause, PlanMade};
use crate::setup::NM_PER_MM;
use crate::solver::{Left, Proposal};
use crate::trace::Record;
use cotama_core::monitor::worst;
use cotama_core::units::{Millimetres, mul_div_half_up};
use cotama_models::missions::Remaining;
use cotama_models::missions::tables::{ENERGY, Rest};

impl World<'_> {
    /// Plans within what is left of the limits, and goes by that plan from now on.
    pub(super) fn plan<R: Recorder>(
        &mut self,
        cause: PlanCause,
        before: Option<[i64; 2]>,
        recorder: &mut R,
    ) -> Result<(), NoPlan> {
        let proposal = self.propose(self.monitor.left())?;
        self.adopt(cause, before, proposal, recorder);
        Ok(())
    }

    /// Plans within the room that an upward plan may use. The new plan comes into force if it has
    /// more quality than the rest of the present one or, at equal quality, if it is higher on the
    /// axis treated last.
    pub(super) fn plan_upwards<R: Recorder>(
        &mut self,
        rest: &[u64; 2],
        before: [i64; 2],
        recorder: &mut R,
    ) {
        if self.plans.len() as u64 <= MAX_REPLANS
            && let Ok(proposal) = self.propose(self.monitor.room())
        {
            let axis = self.simulation.mission.scenario().order.last().copied().unwrap_or(ENERGY);
            let present = (self.planned_quality(), rest[axis]);
            // A replan rounds the rest of the way up to whole mm, which alone is no improvement.
            let differs = proposal.choice != self.choice[self.first_remaining()..];
            if differs && (proposal.planned.quality, proposal.planned.cost[axis]) > present {
                self.adopt(PlanCause::Room, Some(before), proposal, recorder);
                return;
            }
        }
        // Kept: the margins of now are what must grow before the next request.
        let _ = self.monitor.planned(rest);
    }

    /// Returns the rest of the current activity, if it is not done; `None` if it is whole.
    fn rest_of_current(&self) -> Option<Rest> {
        let activity = &self.simulation.activities[self.activity];
        let detour_nm = self.detour_nm();
        if self.fresh && (detour_nm == 0 || !activity.travels()) {
            None
        } else if activity.travels() {
            let left_nm = self.end_nm().saturating_sub(self.x_nm).saturating_add(detour_nm);
            Some(Rest::Travel(Millimetres(left_nm.div_ceil(NM_PER_MM))))
        } else {
            let left_ms = mul_div_half_up(self.standing_us, 1, 1000).unwrap_or(u64::MAX);
            Some(Rest::Time(cotama_core::units::Millis(left_ms)))
        }
    }

    /// Asks the planner for a plan of what is left within these limits.
    fn propose(&mut self, limits: [u64; 2]) -> Result<Proposal, NoPlan> {
        let simulation = self.simulation;
        let (first, beside) = (self.first_remaining(), self.detour_beside());
        let rest = if first == self.activity { self.rest_of_current() } else { None };
        let at_start = first == 0 && rest.is_none() && self.available == simulation.all_hardware();
        let left = Left {
            activities: &simulation.activities,
            first,
            rest,
            available: self.available,
            known: simulation.start.as_ref().filter(|_| at_start),
            limits: std::array::from_fn(|axis| limits[axis].saturating_sub(beside[axis])),
            order: simulation.mission.scenario().order,
        };
        self.solver.propose(simulation.planner, &left)
    }

    /// Goes by a plan from now on.
    fn adopt<R: Recorder>(
        &mut self,
        cause: PlanCause,
        before: Option<[i64; 2]>,
        proposal: Proposal,
        recorder: &mut R,
    ) {
        let first = self.first_remaining();
        self.choice[first..].copy_from_slice(&proposal.choice);
        for activity in (first..self.choice.len()).rev() {
            let (mut cost, needs) = self.rest[activity + 1];
            let id = usize::from(self.choice[activity]);
            for (sum, &part) in cost.iter_mut().zip(&self.simulation.whole[activity][id].cost) {
                *sum += u64::from(part);
            }
            self.rest[activity] = (cost, needs.union(self.chosen(activity).needs));
        }
        let beside = self.detour_beside();
        let cost = [0, 1].map(|axis| proposal.planned.cost[axis].saturating_add(beside[axis]));
        let after = self.margins(&cost);
        let _ = self.monitor.planned(&cost);
        if !self.done {
            self.set_leg();
        }
        self.plans.push(PlanMade {
            cause,
            t_us: self.time_us,
            x_mm: self.x_nm / NM_PER_MM,
            first_activity: first,
            choice: proposal.choice,
            before,
            after,
            used: self.monitor.used(),
            first_cost: proposal.first_cost,
            steps: proposal.planned.steps,
            allocator: proposal.allocator,
        });
        if R::WANTED
            && let Some(plan) = self.plans.last()
        {
            recorder.record(Record::Plan(Box::new(self.plan_record(plan, &proposal.worst))));
            recorder.record(self.sample_record(after));
        }
    }

    /// The quality of what is left of the present plan.
    fn planned_quality(&self) -> u64 {
        let first = self.first_remaining();
        let quality = |activity: usize| {
            let id = usize::from(self.choice[activity]);
            let rest = if activity == self.activity { self.rest_of_current() } else { None };
            let partial = rest.and_then(|rest| self.chosen(activity).quality_of(rest));
            u64::from(partial.unwrap_or(self.simulation.whole[activity][id].quality))
        };
        (first..self.choice.len()).map(quality).sum()
    }

    /// The most that travelling back to the start can cost with the hardware that works; none if
    /// some part of the way has no alternative.
    pub(super) fn way_back(&self) -> Option<[u64; 2]> {
        let mut total = [0u64; 2];
        for activity in &self.simulation.activities[..=self.activity] {
            let start_nm = activity.x_start.0 * NM_PER_MM;
            let done_nm = (activity.x_end.0 * NM_PER_MM).min(self.x_nm).saturating_sub(start_nm);
            if done_nm == 0 {
                continue;
            }
            let way = Rest::Travel(Millimetres(done_nm.div_ceil(NM_PER_MM)));
            let ways = Remaining::new(&[*activity], Some(way), self.available).ok()?;
            for (sum, part) in total.iter_mut().zip(worst(&ways.lists())) {
                *sum += part;
            }
        }
        Some(total)
    }
}
