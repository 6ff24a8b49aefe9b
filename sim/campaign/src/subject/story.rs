//! Faults of teams and of robots in words.

use super::{Robot, Subject};
use cotama_core::units::Millis;
use cotama_models::robots::{Moment, RobotFile};
use cotama_models::team::scenario::{self, FaultKind, FaultTime, Row};
use cotama_sim::robots;

impl Subject<'_> {
    /// Returns a fault of a team in words.
    pub(crate) fn story_of(&self, fault: &scenario::Fault) -> String {
        let Robot::Team(team, _) = &self.robot else { return String::new() };
        let robot = |it: usize| team.robots.get(it).map_or("?", |it| it.name.as_str());
        let words = |it: usize, row: Row| {
            team.robots.get(it).map_or_else(String::new, |it| row.words(it.file.robot()))
        };
        let task = |it: usize| team.tasks.get(it).map_or("?", |it| it.name.as_str());
        let when = match fault.when {
            FaultTime::At(at) => format!("at {}.{:03} s", at / 1_000, at % 1_000),
            FaultTime::During { robot: it, task: of, stage, after_ms, .. } => format!(
                "{after_ms} ms after {} came to `{}` of {}",
                robot(it),
                stage.name(),
                task(of)
            ),
        };
        match fault.what {
            FaultKind::Robot(it, row) => {
                format!("{when}, {} fails: {}", robot(it), words(it, row))
            }
            FaultKind::Auctioneer(row) => {
                format!("{when}, whoever gives tasks out fails: {}", words(0, row))
            }
            FaultKind::Shifted(it) => format!("{when}, the object of {} is shifted", task(it)),
            FaultKind::Turned(it, _) => format!("{when}, the object of {} is turned", task(it)),
        }
    }

    /// Returns a failure of a robot's file in words.
    pub(crate) fn story_of_failure(&self, it: &robots::Injection) -> String {
        let robot = self.mission().and_then(|it| it.robot()).map(RobotFile::robot);
        let row = robot.and_then(|robot| robot.failures.get(it.failure));
        let what = row.map_or_else(String::new, |it| format!("{} fails: {}", it.id, it.mode));
        let seconds = |it: Millis| format!("{}.{:03} s", it.0 / 1_000, it.0 % 1_000);
        let when = match it.when {
            Moment::Place(x) => format!("at {}.{} m", x.0 / 1_000, x.0 / 100 % 10),
            Moment::At(time) => format!("at {}", seconds(time)),
            Moment::During(part, after) => {
                let of = robot.and_then(|robot| robot.sub_objectives.get(part));
                let name = of.map_or("?", |it| it.name.as_str());
                format!("{} after {name} first starts", seconds(after))
            }
            Moment::Waiting(after) => {
                format!("{} after the operator is first asked", seconds(after))
            }
        };
        format!("{when}, {what}")
    }
}
