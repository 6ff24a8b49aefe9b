//! Batteries: robots bid for what they can do and come home from, drive home, and are charged.

use super::{run, run_recorded};
use crate::fleet::record::{Fate, Record};
use crate::fleet::scenarios::{FleetOptions, fleet};
use crate::fleet::trace::{Trace, replay};
use cotama_models::team::scenario::{Scenario, Spot, Supply};

/// A robot carries parcels from a store to a desk, thirty metres apart, and is charged at the dock.
fn carrier(tasks: usize, charge_permille: u16) -> Scenario {
    let mut text = format!(
        "format = 'cotama-team/1'\nname = 'carrier'\n[floor]\nplaces = ['dock', 'store', 'desk']\n\
         [[floor.way]]\nbetween = ['dock', 'store']\nlength_mm = 10000\n\
         [[floor.way]]\nbetween = ['store', 'desk']\nlength_mm = 30000\n\
         [[robot]]\nname = 'anna'\nat = 'dock'\nskills = ['move', 'grasp']\n\
         battery = {{ charge_permille = {charge_permille}, reserve_permille = 1, home = 'dock', \
         charger_w = 400 }}\n"
    );
    for task in 0..tasks {
        text += &format!(
            "[[task]]\nname = 't{task}'\nfrom = 'store'\nto = 'desk'\nskip_ms = 9000000\n\
             [[task.plan]]\nname = 'carry'\n[[task.plan.role]]\nname = 'carrier'\n\
             needs = ['move', 'grasp']\ntake = 'object'\ngive = 'goal'\ntake_ms = 5000\n\
             give_ms = 5000\n"
        );
    }
    Scenario::parse("carrier", &text).unwrap()
}

#[test]
fn a_robot_with_charge_enough_never_drives_home() {
    let (run, records) = run_recorded(&carrier(3, 1_000));
    assert_eq!((run.count(Fate::Done), run.charges), (3, 0));
    assert!(!records.iter().any(|it| matches!(it, Record::GoesHome { .. })));
    // What a robot draws is what it drew before anybody counted it.
    let mut plain = carrier(3, 1_000);
    plain.robots[0].supply = None;
    assert_eq!(super::run(&plain), run);
}

#[test]
fn a_robot_that_is_short_of_charge_is_charged_before_it_bids() {
    // 2 of a thousand are 1.9 kJ: a parcel with the way home needs more.
    let (run, records) = run_recorded(&carrier(2, 2));
    assert!(run.is_sound() && run.count(Fate::Done) == 2, "{run:?}");
    let at = |of: fn(&Record) -> bool| records.iter().position(of).unwrap();
    let charged = at(|it| matches!(it, Record::Charged { .. }));
    assert!(at(|it| matches!(it, Record::GoesHome { .. })) < charged);
    assert!(charged < at(|it| matches!(it, Record::Awarded { .. })));
    assert_eq!((run.charges, run.out), (1, 0));
}

#[test]
fn a_task_beyond_a_full_battery_is_reported() {
    let mut scenario = carrier(1, 1_000);
    let reserve = 500;
    scenario.robots[0].supply = scenario.robots[0].supply.map(|it| Supply {
        reserve_permille: reserve,
        charge_permille: 300,
        ..it
    });
    // Half of the battery is kept back: 30 % are short, a full one is not.
    let charged = run(&scenario);
    assert_eq!((charged.count(Fate::Done), charged.charges), (1, 1));
    // Two days of standing are 860 kJ, and the task is worth more than that time.
    let role = &mut scenario.tasks[0].plans[0].roles[0];
    (role.take_ms, role.give_ms) = (86_400_000, 86_400_000);
    scenario.tasks[0].utility_ms = 400_000_000;
    let never = run(&scenario);
    assert_eq!((never.count(Fate::Reported), never.charges), (1, 1));
    assert!(never.is_sound());
}

/// Bids keep enough for the way home: wherever a robot is when it turns home, it comes there.
#[test]
fn no_robot_of_a_fleet_runs_empty_and_each_task_ends_once() {
    let mut charges = 0;
    for seed in 0..20 {
        let options =
            FleetOptions { robots: 6, tasks: 30, failures: 0, seed, ..Default::default() };
        let mut scenario = fleet(&options);
        for (number, robot) in scenario.robots.iter_mut().enumerate() {
            robot.supply = Some(Supply {
                charge_permille: 6 + number as u16,
                reserve_permille: 1,
                home: robot.start,
                charger_w: 600,
            });
        }
        let (run, records) = run_recorded(&scenario);
        assert!(run.is_sound(), "seed {seed}: {run:?}");
        assert!(!records.iter().any(|it| matches!(it, Record::Empty { .. })), "seed {seed}");
        charges += run.charges;
        if seed == 0 {
            let read = Trace::parse("t", &Trace::of(&scenario).to_json_lines()).unwrap();
            assert_eq!(replay(&read).unwrap().1, None);
        }
    }
    assert!(charges > 20, "{charges}");
}

/// Energy that a robot needs, as its bids say, is what it draws: within 2 % and never less.
#[test]
fn a_role_draws_no_more_energy_than_its_bid_foresees() {
    let mut scenario = carrier(1, 1_000);
    let robot = &scenario.robots[0];
    let pace = robot.pace(0).unwrap();
    let drives = [10_000, 30_000].map(|it| robot.drive_mj(it, pace)).iter().sum::<u64>();
    let foreseen = drives + robot.stand_mj(1_500 + 10_000);
    let home = scenario.home_mj(robot, Spot::at(scenario.tasks[0].goal), pace).unwrap();
    assert_eq!(home, robot.drive_mj(40_000, pace));
    scenario.robots[0].supply = None;
    // Until the auction the robot stands: that is no part of its role.
    let (run, records) = run_recorded(&scenario);
    let begins = records.iter().find_map(|it| match it {
        Record::Stage { t_ms, task: Some(_), .. } => Some(*t_ms),
        _ => None,
    });
    let before = scenario.robots[0].stand_mj(begins.unwrap());
    let drawn = run.energy_mj - before;
    assert!(drawn <= foreseen && drawn * 100 > foreseen * 95, "{drawn} of {foreseen}");
}

#[test]
fn a_battery_that_a_failure_of_its_robot_empties_ends_it() {
    // A tenth of a per mille, no reserve: it lasts for less than the way home.
    let mut scenario = carrier(1, 1);
    scenario.robots[0].start = scenario.tasks[0].goal;
    scenario.robots[0].supply =
        scenario.robots[0].supply.map(|it| Supply { reserve_permille: 0, ..it });
    let (run, records) = run_recorded(&scenario);
    assert!(records.iter().any(|it| matches!(it, Record::Empty { .. })), "{records:?}");
    assert_eq!((run.out, run.count(Fate::Reported)), (1, 1));
    assert!(run.is_sound());
}
