//! How the plan and the supervisors adapt to what is lost or used up.

use super::{Cause, Decider};
use crate::cotama::decisions::{Loss, Losses};
use crate::cotama::level::Told;
use crate::cotama::modules::{Configuration, Health, Modules};
use crate::cotama::supervisors::faults;
use cotama_core::player::Program;

/// Why a plan is needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// Modules are lost, because this broke.
    Lost {
        /// The modules.
        modules: Modules,
        /// The parts diagnosed to be broken.
        broken: Health,
    },
    /// Modules have returned, because this is sound again.
    Returned {
        /// The modules.
        modules: Modules,
        /// The parts that were broken.
        broken: Health,
    },
    /// The margin of this axis is below zero.
    Margin(usize),
}

/// There is no plan within the limits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoPlanLeft;

/// The plan of the mission, made by an allocator of `cotama-core`: which configuration each drive
/// uses, within what is left of the limits (Lambert et al. 2024, Section 7.2).
pub trait Plans {
    /// Whether nothing is left to be planned.
    fn is_over(&self) -> bool;

    /// Plans what is left with these modules, unless the plan in force uses nothing that was lost;
    /// whether it had to be looked at.
    ///
    /// # Errors
    /// When no plan is left that keeps the limits; the plan in force stays.
    fn plan(&mut self, why: Why, available: Modules) -> Result<bool, NoPlanLeft>;

    /// The configuration that is planned for the drive under way, or the next one.
    fn configuration(&self) -> Option<Configuration>;

    /// The axis on which the drive under way no longer keeps its limit.
    fn short(&self) -> Option<usize>;
}

/// A mission without limits, in which each drive uses the best that works.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoPlans;

impl Plans for NoPlans {
    fn is_over(&self) -> bool {
        false
    }

    fn plan(&mut self, _: Why, _: Modules) -> Result<bool, NoPlanLeft> {
        Ok(false)
    }

    fn configuration(&self) -> Option<Configuration> {
        None
    }

    fn short(&self) -> Option<usize> {
        None
    }
}

impl<P: Program<W, C, S>, const W: usize, const C: usize, const S: usize> Decider<P, W, C, S> {
    /// Plans again when a margin is below zero, and asks the operator when there is no such plan.
    pub(super) fn watch_margins(&mut self, plans: &mut impl Plans) {
        if self.resigned {
            return;
        }
        let Some(axis) = plans.short() else { return };
        if plans.plan(Why::Margin(axis), self.known.relied_on).is_ok() {
            self.do_without(plans.configuration(), Cause(0));
        } else {
            self.resigned = true;
            self.untold.push(Told::Failure(faults::Event::fail_hard), Cause(0));
        }
    }

    /// Plans the rest of the mission without these modules.
    pub(super) fn plan_without(
        &mut self,
        modules: Modules,
        broken: Health,
        cause: Cause,
        plans: &mut impl Plans,
    ) -> Result<(), NoPlanLeft> {
        if self.lost.has(Loss::Vital) || plans.is_over() {
            return Ok(());
        }
        if plans.plan(Why::Lost { modules, broken }, self.known.relied_on)? {
            self.do_without(plans.configuration(), cause);
        }
        Ok(())
    }

    /// The supervisors learn of losses.
    pub(super) fn lose(&mut self, lost: Losses, cause: Cause) {
        let new = lost.without(self.lost);
        self.lost = self.lost.union(new);
        // The most severe first; without vital parts nothing else matters.
        if new.has(Loss::Vital) {
            self.untold.push(Told::lost(Loss::Vital, self.known.health), cause);
            return;
        }
        for &it in Loss::ALL.iter().rev().filter(|it| new.has(**it)) {
            self.untold.push(Told::lost(it, self.known.health), cause);
        }
    }

    /// Withdraws the modules that the plan leaves unused, so that the adapter comes to the
    /// configuration that is planned.
    pub(super) fn do_without(&mut self, planned: Option<Configuration>, cause: Cause) {
        self.lose(self.unused(planned), cause);
    }

    /// Returns the losses that a planned configuration chooses, beside those that exist anyway.
    pub(super) fn unused(&self, planned: Option<Configuration>) -> Losses {
        let lacking = Losses::lacking(self.known.relied_on);
        planned.map_or(Losses::NONE, |it| lacking.beside(it))
    }
}
