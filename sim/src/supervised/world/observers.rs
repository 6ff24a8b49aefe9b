//! The flags that observers raise, and the diagnoses of the decisional level.

use super::units;
use super::{CLOCKS, World};
use crate::body::{Observed, Planted, Seen};
use crate::plan::{Planning, Progress};
use crate::run::{Part, PlanCause};
use cotama_core::player::Program;
use cotama_models::cotama::{
    Class, Configuration, FailureMode, Finding, Module, Modules, NoPlanLeft, Plans, Why,
};
use cotama_models::missions::Mission;

impl<P: Program<W, CLOCKS, S>, const W: usize, const S: usize> World<'_, P, W, S> {
    /// Observers look; the decisional level diagnoses what they and the scheduler newly see.
    pub(super) fn observe(&mut self, scheduler: Seen) {
        let Observed { perceived, seen, cause } = self.robot.observe(scheduler, &self.watch_of());
        self.calm &= perceived.raised.is_empty() && perceived.lowered.is_empty();
        let at = self.progress();
        let mut rest = Rest {
            drives: matches!(self.objective(), super::Objective::Drives(_)),
            mission: self.mission,
            planning: &mut self.planning,
            at,
            with_lost: self.planted.contains(&Planted::PlansWithLost),
            planned_with_lost: &mut self.run.planned_with_lost,
        };
        if let Some(finding) = self.decider.perceive(self.now, perceived, &mut rest) {
            self.note_finding(&finding, &seen, cause);
        }
    }

    /// Notes what these failures were taken for.
    pub(super) fn note_finding(
        &mut self,
        finding: &Finding,
        failures: &[usize],
        cause: Option<usize>,
    ) {
        self.causes.push(cause.map_or(0, |it| it as u16 + 1));
        self.robot.are_found(failures);
        for &number in failures {
            let conduct = &mut self.run.conduct[number];
            conduct.detected = Some((self.now, finding.diagnosis));
            conduct.flags = finding.flags;
            conduct.judged = finding.judged;
        }
        if let (true, Some(&first)) = (finding.recorded, failures.first()) {
            self.run.conduct[first].decided = Some((self.now, Class::Record));
        }
    }

    /// The operator's silence, if that is a failure under way.
    pub(super) fn silence(&self) -> Option<usize> {
        self.robot.failures.iter().position(|it| it.mode == FailureMode::Opr1)
    }
}

/// The rest of the mission, planned by PANORAMA.
struct Rest<'w, 'm> {
    mission: &'m Mission,
    planning: &'w mut Planning<'m, Configuration>,
    at: Progress,
    drives: bool,
    /// A defect that was planted.
    with_lost: bool,
    planned_with_lost: &'w mut bool,
}

impl Plans for Rest<'_, '_> {
    fn is_over(&self) -> bool {
        self.at.activity >= self.mission.scenario().activities.len()
    }

    fn plan(&mut self, why: Why, available: Modules) -> Result<bool, NoPlanLeft> {
        // Modules that the mission does not plan with change no plan.
        let plans_with =
            |it: &Module| self.mission.hardware.iter().any(|kind| kind.name == it.name());
        let part = |modules: Modules, broken| {
            let first = modules.iter().find(plans_with)?;
            Some(Part::of(broken).unwrap_or(Part::Module(first)))
        };
        let cause = match why {
            Why::Margin(axis) => Some(PlanCause::Margin { axis }),
            Why::Lost { modules, broken } => part(modules, broken).map(PlanCause::Lost),
            Why::Returned { modules, broken } => part(modules, broken).map(PlanCause::Back),
        };
        let Some(cause) = cause else { return Ok(false) };
        // Hardware that the plan in force does not use changes it no more (Lambert et al. 2024,
        // 7.3.2).
        let is_lost = matches!(cause, PlanCause::Lost(_));
        let left = units(self.mission, available);
        if is_lost && self.planning.needs_no_more(self.at, left) {
            return Ok(true);
        }
        let used = if self.with_lost { units(self.mission, Modules::ALL) } else { left };
        let planned = self.planning.plan(cause, self.at, used);
        *self.planned_with_lost |= planned.is_ok() && !self.planning.needs_no_more(self.at, left);
        planned.map(|()| true).map_err(|_| NoPlanLeft)
    }

    fn configuration(&self) -> Option<Configuration> {
        self.planning.next_drive(self.at.activity)
    }

    fn short(&self) -> Option<usize> {
        if self.drives { self.planning.short(self.at) } else { None }
    }
}
