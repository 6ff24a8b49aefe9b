//! The checks of the margins, and what follows from them (rule 5 of the paper's algorithm).

use super::World;
use crate::plan::{Assessed, NM_PER_MM, Progress};
use crate::record::Recorder;
use crate::run::{MAX_CHECKS, Outcome, PlanCause, Reason};
use crate::trace::Record;
use cotama_core::monitor::MAX_AMOUNT;
use cotama_core::units::{Millijoules, Millimetres, Millis, mul_div_half_up};
use cotama_models::missions::tables::Rest;

impl World<'_> {
    /// Compares consumption with the plan, and replans when it no longer holds.
    pub(super) fn check<R: Recorder>(&mut self, recorder: &mut R) {
        if self.checks >= MAX_CHECKS {
            let cause = self.planning.made.last().map_or(PlanCause::Start, |plan| plan.cause);
            self.stop(cause, Reason::TooManyChecks, recorder);
            return;
        }
        self.checks += 1;
        self.checked_us = Some(self.time_us);
        let at = self.progress();
        if R::WANTED {
            recorder.record(self.sample_record(self.planning.margins(&at)));
        }
        let lost = PlanCause::Hardware { hardware: self.lost.0, units: self.lost.1 };
        match self.planning.assess(&at, self.available, Some(lost)) {
            Assessed::Keeps => {}
            Assessed::Planned => {
                if !self.done {
                    self.set_leg();
                }
                self.record_plan(recorder);
            }
            Assessed::Fails(cause, reason) => self.stop(cause, reason, recorder),
        }
    }

    /// Records the plan that was made now.
    pub(super) fn record_plan<R: Recorder>(&self, recorder: &mut R) {
        if R::WANTED
            && let Some(plan) = self.planning.record(&self.progress(), self.available)
        {
            let after = [plan.after.duration_ms, plan.after.energy_mj];
            recorder.record(Record::Plan(Box::new(plan)));
            recorder.record(self.sample_record(after));
        }
    }

    /// Returns the amounts used, in ms and mJ, rounded half up; at most those that a monitor can
    /// count.
    pub(super) fn used(&self) -> [u64; 2] {
        const PJ_PER_MJ: u64 = 1_000_000_000;
        let energy_mj = match u64::try_from(self.energy_pj) {
            Ok(pj) => mul_div_half_up(pj, 1, PJ_PER_MJ).unwrap_or(u64::MAX),
            Err(_) => u64::try_from((self.energy_pj + 500_000_000) / u128::from(PJ_PER_MJ))
                .unwrap_or(u64::MAX),
        };
        let time_ms = mul_div_half_up(self.time_us, 1, 1000).unwrap_or(u64::MAX);
        [time_ms.min(MAX_AMOUNT), energy_mj.min(MAX_AMOUNT)]
    }

    /// Returns the progress of the mission.
    pub(super) fn progress(&self) -> Progress {
        let first = self.activity + usize::from(self.done);
        let (rest, cost) = if self.done {
            (None, None)
        } else {
            (self.rest_of_current(), Some(self.cost_of_current()))
        };
        let (beside, used) = (self.detour_beside(), self.used());
        let (t_us, x_nm) = (self.time_us, self.x_nm);
        Progress { first, rest, cost, beside, t_us, x_nm, used, runs: None }
    }

    /// Returns the rest of the current activity; `None` if it is whole.
    fn rest_of_current(&self) -> Option<Rest> {
        let detour_nm = self.detour_nm();
        if self.fresh && (detour_nm == 0 || !self.travels()) {
            None
        } else if self.travels() {
            let left_nm = self.end_nm().saturating_sub(self.x_nm).saturating_add(detour_nm);
            Some(Rest::Travel(Millimetres(left_nm.div_ceil(NM_PER_MM))))
        } else {
            let left_ms = mul_div_half_up(self.standing_us, 1, 1000).unwrap_or(u64::MAX);
            Some(Rest::Time(Millis(left_ms)))
        }
    }

    /// The planned cost of the rest of the current activity, from the very place of the robot.
    fn cost_of_current(&self) -> [u64; 2] {
        let alternative = &self.leg.alternative;
        let duration = if self.travels() {
            // nm over mm/s is µs; half up to ms.
            mul_div_half_up(
                self.end_nm().saturating_sub(self.x_nm).saturating_add(self.detour_nm()),
                1,
                alternative.speed.0.saturating_mul(1000),
            )
        } else {
            mul_div_half_up(self.standing_us, 1, 1000)
        };
        let duration = duration.unwrap_or(MAX_AMOUNT);
        let energy = Millijoules::spent(alternative.power, Millis(duration));
        [duration, energy.map_or(MAX_AMOUNT, |it| it.0)]
    }

    /// The robot stops, and the mission is aborted: safely, if it is within its limits.
    fn stop<R: Recorder>(&mut self, cause: PlanCause, reason: Reason, recorder: &mut R) {
        self.release(recorder);
        if R::WANTED {
            recorder.record(self.abort_record(cause, reason));
        }
        self.ended = Some(match self.exceeded(false) {
            Some(exceeded) => (Outcome::Failed, Some(exceeded)),
            None => (Outcome::Safe, Some(reason)),
        });
    }
}
