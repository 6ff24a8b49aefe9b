//! The checks of the margins, and what follows from them (rule 5 of the paper's algorithm).

use super::World;
use crate::record::Recorder;
use crate::run::{MAX_CHECKS, MAX_REPLANS, NoPlan, Outcome, PlanCause, Reason};
use cotama_core::hardware::Equipment;
use cotama_core::monitor::{self, MAX_AMOUNT, Request};
use cotama_core::units::{Millijoules, Millis, mul_div_half_up};
use cotama_models::missions::tables::{DURATION, ENERGY};

impl World<'_> {
    /// Compares consumption with the plan, and replans when it no longer holds.
    pub(super) fn check<R: Recorder>(&mut self, recorder: &mut R) {
        if self.checks >= MAX_CHECKS {
            let cause = self.plans.last().map_or(PlanCause::Start, |plan| plan.cause);
            self.stop(cause, Reason::TooManyChecks, recorder);
            return;
        }
        self.checks += 1;
        self.checked_us = Some(self.time_us);
        self.account();
        let (rest, needs) = self.remaining();
        let margins = self.margins(&rest);
        if R::WANTED {
            recorder.record(self.sample_record(margins));
        }
        let request = self.monitor.assess(&rest, needs, self.available);
        match request {
            Ok(Request::Keep) | Err(_) => {}
            Ok(_) if self.first_remaining() == self.choice.len() => {}
            Ok(Request::Up) => self.plan_upwards(&rest, margins, recorder),
            Ok(Request::Down(trigger)) => {
                let cause = match trigger {
                    monitor::Trigger::Margin { axis } => PlanCause::Margin { axis },
                    monitor::Trigger::Hardware => {
                        PlanCause::Hardware { hardware: self.lost.0, units: self.lost.1 }
                    }
                };
                if !self.simulation.adapts {
                    // A margin below zero is borne; lost hardware that is needed ends the mission.
                    if trigger == monitor::Trigger::Hardware {
                        let activity = self.first_remaining();
                        self.stop(cause, Reason::NoPlan(NoPlan::Emptied { activity }), recorder);
                    }
                } else if self.plans.len() as u64 > MAX_REPLANS {
                    self.stop(cause, Reason::TooManyReplans, recorder);
                } else if let Err(none) = self.plan(cause, Some(margins), recorder) {
                    self.stop(cause, Reason::NoPlan(none), recorder);
                }
            }
        }
    }

    /// Tells the monitor what was used.
    pub(super) fn account(&mut self) {
        let before = self.monitor.used();
        let used = self.used();
        // Both sides are at most MAX_AMOUNT, so this cannot be refused.
        let _ = self
            .monitor
            .spend(&std::array::from_fn(|axis| used[axis].saturating_sub(before[axis])));
    }

    /// Returns the amounts used, in ms and mJ, rounded half up; at most those that the monitor can
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

    pub(super) fn margins(&self, rest: &[u64; 2]) -> [i64; 2] {
        self.monitor.margins(rest).unwrap_or([i64::MIN; 2])
    }

    /// The first activity that is not done.
    pub(super) fn first_remaining(&self) -> usize {
        self.activity + usize::from(self.done)
    }

    /// The planned cost and the needs of what is left.
    fn remaining(&self) -> ([u64; 2], Equipment) {
        let first = self.first_remaining();
        let (later, needs) = self.rest[(self.activity + 1).min(self.choice.len())];
        if first > self.activity {
            return (later, needs);
        }
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
        let energy =
            Millijoules::spent(alternative.power, Millis(duration)).map_or(MAX_AMOUNT, |it| it.0);
        let beside = self.detour_beside();
        let mut cost = [0, 1].map(|axis| later[axis].saturating_add(beside[axis]));
        cost[DURATION] = cost[DURATION].saturating_add(duration);
        cost[ENERGY] = cost[ENERGY].saturating_add(energy);
        (cost, needs.union(alternative.needs))
    }

    /// The robot stops, and the mission is aborted: safely, if it is within its limits.
    fn stop<R: Recorder>(&mut self, cause: PlanCause, reason: Reason, recorder: &mut R) {
        self.release(recorder);
        if R::WANTED {
            recorder.record(self.abort_record(cause, reason));
        }
        self.account();
        self.ended = Some(match self.exceeded() {
            Some(exceeded) => (Outcome::Failed, Some(exceeded)),
            None => (Outcome::Safe, Some(reason)),
        });
    }
}
