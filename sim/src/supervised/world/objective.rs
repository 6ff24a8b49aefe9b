//! The present objective of the mission, and the progress in it.

use super::{CLOCKS, World};
use crate::plan::Progress;
use cotama_core::player::Program;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::missions::tables::Rest;

/// The present objective of the global supervisor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Objective {
    /// The mission has not been given yet.
    Waits,
    /// The robot drives: the number of the objective.
    Drives(usize),
    /// The robot stands: the number of the objective.
    Stands(usize),
    /// The mission is accomplished.
    Done,
    /// The robot is to stop.
    Security,
    /// The robot has stopped for good.
    Safe,
}

impl<P: Program<W, CLOCKS, S>, const W: usize, const S: usize> World<'_, P, W, S> {
    /// Returns the present objective. The places of the global supervisor are: waiting, the
    /// objectives, done, security, safe.
    pub(super) fn objective(&self) -> Objective {
        let (place, count) = (self.decider.global().0 as usize, self.mission.objectives.len());
        match place.checked_sub(1) {
            None => Objective::Waits,
            Some(it) if it < count && self.mission.objectives[it].travels() => {
                Objective::Drives(it)
            }
            Some(it) if it < count => Objective::Stands(it),
            Some(it) if it == count => Objective::Done,
            Some(it) if it == count + 1 => Objective::Security,
            Some(_) => Objective::Safe,
        }
    }

    /// How far the mission has come.
    pub(super) fn progress(&self) -> Progress {
        let x_mm = self.robot.x().0;
        let (activity, rest) = match self.objective() {
            Objective::Waits => (0, None),
            Objective::Drives(it) => {
                let activity = self.planning.activity(it, x_mm);
                let end = self.mission.scenario().activities[activity].x_end;
                let left = Millimetres(end.0.saturating_sub(x_mm).max(1));
                (activity, Some(Rest::Travel(left)))
            }
            Objective::Stands(it) => {
                let activity = self.planning.activity(it, x_mm);
                let done = self.now.0.saturating_sub(self.global_since.0);
                let left = self.planning.standing(activity).0.saturating_sub(done);
                (activity, Some(Rest::Time(Millis(left))))
            }
            _ => (self.mission.scenario().activities.len(), None),
        };
        Progress { activity, rest, now: self.now, x_mm, used: self.used() }
    }
}
