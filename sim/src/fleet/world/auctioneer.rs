//! The auctioneer: it announces, awards, watches, and puts up again.

use super::office::Office;
use super::{Planted, World};
use crate::fleet::allocate::{Allocator, denominator, is_shared};
use crate::fleet::bid::{Offer, Share};
pub(super) use crate::fleet::ledger::{Ledger, State, Ticket};
use crate::fleet::message::{Kind, Message, Party, Status};
use crate::fleet::record::Record;
use cotama_core::team::RobotSet;
use cotama_models::team::scenario::Scenario;
use std::rc::Rc;

/// Bids are waited for so long, in ms; who is silent is asked again after a third of it.
const BIDS: u64 = 1_500;
/// Between two auctions so much time passes at least, in ms.
const PAUSE: u64 = 1_000;
/// And so much if nothing was awarded and nothing has changed, in ms.
const VAIN_PAUSE: u64 = 5_000;
/// Silence in ms after which a robot is not waited for.
const SILENCE: u64 = 7_000;
/// A task is reported after so many auctions without a bid although nobody was busy who could bid
/// later.
const MOST_VAIN: u32 = 3;
/// So many tasks are announced at once; the oldest first.
const ANNOUNCED: usize = 32;

/// An auction under way.
#[derive(Clone, Debug)]
struct Auction {
    round: u32,
    tasks: Rc<[usize]>,
    /// Robots that are waited for, and those that have bid.
    wanted: RobotSet,
    heard: RobotSet,
    bids: Vec<(usize, Rc<[Offer]>)>,
    shares: Vec<Share>,
    resend: u64,
    deadline: u64,
}

/// The state of the auctioneer.
#[derive(Clone, Debug)]
pub(super) struct Auctioneer {
    pub(super) address: usize,
    /// Whether it is there: with the laptop of its robot it is gone.
    pub(super) up: bool,
    /// The robots that may take over from it, and what they are told first.
    pub(super) office: Office,
    round: u32,
    auction: Option<Auction>,
    next_auction: u64,
    pub(super) tickets: Vec<Rc<Ticket>>,
    /// Tasks that are neither unknown nor over.
    live: Vec<usize>,
    /// Time of the last message of each robot, and its contents.
    pub(super) last_heard: Vec<u64>,
    busy: RobotSet,
    unfit: RobotSet,
}

impl Auctioneer {
    pub(super) fn new(scenario: &Scenario) -> Self {
        let ticket = Ticket {
            state: State::Unknown,
            known_since: 0,
            award: None,
            acked: 0,
            completed: 0,
            gone: 0,
            until: Vec::new(),
            resend: 0,
            deadline: 0,
            awards: 0,
            vain: 0,
            finished: false,
            report: None,
            past: Vec::new(),
        };
        Self {
            address: scenario.auctioneer.robot().unwrap_or(scenario.robots.len()),
            up: true,
            office: Office::default(),
            round: 0,
            auction: None,
            next_auction: 0,
            tickets: std::iter::repeat_n(Rc::new(ticket), scenario.tasks.len()).collect(),
            live: Vec::new(),
            last_heard: vec![0; scenario.robots.len()],
            busy: 0,
            unfit: 0,
        }
    }

    pub(super) fn ticket_mut(&mut self, task: usize) -> &mut Ticket {
        Rc::make_mut(&mut self.tickets[task])
    }

    /// The knowledge that another needs to go on.
    pub(super) fn ledger(&self) -> Ledger {
        Ledger { round: self.round, tickets: self.tickets.clone() }
    }

    /// An auctioneer that goes on with what another one knew.
    pub(super) fn successor(self, address: usize, ledger: &Ledger, office: Office) -> Self {
        let (round, tickets) = (ledger.round, ledger.tickets.clone());
        let over = |it: &usize| {
            !matches!(tickets[*it].state, State::Unknown | State::Done | State::Reported)
        };
        let live = (0..tickets.len()).filter(over).collect();
        Self { address, office, round, tickets, live, ..self }
    }

    pub(super) const fn party(&self) -> Party {
        Party::Auctioneer(self.address)
    }

    /// Something is open or somebody free: an auction may come to more than the last.
    pub(super) fn changed(&mut self, now: u64) {
        self.next_auction = self.next_auction.min(now + PAUSE);
    }

    /// The first auction is when robots have been told.
    pub(super) fn begin(&mut self, now: u64) {
        self.next_auction = now + PAUSE;
    }

    /// The robots that were heard of lately.
    fn heard_of(&self, now: u64) -> RobotSet {
        let heard = self.last_heard.iter().enumerate().filter(|it| *it.1 + SILENCE >= now);
        heard.fold(0, |all, it| all | 1 << it.0)
    }

    /// The robots with an award.
    fn engaged(&self) -> RobotSet {
        let awards = self.live.iter().filter_map(|it| {
            let ticket = &self.tickets[*it];
            let award = ticket.award.as_ref()?;
            let works = matches!(ticket.state, State::Awarded | State::Executing);
            works.then_some(award.members & !ticket.completed)
        });
        awards.fold(0, |all, it| all | it)
    }
}

impl World<'_> {
    /// A task becomes known to who gives tasks out.
    pub(super) fn take_on(&mut self, task: usize, known_since: u64) {
        let ticket = self.auctioneer.ticket_mut(task);
        (ticket.state, ticket.known_since) = (State::Open, known_since);
        self.auctioneer.live.push(task);
        self.auctioneer.changed(self.now);
    }

    /// The auctioneer looks at its tasks.
    pub(super) fn tick(&mut self) {
        for task in self.auctioneer.live.clone() {
            match self.auctioneer.tickets[task].state {
                State::Awarded => self.watch_award(task),
                State::Executing => self.watch_work(task),
                State::Withdrawn => self.watch_withdrawal(task),
                _ => {}
            }
        }
        self.auctioneer.live.retain(|it| {
            !matches!(self.auctioneer.tickets[*it].state, State::Done | State::Reported)
        });
        match &self.auctioneer.auction {
            Some(auction) => {
                let (resend, late) = (self.now >= auction.resend, self.now >= auction.deadline);
                if late && self.planted != Some(Planted::NoDeadline) {
                    self.award();
                } else if resend {
                    self.ask_again();
                }
            }
            None if self.now >= self.auctioneer.next_auction => self.announce(),
            None => {}
        }
    }

    /// The bids of the open tasks are asked for.
    fn announce(&mut self) {
        let auctioneer = &self.auctioneer;
        let open = auctioneer.live.iter().copied();
        let open = open.filter(|it| auctioneer.tickets[*it].state == State::Open);
        let mut open: Vec<usize> = open.collect();
        if open.is_empty() {
            return;
        }
        let all: RobotSet = (1 << self.robots.len()) - 1;
        let wanted = auctioneer.heard_of(self.now);
        let engaged = auctioneer.engaged();
        if wanted & !engaged & !auctioneer.unfit == 0 && engaged != 0 {
            return;
        }
        // Brokers share the coalitions of one task.
        let several = |it: usize| self.scenario.tasks[it].plans.iter().any(|it| it.roles.len() > 1);
        if is_shared(self.scenario)
            && let Some(&first) = open.iter().find(|it| several(**it))
        {
            open = vec![first];
        }
        open.truncate(ANNOUNCED);
        self.auctioneer.round += 1;
        let (round, tasks): (u32, Rc<[usize]>) = (self.auctioneer.round, open.into());
        for &task in &*tasks {
            self.auctioneer.ticket_mut(task).state = State::Announced;
        }
        self.auctioneer.auction = Some(Auction {
            round,
            tasks,
            wanted,
            heard: 0,
            bids: Vec::new(),
            shares: Vec::new(),
            resend: self.now + BIDS / 3,
            deadline: self.now + BIDS,
        });
        self.run.rounds += 1;
        self.announce_to(all);
    }

    fn announce_to(&mut self, robots: RobotSet) {
        let Some(auction) = &self.auctioneer.auction else { return };
        let (round, tasks) = (auction.round, Rc::clone(&auction.tasks));
        for robot in (0..self.robots.len()).filter(|it| robots >> it & 1 == 1) {
            let (from, tasks) = (self.auctioneer.party(), Rc::clone(&tasks));
            self.send(from, Party::Robot(robot), Message::Announce { round, tasks });
        }
    }

    fn ask_again(&mut self) {
        let Some(auction) = &mut self.auctioneer.auction else { return };
        auction.resend = self.now + BIDS / 3;
        let silent = auction.wanted & !auction.heard;
        self.announce_to(silent);
    }

    /// Awards tasks from the bids that have come.
    fn award(&mut self) {
        let Some(mut auction) = self.auctioneer.auction.take() else { return };
        auction.bids.sort_by_key(|it| it.0);
        let tickets = &self.auctioneer.tickets;
        let open = auction.tasks.iter().copied();
        let open: Vec<usize> = open.filter(|it| !tickets[*it].finished).collect();
        let waited: Vec<u64> = open.iter().map(|&it| self.now - tickets[it].known_since).collect();
        let bids: Vec<(usize, &[Offer])> = auction.bids.iter().map(|it| (it.0, &*it.1)).collect();
        let (chosen, second) = if auction.shares.is_empty() {
            let chosen = self.allocator.choose(self.scenario, &open, &waited, &bids);
            let undue = undue(&mut self.allocator, self.scenario, (&open, &waited), &bids, &chosen);
            let uses = undue.into_iter().filter_map(|it| self.robots[it].skills.risky_uses());
            self.run.undue.extend(uses);
            let second = chosen.iter().map(|it| second_best(self.scenario, it, &bids)).collect();
            (chosen, second)
        } else {
            best_share(self.scenario, &auction.shares)
        };
        let (round, heard) = (auction.round, auction.heard.count_ones() as usize);
        let (tasks, awards) = (auction.tasks.to_vec(), chosen.len());
        self.note(|t_ms| Record::Round { t_ms, round, tasks, bids: heard, awards });
        // Robots that bid the same again are asked again when something has changed, or later.
        self.auctioneer.next_auction = self.now + if awards > 0 { PAUSE } else { VAIN_PAUSE };
        let mut told: RobotSet = 0;
        for (share, second) in chosen.iter().zip(&second) {
            told |= self.award_to(share, round, *second);
        }
        for robot in (0..self.robots.len()).filter(|it| told >> it & 1 == 0) {
            let (from, until_ms) = (self.auctioneer.party(), 0);
            let message = Message::Assign { award: None, until_ms };
            self.send(from, Party::Robot(robot), message);
        }
        for &task in &*auction.tasks {
            if self.auctioneer.tickets[task].state == State::Announced {
                self.not_awarded(task, &auction);
            }
        }
    }

    /// A task got no award in an auction.
    fn not_awarded(&mut self, task: usize, auction: &Auction) {
        // Offers for some roles of a plan alone never do the task.
        let robots: Vec<usize> = auction.bids.iter().map(|it| it.0).collect();
        let offers = |robot: usize| auction.bids.iter().filter(move |it| it.0 == robot);
        let staffed =
            self.allocator.can_staff(&self.scenario.tasks[task], &robots, |plan, role, robot| {
                let this = |it: &Offer| (it.task, it.plan, it.role) == (task, plan, role);
                offers(robot).any(|it| it.1.iter().any(this))
            });
        let offered = staffed || !auction.shares.is_empty();
        // Whoever was busy and is silent may be gone.
        let busy = self.auctioneer.busy & self.auctioneer.heard_of(self.now);
        let engaged = self.auctioneer.engaged() | busy;
        let ticket = self.auctioneer.ticket_mut(task);
        ticket.state = State::Open;
        if ticket.finished {
            self.close(task);
            return;
        }
        let complete = auction.wanted & !auction.heard == 0;
        // An auction in which somebody was not heard says nothing, for or against.
        ticket.vain = match (offered || engaged != 0, complete) {
            (true, _) => 0,
            (false, true) => ticket.vain + 1,
            (false, false) => ticket.vain,
        };
        if ticket.vain >= MOST_VAIN {
            ticket.report = Some("nobody who is left can do it");
            self.close(task);
        }
    }

    /// Handles a message to the auctioneer.
    pub(super) fn auctioneer_hears(&mut self, robot: usize, message: Message) {
        let (now, auctioneer) = (self.now, &mut self.auctioneer);
        let bit: RobotSet = 1 << robot;
        auctioneer.last_heard[robot] = now;
        auctioneer.office.met |= bit;
        debug_assert!(message.kind() != Kind::Announce);
        match message {
            Message::Alive { busy, fit, asks } => {
                auctioneer.busy = auctioneer.busy & !bit | if busy { bit } else { 0 };
                auctioneer.unfit = auctioneer.unfit & !bit | if fit { 0 } else { bit };
                if asks {
                    let from = auctioneer.party();
                    self.send(from, Party::Robot(robot), Message::Leads);
                }
            }
            Message::Copied { term, version, sent_ms } => {
                auctioneer.office.copied(robot, term, version, sent_ms);
                self.let_go();
            }
            Message::Bid { round, offers, coalition } => {
                let Some(auction) = &mut auctioneer.auction else { return };
                if auction.round != round || auction.heard & bit != 0 {
                    return;
                }
                auction.heard |= bit;
                auction.bids.push((robot, offers));
                auction.shares.extend(coalition);
                if auction.wanted & !auction.heard == 0 {
                    self.award();
                }
            }
            Message::Ack { award } => self.acked(robot, award),
            Message::Nack { award } => self.refused(robot, award),
            Message::Status { award, status } => match status {
                Status::Progress => self.progresses(robot, award),
                Status::Completed => self.completed(robot, award),
                Status::Failed(class) => self.failed(robot, award, class),
            },
            _ => {}
        }
    }
}

/// The robots that are chosen for a task and would not be if all knew how often their skills fail.
fn undue(
    allocator: &mut Allocator,
    scenario: &Scenario,
    (open, waited): (&[usize], &[u64]),
    bids: &[(usize, &[Offer])],
    chosen: &[Share],
) -> Vec<usize> {
    let unlike = |it: &Offer| it.known_ms != it.cost_ms;
    if !bids.iter().flat_map(|it| it.1).any(unlike) {
        return Vec::new();
    }
    let known = |it: &Offer| Offer { cost_ms: it.known_ms, ..*it };
    let known: Vec<(usize, Vec<Offer>)> =
        bids.iter().map(|it| (it.0, it.1.iter().map(known).collect())).collect();
    let known: Vec<(usize, &[Offer])> = known.iter().map(|it| (it.0, &*it.1)).collect();
    let better = allocator.choose(scenario, open, waited, &known);
    let has = |all: &[Share], task: usize, robot: usize| {
        all.iter().any(|it| it.task == task && it.robots.iter().any(|it| it.robot == robot))
    };
    let members =
        chosen.iter().flat_map(|it| it.robots.iter().map(|member| (it.task, member.robot)));
    members.filter(|it| !has(&better, it.0, it.1)).map(|it| it.1).collect()
}

/// The second-best bid for a task of one robot, in ms.
fn second_best(scenario: &Scenario, share: &Share, bids: &[(usize, &[Offer])]) -> Option<u64> {
    if !scenario.second_best || share.robots.len() != 1 {
        return None;
    }
    let costs = bids.iter().flat_map(|it| it.1.iter().map(move |offer| (it.0, offer)));
    let others = costs.filter(|it| {
        it.1.task == share.task && it.1.plan == share.plan && it.0 != share.robots[0].robot
    });
    others.map(|it| u64::from(it.1.cost_ms)).min()
}

/// The best of the coalitions that brokers bid, and what the second best costs.
fn best_share(scenario: &Scenario, shares: &[Share]) -> (Vec<Share>, Vec<Option<u64>>) {
    let mut shares: Vec<&Share> = shares.iter().collect();
    shares.sort_by(|one, other| {
        let rest = |it: &Share| (it.robots.clone(), it.plan);
        let reliable = || other.is_more_reliable(one);
        one.cost.cmp(&other.cost).then_with(reliable).then_with(|| rest(one).cmp(&rest(other)))
    });
    let Some(best) = shares.first() else { return (Vec::new(), Vec::new()) };
    let spec = &scenario.tasks[best.task];
    let parts = u64::from(denominator(spec));
    if best.cost >= u64::from(spec.utility_ms) * parts {
        return (Vec::new(), Vec::new());
    }
    // The utility that a plan yields less is no time of the robot.
    let extra = u64::from(spec.plans[best.plan].extra_ms);
    let second = shares.get(1).map(|it| (it.cost / parts).saturating_sub(extra));
    (vec![(*best).clone()], vec![second])
}
