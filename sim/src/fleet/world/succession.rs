//! Succession of auctioneers, when nothing more is heard of who does (strategy iii of 3.6.1).
//!
//! The auctioneer copies what it knows to two robots, its *successors*, before others hear of it:
//! letters wait until both have the copy. Each copy is answered, and who answers promises not to
//! take over for [`HOLD`] from when it was sent. So the auctioneer acts only while all promises
//! hold, and a successor takes over when its own is over, whatever got lost: at no time do two give
//! tasks out. A successor of which nothing is heard for [`GRACE`] longer has failed, as it would
//! have taken over; the next robot takes its place. Where the auctioneer and both successors fail
//! together, another robot begins without a copy, after [`LOST`].
//!
//! An auctioneer that is new takes each award to hold for as long as the one before can have
//! prolonged it. Whoever gave the tasks to the team says which of them have ended, and tells those
//! that it does not know. Each auctioneer has a *term*; letters of an older term are ignored.

use super::auctioneer::Auctioneer;
use super::office::{Copy, Follows, HOLD, Office, Successor};
use super::{Event, LEASE, Planted, World};
use crate::fleet::ledger::{Ledger, State};
use crate::fleet::message::{Letter, Message, Party};
use crate::fleet::record::{Fate, Record};
use cotama_core::team::RobotSet;
use cotama_models::team::scenario::Seat;
use std::rc::Rc;

/// So many robots have copies.
const SUCCESSORS: usize = 2;
/// A successor that has not answered for so much longer has failed, in ms.
const GRACE: u64 = 5_000;
/// A robot asks who gives tasks out after so long a silence, and takes over without a copy, in ms.
const QUIET: u64 = 10_000;
const LOST: u64 = 60_000;
/// So long after its last word nobody follows an auctioneer that has no successors, in ms.
const GIVEN_UP: u64 = 10_000;
/// Rounds of an auctioneer without a copy are beyond all of those before.
const ROUNDS_OF_A_TERM: u32 = 100_000;
/// Robots that an auctioneer has not heard of since it took over are told so often, in ms.
const TOLD: u64 = 2_000;

impl World<'_> {
    pub(super) const fn has_successors(&self) -> bool {
        matches!(self.scenario.auctioneer, Seat::Queue(_))
    }

    fn somebody_is_there(&self) -> bool {
        (0..self.robots.len()).any(|it| self.is_there(it))
    }

    /// The auctioneer to whom a robot writes.
    pub(super) fn desk(&self, robot: usize) -> Party {
        Party::Auctioneer(self.robots[robot].follows.address)
    }

    /// Whether a robot has not heard of an auctioneer for long.
    pub(super) fn misses_auctioneer(&self, robot: usize) -> bool {
        self.has_successors() && self.robots[robot].follows.heard_ms + QUIET <= self.now
    }

    /// Whether a robot minds a letter: those of auctioneers that were replaced are ignored.
    pub(super) fn is_followed(&mut self, robot: usize, from: Party, term: u32) -> bool {
        let Party::Auctioneer(address) = from else { return true };
        let follows = &mut self.robots[robot].follows;
        if term > follows.term {
            *follows = Follows { term, ..Follows::new(address) };
        }
        follows.heard_ms = self.now;
        term == follows.term
    }

    /// A copy came: the newest is kept, and answered.
    pub(super) fn keep_copy(&mut self, robot: usize, copy: Copy) {
        let follows = &mut self.robots[robot].follows;
        let (term, version, sent_ms) = (follows.term, copy.version, copy.sent_ms);
        // The network may bring the newer one of copies sent in one millisecond first.
        if follows.copy.as_ref().is_none_or(|it| (it.sent_ms, it.version) <= (sent_ms, version)) {
            follows.copy = Some(copy);
        }
        let message = Message::Copied { term, version, sent_ms };
        self.send(Party::Robot(robot), self.desk(robot), message);
    }

    /// A letter of the auctioneer leaves when its reason is copied. For how long an award holds
    /// needs no copy: who takes over expects the longest.
    pub(super) fn send_when_copied(&mut self, letter: Letter) {
        let office = &mut self.auctioneer.office;
        match letter.message {
            Message::Leads | Message::Copy { .. } => self.post(&letter),
            Message::Prolong { .. } if office.may_act(self.now) => self.post(&letter),
            Message::Prolong { .. } => {}
            _ => {
                let at_once = self.planted == Some(Planted::NotCopied);
                let version = if at_once { 0 } else { office.version + 1 };
                office.held.push_back((version, letter));
            }
        }
    }

    /// After each event: what the auctioneer knows now is copied, if letters wait for it.
    pub(super) fn copy_first(&mut self) {
        let office = &self.auctioneer.office;
        if office.held.back().is_none_or(|it| it.0 <= office.version) {
            self.let_go();
            return;
        }
        let ledger = self.auctioneer.ledger();
        let office = &mut self.auctioneer.office;
        office.version += 1;
        office.copy = Some(Rc::new(ledger));
        self.send_copies();
        self.let_go();
    }

    fn send_copies(&mut self) {
        let ledger = self.auctioneer.ledger();
        let office = &mut self.auctioneer.office;
        let version = office.version;
        let ledger = Rc::clone(office.copy.get_or_insert_with(|| Rc::new(ledger)));
        let robots: Vec<usize> = office.successors.iter().map(|it| it.robot).collect();
        for (place, robot) in (0..).zip(robots) {
            let (from, sent_ms) = (self.auctioneer.party(), self.now);
            let ledger = Rc::clone(&ledger);
            let message = Message::Copy { version, sent_ms, place, ledger };
            self.send(from, Party::Robot(robot), message);
        }
    }

    /// Letters leave of which the reason is copied.
    pub(super) fn let_go(&mut self) {
        let office = &self.auctioneer.office;
        let copied = office.successors.iter().map(|it| it.version).min().unwrap_or(u64::MAX);
        if !office.may_act(self.now) {
            return;
        }
        while self.auctioneer.office.held.front().is_some_and(|it| it.0 <= copied) {
            if let Some((_, letter)) = self.auctioneer.office.held.pop_front() {
                self.post(&letter);
            }
        }
    }

    /// The auctioneer looks at its tasks, and its successors at the auctioneer.
    pub(super) fn gives_out(&mut self) {
        if self.has_successors() {
            for robot in 0..self.robots.len() {
                if self.is_due(robot) {
                    self.take_over(robot);
                }
            }
            // An auctioneer that leaves is silent, and followed by another.
            let leads = self.auctioneer.address;
            if self.auctioneer.up && !self.is_there(leads) {
                self.auctioneer_dies_with(leads);
            }
            if self.auctioneer.up {
                self.renew();
                self.let_go();
            }
            if !self.auctioneer.office.may_act(self.now) {
                return;
            }
        }
        if self.auctioneer.up {
            self.tick();
        }
    }

    /// Successors that have failed are replaced, and all get a copy.
    fn renew(&mut self) {
        let (now, address) = (self.now, self.auctioneer.address);
        let heard = |it: usize| self.auctioneer.last_heard[it] + LEASE / 2 >= now;
        let others: Vec<usize> =
            (0..self.robots.len()).filter(|it| *it != address && heard(*it)).collect();
        let office = &mut self.auctioneer.office;
        office.successors.retain(|it| now < it.sent_ms + HOLD + GRACE);
        for robot in others {
            let is_one = office.successors.iter().any(|it| it.robot == robot);
            if office.successors.len() < SUCCESSORS && !is_one {
                office.successors.push(Successor { robot, version: 0, sent_ms: now });
            }
        }
        let (met, term) = (office.met, office.term);
        self.send_copies();
        if term > 0 && now.is_multiple_of(TOLD) {
            self.tell(!met);
        }
    }

    /// Tells robots who gives tasks out.
    fn tell(&mut self, robots: RobotSet) {
        for robot in (0..self.robots.len()).filter(|it| robots >> it & 1 == 1) {
            self.send(self.auctioneer.party(), Party::Robot(robot), Message::Leads);
        }
    }

    /// Whether a robot is to take over.
    fn is_due(&self, robot: usize) -> bool {
        let agent = &self.robots[robot];
        let leads = self.auctioneer.up && self.auctioneer.address == robot;
        let due = match &agent.follows.copy {
            Some(_) if self.planted == Some(Planted::TakesOverEarly) => {
                agent.follows.heard_ms + 1_000
            }
            Some(copy) => copy.sent_ms + HOLD + copy.place * 2 * GRACE,
            None => {
                let heard = agent.follows.heard_ms.max(self.scenario.robots[robot].stay.joins_ms);
                heard + LOST + robot as u64 * 2 * GRACE
            }
        };
        self.is_there(robot) && !leads && due <= self.now
    }

    /// A robot goes on with what it knows of the auctioneer before.
    fn take_over(&mut self, robot: usize) {
        let now = self.now;
        if self.auctioneer.up && self.auctioneer.office.may_act(now) {
            self.run.rivals += 1;
        }
        let follows = &mut self.robots[robot].follows;
        let copy = follows.copy.take();
        // The later in the queue of two that take over at once has the higher term.
        let rank = copy.as_ref().map_or(SUCCESSORS as u64 + 1 + robot as u64, |it| it.place + 1);
        let term = follows.term.saturating_add(rank as u32);
        *follows = Follows { term, heard_ms: now, ..Follows::new(robot) };
        self.run.takeovers += 1;
        let copied = copy.is_some();
        self.note(|t_ms| Record::TakesOver { t_ms, robot, copied });
        let version = copy.as_ref().map_or(0, |it| it.version);
        let office = Office { term, version, met: 1 << robot, ..Office::default() };
        let fresh = Auctioneer::new(self.scenario);
        let ledger = copy.map(|it| it.ledger);
        let ledger = ledger.unwrap_or_else(|| {
            let rounds = term.saturating_mul(ROUNDS_OF_A_TERM);
            Rc::new(Ledger { round: rounds, ..fresh.ledger() })
        });
        self.auctioneer = fresh.successor(robot, &ledger, office);
        self.auctioneer.last_heard.fill(now);
        for task in 0..self.known.len() {
            self.learn(task);
        }
        self.auctioneer.begin(now);
        self.tell(!(1 << robot));
    }

    /// Takes a task over from the copy of a new auctioneer.
    fn learn(&mut self, task: usize) {
        let (now, fate) = (self.now, self.run.fates[task]);
        let ticket = self.auctioneer.ticket_mut(task);
        match (fate, ticket.state) {
            (Fate::Done, _) => ticket.state = State::Done,
            (Fate::Reported, _) => ticket.state = State::Reported,
            (Fate::Open, State::Unknown) => {
                if let Some(since) = self.known[task] {
                    self.take_on(task, since);
                }
            }
            (Fate::Open, State::Announced) => ticket.state = State::Open,
            (Fate::Open, State::Awarded | State::Executing | State::Withdrawn) => {
                ticket.until.fill(now + LEASE);
                ticket.wait_anew(now);
            }
            (Fate::Open, State::Open | State::Done | State::Reported) => {}
        }
    }

    /// With the laptop of its robot an auctioneer is gone.
    pub(super) fn auctioneer_dies_with(&mut self, robot: usize) {
        if self.auctioneer.up && self.auctioneer.address == robot {
            self.auctioneer.up = false;
            let term = self.auctioneer.office.term;
            self.auctioneer.office = Office { term, ..Office::default() };
            if self.open > 0 {
                self.nobody_takes_on();
            }
        } else if !self.somebody_is_there() && self.has_successors() {
            self.nobody_takes_on();
        }
    }

    /// Nobody is there to take a task on. Without successors whoever gave it gives it up.
    pub(super) fn nobody_takes_on(&mut self) {
        let some = self.somebody_is_there();
        if !(self.has_successors() && some) {
            self.queue.push(self.now + GIVEN_UP, 0, Event::GivenUp);
        }
    }

    /// Whoever gave tasks to the team gives them up.
    pub(super) fn given_up(&mut self) {
        for task in 0..self.known.len() {
            if self.known[task].is_some() && self.run.fates[task] == Fate::Open {
                let why = "nothing is heard of who gives tasks out".to_owned();
                self.note(|t_ms| Record::Reported { t_ms, task, why });
                self.ends(task, Fate::Reported);
            }
        }
    }
}
