//! The result of a supervised run, in the terms of every run.

use super::Run;
use crate::run::{EventCounts, LONGEST, Outcome, Reason};
use cotama_models::missions::Mission;

/// A power of ten: pJ of a mJ.
const PJ_PER_MJ: u128 = 1_000_000_000;

impl Run {
    /// Plans, margins and amounts as of a run without supervisors. Margins were not checked under
    /// way, and what happened is in [`conduct`](Self::conduct): both are counted as none. `mission`
    /// must be the mission that was run.
    pub fn summary(&self, mission: &Mission) -> crate::run::Run {
        let limits = mission.scenario().limits;
        let left = |axis: usize| {
            let left = i128::from(limits[axis]) - i128::from(self.used[axis]);
            i64::try_from(left).unwrap_or(i64::MIN)
        };
        crate::run::Run {
            outcome: self.outcome,
            reason: self.reason(limits),
            plans: self.plans.clone(),
            replans: self.plans.len().saturating_sub(1) as u64,
            operator_requests: self.operator_requests,
            margins: [left(0), left(1)],
            used: self.used,
            time_us: self.time.0.saturating_mul(1000),
            energy_pj: u128::from(self.used[1]) * PJ_PER_MJ,
            x_mm: self.x.0,
            events: EventCounts::default(),
            checks: 0,
        }
    }

    /// Why the mission is not completed.
    fn reason(&self, limits: [u64; 2]) -> Option<Reason> {
        let exceeded = (0..2).find(|&axis| self.used[axis] > limits[axis]);
        match self.outcome {
            Outcome::Completed => None,
            Outcome::Failed if self.time >= LONGEST => Some(Reason::TooLong),
            Outcome::Failed => exceeded
                .map(|axis| Reason::LimitExceeded { axis, by: self.used[axis] - limits[axis] }),
            Outcome::Safe => {
                let aborts =
                    |it: &&super::Fired| it.net == "gs" && it.transition.starts_with("abort");
                let Some(abort) = self.fired.iter().find(aborts) else {
                    return Some(Reason::Mindless);
                };
                let failure =
                    usize::from(abort.cause.0).checked_sub(1).and_then(|it| self.conduct.get(it));
                Some(Reason::GivenUp { failure: failure.map(|it| it.mode) })
            }
        }
    }
}
