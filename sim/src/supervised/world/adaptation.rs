//! How the plan and the supervisors adapt to what is lost or used up.

use super::objective::Objective;
use super::{CLOCKS, World};
use crate::run::{NoPlan, PlanCause};
use cotama_core::player::Program;
use cotama_models::cotama::{Cause, Loss, Losses, Module, Modules, Told, faults};

impl<P: Program<W, CLOCKS, S>, const W: usize, const S: usize> World<'_, P, W, S> {
    /// Compares what was used with the plan, once a second; plans again when a margin is below
    /// zero, and asks the operator when there is no such plan (Lambert et al. 2024, Section 5:
    /// performance margins).
    pub(super) fn watch_margins(&mut self) {
        let at = self.progress();
        if self.resigned
            || !self.now.0.is_multiple_of(1_000)
            || !matches!(self.objective(), Objective::Drives(_))
        {
            return;
        }
        let Some(axis) = self.planning.short(at) else { return };
        if self.planning.plan(PlanCause::Margin { axis }, at, self.known.relied_on()).is_ok() {
            self.do_without(Cause(0));
        } else {
            self.resigned = true;
            self.untold.push_back((Told::Failure(faults::Event::fail_hard), Cause(0)));
        }
    }

    /// The supervisors learn of losses.
    pub(super) fn lose(&mut self, lost: Losses, cause: Cause) {
        let new = lost.without(self.lost);
        self.lost = self.lost.union(new);
        // The most severe first; without vital parts nothing else matters.
        let mut new: Vec<Loss> = new.iter().collect();
        new.reverse();
        new.truncate(if new.first() == Some(&Loss::Vital) { 1 } else { new.len() });
        let known = self.known;
        self.untold.extend(new.into_iter().map(|it| (Told::lost(it, known), cause)));
    }

    /// Plans the rest of the mission with the modules that are left.
    pub(super) fn plan_again(&mut self, gone: Modules, cause: Cause) -> Result<(), NoPlan> {
        let at = self.progress();
        if self.lost.has(Loss::Vital) || at.activity >= self.mission.scenario().activities.len() {
            return Ok(()); // nothing is left to be planned
        }
        let named =
            |it: &Module| self.mission.hardware.iter().position(|kind| kind.name == it.name());
        let Some(hardware) = gone.iter().find_map(|it| named(&it)) else { return Ok(()) };
        self.planning.plan(
            PlanCause::Hardware { hardware, units: 1 },
            at,
            self.known.relied_on(),
        )?;
        self.do_without(cause);
        Ok(())
    }

    /// What the plan does without is withdrawn, so that the adapter comes to the configuration that
    /// is planned.
    pub(super) fn do_without(&mut self, cause: Cause) {
        self.lose(self.unused(), cause);
    }

    /// What the plan does without.
    pub(super) fn unused(&self) -> Losses {
        let at = self.progress();
        let drives = (at.activity..self.mission.scenario().activities.len())
            .find_map(|it| self.planning.configuration(it));
        let lacking = Losses::lacking(self.known.relied_on());
        drives.map_or(Losses::NONE, |planned| lacking.beside(planned))
    }
}
