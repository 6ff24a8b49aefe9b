//! One robot and one task.

use super::{Driver, Millimetres, Row, Stage};
use cotama_models::team::scenario::usual;

fn driver(every_round: bool) -> Driver {
    Driver::new(&usual(), every_round)
}

fn row(name: &str) -> Row {
    Row::named(usual().robot(), name).unwrap()
}

fn name(row: Row) -> String {
    row.name(usual().robot()).to_owned()
}

/// When the stages of a task begin, with a failure at 20 s; and how it ends.
fn course(mode: Option<&str>, every_round: bool) -> Vec<(u64, Stage)> {
    let mut driver = driver(every_round);
    driver.begin(0, [6_000, 9_000], [0; 2]);
    let (mut stages, mut now, mut since) = (vec![(0, driver.stage())], 0, 0);
    let mut failure = mode;
    while now < 400_000 {
        if now >= 20_000
            && let Some(mode) = failure.take()
        {
            driver.fail(now, row(mode));
        }
        let takes = matches!(driver.stage(), Stage::Takes | Stage::Gives);
        driver.round(now, takes && now >= since + 5_000);
        if driver.stage() != stages[stages.len() - 1].1 {
            (stages, since) = ([stages, vec![(now, driver.stage())]].concat(), now);
        }
        if matches!(driver.stage(), Stage::Done | Stage::Safe) {
            break;
        }
        let hands = matches!(driver.stage(), Stage::Takes | Stage::Gives);
        let hands = hands.then_some((since + 5_000).max(now + driver.period()));
        let fails = failure.map(|_| 20_000.max(now + driver.period()));
        let Some(next) = driver.next_round().into_iter().chain(hands).chain(fails).min() else {
            break;
        };
        now = next;
    }
    stages
}

#[test]
fn rounds_that_are_left_out_change_nothing() {
    for mode in Row::all(usual().robot()).map(|it| Some(name(it))).chain([None]) {
        let mode = mode.as_deref();
        assert_eq!(course(mode, false), course(mode, true), "{mode:?}");
    }
}

#[test]
fn a_task_takes_its_drives_its_planning_and_its_hands() {
    let stages = course(None, true);
    use Stage::{Done, Gives, Takes, ToGive, ToTake};
    assert_eq!(
        stages.iter().map(|it| it.1).collect::<Vec<_>>(),
        [ToTake, Takes, ToGive, Gives, Done]
    );
    // 2 s of planning, 20 s and 30 s of driving, 5 s each of taking and giving, some rounds.
    assert!((64_000..66_000).contains(&stages[4].0), "{stages:?}");
}

#[test]
fn an_emergency_stop_ends_the_mission_and_lost_sonars_slow_it() {
    let last = |mode| *course(Some(mode), true).last().unwrap();
    assert_eq!(last("EST1").1, Stage::Safe);
    let (slow, stage) = last("SON1");
    assert!(stage == Stage::Done && slow > 80_000, "{slow}");
}

/// The link to the robot drops packets for ten seconds, twice and overlapping: it goes at seven
/// tenths until five seconds after the last of them.
#[test]
fn a_flag_stays_up_while_another_failure_holds_it() {
    let mut driver = driver(true);
    driver.begin(0, [60_000, 60_000], [0; 2]);
    let mut slowed = Vec::new();
    for now in (0..60_000).step_by(100) {
        if now == 20_000 || now == 26_000 {
            driver.fail(now, row("P3D2"));
        }
        driver.round(now, false);
        let slow = now > 20_000 && driver.moving.drive.speed().0 < 300;
        slowed.extend(slow.then_some(now));
    }
    let ends = (slowed.first().copied(), slowed.last().copied());
    // In steps of 30 mm/s, down and up again.
    assert_eq!(ends, (Some(22_200), Some(41_100)));
    assert_eq!(slowed.len() as u64, (41_100 - 22_200) / 100 + 1);
}

/// Drives for 20 s at 300 mm/s, then loses its laptop or its role.
fn stands_after(mode: Option<&str>) -> u64 {
    let mut driver = driver(true);
    driver.begin(0, [60_000, 60_000], [0; 2]);
    for now in (0..=20_000).step_by(100) {
        driver.round(now, false);
    }
    let before = driver.driven_mm(20_000);
    mode.into_iter().for_each(|it| driver.fail(20_000, row(it)));
    driver.stand_mm(20_000) - before
}

#[test]
fn a_robot_brakes_at_the_end_of_its_role_and_coasts_without_its_laptop() {
    assert_eq!(stands_after(None), 150);
    // Two seconds until the micro-controller stops the motors.
    assert_eq!(stands_after(Some("PWR1")), 600 + 150);
    assert_eq!(stands_after(Some("BAT2")), 0);
}

#[test]
fn a_motor_that_runs_away_is_cut_off_and_moved_meanwhile() {
    let mut driver = driver(true);
    (0..=20_000).step_by(100).for_each(|now| {
        if now == 10_000 {
            driver.fail(now, row("MOT4"));
        }
        driver.round(now, false);
    });
    assert_eq!(driver.stage(), Stage::Safe);
    let (x, speed) = (driver.moving.drive.x(), driver.moving.drive.speed().0);
    assert!(x > Millimetres(0) && speed == 0, "{x:?} {speed}");
}

#[test]
fn losses_stay_known_in_the_next_task() {
    let mut driver = driver(true);
    driver.begin(0, [60_000, 60_000], [0; 2]);
    for now in (0..40_000).step_by(100) {
        if now == 10_000 {
            driver.fail(now, row("SON1"));
        }
        driver.round(now, false);
    }
    assert_eq!(driver.pace(), Some(150));
    driver.begin(40_000, [6_000, 60_000], [0; 2]);
    assert_eq!((driver.pace(), driver.moving.drive.speed().0), (Some(150), 0));
    let rounds = (40_100..60_000).step_by(100).map(|now| driver.round(now, false));
    let runs: Vec<_> = rounds.filter_map(|it| it.configuration).collect();
    assert_eq!(runs, ["PP", "PF.DEG"]);
    assert_eq!(driver.level.lost().count_ones(), 1);
}

/// Something stands in the way: the robot asks after eight seconds, and nobody answers.
#[test]
fn a_robot_that_asks_in_vain_is_stopped_after_two_minutes() {
    let (stopped, stage) = *course(Some("LOC2"), false).last().unwrap();
    assert_eq!(stage, Stage::Safe);
    assert!((148_000..149_500).contains(&stopped), "{stopped}");
}

/// A robot that gave its task up finds out again what is in its way.
#[test]
fn a_failure_without_a_loss_is_found_again_in_the_next_task() {
    let mut driver = driver(true);
    driver.begin(0, [60_000, 60_000], [0; 2]);
    let mut found = Vec::new();
    for now in (0..60_000).step_by(100) {
        match now {
            10_000 => driver.fail(now, row("MOT3")),
            30_000 => driver.begin(now, [60_000, 60_000], [0; 2]),
            _ => {}
        }
        found.extend(driver.round(now, false).found.map(|it| (now, name(it))));
    }
    assert_eq!(found, [(10_500, "MOT3".into()), (32_600, "MOT3".into())]);
}
