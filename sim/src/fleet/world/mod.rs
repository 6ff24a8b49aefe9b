//! A run: robots, auctioneer and network, from event to event.

mod acting;
mod auctioneer;
mod awards;
mod bidding;
mod office;
mod robot;
mod sound;
mod succession;
mod supply;
#[cfg(test)]
mod tests;
mod working;

use super::allocate::Allocator;
use super::driver::Driver;
use super::message::{Ending, Letter, Message, Party};
use super::network::Network;
use super::passages::Passages;
use super::record::{Fate, Record, Run};
use super::skills::Skills;
use crate::fleet::bid::{Object, Whereabouts};
use crate::kernel::Queue;
use crate::streams::Streams;
use auctioneer::Auctioneer;
use cotama_models::team::CapabilitySet;
use cotama_models::team::scenario::Spot;
use cotama_models::team::scenario::{FaultKind, FaultTime, RobotSpec, Row, Scenario, Stage, Trust};
use office::Follows;
use robot::{Agent, Duty};

/// A robot says so often how it is, and looks at its terms so often, in ms.
pub(super) const BEAT: u64 = 2_000;
/// The auctioneer looks at its tasks so often, in ms.
pub(super) const TICK: u64 = 250;
/// An award holds for so long after it was last prolonged, in ms.
pub(super) const LEASE: u64 = 20_000;
/// A run ends when nothing has become known, been done or been reported for so long, in ms.
const STUCK: u64 = 3_600_000;

/// The next event.
#[derive(Clone, Debug)]
enum Event {
    /// A letter arrives.
    Arrives(Box<Letter>),
    /// A round of the decisional component of a robot.
    Round(usize),
    /// A robot says how it is.
    Beat(usize),
    /// The auctioneer looks at its tasks.
    Tick,
    /// A broker looks at the replies of this round.
    Replies(usize, u32),
    /// A task becomes known.
    Opens(usize),
    /// Something goes wrong: the number of the fault.
    Fault(usize),
    /// Whoever gave tasks to an auctioneer that nobody follows gives them up.
    GivenUp,
    /// The battery of a robot is full.
    Charged(usize),
}

/// A defect planted on purpose, so that it can be measured what finds it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Planted {
    /// Awards do not end by themselves: a robot that hears nothing works on.
    NoLease,
    /// The auctioneer waits for all bids, however long.
    NoDeadline,
    /// A robot says once that its role is over, whether it is heard or not.
    SaysOnce,
    /// Letters of the auctioneer leave before its successors have a copy of their reason.
    NotCopied,
    /// A robot that drives more slowly than it can when nothing has failed bids in seconds.
    BidsInSeconds,
    /// Robots count no use of their skills.
    StaleReliability,
    /// A successor takes over after a silence of a second, whatever it promised.
    TakesOverEarly,
}

/// A run under way.
#[derive(Debug)]
pub(super) struct World<'s> {
    scenario: &'s Scenario,
    now: u64,
    queue: Queue<Event>,
    network: Network,
    robots: Vec<Agent>,
    auctioneer: Auctioneer,
    allocator: Allocator,
    objects: Vec<Object>,
    /// How often a robot came to a stage of a task: for faults that wait for it.
    visits: Vec<(usize, usize, Stage, u32)>,
    records: Option<Vec<Record>>,
    run: Run,
    /// Tasks that are neither done nor reported.
    open: usize,
    /// When each task became known to who gives it to the team.
    known: Vec<Option<u64>>,
    /// When a task last became known or ended.
    stirred: u64,
    planted: Option<Planted>,
}

impl<'s> World<'s> {
    pub(super) fn new(scenario: &'s Scenario, recorded: bool, planted: Option<Planted>) -> Self {
        let tasks = scenario.tasks.len();
        let streams = Streams::new(scenario.seed);
        let agent = |spec: &RobotSpec| {
            let driver = Driver::new(&spec.file, false);
            let stale = planted == Some(Planted::StaleReliability);
            let trust = if stale { Trust::Stated } else { scenario.trust };
            let skills = Skills::new(spec, &scenario.skills, trust, streams);
            let follows =
                Follows::new(scenario.auctioneer.robot().unwrap_or(scenario.robots.len()));
            let passages = Passages::new(scenario, spec, streams);
            Agent::new(driver, Spot::at(spec.start), (skills, passages), follows, spec)
        };
        let lies = |it: &cotama_models::team::scenario::TaskSpec| Object {
            at: Whereabouts::Lies(Spot::at(it.start)),
            hidden: CapabilitySet::NONE,
        };
        let mut world = Self {
            scenario,
            now: 0,
            queue: Queue::new(),
            network: Network::new(scenario.network, streams),
            robots: scenario.robots.iter().map(agent).collect(),
            auctioneer: Auctioneer::new(scenario),
            allocator: Allocator::default(),
            objects: scenario.tasks.iter().map(lies).collect(),
            visits: Vec::new(),
            records: recorded.then(Vec::new),
            run: Run {
                fates: vec![Fate::Open; tasks],
                ended_ms: vec![0; tasks],
                deliveries: vec![0; tasks],
                awards: vec![0; tasks],
                ..Run::default()
            },
            open: tasks,
            known: vec![None; tasks],
            stirred: scenario.tasks.iter().map(|it| it.arrival_ms).max().unwrap_or(0),
            planted,
        };
        for (task, spec) in scenario.tasks.iter().enumerate().filter(|it| it.1.after.is_none()) {
            world.queue.push(spec.arrival_ms, 0, Event::Opens(task));
        }
        for (number, fault) in scenario.faults.iter().enumerate() {
            if let FaultTime::At(at) = fault.when {
                world.queue.push(at, 0, Event::Fault(number));
            }
        }
        let count = scenario.robots.len() as u64;
        for robot in 0..scenario.robots.len() {
            world.queue.push(robot as u64 * BEAT / count.max(1), 1, Event::Beat(robot));
        }
        world.queue.push(0, 2, Event::Tick);
        world
    }

    /// Takes rounds of decisional components in which nothing happens, too: they change nothing.
    #[cfg(test)]
    pub(super) fn in_every_round(mut self) -> Self {
        let specs = &self.scenario.robots;
        let driver = |it: &RobotSpec| Driver::new(&it.file, true);
        self.robots.iter_mut().zip(specs).for_each(|it| it.0.driver = driver(it.1));
        self
    }

    /// Runs until each task is done or reported.
    pub(super) fn run(self) -> (Run, Vec<Record>) {
        self.run_and_look(|_| ())
    }

    /// Runs in the same way, and lets somebody look at the world after each event.
    fn run_and_look(mut self, mut look: impl FnMut(&Self)) -> (Run, Vec<Record>) {
        while let Some((now, event)) = self.queue.pop() {
            debug_assert!(now >= self.now, "time goes back");
            if now > self.stirred + STUCK || self.open == 0 {
                break;
            }
            self.now = now;
            match event {
                Event::Arrives(letter) => self.deliver(*letter),
                Event::Round(robot) => self.round(robot),
                Event::Beat(robot) => self.beat(robot),
                Event::Tick => {
                    self.gives_out();
                    self.queue.push(now + TICK, 2, Event::Tick);
                }
                Event::Replies(robot, round) => self.replies_are_due(robot, round),
                Event::Opens(task) => self.open(task),
                Event::Fault(number) => self.fault(number),
                Event::GivenUp => self.given_up(),
                Event::Charged(robot) => self.charged(robot),
            }
            self.copy_first();
            debug_assert_eq!(self.defect(), None, "after an event at {now} ms");
            look(&self);
        }
        let tasks = self.scenario.tasks.iter().zip(&self.run.fates);
        let undone = tasks.filter(|it| *it.1 != Fate::Done).map(|it| u64::from(it.0.utility_ms));
        self.run.cost_ms = self.run.busy_ms + undone.sum::<u64>();
        self.run.end_ms = self.run.ended_ms.iter().copied().max().unwrap_or(0);
        (self.run.messages, self.run.lost) = (self.network.sent(), self.network.lost());
        self.run.copies = self.network.copied();
        let energy = self.robots.iter().map(|it| it.driver.energy_mj(self.now));
        self.run.energy_mj = energy.sum();
        self.run.skills = self.skill_uses();
        self.run.out = self.robots.iter().filter(|it| !it.is_fit()).count();
        (self.run, self.records.unwrap_or_default())
    }

    fn note(&mut self, record: impl FnOnce(u64) -> Record) {
        if let Some(records) = &mut self.records {
            records.push(record(self.now));
        }
    }

    fn send(&mut self, from: Party, to: Party, message: Message) {
        let of_auctioneer = matches!(from, Party::Auctioneer(_));
        let term = if of_auctioneer { self.auctioneer.office.term } else { 0 };
        let letter = Letter { from, to, term, message };
        if of_auctioneer && self.has_successors() {
            self.send_when_copied(letter);
        } else {
            self.post(&letter);
        }
    }

    /// A letter leaves.
    fn post(&mut self, letter: &Letter) {
        for at in self.network.carry(self.now, letter) {
            self.queue.push(at, 1, Event::Arrives(Box::new(letter.clone())));
        }
    }

    fn deliver(&mut self, letter: Letter) {
        match letter.to {
            Party::Robot(robot) if self.is_there(robot) => {
                if self.is_followed(robot, letter.from, letter.term) {
                    self.hear(robot, letter.from, letter.message);
                }
            }
            Party::Auctioneer(address) => {
                let is_it = address == self.auctioneer.address && self.auctioneer.up;
                if let (Party::Robot(robot), true) = (letter.from, is_it) {
                    self.auctioneer_hears(robot, letter.message);
                }
            }
            Party::Robot(_) => {}
        }
    }

    /// Something goes wrong.
    fn fault(&mut self, number: usize) {
        match self.scenario.faults[number].what {
            FaultKind::Robot(robot, mode) => self.fails(robot, mode),
            FaultKind::Auctioneer(mode) => {
                let address = self.auctioneer.address;
                let row = self.scenario.row_of(address, mode).filter(|_| self.auctioneer.up);
                if let Some(row) = row {
                    self.fails(address, row);
                }
            }
            FaultKind::Shifted(task) => {
                self.note(|t_ms| Record::Shifted { t_ms, task });
                self.shifted(task);
            }
            FaultKind::Turned(task, hides) => {
                self.note(|t_ms| Record::Turned { t_ms, task });
                self.objects[task].hidden = hides;
                self.turned(task);
            }
        }
    }

    /// Returns the short name of a row of a robot's file.
    fn mode(&self, robot: usize, row: Row) -> String {
        row.name(self.scenario.robots[robot].file.robot()).to_owned()
    }

    fn fails(&mut self, robot: usize, mode: Row) {
        let name = self.mode(robot, mode);
        self.note(|t_ms| Record::Fails { t_ms, robot, mode: name });
        self.robots[robot].driver.fail(self.now, mode);
        if self.robots[robot].driver.thinks() {
            self.wake(robot);
        } else {
            self.dies(robot);
        }
    }

    /// A task becomes known to who gives it to the team.
    fn open(&mut self, task: usize) {
        self.note(|t_ms| Record::Opened { t_ms, task });
        self.known[task] = Some(self.now);
        if self.auctioneer.up {
            self.take_on(task, self.now);
        } else {
            self.nobody_takes_on();
        }
    }

    /// A task is done or reported: nobody is to work for it any more.
    fn ends(&mut self, task: usize, fate: Fate) {
        if self.run.fates[task] != Fate::Open {
            return;
        }
        self.run.fates[task] = fate;
        self.open -= 1;
        self.stirred = self.stirred.max(self.now);
        self.run.ended_ms[task] = self.now;
        if fate == Fate::Done {
            self.run.waited_ms += self.now - self.known[task].unwrap_or(self.now);
        } else if let Whereabouts::Held(robot) = self.objects[task].at {
            // Somebody comes for it: the robot is free for others.
            self.objects[task].at = Whereabouts::Lies(self.spot(robot));
            self.robots[robot].holds = None;
        }
        let follows =
            |it: &(usize, &cotama_models::team::scenario::TaskSpec)| it.1.after == Some(task);
        let after: Vec<usize> =
            self.scenario.tasks.iter().enumerate().filter(follows).map(|it| it.0).collect();
        for next in after {
            if fate == Fate::Done {
                self.queue.push(self.now, 0, Event::Opens(next));
            } else {
                self.note(|t_ms| Record::Reported {
                    t_ms,
                    task: next,
                    why: "the task before it was not done".into(),
                });
                self.ends(next, Fate::Reported);
            }
        }
    }

    /// Notes where a robot is, on a floor that is drawn.
    fn note_spot(&mut self, robot: usize) {
        if self.records.is_some() && self.scenario.floor.is_drawn() {
            let Spot { from, to, done_mm } = self.spot(robot);
            let (from, to) = (from.0, to.0);
            self.note(|t_ms| Record::At { t_ms, robot, from, to, done_mm });
        }
    }

    /// Returns the spot of a robot.
    fn spot(&self, robot: usize) -> Spot {
        let agent = &self.robots[robot];
        let Some(goal) = agent.drives_to() else { return agent.spot };
        self.scenario.floor.gone(agent.spot, goal, agent.driver.driven_mm(self.now))
    }

    /// The robots that somebody works with on an award of a task.
    fn workers(&self, task: usize) -> impl Iterator<Item = (usize, u32)> + '_ {
        self.robots.iter().enumerate().filter_map(move |(robot, it)| match &it.duty {
            Duty::Executing(work) if work.award.id.task == task => {
                Some((robot, work.award.id.round))
            }
            _ => None,
        })
    }

    fn release(&mut self, robot: usize, award: super::message::AwardId, ending: Ending) {
        let (from, to) = (self.auctioneer.party(), Party::Robot(robot));
        self.send(from, to, Message::Release { award, ending });
    }
}
