//! Runs take the steps of the checked nets, and keep their requirements.

use crate::fleet::record::Run;
use crate::fleet::scenarios::{FleetOptions, fleet};
use crate::fleet::world::auctioneer::State;
use crate::fleet::world::robot::Duty;
use crate::fleet::world::{Planted, World};
use cotama_core::team::RobotSet;
use cotama_models::team::protocol::{Team, net};
use cotama_models::team::scenario::Scenario;
use std::collections::{BTreeMap, BTreeSet};

/// The steps from place to place that the net of three robots allows the first task, or robot.
fn steps(places: &[(&str, &'static str)]) -> BTreeSet<(&'static str, &'static str)> {
    let net = net(&Team::new(3, 2));
    let word = |at: usize| {
        let name = &net.places[at].name;
        places.iter().find(|it| it.0 == name).map(|it| it.1)
    };
    let mut all = BTreeSet::new();
    for it in &net.transitions {
        let ends = |arcs: &[cotama_core::net::Arc]| -> Vec<&'static str> {
            arcs.iter().filter_map(|it| word(it.place.0 as usize)).collect()
        };
        for from in ends(&it.take) {
            all.extend(ends(&it.give).into_iter().map(|to| (from, to)).filter(|it| it.0 != it.1));
        }
    }
    all
}

/// One event may take two of them.
fn twice(steps: &BTreeSet<(&'static str, &'static str)>) -> BTreeSet<(&'static str, &'static str)> {
    let next = |from: &'static str| steps.iter().filter(move |it| it.0 == from);
    let two = steps.iter().flat_map(|one| next(one.1).map(|two| (one.0, two.1)));
    steps.iter().copied().chain(two).collect()
}

/// The phases of a task; to announce again is no step, as the net keeps what was announced.
fn of_a_task() -> BTreeSet<(&'static str, &'static str)> {
    steps(&[
        ("t1.open", "wanted"),
        ("t1.announced", "wanted"),
        ("t1.awarded", "awarded"),
        ("t1.executing", "executing"),
        ("t1.withdrawn", "withdrawn"),
        ("t1.done", "done"),
        ("t1.reported", "reported"),
    ])
}

fn of_a_robot() -> BTreeSet<(&'static str, &'static str)> {
    steps(&[
        ("r1.idle", "idle"),
        ("r1.waiting.t1", "waiting"),
        ("r1.executing.t1", "executing"),
        ("r1.down", "down"),
    ])
}

fn phase(state: State) -> &'static str {
    match state {
        State::Unknown => "unknown",
        State::Open | State::Announced => "wanted",
        State::Awarded => "awarded",
        State::Executing => "executing",
        State::Withdrawn => "withdrawn",
        State::Done => "done",
        State::Reported => "reported",
    }
}

/// Observations of a run.
#[derive(Default)]
struct Seen {
    tasks: Vec<&'static str>,
    robots: Vec<&'static str>,
    /// The leader, and its term; nobody after its robot failed.
    leader: Option<(usize, u32)>,
    vacant: bool,
    /// The members that have acknowledged an award.
    acked: BTreeMap<(usize, u32), RobotSet>,
    /// Steps that the nets do not know, and requirements that are broken.
    steps: BTreeSet<(&'static str, &'static str)>,
    broken: BTreeSet<&'static str>,
}

impl Seen {
    fn look(&mut self, world: &World<'_>) {
        let auctioneer = &world.auctioneer;
        let now = (auctioneer.address, auctioneer.office.term);
        let same = self.leader == Some(now);
        if !same && self.leader.is_some() && !self.vacant {
            self.broken.insert("S7");
        }
        (self.leader, self.vacant) = (Some(now), !auctioneer.up);
        self.tasks.resize(auctioneer.tickets.len(), "unknown");
        for (task, ticket) in auctioneer.tickets.iter().enumerate() {
            let phase = phase(ticket.state);
            let before = std::mem::replace(&mut self.tasks[task], phase);
            // A successor goes on from what was copied to it.
            if same && before != phase && before != "unknown" {
                self.steps.insert((before, phase));
            }
            if before == "done" && phase != "done" {
                self.broken.insert("S6");
            }
        }
        self.one_award_a_task(world);
        let duty = |it: &crate::fleet::world::Agent| match &it.duty {
            _ if !it.driver.thinks() => "down",
            Duty::Free => "idle",
            Duty::Waiting(_) => "waiting",
            Duty::Executing(_) => "executing",
        };
        let robots: Vec<_> = world.robots.iter().map(duty).collect();
        for (before, after) in self.robots.iter().zip(&robots).filter(|it| it.0 != it.1) {
            self.steps.insert((*before, *after));
        }
        self.robots = robots;
        for (robot, agent) in world.robots.iter().enumerate() {
            let Some(work) = agent.work() else { continue };
            let id = (work.award.id.task, work.award.id.round);
            let acked = self.acked.entry(id).or_default();
            *acked |= 1 << robot;
            if agent.offered < work.award.id.round {
                self.broken.insert("S5");
            }
        }
        for agent in &world.robots {
            if let Duty::Executing(work) = &agent.duty {
                let id = (work.award.id.task, work.award.id.round);
                let acked = self.acked.get(&id).copied().unwrap_or(0);
                if work.award.members & !acked != 0 {
                    self.broken.insert("S3");
                }
            }
        }
    }
}

impl Seen {
    /// Nobody works for a task that is wanted or over, and all that do work for the same award.
    fn one_award_a_task(&mut self, world: &World<'_>) {
        let mut awards = BTreeMap::new();
        for it in &world.robots {
            let Duty::Executing(work) = &it.duty else { continue };
            let id = work.award.id;
            let other = awards.insert(id.task, id.round).is_some_and(|it| it != id.round);
            let over = matches!(self.tasks[id.task], "wanted" | "done" | "reported");
            if other || over {
                self.broken.insert("S1");
            }
        }
    }
}

/// A run, with what was seen of it.
fn watched(scenario: &Scenario, planted: Option<Planted>) -> (Run, Seen) {
    let mut seen = Seen::default();
    let run = World::new(scenario, false, planted).run_and_look(|it| seen.look(it)).0;
    (run, seen)
}

/// Robots of which auctioneers are killed at any moment.
fn killed(robots: usize, tasks: usize, seed: u64) -> Scenario {
    let loss_permille = [0, 50, 100, 200][seed as usize % 4];
    let options = FleetOptions { robots, tasks, loss_permille, seed, ..FleetOptions::default() };
    let failures = robots / 8;
    fleet(&FleetOptions { takeover: true, kills: 3, failures, ..options })
}

fn conforms(scenario: &Scenario) -> u32 {
    let (run, seen) = watched(scenario, None);
    let known: BTreeSet<_> = twice(&of_a_task()).union(&twice(&of_a_robot())).copied().collect();
    let unknown: Vec<_> = seen.steps.difference(&known).collect();
    let what = (scenario.seed, unknown, seen.broken, run.is_sound());
    assert_eq!(what, (scenario.seed, vec![], BTreeSet::new(), true), "{run:?}");
    run.takeovers
}

#[test]
fn tasks_robots_and_auctioneers_take_the_steps_of_the_checked_nets() {
    let takeovers: u32 = (0..8).map(|seed| conforms(&killed(8, 24, seed))).sum();
    assert!(takeovers > 8, "{takeovers}");
}

#[test]
#[ignore = "takes minutes"]
fn a_thousand_fleets_of_forty_robots_conform_to_the_checked_nets() {
    let takeovers: u32 = (0..1_000).map(|seed| conforms(&killed(40, 200, seed))).sum();
    println!("{takeovers} takeovers in 1,000 runs");
}

/// The checks can fail.
#[test]
fn takeovers_without_copies_or_promises_are_seen() {
    let found = |planted| {
        let of = |seed| {
            let (run, seen) = watched(&killed(8, 24, seed), Some(planted));
            !run.is_sound() || !seen.broken.is_empty()
        };
        (0..12).filter(|it| of(*it)).count()
    };
    assert!(found(Planted::TakesOverEarly) > 0);
    assert!(found(Planted::NotCopied) > 0);
}
