//! Periods in which nothing happens: how long they last, and how they are passed over.

use super::{Body, Decider, PATIENCE, PATIENCE_WITH_PLANNER};
use crate::cotama::supervisors::local;
use cotama_core::player::Program;
use cotama_core::units::Millis;

impl<P: Program<W, C, S>, const W: usize, const C: usize, const S: usize> Decider<P, W, C, S> {
    /// Until when nothing comes of periods in which nothing is raised or lowered, nothing is said
    /// and no margin falls below zero: none where something may come of the next one. Who simulates
    /// such periods may pass over those that begin before, and says so by [`idle`](Self::idle).
    pub fn idle_until(&self) -> Option<Millis> {
        use local::State::{HandOver, Planning, Teleoperated, Teleprogrammed};
        let settled = self.settings.stay(self.now, self.up) && self.returns.is_none();
        if !settled || !self.untold.is_empty() || self.global.0 > self.objectives {
            return None;
        }
        Some(Millis(match self.situation.local {
            Planning => self.since.0.saturating_add(PATIENCE_WITH_PLANNER.0),
            HandOver | Teleprogrammed | Teleoperated => {
                self.since.0.max(self.stands_since.0).saturating_add(PATIENCE.0)
            }
            _ => u64::MAX,
        }))
    }

    /// Periods up to the one that began now were passed over: see [`idle_until`](Self::idle_until).
    pub fn idle(&mut self, now: Millis, body: Body) {
        self.now = now;
        self.settings.see(now, self.up);
        if !body.stands {
            self.stands_since = now;
        }
    }
}
