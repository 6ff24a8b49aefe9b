//! Ways that a robot drives beside those of its mission.

use super::{AT, Aside, Rover, milli};
use crate::follower::Follower;
use cotama_core::units::Millimetres;

impl Rover<'_> {
    /// Returns the way that is left to drive beside its path.
    pub fn owed(&self) -> Millimetres {
        let longer = self.detours.owed(self.x.0 as f64 / 1_000.0, self.along());
        let longer = if self.detours.is_none() { 0 } else { milli(longer) };
        Millimetres(self.owed.0 + longer)
    }

    /// Owes a way beside its path: it drives so much further before it is further along its
    /// mission, where [corridors](crate::corridors) are longer than that; elsewhere it turns back
    /// and comes again.
    pub fn owe(&mut self, way: Millimetres) {
        let (length, spare) = (self.course().track().length(), self.course().spare());
        let more = way.0 as f64 / 1_000.0;
        if self.detours.goal(length - spare) + more <= length + AT {
            self.detours.lengthen(self.x.0 as f64 / 1_000.0, self.along(), more);
        } else {
            self.owed.0 += way.0;
        }
    }

    /// Turns back for half of the way that is owed, as far as there is path behind it.
    pub(super) fn turn_back(&mut self) {
        let along = self.follower.along();
        let half = (self.owed.0 as f64 / 2_000.0).min(along);
        self.turned = along;
        let back = self.course().track().length() - along;
        self.aside = Aside::Back(back + half);
        let at = self.believed().translation.vector.into();
        self.follower = Follower::new(self.course().back().find(at, back - 0.1, back + 0.1).0);
    }

    pub(super) fn follow(&mut self, along: f64) {
        let at = self.believed().translation.vector.into();
        self.follower = Follower::new(self.course().track().find(at, along - 0.1, along + 0.1).0);
    }
}
