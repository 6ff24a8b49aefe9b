//! Planning again: around what is lost, with what works again, and where a limit is in danger.

use super::World;
use super::records::Recording;
use crate::plan::Assessed;
use crate::record::Recorder;
use crate::robots::failing::mode;
use crate::run::PlanCause;
use cotama_core::hardware::Equipment;
use cotama_core::player::Program;
use cotama_models::level::Cause;
use cotama_models::robots::{Mode, Parts};
use cotama_models::severity::Severity;

impl<P: Program<W, 0, S>, const W: usize, const S: usize> World<'_, P, W, S> {
    /// Plans around what is known to be lost with a failure.
    pub(super) fn lose<R: Recorder>(&mut self, failure: usize, recording: &mut Recording<'_, R>) {
        let Some(row) = self.robot.failures.get(failure) else { return };
        let before = self.known;
        self.known = before.union(row.loses);
        self.known_rows.insert(failure);
        if self.known != before {
            self.record_status(recording);
        }
        // A fatal failure ends the mission: nothing is left to plan.
        let mode = mode(self.robot, self.place).unwrap_or(Mode::Autonomous);
        let is_fatal = row.severity(mode) == Severity::Fatal;
        if self.known == before || is_fatal || self.objective >= self.mission.objectives.len() {
            return;
        }
        // Hardware that the plan in force does not use changes it no more (Lambert et al. 2024,
        // 7.3.2).
        if !self.planning.needs_no_more(&self.progress(), self.units()) {
            let planned = self.plans(PlanCause::Failure(failure), recording);
            self.has_plan(planned, recording);
        }
    }

    /// Plans with what works again.
    pub(super) fn regain<R: Recorder>(&mut self, loss: usize, recording: &mut Recording<'_, R>) {
        let reports = self.robot.losses.reports.iter().filter(|it| it.loss == Some(loss));
        let rows: Vec<usize> = reports.flat_map(|it| it.failures.iter().copied()).collect();
        self.known_rows.retain(|it| !rows.contains(it));
        self.known = self
            .known_rows
            .iter()
            .filter_map(|it| self.robot.failures.get(*it))
            .fold(Parts::NONE, |all, it| all.union(it.loses));
        self.record_status(recording);
        // Only a plan that was made without it can be better with it.
        let was_without = self.planning.made.iter().any(|it| match it.cause {
            PlanCause::Failure(it) => rows.contains(&it),
            _ => false,
        });
        self.planning.hardware_returned();
        if !was_without || self.objective >= self.mission.objectives.len() {
            return;
        }
        // Without a plan the one in force goes on.
        if self.plans(PlanCause::Works(loss), recording) {
            self.planless = false;
        }
    }

    /// Plans again where the margins ask for it: one is below zero, or they leave room for a better
    /// plan. What is lost was planned around when it was told.
    pub(super) fn watch_margins<R: Recorder>(&mut self, recording: &mut Recording<'_, R>) {
        let (at, left) = (self.progress(), self.units());
        self.planning.reach(&at);
        if !self.drives() {
            return;
        }
        match self.planning.assess(&at, left, None) {
            Assessed::Keeps => {}
            Assessed::Planned => {
                self.is_planned(left, recording);
                self.has_plan(true, recording);
            }
            Assessed::Fails(..) => self.has_plan(false, recording),
        }
    }

    /// Plans from here with what is not known to be lost; returns whether there is a plan.
    fn plans<R: Recorder>(&mut self, cause: PlanCause, recording: &mut Recording<'_, R>) -> bool {
        let (at, left) = (self.progress(), self.units());
        let planned = self.planning.plan(cause, &at, left).is_ok();
        if planned {
            self.is_planned(left, recording);
        }
        planned
    }

    /// A new plan is in force.
    fn is_planned<R: Recorder>(&mut self, left: Equipment, recording: &mut Recording<'_, R>) {
        self.run.planned_with_lost |= !self.planning.needs_no_more(&self.progress(), left);
        self.record_plan(recording);
    }

    /// The hardware that is not known to be lost.
    pub(super) fn units(&self) -> Equipment {
        let under = self.mission.under.as_ref();
        under.map_or(self.mission.available(), |it| it.units(self.mission, self.known))
    }

    /// Tells the supervisors once that no plan is left, where the robot's file has a row for it
    /// (Lambert et al. 2024, Section 7.2: who is asked then is not said; the row says it).
    fn has_plan<R: Recorder>(&mut self, planned: bool, recording: &mut Recording<'_, R>) {
        let was_told = std::mem::replace(&mut self.planless, !planned);
        let row = self.robot.failures.iter().position(|it| it.no_plan);
        let (false, false, Some(failure)) = (planned, was_told, row) else { return };
        self.begin(failure, None, recording);
        let begun = self.run.conduct.len();
        if let Some(it) = self.run.conduct.last_mut() {
            (it.detected, it.taken_for) = (Some(self.now), vec![failure]);
        }
        self.decider.report(failure, Cause(u16::try_from(begun).unwrap_or(u16::MAX)));
        self.record_diagnosis(recording, &[begun - 1], &[], &[failure]);
    }
}
