//! What observers raise, and what the decisional level makes of it.

use super::{CLOCKS, World};
use crate::run::PlanCause;
use crate::supervised::effect::observable;
use crate::supervised::plan::{Planning, Progress};
use crate::supervised::{Decided, PERIOD};
use cotama_core::player::Program;
use cotama_core::units::Millis;
use cotama_models::cotama::{
    Configuration, FailureMode, Finding, Flags, Modules, NoPlanLeft, Perceived, Plans, Why,
};
use cotama_models::missions::Mission;

impl<P: Program<W, CLOCKS, S>, const W: usize, const S: usize> World<'_, P, W, S> {
    /// Observers look; the decisional level diagnoses what they newly see.
    pub(super) fn observe(&mut self) {
        let seen = self.newly_seen();
        let flags = |number: &usize| self.failures[*number].mode.rule().signature.always;
        let raised = seen.iter().map(flags).fold(Flags::NONE, Flags::union);
        let part = seen.first().map_or(Modules::NONE, |&it| self.failures[it].part);
        let works = self.broken().available();
        let perceived = Perceived { raised, lowered: self.newly_lowered(), part, works };
        let at = self.progress();
        let mut rest = Rest {
            drives: matches!(self.objective(), super::Objective::Drives(_)),
            mission: self.mission,
            planning: &mut self.planning,
            at,
        };
        if let Some(finding) = self.decider.perceive(self.now, perceived, &mut rest) {
            self.note_finding(&finding, &seen);
        }
    }

    /// The failures that are seen from now on.
    fn newly_seen(&mut self) -> Vec<usize> {
        let (moving, situation) = (self.robot.speed().0 > 0, self.decider.situation());
        let mut seen = Vec::new();
        for (number, failure) in self.failures.iter_mut().enumerate() {
            let found = self.run.conduct[number].detected.is_some();
            if failure.over || found || !observable(failure.mode, situation, moving) {
                continue;
            }
            failure.seen.0 += PERIOD.0;
            if failure.seen >= Millis(u64::from(failure.mode.rule().latency_ms)) {
                seen.push(number);
            }
        }
        seen
    }

    /// The flags of failures that are over since they were seen, but for those that others hold.
    fn newly_lowered(&mut self) -> Flags {
        let (mut lowered, mut held) = (Flags::NONE, Flags::NONE);
        for (failure, conduct) in self.failures.iter_mut().zip(&self.run.conduct) {
            let flags = failure.mode.rule().signature.always;
            match (conduct.detected, failure.over) {
                (Some(_), false) => held = held.union(flags),
                (Some(_), true) if !failure.lowered => {
                    failure.lowered = true;
                    lowered = lowered.union(flags);
                }
                _ => {}
            }
        }
        lowered.without(held)
    }

    /// Notes what these failures were taken for.
    pub(super) fn note_finding(&mut self, finding: &Finding, failures: &[usize]) {
        let first = failures.first().map_or(0, |it| *it as u16 + 1);
        self.causes.push(first);
        for &number in failures {
            let conduct = &mut self.run.conduct[number];
            conduct.detected = Some((self.now, finding.diagnosis));
            conduct.flags = finding.flags;
            conduct.judged = finding.judged;
        }
        if let (true, Some(&first)) = (finding.recorded, failures.first()) {
            self.run.conduct[first].decided = Some((self.now, Decided::Record));
        }
    }

    /// The operator's silence, if that is a failure under way.
    pub(super) fn silence(&self) -> Option<usize> {
        self.failures.iter().position(|it| it.mode == FailureMode::Opr1)
    }
}

/// What is left of the mission, planned by PANORAMA.
struct Rest<'w, 'm> {
    mission: &'m Mission,
    planning: &'w mut Planning<'m>,
    at: Progress,
    drives: bool,
}

impl Plans for Rest<'_, '_> {
    fn is_over(&self) -> bool {
        self.at.activity >= self.mission.scenario().activities.len()
    }

    fn plan(&mut self, why: Why, available: Modules) -> Result<bool, NoPlanLeft> {
        let hardware = |of: Modules| {
            let names = of.iter().map(|it| it.name());
            { names }.find_map(|it| self.mission.hardware.iter().position(|kind| kind.name == it))
        };
        let cause = match why {
            Why::Margin(axis) => Some(PlanCause::Margin { axis }),
            Why::Lost(modules) => {
                hardware(modules).map(|hardware| PlanCause::Hardware { hardware, units: 1 })
            }
            Why::Returned(modules) => {
                hardware(modules).map(|hardware| PlanCause::Returned { hardware })
            }
        };
        let Some(cause) = cause else { return Ok(false) };
        let planned = self.planning.plan(cause, self.at, available);
        planned.map(|()| true).map_err(|_| NoPlanLeft)
    }

    fn configuration(&self) -> Option<Configuration> {
        self.planning.next_drive(self.at.activity)
    }

    fn short(&self) -> Option<usize> {
        if self.drives { self.planning.short(self.at) } else { None }
    }
}
