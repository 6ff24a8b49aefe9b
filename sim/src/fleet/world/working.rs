//! Robots at work: stages of a task, what is taken and given, what goes wrong.

use super::robot::{Agent, Duty, Work};
use super::{Event, World};
use crate::fleet::bid::Whereabouts;
use crate::fleet::message::Status;
use crate::fleet::record::Record;
use cotama_models::team::ErrorClass;
use cotama_models::team::scenario::{FaultTime, Give, RoleSpec, Stage, Take, drive_ms};
use cotama_models::team::{MOST_REPEATS, classify};

impl World<'_> {
    /// Returns the role of a robot in its award.
    pub(super) fn role(&self, work: &Work) -> &RoleSpec {
        let id = work.award.id;
        &self.scenario.tasks[id.task].plans[work.award.plan].roles[work.role]
    }

    /// A robot begins its role.
    pub(super) fn execute(&mut self, robot: usize, work: Work) {
        let (task, round) = (work.award.id.task, work.award.id.round);
        let overlaps = self.workers(task).any(|it| it.1 != round);
        self.run.overlaps += u32::from(overlaps);
        let role = self.role(&work).clone();
        let places = self.places(robot, task, &role);
        self.robots[robot].duty = Duty::Executing(work);
        let floor = &self.scenario.floor;
        let legs = places.and_then(|[takes, gives]| {
            let first = floor.distance(self.robots[robot].spot, takes)?;
            Some(([takes, gives], [first, floor.distance(takes, gives)?]))
        });
        let Some((goals, legs)) = legs else {
            self.give_back(robot, ErrorClass::NonRecoverable, "there is nothing to take");
            return;
        };
        let (now, scenario, agent) = (self.now, self.scenario, &mut self.robots[robot]);
        agent.goals = goals;
        let drives = [(agent.spot, goals[0]), (goals[0], goals[1])];
        let ways = drives.map(|(from, to)| scenario.crowds_on(from, to));
        let holds = agent.passages.enter(&scenario.crowds, ways);
        agent.driver.begin(now, legs, holds);
        self.enter(robot, Stage::ToTake);
        self.wake(robot);
    }

    /// A round of the decisional component.
    pub(super) fn round(&mut self, robot: usize) {
        if self.robots[robot].next_round != Some(self.now) {
            return;
        }
        self.robots[robot].next_round = None;
        // A robot that has ended stays where that found it.
        if !self.robots[robot].driver.thinks() {
            return;
        }
        self.hand_over(robot);
        let done = self.hands_are_done(robot) && self.acts(robot);
        let now = self.now;
        let driven = self.robots[robot].driver.round(now, done);
        if let Some(mode) = driven.found
            && !self.robots[robot].found.contains(&mode)
        {
            self.robots[robot].found.push(mode);
            let name = self.mode(robot, mode);
            self.note(|t_ms| Record::Found { t_ms, robot, mode: name });
        }
        let (stage, before) = (self.robots[robot].driver.stage(), self.robots[robot].stage);
        if let Some(it) = driven.configuration
            && stage == before
            && matches!(stage, Stage::ToTake | Stage::ToGive)
            && driven.found.is_none()
        {
            self.note(|t_ms| Record::Configured { t_ms, robot, configuration: it.to_owned() });
        }
        if stage != before {
            self.arrive(robot, before, stage);
        }
        self.wake(robot);
    }

    /// A robot has come to another stage.
    fn arrive(&mut self, robot: usize, before: Stage, stage: Stage) {
        let agent = &mut self.robots[robot];
        match before {
            Stage::ToTake if stage == Stage::Takes => {
                agent.spot = agent.goals[0];
                agent.passages.is_through(0);
            }
            Stage::ToGive if stage == Stage::Gives => {
                agent.spot = agent.goals[1];
                agent.passages.is_through(1);
            }
            _ => {}
        }
        let Some(work) = self.robots[robot].work() else {
            self.on_its_own(robot, stage);
            return;
        };
        let (task, award) = (work.award.id.task, std::rc::Rc::clone(&work.award));
        let (take, give) = (self.role(work).take, self.role(work).give);
        match stage {
            Stage::Takes => {
                let other = match self.objects[task].at {
                    Whereabouts::Held(other) if other != robot => {
                        self.workers(task).any(|it| it.0 == other)
                    }
                    at => at == Whereabouts::Delivered,
                };
                self.enter(robot, stage);
                if take == Take::Object && other {
                    self.give_back(robot, ErrorClass::NonRecoverable, "there is nothing to take");
                }
            }
            Stage::ToGive => {
                if take == Take::Object {
                    self.take(robot, task);
                }
                self.enter(robot, stage);
            }
            Stage::Done => {
                match give {
                    Give::Goal => {
                        self.objects[task].at = Whereabouts::Delivered;
                        self.robots[robot].holds = None;
                        self.run.deliveries[task] += 1;
                    }
                    Give::Nobody => {
                        self.run.deliveries[task] += u32::from(work_is_first(&award, robot));
                    }
                    Give::Partner(_) => {}
                }
                self.leave(robot);
                self.say_final(robot, &award, Status::Completed);
            }
            Stage::Stops | Stage::Safe => {
                let class = self.class_of_loss(task);
                self.give_back(robot, class, "its supervisors make it safe");
            }
            _ => self.enter(robot, stage),
        }
    }

    /// The robot has the object on board from now on.
    fn take(&mut self, robot: usize, task: usize) {
        if let Whereabouts::Held(other) = self.objects[task].at {
            self.robots[other].holds = None;
        }
        self.objects[task].at = Whereabouts::Held(robot);
        self.robots[robot].holds = Some(task);
    }

    /// Notes a stage, and sets off the faults that wait for it.
    pub(super) fn enter(&mut self, robot: usize, stage: Stage) {
        let (now, agent) = (self.now, &mut self.robots[robot]);
        let same = agent.stage == stage;
        (agent.stage, agent.stage_since) = (stage, now);
        if let Some(work) = agent.work_mut().filter(|_| !same) {
            (work.acted, work.failures) = (false, 0);
        }
        let task = agent.work().map(|it| it.award.id.task);
        if !same || stage != Stage::Rests {
            self.note(|t_ms| Record::Stage { t_ms, robot, task, stage });
            self.note_spot(robot);
        }
        if let Some(task) = task {
            self.visit(robot, task, stage);
            self.stir_partners(robot);
        }
    }

    fn visit(&mut self, robot: usize, task: usize, stage: Stage) {
        let waits = |when: &FaultTime| match *when {
            FaultTime::During { robot: r, task: t, stage: s, time, after_ms }
                if (r, t, s) == (robot, task, stage) =>
            {
                Some((time, after_ms))
            }
            _ => None,
        };
        if !self.scenario.faults.iter().any(|it| waits(&it.when).is_some()) {
            return;
        }
        let known = self.visits.iter_mut().find(|it| (it.0, it.1, it.2) == (robot, task, stage));
        let count = if let Some(it) = known {
            it.3 += 1;
            it.3
        } else {
            self.visits.push((robot, task, stage, 1));
            1
        };
        for (number, fault) in self.scenario.faults.iter().enumerate() {
            if let Some((time, after)) = waits(&fault.when)
                && time == count
            {
                self.queue.push(self.now + after, 0, Event::Fault(number));
            }
        }
    }

    /// Partners who wait for somebody look again.
    fn stir_partners(&mut self, robot: usize) {
        let Some(work) = self.robots[robot].work() else { return };
        let others: Vec<usize> =
            work.award.robots.iter().copied().filter(|it| *it != robot).collect();
        for other in others {
            self.wake(other);
        }
    }

    /// The partner with whom the robot exchanges the object now: who gives, who takes, and since
    /// when both are there.
    fn exchange(&self, robot: usize) -> Option<(usize, usize, u64)> {
        let Duty::Executing(work) = &self.robots[robot].duty else { return None };
        let stage = self.robots[robot].stage;
        let role = self.role(work);
        let gives = stage == Stage::Gives && matches!(role.give, Give::Partner(_));
        let takes = stage == Stage::Takes && matches!(role.take, Take::Partner(_));
        let (giver, taker) = match (gives, takes) {
            (true, _) => (robot, *work.award.robots.get(work.role + 1)?),
            (_, true) => (*work.award.robots.get(work.role.checked_sub(1)?)?, robot),
            _ => return None,
        };
        let at = |it: usize, stage: Stage| {
            let agent = &self.robots[it];
            let same = agent.work().is_some_and(|it| it.award.id == work.award.id);
            let works = matches!(agent.duty, Duty::Executing(_));
            (same && works && agent.stage == stage).then_some(agent.stage_since)
        };
        let since = at(giver, Stage::Gives)?.max(at(taker, Stage::Takes)?);
        Some((giver, taker, since))
    }

    /// The object goes from partner to partner when both are there for long enough.
    fn hand_over(&mut self, robot: usize) {
        let Some((giver, taker, since)) = self.exchange(robot) else { return };
        let Some(work) = self.robots[giver].work() else { return };
        let (task, due) = (work.award.id.task, since + self.role(work).give_ms);
        if self.now < due || work.handed || !self.exchange_works(giver, taker) {
            return;
        }
        self.take(taker, task);
        for it in [giver, taker] {
            if let Some(work) = self.robots[it].work_mut() {
                work.handed = true;
            }
            self.wake(it);
        }
    }

    /// When what the robot takes or gives is taken or given; none while that is not known.
    fn hands(&self, robot: usize) -> Option<u64> {
        let agent = &self.robots[robot];
        let Duty::Executing(work) = &agent.duty else { return None };
        let (role, since) = (self.role(work), agent.stage_since);
        match agent.stage {
            Stage::Takes | Stage::Gives if work.handed && is_exchange(agent, role) => Some(since),
            Stage::Takes | Stage::Gives if is_exchange(agent, role) => {
                let (giver, _, since) = self.exchange(robot)?;
                let work = self.robots[giver].work()?;
                Some(since + self.role(work).give_ms)
            }
            Stage::Takes if agent.holds == Some(work.award.id.task) => Some(since),
            Stage::Takes => Some(since + role.take_ms),
            Stage::Gives => Some(since + role.give_ms),
            _ => None,
        }
    }

    fn hands_are_done(&self, robot: usize) -> bool {
        let agent = &self.robots[robot];
        let Duty::Executing(work) = &agent.duty else { return false };
        if is_exchange(agent, self.role(work)) {
            return work.handed;
        }
        self.hands(robot).is_some_and(|it| self.now >= it)
    }

    /// The next round of the decisional component is when something can happen.
    pub(super) fn wake(&mut self, robot: usize) {
        let period = self.robots[robot].driver.period();
        let soon = (self.now + 1).next_multiple_of(period);
        let hands = self.hands(robot).map(|it| it.next_multiple_of(period));
        let agent = &mut self.robots[robot];
        if !agent.driver.thinks() {
            return;
        }
        if hands.is_some_and(|it| it <= soon) {
            agent.driver.stir();
        }
        let next = agent.driver.next_round().into_iter().chain(hands).min();
        let Some(next) = next.map(|it| it.max(soon)) else { return };
        if agent.next_round.is_none_or(|it| next < it || it <= self.now) {
            agent.next_round = Some(next);
            // Robots go by their numbers at one moment: a round more shifts no draw.
            self.queue.push(next, 3 + robot as u8, Event::Round(robot));
        }
    }

    /// Gives the task back if it comes to cost more than was pledged.
    pub(super) fn breaks_its_pledge(&mut self, robot: usize) -> bool {
        let Duty::Executing(work) = &self.robots[robot].duty else { return false };
        let (pledge, task, repeats) = (work.pledge(), work.award.id.task, work.repeats);
        let estimate = self.estimate(robot);
        if estimate.is_some_and(|it| pledge.is_kept(it)) {
            return false;
        }
        let others = self.others_can(task);
        let class = classify(estimate, pledge, others, repeats, MOST_REPEATS);
        self.give_back(robot, class, "it takes longer than pledged");
        self.robots[robot].left.push(task);
        true
    }

    /// Returns the expected cost of the role under way, with the time spent, in ms.
    pub(super) fn estimate(&self, robot: usize) -> Option<u64> {
        let agent = &self.robots[robot];
        let Duty::Executing(work) = &agent.duty else { return None };
        let role = self.role(work);
        // A robot that cannot drive is stopped, or asks the operator, by its supervisors: that
        // takes time.
        let Some(pace) = agent.driver.pace() else { return Some(self.now - work.since) };
        let [takes, gives] = agent.goals;
        let delay = self.scenario.delay(takes, gives, agent.passages.seen());
        let body = self.scenario.robots[robot].file.robot();
        let second = drive_ms(body, self.scenario.floor.distance(takes, gives)?, pace) + delay;
        let left = agent.driver.left_mm(self.now) * 1_000 / pace;
        let spent = self.now - work.since;
        let rest = match agent.stage {
            Stage::ToTake => [left, role.take_ms, second, role.give_ms],
            Stage::Takes => [0, role.take_ms, second, role.give_ms],
            Stage::ToGive => [0, 0, left, role.give_ms],
            // To give again costs as much again.
            Stage::Gives if !agent.skills.is_certain() => [0, 0, 0, role.give_ms],
            _ => [0; 4],
        };
        if agent.skills.is_certain() {
            return Some(spent + rest.iter().sum::<u64>());
        }
        let task = work.award.id.task;
        let able = self.able(robot, task, role);
        if !role.possible(able) {
            return None;
        }
        let usable = agent.skills.trusted().iter().filter(|it| able.has(it.capability));
        let usable: Vec<_> = usable.copied().collect();
        Some(spent + u64::from(role.quote(&usable, rest)?.cost_ms))
    }

    /// The class of an error after which this robot cannot do the task.
    fn class_of_loss(&mut self, task: usize) -> ErrorClass {
        let others = self.others_can(task);
        let never = cotama_models::team::Pledge { most: 0 };
        classify(None, never, others, 0, MOST_REPEATS)
    }

    /// The object of a task moved under the hand: it is taken again.
    pub(super) fn shifted(&mut self, task: usize) {
        let takers: Vec<usize> = self.takers(task);
        for robot in takers {
            let Some(work) = self.robots[robot].work_mut() else { continue };
            let (pledge, repeats) = (work.pledge(), work.repeats);
            work.repeats += 1;
            self.robots[robot].stage_since = self.now;
            let estimate = self.estimate(robot);
            let others = self.others_can(task);
            let class = classify(estimate, pledge, others, repeats, MOST_REPEATS);
            if class == ErrorClass::Recoverable {
                let why = "grasps again".to_owned();
                self.note(|t_ms| Record::Error { t_ms, robot, task, class, why });
                self.enter(robot, Stage::Takes);
                self.wake(robot);
            } else {
                self.give_back(robot, class, "the grasp fails");
            }
        }
    }

    /// The object of a task turned: who needs the handle cannot take it.
    pub(super) fn turned(&mut self, task: usize) {
        for robot in self.takers(task) {
            let Some(work) = self.robots[robot].work() else { continue };
            let role = self.role(work);
            if role.possible(self.able(robot, task, role)) {
                continue;
            }
            let class = self.class_of_loss(task);
            self.give_back(robot, class, "the handle is hidden");
        }
    }

    /// Returns the robots that are about to take the object of a task.
    fn takers(&self, task: usize) -> Vec<usize> {
        let takes = |it: &usize| {
            let agent = &self.robots[*it];
            agent.stage == Stage::Takes
                && agent.work().is_some_and(|work| {
                    work.award.id.task == task && self.role(work).take == Take::Object
                })
        };
        (0..self.robots.len()).filter(takes).collect()
    }
}

/// Whether the robot is where a partner gives or takes.
fn is_exchange(agent: &Agent, role: &RoleSpec) -> bool {
    let gives = agent.stage == Stage::Gives && matches!(role.give, Give::Partner(_));
    gives || agent.stage == Stage::Takes && matches!(role.take, Take::Partner(_))
}

/// Words are said once, however many listen.
fn work_is_first(award: &crate::fleet::message::Award, robot: usize) -> bool {
    award.robots.first() == Some(&robot)
}
