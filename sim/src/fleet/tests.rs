//! Properties of every run.

mod skills;
mod succession;
mod supply;
mod travel;

use super::allocate::Allocator;
use super::record::{Fate, Record, Run};
use super::scenarios::{FleetOptions, ServiceOptions, Worst, fleet, service, worst};
use super::trace::{Trace, replay};
use super::world::{Planted, World};
use super::{Kind, run, run_recorded};
use crate::fleet::bid::Offer;
use crate::streams::Streams;
use cotama_models::team::scenario::{
    Fault, FaultKind, FaultTime, Method, Row, Scenario, TaskSpec, usual,
};
use cotama_models::team::{Probability, Reliability};

/// Table 3.1, worst case: 4n, n² + 3n and 3n² + 3n.
#[test]
fn simulated_messages_are_those_of_the_table() {
    let table = [
        (Worst::Singles, [16, 24, 32, 40, 48]),
        (Worst::Together, [28, 54, 88, 130, 180]),
        (Worst::TogetherDistributed, [60, 126, 216, 330, 468]),
    ];
    use Kind::{Ack, Announce, Assign, Bid, Reply, Request};
    for (case, counts) in table {
        for (n, count) in [4_u64, 6, 8, 10, 12].into_iter().zip(counts) {
            let run = run(&worst(case, n as usize));
            assert_eq!((run.rounds, run.count(Fate::Done)), (1, run.fates.len()), "{case:?} {n}");
            let sent = |it| run.sent(it);
            let kinds = [Announce, Request, Reply, Bid, Assign, Ack];
            assert_eq!(kinds.into_iter().map(sent).sum::<u64>(), count, "{case:?} {n}");
            let asked = if case == Worst::TogetherDistributed { n * n } else { 0 };
            let acks = if case == Worst::Singles { n } else { n * n };
            assert_eq!(kinds.map(sent), [n, asked, asked, n, n, acks], "{case:?} {n}");
        }
    }
}

fn names(scenario: &cotama_models::team::scenario::Scenario, robots: &[usize]) -> Vec<String> {
    robots.iter().map(|it| scenario.robots[*it].name.clone()).collect()
}

/// Run 2 of the thesis (3.6.3, Fig. 3.7).
#[test]
fn disturbances_lead_to_the_auctions_and_errors_of_the_thesis() {
    let scenario = service(&ServiceOptions { disturbances: true, ..ServiceOptions::default() });
    let (run, records) = run_recorded(&scenario);
    assert!(run.is_sound());
    let mut awards = Vec::new();
    let mut errors = Vec::new();
    for it in &records {
        match it {
            Record::Awarded { task, plan, robots, .. } => {
                awards.push((
                    scenario.tasks[*task].name.as_str(),
                    plan.as_str(),
                    names(&scenario, robots),
                ));
            }
            Record::Error { robot, class, .. } => {
                errors.push((scenario.robots[*robot].name.as_str(), class.name()));
            }
            _ => {}
        }
    }
    let team = |it: &[&str]| it.iter().map(|it| (*it).to_owned()).collect::<Vec<_>>();
    assert_eq!(
        awards,
        [
            ("order", "order", team(&["Eddie"])),
            ("serve", "bring", team(&["Eddie"])),
            ("serve", "fetch-and-bring", team(&["Poppy", "Eddie"])),
            ("serve", "fetch", team(&["Poppy"])),
        ]
    );
    assert_eq!(
        errors,
        [("Eddie", "recoverable"), ("Eddie", "semi-recoverable"), ("Eddie", "semi-recoverable"),]
    );
    assert_eq!((run.rounds, run.awards), (4, vec![1, 3]));
}

fn check(run: &Run, what: &str) {
    assert!(run.is_sound(), "{what}: {run:?}");
}

#[test]
fn every_task_of_a_fleet_is_done_once_or_reported() {
    for seed in 0..20 {
        let loss_permille = [10, 50, 100, 200][seed as usize % 4];
        let options = FleetOptions { seed, loss_permille, ..FleetOptions::default() };
        check(&run(&fleet(&options)), &format!("{options:?}"));
    }
}

#[test]
fn the_same_seed_gives_the_same_run_and_silent_rounds_change_nothing() {
    let options = FleetOptions { robots: 10, tasks: 30, failures: 3, ..FleetOptions::default() };
    let scenario = fleet(&options);
    let (first, records) = run_recorded(&scenario);
    assert_eq!(run_recorded(&scenario), (first.clone(), records));
    assert_eq!(run(&scenario), first);
    assert_eq!(World::new(&scenario, false, None).in_every_round().run().0, first);
}

/// Each row of the robot's file, on the first of three robots, before, in and after its tasks.
#[test]
fn silent_rounds_change_nothing_whatever_fails() {
    let options = FleetOptions { robots: 3, tasks: 6, failures: 0, ..FleetOptions::default() };
    for (number, row) in Row::all(usual().robot()).enumerate() {
        let mut scenario = fleet(&FleetOptions { seed: number as u64, ..options });
        let at = |it: usize| FaultTime::At(1_000 + 61_234 * it as u64);
        let fault = |when| Fault { when, what: FaultKind::Robot(0, row) };
        scenario.faults = [0, number % 4, 4].map(|it| fault(at(it))).to_vec();
        let first = run(&scenario);
        let every = World::new(&scenario, false, None).in_every_round().run().0;
        assert_eq!((first.is_sound(), &first), (true, &every), "{row:?}");
    }
}

/// How many of some runs with much loss are not sound.
fn unsound(planted: Option<Planted>) -> usize {
    let unsound = (0..12).filter(|&seed| {
        let (robots, tasks, loss_permille) = (20, 40, 500);
        let options =
            FleetOptions { seed, robots, tasks, loss_permille, ..FleetOptions::default() };
        !World::new(&fleet(&options), false, planted).run().0.is_sound()
    });
    unsound.count()
}

/// Without its terms the protocol fails, so the checks can.
#[test]
fn without_leases_or_deadlines_runs_are_not_sound() {
    assert_eq!(unsound(None), 0);
    assert!(unsound(Some(Planted::NoLease)) > 0);
    assert!(unsound(Some(Planted::NoDeadline)) > 0);
}

/// One robot, two tasks of the same cost and the same use: who has waited longer comes first, and
/// one robot does one task.
#[test]
fn the_trace_of_a_team_is_read_and_replayed_record_by_record() {
    let scenarios = (0..6).map(|seed| {
        let options = FleetOptions {
            seed,
            robots: 6,
            tasks: 6,
            failures: 2,
            loss_permille: 50,
            ..FleetOptions::default()
        };
        fleet(&options)
    });
    let service = ServiceOptions { disturbances: true, ..ServiceOptions::default() };
    for scenario in scenarios.chain([self::service(&service)]) {
        let trace = Trace::of(&scenario);
        assert_eq!(trace.scenario().unwrap(), scenario);
        let read = Trace::parse("t.jsonl", &trace.to_json_lines()).unwrap();
        assert_eq!((replay(&read).unwrap(), &read), ((trace.clone(), None), &trace));
        // A record that was changed is found, in its line.
        for at in (0..trace.records.len() - 1).step_by(7) {
            let mut lost = trace.clone();
            lost.records.remove(at);
            let (_, difference) = replay(&lost).unwrap();
            let line = difference.map(|it| it.line).unwrap();
            // Equal records follow each other where robots tell the same.
            assert!(line >= at + 2, "{line} {at}");
        }
    }
}

/// A role of one action costs its drives and its hands, whether failures are counted in or not.
#[test]
fn a_robot_that_may_fail_bids_and_pledges_for_the_whole_of_its_role() {
    let mut scenario = fleet(&FleetOptions {
        robots: 2,
        tasks: 2,
        failures: 0,
        loss_permille: 0,
        ..FleetOptions::default()
    });
    for robot in &mut scenario.robots {
        for skill in &mut robot.skills {
            skill.reliability = Reliability::Uses { succeeded: 19, failed: 1 };
        }
    }
    let run = run(&scenario);
    assert_eq!((run.count(Fate::Done), run.awards, run.reopened), (2, vec![1, 1], 0));
}

#[test]
fn of_two_tasks_the_one_that_waits_longer_is_given_out() {
    let mut scenario = fleet(&FleetOptions::default());
    let alone = scenario.tasks.iter().find_map(|task| {
        let plan = task.plans.iter().find(|it| it.roles.len() == 1)?;
        Some(TaskSpec { utility_ms: 1_000, plans: vec![plan.clone()], ..task.clone() })
    });
    scenario.tasks = vec![alone.unwrap(); 2];
    let success = Probability::ONE;
    let offer = |task| Offer { task, plan: 0, role: 0, cost_ms: 100, success, known_ms: 100 };
    let offers = [offer(0), offer(1)];
    for method in [Method::Optimal, Method::Rounds, Method::OneByOne] {
        scenario.method = method;
        let chosen = |waited_ms: [u64; 2]| {
            let bids = [(0, &offers[..])];
            let shares = Allocator::default().choose(&scenario, &[0, 1], &waited_ms, &bids);
            shares.iter().map(|it| it.task).collect::<Vec<_>>()
        };
        // One by one they come in their order.
        let second = if method == Method::OneByOne { 0 } else { 1 };
        assert_eq!([chosen([500, 0]), chosen([0, 500])], [[0], [second]], "{method:?}");
    }
}

#[test]
fn a_run_is_sound_if_each_task_ended_and_was_delivered_once_where_it_is_done() {
    let sound = |fate, deliveries| {
        Run { fates: vec![fate], deliveries: vec![deliveries], ..Run::default() }.is_sound()
    };
    assert_eq!([0, 1, 2].map(|it| sound(Fate::Done, it)), [false, true, false]);
    // The object was put down at its goal, and nobody heard of it.
    assert_eq!([0, 1, 2].map(|it| sound(Fate::Reported, it)), [true, true, false]);
    assert_eq!([0, 1].map(|it| sound(Fate::Open, it)), [false, false]);
}

#[test]
fn a_task_that_no_robot_can_do_is_reported_after_three_auctions() {
    let options = FleetOptions { robots: 2, tasks: 1, failures: 0, ..FleetOptions::default() };
    let mut scenario = fleet(&options);
    scenario.robots.iter_mut().for_each(|it| it.skills.clear());
    let run = run(&scenario);
    assert_eq!((&run.fates[..], run.rounds), (&[Fate::Reported][..], 3));
}

/// Whatever is read is run to its end: digits, words and whole lines of the shipped team changed.
#[test]
fn a_team_that_is_read_is_run_and_replayed() {
    let file =
        service(&ServiceOptions { disturbances: true, ..ServiceOptions::default() }).to_toml();
    let mut stream = Streams::new(7).stream("mutants");
    let mut run = 0;
    for _ in 0..600 {
        let mut lines: Vec<String> = file.lines().map(str::to_owned).collect();
        for _ in 0..=stream.below(2) {
            let (at, from) = (
                stream.below(lines.len() as u64) as usize,
                stream.below(lines.len() as u64) as usize,
            );
            match stream.below(3) {
                // Another number, a value from elsewhere, or no line at all.
                0 => {
                    let number = 10_u64.pow(stream.below(8) as u32) * stream.below(10);
                    let is_digit = |it: char| it.is_ascii_digit();
                    if let Some((head, tail)) = lines[at].clone().split_once(is_digit) {
                        lines[at] = format!("{head}{number}{}", tail.trim_start_matches(is_digit));
                    }
                }
                1 => {
                    let value = lines[from].split_once(" = ").map(|it| it.1.to_owned());
                    if let (Some((key, _)), Some(value)) =
                        (lines[at].clone().split_once(" = "), value)
                    {
                        lines[at] = format!("{key} = {value}");
                    }
                }
                _ => lines[at].clear(),
            }
        }
        if let Ok(scenario) = Scenario::parse("t.toml", &lines.join("\n")) {
            run += 1;
            let trace = Trace::of(&scenario);
            assert_eq!(replay(&trace).unwrap(), (trace, None));
        }
    }
    assert!(run > 200, "{run}");
}
