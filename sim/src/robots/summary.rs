//! The result of a run of a robot, in the terms of every run.

use super::Run;
use crate::run::{EventCounts, LONGEST, Outcome, Reason};
use cotama_models::missions::Mission;

/// A power of ten: pJ of a mJ.
const PJ_PER_MJ: u128 = 1_000_000_000;

impl Run {
    /// Plans, margins and amounts as of every run. `mission` must be the mission that was run.
    pub fn summary(&self, mission: &Mission) -> crate::run::Run {
        let limits = mission.scenario().limits;
        let signed = |it: u64| i64::try_from(it).unwrap_or(i64::MAX);
        crate::run::Run {
            outcome: self.outcome,
            reason: self.reason(limits),
            plans: self.plans.clone(),
            replans: self.plans.len().saturating_sub(1) as u64,
            operator_requests: self.operator_requests,
            margins: std::array::from_fn(|axis| signed(limits[axis]) - signed(self.used[axis])),
            used: self.used,
            time_us: self.time.0.saturating_mul(1_000),
            energy_pj: u128::from(self.used[1]) * PJ_PER_MJ,
            x_mm: self.x.0,
            events: EventCounts::default(),
            checks: 0,
            spent: self.spent.clone(),
        }
    }

    /// Why the mission is not completed.
    fn reason(&self, limits: [u64; 2]) -> Option<Reason> {
        let exceeded = (0..2).find(|&axis| self.used[axis] > limits[axis]);
        match self.outcome {
            Outcome::Completed => None,
            Outcome::Failed if self.touched.is_some() => Some(Reason::Touched),
            Outcome::Failed if self.time >= LONGEST => Some(Reason::TooLong),
            Outcome::Failed => exceeded
                .map(|axis| Reason::LimitExceeded { axis, by: self.used[axis] - limits[axis] })
                .or_else(|| self.missed.map(|(end, by)| Reason::EndMissed { end, by })),
            Outcome::Safe => Some(match self.blocked {
                Some((drive, door)) => Reason::Blocked { drive, door },
                None => self.ended(),
            }),
        }
    }

    fn ended(&self) -> Reason {
        let ended = self.configurations.last().is_some_and(|it| it.1.is_none());
        match self.ended_by.and_then(|it| self.conduct.get(it)) {
            Some(it) => Reason::EndedBy { failure: it.failure },
            None if ended => Reason::GivenUp,
            None => Reason::Mindless,
        }
    }
}
