//! Bidders and brokers: what a robot asks for a role, and which coalition a broker bids.

use super::robot::Asking;
use super::{Event, World};
use crate::fleet::allocate::is_shared;
use crate::fleet::bid::{Offer, Whereabouts};
use crate::fleet::charge::Errand;
use crate::fleet::message::{Message, Party};
use cotama_models::team::scenario::{Outlook, Quote, RoleSpec, Spot, Take};
use cotama_models::team::{CapabilitySet, Skill};
use std::rc::Rc;

/// A broker asks again after so long, in ms, and bids at the third time with what it has.
const ASK_AGAIN: u64 = 200;
const TRIES: u32 = 3;

impl World<'_> {
    /// Tasks are announced: the broker bids, or asks bidders first.
    pub(super) fn announced(&mut self, robot: usize, round: u32, tasks: &Rc<[usize]>) {
        let agent = &mut self.robots[robot];
        if round < agent.heard {
            return;
        }
        agent.heard = round;
        let several = tasks
            .iter()
            .any(|&it| self.scenario.tasks[it].plans.iter().any(|it| it.roles.len() > 1));
        if !(several && is_shared(self.scenario)) {
            let offers = self.offers(robot, tasks);
            self.robots[robot].offered = round;
            self.bid(robot, round, offers.into(), None);
            return;
        }
        match &self.robots[robot].asking {
            Some(it) if it.round == round && it.answered => self.bid_for_coalition(robot),
            Some(it) if it.round == round => {}
            _ => {
                let (replies, tries, answered) = (Vec::new(), 0, false);
                let tasks = Rc::clone(tasks);
                self.robots[robot].asking = Some(Asking { round, tasks, replies, tries, answered });
                self.ask(robot);
            }
        }
    }

    /// Asks the bidders that have not replied.
    fn ask(&mut self, robot: usize) {
        let Some(asking) = &self.robots[robot].asking else { return };
        let (round, tasks) = (asking.round, Rc::clone(&asking.tasks));
        let silent = |it: &usize| !asking.replies.iter().any(|reply| reply.0 == *it);
        let silent: Vec<usize> = (0..self.robots.len()).filter(silent).collect();
        for other in silent {
            let tasks = Rc::clone(&tasks);
            let to = Party::Robot(other);
            self.send(Party::Robot(robot), to, Message::Request { round, tasks });
        }
        self.queue.push(self.now + ASK_AGAIN, 1, Event::Replies(robot, round));
    }

    /// A bidder replied; when all have, the broker bids.
    pub(super) fn replied(&mut self, robot: usize, from: usize, round: u32, offers: Rc<[Offer]>) {
        let all = self.robots.len();
        let Some(asking) = &mut self.robots[robot].asking else { return };
        if asking.round != round || asking.replies.iter().any(|it| it.0 == from) {
            return;
        }
        asking.replies.push((from, offers));
        if asking.replies.len() == all && !asking.answered {
            self.bid_for_coalition(robot);
        }
    }

    pub(super) fn replies_are_due(&mut self, robot: usize, round: u32) {
        if !self.is_there(robot) {
            return;
        }
        let Some(asking) = &mut self.robots[robot].asking else { return };
        if asking.round != round || asking.answered {
            return;
        }
        asking.tries += 1;
        if asking.tries < TRIES {
            self.ask(robot);
        } else {
            self.bid_for_coalition(robot);
        }
    }

    /// The best coalition among those that the broker answers for.
    fn bid_for_coalition(&mut self, robot: usize) {
        let Some(asking) = &mut self.robots[robot].asking else { return };
        asking.answered = true;
        asking.replies.sort_by_key(|it| it.0);
        let replies: Vec<(usize, &[Offer])> =
            asking.replies.iter().map(|it| (it.0, &*it.1)).collect();
        let Some(&task) = asking.tasks.first() else { return };
        let best = self.allocator.best_of_shares(self.scenario, robot, task, &replies);
        let round = asking.round;
        self.bid(robot, round, Rc::new([]), best);
    }

    fn bid(
        &mut self,
        robot: usize,
        round: u32,
        offers: Rc<[Offer]>,
        coalition: Option<crate::fleet::bid::Share>,
    ) {
        let message = Message::Bid { round, offers, coalition };
        self.send(Party::Robot(robot), self.desk(robot), message);
    }

    /// Returns the offers of a robot for the roles of these tasks: none where it cannot, or is
    /// busy.
    pub(super) fn offers(&self, robot: usize, tasks: &[usize]) -> Vec<Offer> {
        let agent = &self.robots[robot];
        if agent.is_busy() || !self.works(robot) {
            return Vec::new();
        }
        // A robot with an object on board works for its task only.
        let tasks = tasks.iter().copied().filter(|it| agent.holds.is_none_or(|held| held == *it));
        let tasks = tasks.filter(|it| !agent.left.contains(it));
        let mut offers = Vec::new();
        for task in tasks {
            for (plan, spec) in self.scenario.tasks[task].plans.iter().enumerate() {
                for (role, spec) in spec.roles.iter().enumerate() {
                    let skills = &agent.skills;
                    let quote = |skills| self.quote(robot, task, spec, skills);
                    let Some(Quote { cost_ms, success }) = quote(skills.trusted()) else {
                        continue;
                    };
                    let known = skills.risky_uses().and_then(|_| quote(skills.known()));
                    let known_ms = known.map_or(cost_ms, |it| it.cost_ms);
                    offers.push(Offer { task, plan, role, cost_ms, success, known_ms });
                }
            }
        }
        offers
    }

    /// Returns the capabilities of a robot with regard to the object of a task.
    pub(super) fn able(&self, robot: usize, task: usize, role: &RoleSpec) -> CapabilitySet {
        let able = self.robots[robot].skills.capabilities();
        let takes = role.take == Take::Object && self.robots[robot].holds != Some(task);
        if takes { able.without(self.objects[task].hidden) } else { able }
    }

    /// Returns the bid of a robot for a role; `None` where it cannot.
    fn quote(&self, robot: usize, task: usize, role: &RoleSpec, skills: &[Skill]) -> Option<Quote> {
        let agent = &self.robots[robot];
        let able = self.able(robot, task, role);
        let spec = &self.scenario.robots[robot];
        let outlook = Outlook {
            robot: spec,
            skills,
            able,
            from: agent.spot,
            pace: agent.driver.pace()?,
            ends: self.places(robot, task, role)?,
            holds: role.take == Take::Object && agent.holds == Some(task),
            seen: agent.passages.seen(),
        };
        if self.is_short(robot, role, &outlook) {
            return None;
        }
        let quote = self.scenario.quote(role, &outlook)?;
        let slowed = spec.pace(0) > Some(outlook.pace);
        if self.planted == Some(super::Planted::BidsInSeconds) && slowed {
            return Some(Quote { cost_ms: quote.cost_ms / 1_000, ..quote });
        }
        Some(quote)
    }

    /// Returns the spots where a robot takes and gives in a role; `None` where the object is
    /// delivered.
    pub(super) fn places(&self, robot: usize, task: usize, role: &RoleSpec) -> Option<[Spot; 2]> {
        let object = match self.objects[task].at {
            Whereabouts::Lies(spot) => spot,
            Whereabouts::Held(other) if other == robot => self.robots[robot].spot,
            // Nobody knows where to meet a robot that drives home.
            Whereabouts::Held(other)
                if role.take == Take::Object && self.robots[other].errand == Some(Errand::Home) =>
            {
                return None;
            }
            Whereabouts::Held(other) => self.spot(other),
            // Nobody looks for it where the role takes none.
            Whereabouts::Delivered if role.take == Take::Object => return None,
            Whereabouts::Delivered => Spot::at(self.scenario.tasks[task].goal),
        };
        Some(self.scenario.ends(task, role, object))
    }

    /// Whether some robots that can work can do a task together.
    pub(super) fn others_can(&mut self, task: usize) -> bool {
        let fit = (0..self.robots.len()).filter(|it| self.works(*it));
        let fit: Vec<usize> = fit.collect();
        let spec = &self.scenario.tasks[task];
        let can: Vec<Vec<Vec<bool>>> = spec
            .plans
            .iter()
            .map(|plan| {
                let of = |role: &RoleSpec| {
                    let able = |it: &usize| role.possible(self.able(*it, task, role));
                    fit.iter().map(able).collect()
                };
                plan.roles.iter().map(of).collect()
            })
            .collect();
        let place = |robot: usize| fit.iter().position(|it| *it == robot);
        self.allocator.can_staff(spec, &fit, |plan, role, robot| {
            place(robot).is_some_and(|at| can[plan][role][at])
        })
    }
}
