//! Reactions of the auctioneer to single messages.

mod conformance;

use super::auctioneer::State;
use super::{LEASE, World};
use crate::fleet::Kind;
use crate::fleet::bid::{Member, Offer, Share};
use crate::fleet::message::{AwardId, Message};
use crate::fleet::record::Record;
use crate::fleet::scenarios::{FleetOptions, fleet};
use cotama_models::team::Probability;
use cotama_models::team::scenario::Scenario;

/// Two robots, one task, a network that loses nothing.
fn two_robots() -> Scenario {
    let options = FleetOptions { robots: 2, tasks: 1, failures: 0, ..FleetOptions::default() };
    fleet(&FleetOptions { loss_permille: 0, ..options })
}

/// Both are awarded the task, in round 1.
fn awarded(scenario: &Scenario) -> (World<'_>, AwardId) {
    let mut world = World::new(scenario, true, None);
    world.open(0);
    let success = Probability::ONE;
    let robots = [0, 1].map(|robot| Member { robot, cost_ms: 100, success }).to_vec();
    world.award_to(&Share { task: 0, plan: 0, robots, cost: 200 }, 1, None);
    (world, AwardId { task: 0, round: 1 })
}

fn bid(world: &mut World<'_>, robot: usize, cost_ms: u32) {
    let success = Probability::ONE;
    let offers = [Offer { task: 0, plan: 0, role: 0, cost_ms, success, known_ms: cost_ms }].into();
    world.auctioneer_hears(robot, Message::Bid { round: 1, offers, coalition: None });
}

/// The network copies messages: the first bid of a robot in a round is the one that counts.
#[test]
fn a_robot_bids_once_in_a_round() {
    let scenario = two_robots();
    let mut world = World::new(&scenario, true, None);
    world.open(0);
    world.now += 1_000;
    world.tick();
    for (robot, cost_ms) in [(0, 500), (0, 100), (1, 300)] {
        bid(&mut world, robot, cost_ms);
    }
    let awards = world.records.iter().flatten().filter_map(|it| match it {
        Record::Awarded { robots, costs_ms, .. } => Some((robots.as_slice(), costs_ms.as_slice())),
        _ => None,
    });
    assert!(awards.eq([(&[1][..], &[300][..])]));
}

#[test]
fn an_award_is_told_again_to_those_who_have_not_acknowledged() {
    let scenario = two_robots();
    let (mut world, award) = awarded(&scenario);
    let told = |it: &World<'_>| it.network.sent()[Kind::Assign as usize];
    assert_eq!(told(&world), 2);
    world.acked(0, award);
    world.now += 499;
    world.watch_award(0);
    assert_eq!(told(&world), 2);
    world.now += 1;
    world.watch_award(0);
    assert_eq!(told(&world), 3);
}

#[test]
fn a_task_is_withdrawn_until_the_last_award_has_run_out() {
    let scenario = two_robots();
    let (mut world, award) = awarded(&scenario);
    world.refused(0, award);
    let mut states = Vec::new();
    for now in [LEASE, LEASE + 1] {
        world.now = now;
        world.watch_withdrawal(0);
        states.push(world.auctioneer.tickets[0].state);
    }
    assert_eq!(states, [State::Withdrawn, State::Open]);
}

#[test]
fn a_broken_law_of_a_run_is_named() {
    let scenario = two_robots();
    let (world, _) = awarded(&scenario);
    assert_eq!(world.defect(), None);
    let broken = |break_it: &dyn Fn(&mut World<'_>)| {
        let (mut world, _) = awarded(&scenario);
        break_it(&mut world);
        world.defect()
    };
    let open = "as many tasks are open as have neither been done nor reported";
    assert_eq!(broken(&|it| it.open += 1), Some(open));
    let held = "an object is on board of the robot that holds it";
    assert_eq!(broken(&|it| it.robots[0].holds = Some(0)), Some(held));
    let begun = "a stage and a role have begun before now";
    assert_eq!(broken(&|it| it.robots[0].stage_since = 1), Some(begun));
}
