//! How the robot moves in a period, and what of it must never happen.

use super::objective::Objective;
use super::{CLOCKS, FIRMWARE_WATCHDOG, Failure, PERIOD, World};
use crate::supervised::Planted;
use crate::supervised::effect::{Motion, observable};
use cotama_core::player::Program;
use cotama_core::units::{Millimetres, MillimetresPerSecond, Millis};
use cotama_models::cotama::{Modules, local};

impl<P: Program<W, CLOCKS, S>, const W: usize, const S: usize> World<'_, P, W, S> {
    /// The robot goes on for a period, whatever the mission is about: who holds a permit moves it.
    pub(super) fn travel(&mut self) {
        let (objective, before) = (self.objective(), self.robot.x());
        let activity = self.activity();
        let (pace, power) = self.planning.pace(activity, self.decider.situation().configuration());
        // Only who holds a permit may command motion.
        let command =
            self.decider.permit().map_or(MillimetresPerSecond(0), |_permit| self.speed(pace));
        let free = self.limited(pace);
        let mut towards = command;
        let mut blocked = false;
        for failure in self.failures.iter().filter(|it| !it.over) {
            match failure.motion() {
                Motion::Blocked => {
                    blocked |= observable(failure.mode, self.decider.situation(), true);
                }
                // What is asked of it is more, or already less.
                Motion::Slowed(parts) => {
                    towards = towards.min(MillimetresPerSecond(free.0 * u64::from(parts) / 1000));
                }
                Motion::Runaway if !self.decider.requests().halt => {
                    towards = self.mission.robot.speed_max;
                }
                Motion::Silent | Motion::Mindless
                    if self.now.0 >= failure.since.0 + FIRMWARE_WATCHDOG.0 =>
                {
                    towards = MillimetresPerSecond(0);
                }
                Motion::Free | Motion::Runaway | Motion::Silent | Motion::Mindless => {}
                Motion::Dead => {
                    self.robot.stand();
                    towards = MillimetresPerSecond(0);
                }
            }
        }
        let end = if blocked && self.decider.situation().local != local::State::Teleoperated {
            self.robot.x()
        } else {
            self.end()
        };
        let creeps = matches!(objective, Objective::Safe | Objective::Security)
            && self.planted.contains(&Planted::Creeps);
        if creeps {
            towards = MillimetresPerSecond(50);
        }
        self.robot.go(towards, end, PERIOD);
        if matches!(objective, Objective::Stands(_) | Objective::Drives(_)) {
            self.drive_well(activity, self.robot.x().0 - before.0);
            self.energy_uj += power.0 * PERIOD.0;
        }
        self.run.moved_when_safe |= objective == Objective::Safe && self.robot.x() > before;
        self.measure(before);
    }

    /// So much of the path was driven.
    pub(super) fn drive_well(&mut self, activity: usize, way_mm: u64) {
        let quality = self.planning.quality(activity, self.decider.situation().configuration());
        let adjusted = self.decider.requests().adjusted;
        self.quality += way_mm * u64::from(quality) * u64::from(adjusted.quality);
    }

    /// The end of the drive, or where the robot stands.
    pub(super) fn end(&self) -> Millimetres {
        match self.objective() {
            Objective::Drives(it) => self.mission.objectives[it].x_end,
            _ => self
                .robot
                .x()
                .max(Millimetres(self.robot.x().0 + self.robot.braking_distance().0 + 1)),
        }
    }

    /// How fast the running configuration goes, as it is adjusted.
    fn speed(&self, pace: MillimetresPerSecond) -> MillimetresPerSecond {
        let adjusted = self.decider.requests().adjusted;
        MillimetresPerSecond(self.limited(pace).0 * u64::from(adjusted.speed) / 1000)
    }

    /// How fast it could go.
    fn limited(&self, pace: MillimetresPerSecond) -> MillimetresPerSecond {
        let limit = self
            .decider
            .situation()
            .configuration()
            .map_or(MillimetresPerSecond(0), |it| it.facts().speed);
        pace.min(limit)
    }

    /// What must never happen, or not for long; the period began here.
    fn measure(&mut self, before: Millimetres) {
        let moving = self.robot.speed().0 > 0;
        let required = self
            .decider
            .situation()
            .configuration()
            .map_or(Modules::NONE, |it| it.facts().required);
        let exposed = moving && !self.broken().available().covers(required);
        self.exposed = if exposed { Millis(self.exposed.0 + PERIOD.0) } else { Millis(0) };
        self.run.exposed = self.run.exposed.max(self.exposed);
        if exposed {
            let breaks =
                |it: &Failure| !it.over && !it.mode.health(it.part).available().covers(required);
            let conducts = self.failures.iter().zip(&mut self.run.conduct);
            for (_, it) in conducts.filter(|(it, _)| breaks(it)) {
                it.exposed.0 += PERIOD.0;
            }
        }
        let permitted = self.decider.permit().is_some();
        if self.permitted && !permitted {
            self.withdrawn = Some(before);
        }
        if (permitted || self.robot.speed().0 == 0)
            && let Some(from) = self.withdrawn.take()
        {
            let way = Millimetres(self.robot.x().0 - from.0);
            self.run.braked = self.run.braked.max(way);
        }
        self.permitted = permitted;
    }
}
