//! Words of a driver to its supervisors: of the mission, of the planner of paths, of time.

use super::Driver;
use crate::robots::failing::{mode, moves};
use crate::robots::operator::PATIENCE;
use cotama_models::robots::{Global, Mode, Told, Where};

impl Driver {
    /// Returns the word of the mission, of the planner of paths, or of time.
    pub(super) fn says(&mut self, now: u64, done: bool) -> Option<Told> {
        let stands = self.moving.drive.speed().0 == 0;
        match self.global {
            Global::Waits => self.wanted.then_some(Told::Begins),
            Global::Does(_) if self.is_driving() => self.drive_says(now),
            Global::Does(it) => done.then_some(Told::Over(it)),
            Global::Secures => stands.then_some(Told::Stopped),
            Global::Done | Global::Safe => None,
        }
    }

    fn drive_says(&mut self, now: u64) -> Option<Told> {
        let waited = now.saturating_sub(self.place_since);
        match self.place {
            Where::Rests => None,
            // Nobody answers in a team.
            Where::Waits => (waited > PATIENCE.0).then(|| {
                self.place_since = now;
                Told::GivesUp
            }),
            Where::Runs { sub_objective, configuration } => {
                let own = mode(self.robot(), self.place) == Some(Mode::Autonomous);
                let takes = self.robot().configurations.get(configuration);
                let takes = takes.map_or(0, |it| it.takes.0);
                let reached = if moves(self.robot(), self.place) {
                    self.moving.drive.x() >= self.leg() && self.moving.drive.speed().0 == 0
                } else {
                    waited >= takes
                };
                (own && reached).then_some(Told::Reached(sub_objective))
            }
        }
    }
}
