//! How the robot moves in a period, and what of it must never happen.

use super::objective::Objective;
use super::{CLOCKS, World};
use crate::body::{Demand, Failure, PERIOD, Planted};
use cotama_core::player::Program;
use cotama_core::units::{Millimetres, MillimetresPerSecond, Millis, Milliwatts};
use cotama_models::cotama::Modules;

impl<P: Program<W, CLOCKS, S>, const W: usize, const S: usize> World<'_, P, W, S> {
    /// The robot goes on for a period, whatever the mission is about: who holds a permit moves it.
    pub(super) fn travel(&mut self) {
        let (objective, before) = (self.objective(), self.robot.x());
        let activity = self.activity();
        let (pace, _) = self.planning.pace(activity, self.decider.situation().configuration());
        // Only who holds a permit may command motion.
        let command =
            self.decider.permit().map_or(MillimetresPerSecond(0), |_permit| self.speed(pace));
        let demand = Demand {
            speed: command,
            free: self.limited(pace),
            most: self.mission.robot.speed_max,
            halt: self.decider.requests().halt,
            end: self.end(),
            situation: self.decider.situation(),
        };
        let (mut towards, end) = self.robot.answer(self.now, &demand);
        let creeps = matches!(objective, Objective::Safe | Objective::Security)
            && self.planted.contains(&Planted::Creeps);
        if creeps {
            towards = MillimetresPerSecond(50);
        }
        self.robot.drive.go(towards, end, PERIOD);
        if matches!(objective, Objective::Stands(_) | Objective::Drives(_)) {
            self.drive_well(activity, self.robot.x().0 - before.0);
        }
        self.robot.draw(self.power(activity, self.robot.x() > before), PERIOD);
        self.run.moved_when_safe |= objective == Objective::Safe && self.robot.x() > before;
        self.measure(before);
    }

    /// Returns the power of the robot: that of its pace while it moves, or that of its task where
    /// it has one to stand for; else that of rest, with the hardware of its configuration on.
    pub(super) fn power(&self, activity: usize, moves: bool) -> Milliwatts {
        let configuration = self.decider.situation().configuration();
        let works = matches!(self.objective(), Objective::Stands(_));
        if moves || works || self.robot.moves() {
            self.planning.pace(activity, configuration).1
        } else {
            self.planning.rest_power(activity, configuration)
        }
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
                .max(Millimetres(self.robot.x().0 + self.robot.drive.braking_distance().0 + 1)),
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

    /// Measures the conditions that must never hold, or not for long; the period began here.
    fn measure(&mut self, before: Millimetres) {
        let moving = self.robot.moves();
        let required = self
            .decider
            .situation()
            .configuration()
            .map_or(Modules::NONE, |it| it.facts().required);
        let exposed = moving && !self.robot.broken().available().covers(required);
        self.exposed = if exposed { Millis(self.exposed.0 + PERIOD.0) } else { Millis(0) };
        self.run.exposed = self.run.exposed.max(self.exposed);
        if exposed {
            let breaks =
                |it: &Failure| !it.over && !it.mode.health(it.part).available().covers(required);
            let conducts = self.robot.failures.iter().zip(&mut self.run.conduct);
            for (_, it) in conducts.filter(|(it, _)| breaks(it)) {
                it.exposed.0 += PERIOD.0;
            }
        }
        let permitted = self.decider.permit().is_some();
        if self.permitted && !permitted {
            self.withdrawn = Some(before);
        }
        if (permitted || !self.robot.moves())
            && let Some(from) = self.withdrawn.take()
        {
            let way = Millimetres(self.robot.x().0 - from.0);
            self.run.braked = self.run.braked.max(way);
        }
        self.permitted = permitted;
    }
}
