//! The patrol gives Table 5 of Lambert et al. 2024 exactly, and the tables printed for firmware are
//! its own.
#![cfg(feature = "std")]

use cotama_core::hardware::Equipment;
use cotama_core::problem::Problem;
use cotama_core::units::{Millijoules, Millimetres, MillimetresPerSecond, Millis, Milliwatts};
use cotama_models::missions::infeasible::{Relaxation, explain};
use cotama_models::missions::tables::{
    Alternative, EMPTY, RemainingError, Rest, buffer_sizes, remaining,
};
use cotama_models::missions::tables::{delivery, patrol};
use cotama_models::missions::{Constraint, Mission, Unfolded, embedded, harmless_speed};

fn patrol() -> Mission {
    let patrol = embedded::mission("patrol").unwrap();
    Mission::parse(patrol.name, patrol.text).unwrap()
}

#[test]
fn the_activities_are_those_of_table_5() {
    // id, objective, start and end in mm, alternatives before and after the constraints, v_max in
    // mm/s
    let table_5 = [
        ("A1", "O1", 0, 31_000, 21, 21, 410),
        ("A2", "O1", 31_000, 34_000, 21, 12, 330),
        ("A3", "O1", 34_000, 37_000, 21, 4, 330),
        ("A4", "O2", 37_000, 37_000, 3, 3, 0),
        ("A5", "O3", 37_000, 37_000, 2, 2, 0),
        ("A6", "O4", 37_000, 37_000, 3, 3, 0),
        ("A7", "O5", 37_000, 41_000, 21, 12, 330),
        ("A8", "O5", 41_000, 63_500, 21, 21, 410),
        ("A9", "O5", 63_500, 91_500, 21, 21, 560),
        ("A10", "O5", 91_500, 93_500, 21, 4, 410),
        ("A11", "O6", 93_500, 93_500, 3, 3, 0),
        ("A12", "O7", 93_500, 93_500, 2, 2, 0),
        ("A13", "O8", 93_500, 93_500, 3, 3, 0),
        ("A14", "O9", 93_500, 123_500, 21, 21, 560),
        ("A15", "O9", 123_500, 146_000, 21, 21, 410),
        ("A16", "O9", 146_000, 156_000, 21, 12, 330),
        ("A17", "O9", 156_000, 187_000, 21, 21, 410),
    ];
    let mission = patrol();
    let activities = mission.scenario().activities.iter();
    let found: Vec<_> = activities
        .map(|it| {
            let objective = mission.objectives[it.objective].id.as_str();
            let (before, after) = (it.unconstrained(), it.alternatives.len());
            (it.id.as_str(), objective, it.x_start.0, it.x_end.0, before, after, it.speed_max.0)
        })
        .collect();
    assert_eq!(found, table_5);
    assert_eq!(mission.scenario().combinations(), Some(768_288_795_144_192));
}

/// The wide hall without its speed limit, and the robot could do 760 mm/s.
#[test]
fn a_harmless_zone_limits_the_speed_if_no_other_does() {
    let hall = "speed_max_mm_s = 560 ";
    let text = embedded::mission("patrol").unwrap().text;
    let speeds = |text: &str| {
        let mission = Mission::parse("patrol", text).unwrap();
        let hall = mission.scenario().activities[8].clone();
        let speeds = hall.alternatives.iter().map(|it| it.speed.0).collect::<Vec<_>>();
        (hall.speed_max.0, speeds.iter().min().copied(), speeds.iter().max().copied())
    };
    assert_eq!(text.matches(hall).count(), 1);
    let open = text.replace(hall, "#");
    assert_eq!(speeds(&open), (560, Some(410), Some(560)));
    assert_eq!(speeds(&open.replace("speed_harmless_mm_s", "#")), (565, Some(410), Some(565)));
    let slow = open.replace("speed_max_mm_s = 760", "speed_max_mm_s = 400");
    assert_eq!(speeds(&slow), (400, Some(400), Some(400)));
}

/// An impact must stay below its energy: 2 g at 1 m/s have 1 mJ.
#[test]
fn a_speed_that_just_reaches_the_energy_of_an_impact_is_not_harmless() {
    assert_eq!(harmless_speed(2, Millijoules(1)), MillimetresPerSecond(999));
    assert_eq!(harmless_speed(1, Millijoules(0)), MillimetresPerSecond(0));
    let text = embedded::mission("patrol").unwrap().text;
    let parse = |stated: u64| {
        let stated = format!("speed_harmless_mm_s = {stated}");
        Mission::parse("patrol", &text.replacen("speed_harmless_mm_s = 560", &stated, 1))
    };
    assert_eq!(parse(565).unwrap().robot.speed_harmless, MillimetresPerSecond(565));
    assert_eq!(parse(500).unwrap().robot.speed_harmless, MillimetresPerSecond(500));
    assert!(parse(566).unwrap_err().to_string().contains("the fastest harmless speed is 565 mm/s"));
}

#[test]
fn qualities_are_optional() {
    let text = embedded::mission("patrol").unwrap().text;
    let lines = text.lines().filter(|line| !line.starts_with("quality"));
    let mission = Mission::parse("plain", &lines.collect::<Vec<_>>().join("\n")).unwrap();
    assert_eq!(mission.scenario().combinations(), patrol().scenario().combinations());
    assert!(mission.tios.iter().all(|tio| (tio.quality, tio.quality_per_dm) == (0, 0)));
}

#[test]
fn an_alternative_costs_the_same_as_by_hand() {
    let mission = patrol();
    let activities = mission.scenario().activities();
    let a1 = &mission.scenario().activities[0];
    let m5_l2 = a1.labels.iter().position(|label| label == "M5 L2").unwrap();
    let alternative = a1.alternatives[m5_l2];
    assert_eq!(alternative.speed, MillimetresPerSecond(410));
    // motion at 0.41 m/s, sonar, two lasers, Kinect; the actuators are a part of motion
    assert_eq!(alternative.power, Milliwatts(7_924 + 1_300 + 2 * 2_200 + 4_600));
    let whole = activities[0].whole(&alternative);
    assert_eq!(whole, Rest::Travel(Millimetres(31_000)));
    // 31 m / 0.41 m/s = 75.6098 s, times 18.224 W = 1377.917 J; (3 * 3 + 3) for each of 310 dm
    let candidate = alternative.candidate(whole, 7).unwrap();
    assert_eq!(
        (candidate.cost, candidate.quality, candidate.id),
        ([75_610, 1_377_917], 12 * 310, 7)
    );
    // A turn with L3: 8 s at 7.5 W and two lasers.
    let t1_l3 = mission.scenario().activities[3].alternatives[2];
    let whole = activities[3].whole(&t1_l3);
    assert_eq!(whole, Rest::Time(Millis(8_000)));
    assert_eq!(t1_l3.cost(whole), Some([8_000, (7_500 + 2 * 2_200) * 8]));
    assert_eq!(t1_l3.quality, 20);
}

#[test]
fn every_dropped_combination_names_all_its_constraints() {
    let mission = patrol();
    let a3 = &mission.scenario().activities[2];
    let m3_l1 = a3.dropped.iter().find(|dropped| dropped.label == "M3 L1").unwrap();
    let zone = |id| mission.zones.iter().position(|zone| zone.id == id).unwrap();
    let expected =
        [(zone("glass-out"), Constraint::Hardware), (zone("valve1-approach"), Constraint::Tio)];
    assert_eq!(m3_l1.by, expected);
    assert_eq!(
        m3_l1.reason,
        "zone `glass-out` requires the moving option to use 1 of `sonar`; \
         zone `valve1-approach` requires the option `L2`"
    );
}

/// The glazed zone with lasers in place of sonars: two of the moving options have none, and that
/// the grid map of `L3` needs two is no help.
#[test]
fn required_hardware_must_be_of_the_moving_option() {
    let text = embedded::mission("patrol").unwrap().text;
    let text = text.replacen("require_hardware = \"sonar\"", "require_hardware = \"laser\"", 1);
    let mission = Mission::parse("patrol", &text).unwrap();
    let a2 = &mission.scenario().activities[1];
    assert_eq!((a2.alternatives.len(), a2.unconstrained()), (15, 21));
    let dropped: Vec<_> = a2.dropped.iter().map(|it| it.label.as_str()).collect();
    assert_eq!(dropped, ["M1 L1", "M1 L2", "M1 L3", "M2 L1", "M2 L2", "M2 L3"]);
}

#[test]
fn the_axes_are_treated_in_the_order_of_the_file() {
    let text = embedded::mission("patrol").unwrap().text;
    let with = |order: &str| {
        let text = text.replacen("[\"duration\", \"energy\"]", order, 1);
        Mission::parse("patrol", &text).map(|it| (it.order, it.scenario().order))
    };
    assert_eq!(with("[\"duration\", \"energy\"]").unwrap(), ([0, 1], [0, 1]));
    assert_eq!(with("[\"energy\", \"duration\"]").unwrap(), ([1, 0], [1, 0]));
    assert!(with("[\"energy\", \"energy\"]").is_err());
}

/// Both lasers are lost, and a glazed zone wants one: two would do as well.
#[test]
fn no_more_hardware_is_kept_than_suffices() {
    let text = embedded::mission("patrol").unwrap().text;
    let text = text.replacen("require_hardware = \"sonar\"", "require_hardware = \"laser\"", 1);
    let mission = Mission::parse("patrol", &text).unwrap();
    let left = mission.available().without(1, 2);
    let why = explain(&mission, mission.limits, left).unwrap();
    let kept: Vec<_> =
        why.relaxations.iter().filter(|it| matches!(it, Relaxation::KeepHardware { .. })).collect();
    assert_eq!(kept, [&Relaxation::KeepHardware { hardware: 1, units: 1 }]);
}

#[test]
fn constraints_can_be_lifted_and_objectives_left_out() {
    let mission = patrol();
    let zone = |id| mission.zones.iter().position(|zone| zone.id == id).unwrap();
    // Without the added sonar requirement A10 has the 7 alternatives of its printed constraint, and
    // all else is as it was.
    let lifted = mission
        .without_zone_constraint(zone("valve2-approach-sonar"), Constraint::Hardware)
        .unwrap();
    let alternatives = |mission: &Unfolded| {
        let activities = mission.scenario().activities.iter();
        activities.map(|it| (it.id.clone(), it.alternatives.len())).collect::<Vec<_>>()
    };
    let (with, without) = (alternatives(&mission), alternatives(&lifted));
    assert_eq!((&with[9], &without[9]), (&("A10".to_owned(), 4), &("A10".to_owned(), 7)));
    assert_eq!((&with[..9], &with[10..]), (&without[..9], &without[10..]));
    assert_eq!(lifted.scenario().combinations(), Some(1_344_505_391_502_336));
    assert_eq!(mission.without_zone_constraint(zone("H2"), Constraint::Hardware), None);
    assert_eq!(mission.without_zone_constraint(99, Constraint::Tio), None);

    let without_detection = mission.without_objective(2).unwrap();
    assert_eq!(without_detection.scenario().activities.len(), 16);
    assert_eq!(without_detection.path_length, mission.path_length);
    let one_way = mission.without_objective(8).unwrap();
    assert_eq!(
        (one_way.scenario().activities.len(), one_way.path_length),
        (13, Millimetres(93_500))
    );
    assert!(one_way.run.faults.events.iter().all(|event| event.x <= one_way.path_length));
    assert_eq!(mission.without_objective(0), None);
    assert_eq!(mission.without_objective(9), None);
}

#[test]
fn a_remaining_mission_becomes_a_problem_without_heap() {
    let mission = patrol();
    let scenario = mission.scenario();
    let activities = scenario.activities();
    let lasers = mission.hardware.iter().position(|hardware| hardware.name == "laser").unwrap();
    let available = scenario.available().without(lasers, 1);
    // At 118 m one laser is lost: M4 to M7 and L3 fall away, 3 * 2 remain of 21, and M1, M2 in the
    // glazed A16.
    let rest = Rest::Travel(Millimetres(123_500 - 118_000));
    let mut candidates = vec![EMPTY; buffer_sizes(&activities[13..]).0];
    let mut lists = [&[][..]; 17];
    let lists =
        remaining(&activities[13..], Some(rest), available, &mut candidates, &mut lists).unwrap();
    let problem = Problem::new(lists, scenario.limits, scenario.order).unwrap();
    let counts: Vec<_> = problem.activities().iter().map(|candidates| candidates.len()).collect();
    assert_eq!(counts, [6, 6, 4, 6]);
    // The ids are still those of the alternatives.
    let last = problem.activities()[3].last().unwrap();
    assert_eq!(scenario.activities[16].labels[usize::from(last.id)], "M3 L2");

    let nothing = cotama_core::hardware::Equipment::NONE;
    let mut candidates = [EMPTY; 5];
    let mut lists = [&[][..]; 17];
    let refused = remaining(&activities[13..], Some(rest), nothing, &mut candidates, &mut lists);
    assert_eq!(refused, Err(RemainingError::NoCandidates { activity: 0 }));
    let mut lists = [&[][..]; 17];
    let refused = remaining(&activities[13..], Some(rest), available, &mut candidates, &mut lists);
    assert_eq!(refused, Err(RemainingError::BufferTooSmall));
    let mut lists = [&[][..]; 3];
    let refused = remaining(&activities[13..], Some(rest), available, &mut candidates, &mut lists);
    assert_eq!(refused, Err(RemainingError::BufferTooSmall));
    let far = Rest::Travel(Millimetres(u64::MAX));
    let mut lists = [&[][..]; 17];
    let refused = remaining(&activities[13..], Some(far), available, &mut candidates, &mut lists);
    assert_eq!(refused, Err(RemainingError::TooLarge { activity: 0 }));
}

/// Compares printed tables with the file of the crate, and what is compiled of it with the mission.
macro_rules! assert_printed {
    ($mission:literal, $tables:ident) => {{
        let embedded = embedded::mission($mission).unwrap();
        let mission = Mission::parse(embedded.name, embedded.text).unwrap();
        let scenario = mission.scenario();
        let printed = scenario.to_rust(&mission.name);
        cotama_golden::compare(
            concat!("src/missions/tables/", stringify!($tables), ".rs"),
            &printed,
        );
        // And compiled, they are the same values; those of a file just written at the next run.
        assert_eq!($tables::ACTIVITIES[..], scenario.activities()[..]);
        assert_eq!(($tables::LIMITS, $tables::ORDER), (scenario.limits, scenario.order));
        assert_eq!($tables::AVAILABLE, scenario.available());
        for (labels, activity) in $tables::LABELS.iter().zip(&scenario.activities) {
            assert_eq!(*labels, activity.labels);
        }
    }};
}

#[test]
fn the_printed_tables_are_those_of_the_mission_file() {
    assert_printed!("patrol", patrol);
}

#[test]
fn the_printed_tables_of_the_delivery_are_those_of_its_file() {
    assert_printed!("delivery", delivery);
}

/// A rest of an activity costs 32 bits of milliseconds and of millijoules at most.
#[test]
fn a_rest_that_does_not_fit_32_bits_has_no_cost() {
    let standing = |power| Alternative::standing(0, power, Equipment::NONE, 0);
    let most = u64::from(u32::MAX);
    let cost = |power, ms| standing(power).cost(Rest::Time(Millis(ms)));
    assert_eq!(cost(0, most), Some([u32::MAX, 0]));
    assert_eq!(cost(0, most + 1), None);
    assert_eq!(cost(0, most + 2), None);
    assert_eq!(cost(1_000 * most, 1_000), None);
    assert_eq!(cost(most, 1_000), Some([1_000, u32::MAX]));
    assert_eq!(cost(most + 1, 1_000), None);
    assert_eq!(cost(most + 2, 1_000), None);
    assert_eq!(standing(1).cost(Rest::Travel(Millimetres(1))), None);
}
