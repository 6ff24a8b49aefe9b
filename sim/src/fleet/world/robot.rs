//! A robot of the team: what its broker hears and says.

use super::office::{Copy, Follows};
use super::{BEAT, Planted, World};
use crate::fleet::bid::Offer;
use crate::fleet::charge::{Charge, Errand};
use crate::fleet::driver::Driver;
use crate::fleet::message::{Award, AwardId, Ending, Message, Party, Status};
use crate::fleet::passages::Passages;
use crate::fleet::record::Record;
use crate::fleet::skills::Skills;
use cotama_core::team::RobotSet;
use cotama_models::team::ErrorClass;
use cotama_models::team::Pledge;
use cotama_models::team::scenario::{RobotSpec, Row, Spot, Stage};
use std::rc::Rc;

/// A robot.
#[derive(Clone, Debug)]
pub(super) struct Agent {
    pub(super) driver: Driver,
    pub(super) skills: Skills,
    /// The people that it meets on crowded ways.
    pub(super) passages: Passages,
    /// The charge of its battery; `None` where nobody counts it.
    pub(super) charge: Option<Charge>,
    /// The errand of its own while it is free.
    pub(super) errand: Option<Errand>,
    /// The spot where it stands, or began to drive.
    pub(super) spot: Spot,
    /// The spots where it takes and gives in its task.
    pub(super) goals: [Spot; 2],
    pub(super) stage: Stage,
    pub(super) stage_since: u64,
    pub(super) duty: Duty,
    /// Ends of awards that the auctioneer has not yet heard of.
    pub(super) finals: Vec<(AwardId, Status)>,
    /// The last round in which it bid, the last it heard of.
    pub(super) offered: u32,
    pub(super) heard: u32,
    /// The round of its last award.
    taken: u32,
    /// Acknowledgements that came before the award.
    early: Vec<(AwardId, usize)>,
    pub(super) asking: Option<Asking>,
    /// Tasks that took it longer than it had pledged: it leaves them to others.
    pub(super) left: Vec<usize>,
    /// Failures that its decisional component has found.
    pub(super) found: Vec<Row>,
    /// The task whose object it has on board.
    pub(super) holds: Option<usize>,
    /// When its next round is.
    pub(super) next_round: Option<u64>,
    was_fit: bool,
    /// The auctioneer, as far as it knows, and its copy of what that one knows.
    pub(super) follows: Follows,
}

/// The question of a broker to bidders, and their replies.
#[derive(Clone, Debug)]
pub(super) struct Asking {
    pub(super) round: u32,
    pub(super) tasks: Rc<[usize]>,
    pub(super) replies: Vec<(usize, Rc<[Offer]>)>,
    pub(super) tries: u32,
    pub(super) answered: bool,
}

/// The duty of a robot.
#[derive(Clone, Debug)]
pub(super) enum Duty {
    Free,
    /// The robot waits until all partners have acknowledged.
    Waiting(Work),
    Executing(Work),
}

/// A role in an award.
#[derive(Clone, Debug)]
pub(super) struct Work {
    pub(super) award: Rc<Award>,
    pub(super) role: usize,
    acked: RobotSet,
    /// The award holds until then.
    until_ms: u64,
    /// Since when.
    pub(super) since: u64,
    /// The object went from partner to partner.
    pub(super) handed: bool,
    /// How often the same error was answered.
    pub(super) repeats: u32,
    /// What is taken or given at this stage has been, and no skill of it has failed.
    pub(super) acted: bool,
    /// How often a skill failed at this stage.
    pub(super) failures: u32,
}

impl Work {
    pub(super) fn pledge(&self) -> Pledge {
        Pledge { most: self.award.pledges_ms[self.role] }
    }
}

impl Agent {
    pub(super) fn new(
        driver: Driver,
        spot: Spot,
        (skills, passages): (Skills, Passages),
        follows: Follows,
        spec: &RobotSpec,
    ) -> Self {
        Self {
            driver,
            skills,
            passages,
            charge: Charge::of(spec),
            errand: None,
            spot,
            goals: [spot; 2],
            stage: Stage::Rests,
            stage_since: 0,
            duty: Duty::Free,
            finals: Vec::new(),
            offered: 0,
            heard: 0,
            taken: 0,
            early: Vec::new(),
            asking: None,
            left: Vec::new(),
            found: Vec::new(),
            holds: None,
            next_round: None,
            was_fit: true,
            follows,
        }
    }

    pub(super) fn work(&self) -> Option<&Work> {
        match &self.duty {
            Duty::Free => None,
            Duty::Waiting(it) | Duty::Executing(it) => Some(it),
        }
    }

    pub(super) fn work_mut(&mut self) -> Option<&mut Work> {
        match &mut self.duty {
            Duty::Free => None,
            Duty::Waiting(it) | Duty::Executing(it) => Some(it),
        }
    }

    /// Whether it may bid later, but not now.
    pub(super) fn is_busy(&self) -> bool {
        self.work().is_some() || self.errand.is_some()
    }

    fn has(&self, award: AwardId) -> bool {
        self.work().is_some_and(|it| it.award.id == award)
    }

    /// Returns the target of its drive, while it drives.
    pub(super) fn drives_to(&self) -> Option<Spot> {
        match (&self.duty, self.stage) {
            (Duty::Free, Stage::ToTake) if self.errand == Some(Errand::Home) => Some(self.goals[0]),
            (Duty::Executing(_), Stage::ToTake) => Some(self.goals[0]),
            (Duty::Executing(_), Stage::ToGive) => Some(self.goals[1]),
            _ => None,
        }
    }

    /// Whether it can work.
    pub(super) fn is_fit(&self) -> bool {
        self.driver.thinks() && self.driver.pace().is_some()
    }
}

impl World<'_> {
    /// Handles a message to a broker.
    pub(super) fn hear(&mut self, robot: usize, from: Party, message: Message) {
        let me = Party::Robot(robot);
        match message {
            Message::Announce { round, tasks } => self.announced(robot, round, &tasks),
            Message::Request { round, tasks } => {
                let offers = self.offers(robot, &tasks);
                self.robots[robot].offered = self.robots[robot].offered.max(round);
                self.send(me, from, Message::Reply { round, offers: offers.into() });
            }
            Message::Reply { round, offers } => self.replied(robot, from.address(), round, offers),
            Message::Assign { award: Some(award), until_ms } => {
                self.assigned(robot, &award, until_ms);
            }
            Message::Ack { award } => self.partner_acked(robot, from.address(), award),
            Message::Nack { award } => {
                let waits = matches!(self.robots[robot].duty, Duty::Waiting(_));
                if waits && self.robots[robot].has(award) {
                    self.leave(robot);
                }
            }
            Message::Prolong { award, until_ms, complete } => {
                if !self.robots[robot].has(award) {
                    self.answer_for(robot, award);
                } else if let Some(work) = self.robots[robot].work_mut() {
                    work.until_ms = work.until_ms.max(until_ms);
                    if complete {
                        work.acked = work.award.members;
                        self.start_if_all_acked(robot);
                    }
                }
            }
            Message::Status { award, status: Status::Failed(_) } => {
                // A partner has failed: everybody leaves the role.
                if self.robots[robot].has(award) {
                    self.leave(robot);
                }
            }
            Message::Release { award, ending: Ending::Heard } => {
                self.robots[robot].finals.retain(|it| it.0 != award);
            }
            Message::Release { award, ending: Ending::Withdrawn } => {
                if self.robots[robot].has(award) {
                    self.leave(robot);
                }
                self.answer_for(robot, award);
            }
            Message::Assign { award: None, .. }
            | Message::Status { .. }
            | Message::Alive { .. }
            | Message::Bid { .. }
            | Message::Copied { .. }
            | Message::Leads => {}
            Message::Copy { version, sent_ms, place, ledger } => {
                self.keep_copy(robot, Copy { version, sent_ms, place, ledger });
            }
        }
    }

    /// Says how an award ended that the robot has no longer, or never had.
    fn answer_for(&mut self, robot: usize, award: AwardId) {
        let known = self.robots[robot].finals.iter().find(|it| it.0 == award);
        let message = if let Some(&(award, status)) = known {
            Message::Status { award, status }
        } else {
            // The award may still be under way: it is not taken when it comes.
            let taken = &mut self.robots[robot].taken;
            *taken = (*taken).max(award.round);
            Message::Nack { award }
        };
        self.send(Party::Robot(robot), self.desk(robot), message);
    }

    /// An award: it is accepted by who bid in its round and is free.
    fn assigned(&mut self, robot: usize, award: &Rc<Award>, until_ms: u64) {
        let works = self.works(robot);
        let (round, agent) = (award.id.round, &mut self.robots[robot]);
        if agent.has(award.id) {
            if let Some(work) = agent.work_mut() {
                work.until_ms = work.until_ms.max(until_ms);
            }
            self.acknowledge(robot, award);
            return;
        }
        if agent.finals.iter().any(|it| it.0 == award.id) {
            self.answer_for(robot, award.id);
            return;
        }
        let bid = agent.offered == round;
        // No award is taken twice, and none whose time is over before the robot looks again.
        let new = round > agent.taken;
        let holds = until_ms > self.now + BEAT || self.planted == Some(Planted::NoLease);
        let free = !agent.is_busy() && works && new;
        let role = award.robots.iter().position(|it| *it == robot);
        let Some(role) = role.filter(|_| bid && holds && free) else {
            // No is no: a copy of the award that comes later is not taken.
            self.robots[robot].taken = self.robots[robot].taken.max(round);
            let others = award.robots.iter().filter(|it| **it != robot);
            let partners = others.map(|it| Party::Robot(*it)).collect::<Vec<_>>();
            for to in partners.into_iter().chain([self.desk(robot)]) {
                self.send(Party::Robot(robot), to, Message::Nack { award: award.id });
            }
            return;
        };
        let agent = &mut self.robots[robot];
        let early = agent.early.iter().filter(|it| it.0 == award.id).map(|it| 1 << it.1);
        let acked = early.fold(1 << robot, |all: RobotSet, it: RobotSet| all | it);
        agent.early.clear();
        agent.taken = round;
        agent.duty = Duty::Waiting(Work {
            award: Rc::clone(award),
            role,
            acked,
            until_ms,
            since: self.now,
            handed: false,
            repeats: 0,
            acted: false,
            failures: 0,
        });
        self.acknowledge(robot, award);
        self.start_if_all_acked(robot);
    }

    /// To the auctioneer and to all partners.
    fn acknowledge(&mut self, robot: usize, award: &Award) {
        let others = award.robots.iter().filter(|it| **it != robot).map(|it| Party::Robot(*it));
        for to in others.chain([self.desk(robot)]) {
            self.send(Party::Robot(robot), to, Message::Ack { award: award.id });
        }
    }

    fn partner_acked(&mut self, robot: usize, partner: usize, award: AwardId) {
        let agent = &mut self.robots[robot];
        if !agent.has(award) {
            if !agent.early.contains(&(award, partner)) && agent.early.len() < 64 {
                agent.early.push((award, partner));
            }
            return;
        }
        if let Some(work) = agent.work_mut() {
            work.acked |= 1 << partner;
        }
        self.start_if_all_acked(robot);
    }

    /// Nobody executes a role before every member has acknowledged.
    fn start_if_all_acked(&mut self, robot: usize) {
        let Duty::Waiting(work) = &self.robots[robot].duty else { return };
        if work.acked & work.award.members == work.award.members {
            let work = work.clone();
            self.execute(robot, work);
        }
    }

    /// The robot leaves its role, and stands.
    pub(super) fn leave(&mut self, robot: usize) {
        self.stop_short(robot);
        let (now, agent) = (self.now, &mut self.robots[robot]);
        if let Duty::Executing(work) = &agent.duty {
            self.run.busy_ms += now - work.since;
        }
        agent.duty = Duty::Free;
        agent.driver.forget(now);
        let stage = agent.driver.stage();
        self.enter(robot, stage);
        self.wake(robot);
    }

    /// The laptop of a robot is down: it stands, and says nothing any more.
    pub(super) fn dies(&mut self, robot: usize) {
        self.stop_short(robot);
        let (now, agent) = (self.now, &mut self.robots[robot]);
        if let Duty::Executing(work) = &agent.duty {
            self.run.busy_ms += now - work.since;
        }
        (agent.duty, agent.errand) = (Duty::Free, None);
        self.enter(robot, Stage::Safe);
        self.auctioneer_dies_with(robot);
    }

    /// The robot gives its task back, and says so until it is heard.
    pub(super) fn give_back(&mut self, robot: usize, class: ErrorClass, why: &str) {
        let Some(work) = self.robots[robot].work() else { return };
        let award = Rc::clone(&work.award);
        let task = award.id.task;
        self.note(|t_ms| Record::Error { t_ms, robot, task, class, why: why.to_owned() });
        self.leave(robot);
        self.say_final(robot, &award, Status::Failed(class));
    }

    /// The end of a role, to the auctioneer and to partners; again and again to the auctioneer.
    pub(super) fn say_final(&mut self, robot: usize, award: &Award, status: Status) {
        self.robots[robot].finals.push((award.id, status));
        let others = award.robots.iter().filter(|it| **it != robot).map(|it| Party::Robot(*it));
        for to in others.chain([self.desk(robot)]) {
            self.send(Party::Robot(robot), to, Message::Status { award: award.id, status });
        }
    }

    /// The robot says how it is.
    pub(super) fn beat(&mut self, robot: usize) {
        self.queue.push(self.now + BEAT, 1, super::Event::Beat(robot));
        if self.robots[robot].drives_to().is_some() {
            self.note_spot(robot);
        }
        self.looks_at_charge(robot);
        if !self.is_there(robot) {
            return;
        }
        let (me, desk) = (Party::Robot(robot), self.desk(robot));
        if let Some(work) = self.robots[robot].work() {
            if self.now + BEAT > work.until_ms && self.planted != Some(Planted::NoLease) {
                self.give_back(robot, ErrorClass::SemiRecoverable, "it hears nothing any more");
            } else {
                let award = Rc::clone(&work.award);
                if matches!(self.robots[robot].duty, Duty::Waiting(_)) {
                    self.acknowledge(robot, &award);
                } else if !self.breaks_its_pledge(robot) {
                    let status = Status::Progress;
                    let others = award.robots.iter().filter(|it| **it != robot);
                    let others = others.map(|it| Party::Robot(*it));
                    for to in others.chain([desk]) {
                        self.send(me, to, Message::Status { award: award.id, status });
                    }
                }
            }
        }
        let fit = self.works(robot);
        let agent = &mut self.robots[robot];
        let (works, busy) = (agent.work().is_some(), agent.is_busy());
        let news = fit != agent.was_fit;
        agent.was_fit = fit;
        // A robot at work has said so already.
        if news || !works {
            let asks = self.misses_auctioneer(robot);
            self.send(me, desk, Message::Alive { busy, fit, asks });
        }
        if self.planted == Some(Planted::SaysOnce) {
            return;
        }
        for (award, status) in self.robots[robot].finals.clone() {
            self.send(me, desk, Message::Status { award, status });
        }
    }

    /// Whether a robot takes tasks: it is part of the team, and can.
    pub(super) fn works(&self, robot: usize) -> bool {
        self.scenario.robots[robot].stay.works(self.now) && self.robots[robot].is_fit()
    }

    /// Whether a robot hears and speaks: who leaves stays until its role is over and that was
    /// heard; whoever gives tasks out stays where no other takes over.
    pub(super) fn is_there(&self, robot: usize) -> bool {
        let (stay, agent) = (self.scenario.robots[robot].stay, &self.robots[robot]);
        let stuck = self.auctioneer.address == robot && !self.has_successors();
        let ends = agent.work().is_none() && agent.finals.is_empty() && !stuck;
        let gone = !stay.works(self.now) && (self.now < stay.joins_ms || ends);
        agent.driver.thinks() && !gone
    }

    /// The drive is cut short: the robot comes to stand.
    pub(super) fn stop_short(&mut self, robot: usize) {
        let agent = &self.robots[robot];
        if let Some(goal) = agent.drives_to() {
            let way = agent.driver.stand_mm(self.now);
            self.robots[robot].spot = self.scenario.floor.gone(agent.spot, goal, way);
        }
    }
}
