//! Speeds that follow from the hardware which works: with axes (Lambert et al. 2024, Section 6.1.4)
//! a robot that has lost its fastest detector avoids obstacles at lower speeds only.

use super::{Planning, Progress};
use cotama_core::hardware::Equipment;
use cotama_core::problem::Candidate;
use cotama_models::missions;
use cotama_models::missions::tables::{Activity, Alternative};

/// Alternatives of all activities with the speeds that some hardware allows.
#[derive(Clone, Debug)]
pub(super) struct Slowed {
    available: Equipment,
    all: missions::Slowed,
}

impl Slowed {
    /// Returns the hardware that works.
    pub(super) const fn available(&self) -> Equipment {
        self.available
    }

    /// Returns activities with these alternatives in place of their own.
    pub(super) fn activities<'a>(&'a self, own: &[Activity<'a>]) -> Vec<Activity<'a>> {
        let all = own.iter().zip(&self.all.alternatives);
        all.map(|(it, alternatives)| Activity { alternatives, ..*it }).collect()
    }
}

impl Planning<'_> {
    /// Derives the speeds anew that follow from the hardware which works.
    pub(super) fn slow_down(&mut self, available: Equipment) {
        let mission = self.of.mission;
        if available == mission.scenario().available {
            self.slowed = None;
        } else if self.slowed.as_ref().is_none_or(|it| it.available != available) {
            self.slowed = mission.slowed(available).map(|all| Slowed { available, all });
        }
    }

    /// Whether the hardware that works no longer allows a speed of the plan in force.
    pub(super) fn is_too_fast(&mut self, at: &Progress, available: Equipment) -> bool {
        let all = self.of.mission.scenario().available;
        if available == self.slowed.as_ref().map_or(all, |it| it.available) {
            return false;
        }
        let speeds = |of: &Self| -> Vec<_> {
            (at.first..of.choice.len()).map(|it| of.chosen(it).speed).collect()
        };
        let before = speeds(self);
        self.slow_down(available);
        speeds(self).iter().zip(before).any(|(now, before)| *now < before)
    }

    /// Returns the alternatives of an activity.
    pub(super) fn alternatives(&self, activity: usize) -> &[Alternative] {
        match &self.slowed {
            Some(it) => &it.all.alternatives[activity],
            None => self.of.activities[activity].alternatives,
        }
    }

    /// Returns the values of the alternatives of an activity, in a mission with axes.
    pub(super) fn derived(&self, activity: usize) -> &[cotama_axes::Candidate] {
        match &self.slowed {
            Some(it) => &it.all.derived[activity],
            None => &self.of.mission.scenario().activities[activity].derived,
        }
    }

    /// Returns an alternative as a candidate of the whole activity.
    pub(super) fn whole(&self, activity: usize, id: usize) -> Option<Candidate<2>> {
        if self.slowed.is_none() {
            return self.of.whole[activity].get(id).copied();
        }
        let it = self.alternatives(activity).get(id)?;
        it.candidate(self.of.activities[activity].whole(it), 0)
    }
}
