//! Awards under way: until when they hold, who has acknowledged, completed or failed, and what
//! becomes of the task.

use super::auctioneer::{State, Ticket};
use super::{LEASE, Planted, TICK, World};
use crate::fleet::bid::Share;
use crate::fleet::message::{Award, AwardId, Ending, Message, Party};
use crate::fleet::record::{Fate, Record};
use cotama_core::team::RobotSet;
use cotama_models::team::{ErrorClass, Pledge, Probability};
use std::rc::Rc;

/// Acknowledgements are waited for so long, in ms.
const ACKS: u64 = 4_000;
/// A task is reported after so many awards.
const MOST_AWARDS: u32 = 10;

impl Ticket {
    /// Answers are waited for from now on.
    pub(super) fn wait_anew(&mut self, now: u64) {
        (self.deadline, self.resend) = (now + ACKS, now);
    }
}

impl World<'_> {
    /// An award goes to its members; who they are.
    pub(super) fn award_to(&mut self, share: &Share, round: u32, second: Option<u64>) -> RobotSet {
        let members = share.robots.iter().fold(0, |all: RobotSet, it| all | 1 << it.robot);
        // A partner waits for the slowest.
        let slowest = share.robots.iter().map(|it| u64::from(it.cost_ms)).max().unwrap_or(0);
        let alone = share.robots.len() == 1 && self.scenario.second_best;
        let pledge = Pledge::of(slowest, second.filter(|_| alone), self.scenario.slack_permille);
        let pledges_ms = vec![pledge.most; share.robots.len()];
        let award = Rc::new(Award {
            id: AwardId { task: share.task, round },
            plan: share.plan,
            robots: share.robots.iter().map(|it| it.robot).collect(),
            pledges_ms: pledges_ms.clone(),
            members,
        });
        let plan = self.scenario.tasks[share.task].plans[share.plan].name.clone();
        let (task, robots) = (share.task, award.robots.clone());
        let costs_ms = share.robots.iter().map(|it| it.cost_ms).collect();
        let certain = share.robots.iter().all(|it| it.success == Probability::ONE);
        let success = share.robots.iter().filter(|_| !certain).map(|it| it.success.parts());
        let success = success.collect();
        self.note(|t_ms| Record::Awarded {
            t_ms,
            task,
            round,
            plan,
            robots,
            costs_ms,
            pledges_ms,
            success,
        });
        self.run.awards[task] += 1;
        let ticket = self.auctioneer.ticket_mut(task);
        if let Some(before) = ticket.award.take() {
            ticket.past.push((before, ticket.completed));
        }
        (ticket.state, ticket.acked, ticket.completed, ticket.gone) = (State::Awarded, 0, 0, 0);
        (ticket.until, ticket.vain) = (vec![0; award.robots.len()], 0);
        ticket.awards += 1;
        ticket.deadline = self.now + ACKS;
        ticket.award = Some(award);
        self.assign(task);
        members
    }

    /// Tells those members of their award who have not acknowledged.
    fn assign(&mut self, task: usize) {
        let (until_ms, from) = (self.now + LEASE, self.auctioneer.party());
        let ticket = self.auctioneer.ticket_mut(task);
        ticket.resend = self.now + 2 * TICK;
        let Some(award) = ticket.award.clone() else { return };
        for (place, &robot) in award.robots.iter().enumerate() {
            if self.auctioneer.tickets[task].acked >> robot & 1 == 1 {
                continue;
            }
            self.auctioneer.ticket_mut(task).until[place] = until_ms;
            let message = Message::Assign { award: Some(Rc::clone(&award)), until_ms };
            self.send(from, Party::Robot(robot), message);
        }
    }

    pub(super) fn watch_award(&mut self, task: usize) {
        let ticket = &self.auctioneer.tickets[task];
        if self.now >= ticket.deadline {
            self.withdraw(task);
        } else if self.now >= ticket.resend {
            self.assign(task);
        }
    }

    /// Whether a member was not heard of for so long that its award has run out.
    pub(super) fn watch_work(&mut self, task: usize) {
        let ticket = &self.auctioneer.tickets[task];
        let Some(award) = ticket.award.clone() else { return };
        let over = |it: &(usize, &usize)| {
            ticket.completed >> it.1 & 1 == 0 && self.now > ticket.until[it.0]
        };
        let silent: Vec<usize> =
            award.robots.iter().enumerate().filter(over).map(|it| *it.1).collect();
        if silent.is_empty() {
            return;
        }
        for &robot in &silent {
            self.note(|t_ms| Record::Silent { t_ms, robot, task });
        }
        self.withdraw(task);
    }

    /// Takes an award back.
    fn withdraw(&mut self, task: usize) {
        let ticket = self.auctioneer.ticket_mut(task);
        (ticket.state, ticket.resend) = (State::Withdrawn, self.now);
        self.watch_withdrawal(task);
    }

    /// When all members have left, or their time is over, the task is open again.
    pub(super) fn watch_withdrawal(&mut self, task: usize) {
        let now = self.now;
        let ticket = self.auctioneer.ticket_mut(task);
        let Some(award) = ticket.award.clone() else { return };
        let left = ticket.gone | ticket.completed;
        let lease = self.planted != Some(Planted::NoLease);
        let held = award.robots.iter().enumerate().filter(|it| left >> it.1 & 1 == 0);
        let held: Vec<usize> =
            held.filter(|it| lease && now <= ticket.until[it.0]).map(|it| *it.1).collect();
        if held.is_empty() {
            let all = ticket.completed & award.members == award.members;
            ticket.finished |= all;
            if !ticket.finished {
                if ticket.awards >= MOST_AWARDS {
                    ticket.report.get_or_insert("it was given back too often");
                }
                if ticket.report.is_none() {
                    ticket.state = State::Open;
                    self.auctioneer.changed(now);
                    self.run.reopened += 1;
                    self.note(|t_ms| Record::Reopened { t_ms, task });
                    return;
                }
            }
            self.close(task);
        } else if now >= ticket.resend {
            ticket.resend = now + 2 * TICK;
            for robot in held {
                self.release(robot, award.id, Ending::Withdrawn);
            }
        }
    }

    /// The task is over.
    pub(super) fn close(&mut self, task: usize) {
        self.auctioneer.changed(self.now);
        let ticket = self.auctioneer.ticket_mut(task);
        if ticket.finished {
            ticket.state = State::Done;
            let robots = ticket.award.as_ref().map_or(Vec::new(), |it| it.robots.clone());
            self.note(|t_ms| Record::Done { t_ms, task, robots });
            self.ends(task, Fate::Done);
        } else {
            let why = ticket.report.unwrap_or("it cannot be done");
            ticket.state = State::Reported;
            self.note(|t_ms| Record::Reported { t_ms, task, why: why.to_owned() });
            self.ends(task, Fate::Reported);
        }
    }

    /// The ticket of an award, if it is the one in force.
    fn in_force(&mut self, award: AwardId) -> Option<&mut Ticket> {
        let ticket = Rc::make_mut(self.auctioneer.tickets.get_mut(award.task)?);
        let same = ticket.award.as_ref().is_some_and(|it| it.id == award);
        let live = matches!(ticket.state, State::Awarded | State::Executing | State::Withdrawn);
        (same && live).then_some(ticket)
    }

    pub(super) fn acked(&mut self, robot: usize, award: AwardId) {
        if let Some(ticket) = self.in_force(award) {
            ticket.acked |= 1 << robot;
            let all = ticket.award.as_ref().is_some_and(|it| it.members & !ticket.acked == 0);
            if all && ticket.state == State::Awarded {
                ticket.state = State::Executing;
            }
        }
        self.prolong(robot, award);
    }

    /// A member works, so that all have acknowledged; an auctioneer that took over may have missed
    /// that.
    pub(super) fn progresses(&mut self, robot: usize, award: AwardId) {
        if self.auctioneer.office.term > 0
            && let Some(ticket) = self.in_force(award).filter(|it| it.state == State::Awarded)
        {
            ticket.acked = ticket.award.as_ref().map_or(0, |it| it.members);
            ticket.state = State::Executing;
        }
        self.prolong(robot, award);
    }

    /// The award holds for longer, as its member was heard of.
    pub(super) fn prolong(&mut self, robot: usize, award: AwardId) {
        let until_ms = self.now + LEASE;
        let Some(ticket) = self.in_force(award).filter(|it| it.state != State::Withdrawn) else {
            self.release(robot, award, Ending::Withdrawn);
            return;
        };
        let Some(award_here) = ticket.award.clone() else { return };
        let members = &award_here.robots;
        let Some(place) = members.iter().position(|it| *it == robot) else { return };
        ticket.until[place] = ticket.until[place].max(until_ms);
        let complete = ticket.state == State::Executing;
        let message = Message::Prolong { award, until_ms, complete };
        self.send(self.auctioneer.party(), Party::Robot(robot), message);
    }

    /// A member does not accept, or no longer.
    pub(super) fn refused(&mut self, robot: usize, award: AwardId) {
        let Some(ticket) = self.in_force(award) else { return };
        ticket.gone |= 1 << robot;
        if ticket.state == State::Withdrawn {
            self.watch_withdrawal(award.task);
        } else {
            self.withdraw(award.task);
        }
    }

    pub(super) fn completed(&mut self, robot: usize, award: AwardId) {
        self.release(robot, award, Ending::Heard);
        let Some(ticket) = self.in_force(award) else {
            self.completed_late(robot, award);
            return;
        };
        ticket.completed |= 1 << robot;
        let all = ticket.award.as_ref().is_some_and(|it| it.members & !ticket.completed == 0);
        if ticket.state == State::Withdrawn {
            self.watch_withdrawal(award.task);
        } else if all {
            ticket.finished = true;
            self.close(award.task);
        }
    }

    /// News of an award that was withdrawn: what is done is done.
    fn completed_late(&mut self, robot: usize, award: AwardId) {
        let ticket = self.auctioneer.ticket_mut(award.task);
        if ticket.award.as_ref().is_some_and(|it| it.id == award) {
            ticket.completed |= 1 << robot;
            let all = ticket.award.as_ref().is_some_and(|it| it.members & !ticket.completed == 0);
            ticket.finished |= all;
        }
        for (past, completed) in ticket.past.iter_mut().filter(|it| it.0.id == award) {
            *completed |= 1 << robot;
            ticket.finished |= past.members & !*completed == 0;
        }
        if !ticket.finished {
            return;
        }
        match ticket.state {
            State::Open => self.close(award.task),
            State::Awarded | State::Executing => self.withdraw(award.task),
            _ => {}
        }
    }

    pub(super) fn failed(&mut self, robot: usize, award: AwardId, class: ErrorClass) {
        self.release(robot, award, Ending::Heard);
        let Some(ticket) = self.in_force(award) else { return };
        ticket.gone |= 1 << robot;
        if class == ErrorClass::NonRecoverable {
            ticket.report.get_or_insert("a robot says that it cannot be done");
        }
        if ticket.state == State::Withdrawn {
            self.watch_withdrawal(award.task);
        } else {
            self.withdraw(award.task);
        }
    }
}
