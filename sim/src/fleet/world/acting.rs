//! Actions of hands: whether the skills that they use work, and what becomes of it where one does
//! not.

use super::World;
use super::robot::Duty;
use crate::fleet::record::{Record, SkillUses};
use crate::fleet::skills::FailedUse;
use cotama_models::team::scenario::{Give, Stage};
use cotama_models::team::{ErrorClass, MOST_REPEATS, classify};

impl World<'_> {
    /// Whether what a robot takes or gives by itself is taken or given, now that the time of it is
    /// over: each skill of the action is used once. Where one fails it is dealt with.
    pub(super) fn acts(&mut self, robot: usize) -> bool {
        let agent = &self.robots[robot];
        let Duty::Executing(work) = &agent.duty else { return true };
        let role = self.role(work);
        let nothing = match agent.stage {
            Stage::Takes => agent.holds == Some(work.award.id.task),
            Stage::Gives => role.give == Give::Nobody,
            _ => true,
        };
        if nothing || work.acted {
            return true;
        }
        match self.uses_skills(robot) {
            Ok(()) => {
                if let Some(work) = self.robots[robot].work_mut() {
                    work.acted = true;
                }
                true
            }
            Err(failed) => {
                self.action_failed(robot, failed);
                false
            }
        }
    }

    /// Whether both partners of an exchange have worked; where one has not, it is dealt with.
    pub(super) fn exchange_works(&mut self, giver: usize, taker: usize) -> bool {
        for robot in [giver, taker] {
            if let Err(failed) = self.uses_skills(robot) {
                for it in [giver, taker] {
                    self.robots[it].stage_since = self.now;
                }
                self.action_failed(robot, failed);
                for it in [giver, taker] {
                    self.wake(it);
                }
                return false;
            }
        }
        true
    }

    fn uses_skills(&mut self, robot: usize) -> Result<(), FailedUse> {
        let scenario = self.scenario;
        let agent = &mut self.robots[robot];
        let Duty::Executing(work) = &agent.duty else { return Ok(()) };
        let plan = &scenario.tasks[work.award.id.task].plans[work.award.plan];
        agent.skills.act(plan.roles[work.role].by_hand(agent.stage))
    }

    /// The action is tried again while the robot keeps its pledge, else the task is given back.
    fn action_failed(&mut self, robot: usize, failed: FailedUse) {
        let (now, agent) = (self.now, &mut self.robots[robot]);
        agent.stage_since = now;
        let stage = agent.stage;
        let Some(work) = agent.work_mut() else { return };
        let (pledge, task, before) = (work.pledge(), work.award.id.task, work.failures);
        work.failures += 1;
        self.run.failed_uses += 1;
        let skill = self.scenario.skills.get(usize::from(failed.capability.number()));
        let skill = skill.cloned().unwrap_or_default();
        let (number, reliability) = (failed.number, failed.reliability.parts());
        let name = skill.clone();
        self.note(|t_ms| Record::Failed { t_ms, robot, task, skill: name, number, reliability });
        let estimate = self.estimate(robot);
        let others = self.others_can(task);
        let class = classify(estimate, pledge, others, before, MOST_REPEATS);
        if class == ErrorClass::Recoverable {
            let why = format!("{skill} fails, and tries again");
            self.note(|t_ms| Record::Error { t_ms, robot, task, class, why });
            self.enter(robot, stage);
            self.wake(robot);
        } else {
            self.give_back(robot, class, &format!("{skill} fails"));
        }
    }

    /// The uses of skills that may fail or are counted, at the end of a run.
    pub(super) fn skill_uses(&self) -> Vec<SkillUses> {
        let all = self.robots.iter().enumerate().flat_map(|(robot, agent)| {
            agent.skills.used().filter(|it| it.1 > 0).map(move |it| (robot, it))
        });
        let name = |it: u8| self.scenario.skills.get(usize::from(it)).cloned().unwrap_or_default();
        let row = |(robot, (capability, uses, failed, reliability)): (usize, (_, _, _, _))| {
            let capability: cotama_models::team::Capability = capability;
            let reliability: cotama_models::team::Probability = reliability;
            let (skill, reliability) = (name(capability.number()), reliability.parts());
            SkillUses { robot, skill, uses, failed, reliability }
        };
        all.map(row).collect()
    }
}
