//! Robots that take over from an auctioneer that failed.

use crate::fleet::record::{Fate, Record, Run};
use crate::fleet::run_recorded;
use crate::fleet::scenarios::{FleetOptions, fleet};
use crate::fleet::trace::{Trace, replay};
use cotama_models::team::scenario::{Fault, FaultKind, FaultTime, Row, Scenario, Seat, usual};

/// Eight robots, of which the first gives sixteen tasks out; nothing else fails.
fn eight(loss_permille: u16, seed: u64) -> Scenario {
    let options = FleetOptions { robots: 8, tasks: 16, failures: 0, ..FleetOptions::default() };
    fleet(&FleetOptions { takeover: true, loss_permille, seed, ..options })
}

/// Laptops that go down: of whoever gives tasks out then, or of a robot.
fn kill(at_ms: u64, robot: Option<usize>) -> Fault {
    let row = Row::named(usual().robot(), "PWR1").unwrap();
    let what = robot.map_or(FaultKind::Auctioneer(row), |it| FaultKind::Robot(it, row));
    Fault { when: FaultTime::At(at_ms), what }
}

/// When which robot took over, in ms, and whether it had a copy.
fn takeovers(records: &[Record]) -> Vec<(u64, usize, bool)> {
    let all = records.iter().filter_map(|it| match it {
        Record::TakesOver { t_ms, robot, copied } => Some((*t_ms, *robot, *copied)),
        _ => None,
    });
    all.collect()
}

fn done(run: &Run) -> usize {
    run.count(Fate::Done)
}

#[test]
fn an_auctioneer_at_a_robot_gives_out_what_one_at_a_desk_does() {
    for seed in 0..4 {
        let (queue, records) = run_recorded(&eight(100, seed));
        assert_eq!((takeovers(&records), queue.is_sound(), done(&queue)), (vec![], true, 16));
    }
}

#[test]
fn the_second_robot_takes_over_within_seconds_and_then_the_third() {
    let mut scenario = eight(0, 1);
    scenario.faults = vec![kill(100_000, None), kill(200_000, None)];
    let (run, records) = run_recorded(&scenario);
    let all = takeovers(&records);
    assert_eq!(all.iter().map(|it| (it.1, it.2)).collect::<Vec<_>>(), [(1, true), (2, true)]);
    let latency: Vec<u64> = all.iter().zip([100_000, 200_000]).map(|it| it.0.0 - it.1).collect();
    assert!(latency.iter().all(|it| (4_500..=5_500).contains(it)), "{latency:?}");
    assert_eq!((run.is_sound(), done(&run), run.out), (true, 16, 2));
}

#[test]
fn robots_that_fail_together_with_both_successors_are_followed_by_one_without_a_copy() {
    let mut scenario = eight(0, 2);
    scenario.faults = [0, 1, 2].map(|it| kill(150_000, Some(it))).to_vec();
    let (run, records) = run_recorded(&scenario);
    let all = takeovers(&records);
    assert_eq!(all.iter().map(|it| (it.1, it.2)).collect::<Vec<_>>(), [(3, false)]);
    assert!(run.is_sound(), "{run:?}");
}

/// An auctioneer without successors takes its tasks with it: they are reported, whatever robots do.
#[test]
fn tasks_of_an_auctioneer_without_successors_are_reported_when_it_fails() {
    let scenario =
        Scenario { auctioneer: Seat::Robot(0), faults: vec![kill(250_000, None)], ..eight(0, 1) };
    let (run, records) = run_recorded(&scenario);
    assert_eq!((takeovers(&records), run.is_sound()), (vec![], true));
    assert!(run.count(Fate::Reported) > 4 && done(&run) > 0, "{run:?}");
}

#[test]
fn tasks_are_reported_when_no_robot_is_left() {
    let mut scenario = eight(0, 1);
    scenario.faults = (0..8).map(|it| kill(60_000 + 1_000 * it, Some(it as usize))).collect();
    let (run, _) = run_recorded(&scenario);
    assert_eq!((run.is_sound(), run.out), (true, 8));
}

#[test]
fn a_run_with_takeovers_is_replayed_record_by_record() {
    let mut scenario = eight(200, 5);
    scenario.faults = vec![kill(80_000, None), kill(90_000, None), kill(300_000, None)];
    let trace = Trace::of(&scenario);
    assert!(trace.run().is_sound() && trace.run().takeovers >= 2);
    let read = Trace::parse("t.jsonl", &trace.to_json_lines()).unwrap();
    assert_eq!(replay(&read).unwrap(), (trace, None));
}

/// Forty robots, three auctioneers killed at any moment.
fn killed(seed: u64) -> Run {
    let loss_permille = [0, 50, 100, 200][seed as usize % 4];
    let options =
        FleetOptions { takeover: true, kills: 3, loss_permille, seed, ..FleetOptions::default() };
    run_recorded(&fleet(&options)).0
}

#[test]
fn every_task_is_done_once_or_reported_whenever_auctioneers_are_killed() {
    for seed in 0..8 {
        let run = killed(seed);
        assert!(run.is_sound() && run.takeovers > 0, "{seed}: {run:?}");
    }
}

#[test]
fn a_robot_that_joins_later_is_given_tasks_and_one_that_leaves_ends_its_own_first() {
    let mut scenario = eight(50, 3);
    scenario.robots[7].stay.joins_ms = 200_000;
    scenario.robots[1].stay.leaves_ms = Some(200_000);
    let (run, records) = run_recorded(&scenario);
    assert!(run.is_sound() && takeovers(&records).is_empty(), "{run:?}");
    let awards = |robot: usize| -> Vec<u64> {
        let all = records.iter().filter_map(|it| match it {
            Record::Awarded { t_ms, robots, .. } => robots.contains(&robot).then_some(*t_ms),
            _ => None,
        });
        all.collect()
    };
    assert!(awards(7).iter().all(|it| *it >= 200_000) && !awards(7).is_empty());
    assert!(awards(1).iter().all(|it| *it < 200_000) && !awards(1).is_empty());
    let gave_back = records.iter().any(|it| matches!(it, Record::Error { robot: 1, .. }));
    assert!(!gave_back);
}

#[test]
fn another_robot_gives_tasks_out_when_the_one_that_did_leaves() {
    let mut scenario = eight(50, 3);
    scenario.robots[0].stay.leaves_ms = Some(200_000);
    let (run, records) = run_recorded(&scenario);
    let all = takeovers(&records);
    assert!(run.is_sound() && all.len() == 1 && all[0].1 == 1 && all[0].2, "{all:?}");
    let desk = Scenario { auctioneer: Seat::Robot(0), ..scenario };
    assert!(run_recorded(&desk).0.is_sound());
}
