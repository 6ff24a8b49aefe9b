//! Laws of a run under way, looked at after each event where assertions are on.

use super::World;
use super::robot::Duty;
use crate::fleet::bid::Whereabouts;
use crate::fleet::record::Fate;

impl World<'_> {
    /// Returns a law that does not hold now.
    pub(super) fn defect(&self) -> Option<&'static str> {
        let laws = [
            (self.counts_tasks(), "as many tasks are open as have neither been done nor reported"),
            (self.knows_holders(), "an object is on board of the robot that holds it"),
            (self.works_once(), "a role of an award is executed by one robot, a member"),
            (self.goes_forward(), "a stage and a role have begun before now"),
        ];
        laws.into_iter().find(|it| !it.0).map(|it| it.1)
    }

    fn counts_tasks(&self) -> bool {
        self.run.fates.iter().filter(|it| **it == Fate::Open).count() == self.open
    }

    fn knows_holders(&self) -> bool {
        let held = self.objects.iter().enumerate().all(|(task, it)| match it.at {
            Whereabouts::Held(robot) => self.robots[robot].holds == Some(task),
            Whereabouts::Lies(_) | Whereabouts::Delivered => true,
        });
        let holds = self.robots.iter().enumerate().all(|(robot, it)| {
            it.holds.is_none_or(|task| self.objects[task].at == Whereabouts::Held(robot))
        });
        held && holds
    }

    fn works_once(&self) -> bool {
        let works = |robot: usize| match &self.robots[robot].duty {
            Duty::Executing(work) => Some((work.award.id, work.role)),
            Duty::Free | Duty::Waiting(_) => None,
        };
        (0..self.robots.len()).all(|robot| {
            let Some(work) = self.robots[robot].work() else { return true };
            let is_member = work.award.robots.get(work.role) == Some(&robot);
            let alone = works(robot).is_none_or(|it| {
                (0..robot).all(|other| works(other).is_none_or(|that| that != it))
            });
            is_member && alone
        })
    }

    fn goes_forward(&self) -> bool {
        let now = self.now;
        let is_past = |it: &super::Agent| {
            it.stage_since <= now && it.work().is_none_or(|work| work.since <= now)
        };
        self.robots.iter().all(is_past)
    }
}
