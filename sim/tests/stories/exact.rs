//! Limits, ends of zones, rests and rates: what a unit more or less changes.

use super::common::{SHUTTLE, faults, patrol, run, shuttle, under, with_period};
use super::records;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::missions::Mission;
use cotama_models::missions::faults::{Event, EventKind, Faults, PowerError, RandomEvent};
use cotama_sim::options::{Aim, FaultChoice, Options, Planner};
use cotama_sim::run::{Outcome, Reason};
use cotama_sim::setup::Simulation;
use cotama_sim::trace::{Occurrence, Record};
use cotama_sim::world::World;

fn given(faults: Faults) -> Options {
    let faults = FaultChoice::Given { source: "test".into(), faults };
    Options { faults, ..Options::default() }
}

#[test]
fn a_repair_gives_back_no_more_units_than_the_robot_has() {
    let mission = shuttle();
    let body = r#"event = [{ x_mm = 10000, kind = "fault", hardware = "laser", units_lost = 1 },
        { x_mm = 20000, kind = "repair", hardware = "laser", units_back = 2 }]"#;
    let options = under(&mission, body);
    let laser = || "laser".to_owned();
    let happened: Vec<_> = records(&mission, &options)
        .into_iter()
        .filter_map(|it| if let Record::Event(it) = it { Some(it.event) } else { None })
        .collect();
    assert_eq!(
        happened,
        [
            Occurrence::Fault { hardware: laser(), units_lost: 1, units_left: 1 },
            Occurrence::Repair { hardware: laser(), units_back: 1, units_left: 2 },
        ]
    );
    let simulation = Simulation::new(&mission, &options).unwrap();
    let mut world = World::start(&simulation, 0, &mut cotama_sim::record::Silent).unwrap();
    while world.step(&mut cotama_sim::record::Silent).is_none() {}
    assert_eq!(world.available(), mission.available());
}

/// 10 s of standing, then 500 mm/s: every odd millisecond ends at a half of a millimetre.
#[test]
fn a_replan_under_way_takes_the_rest_of_the_way_rounded_up() {
    let mission = shuttle();
    let body = "power_error_permille = { near = 100, far = 100 }";
    let options = Options { monitor_period: Some(Millis(1)), ..under(&mission, body) };
    let simulation = Simulation::new(&mission, &options).unwrap();
    let mut told: Vec<Record> = Vec::new();
    let mut world = World::start(&simulation, 0, &mut told).unwrap();
    let (scenario, mut halves) = (mission.scenario(), 0);
    while {
        told.clear();
        world.step(&mut told).is_none()
    } {
        let Some(Record::Plan(replan)) = told.iter().find(|it| matches!(it, Record::Plan(_)))
        else {
            continue;
        };
        assert_eq!(replan.cause, "energy margin below zero");
        let x_nm = world.x_nm();
        let activity =
            scenario.activities.iter().find(|it| it.id == replan.first_activity).unwrap();
        let rest_mm = (activity.x_end.0 * 1_000_000 - x_nm).div_ceil(1_000_000);
        let first = &replan.plan[0];
        assert_eq!((first.speed_mm_s, first.duration_ms), (500, rest_mm * 2));
        // Back to the start it is as far as it came, rounded up as well: 2 ms for each mm.
        let back = replan.return_margin.start.unwrap().duration_ms.unsigned_abs();
        let left = scenario.limits[0] - replan.used.duration_ms;
        assert_eq!(left - back, x_nm.div_ceil(1_000_000) * 2);
        halves += u32::from(x_nm % 1_000_000 == 500_000);
    }
    assert!(halves > 0, "a replan between two millimetres");
}

#[test]
fn what_happens_in_any_order_of_the_file_happens_by_place() {
    let mission = shuttle();
    let event = |x: u64, s: u64| Event {
        x: Millimetres(x),
        kind: EventKind::Obstacle { delay: Millis(1_000 * s) },
    };
    let with = |events: Vec<Event>| {
        let options = given(Faults { events, ..Faults::default() });
        let places = records(&mission, &options).into_iter().filter_map(|it| match it {
            Record::Event(it) => Some((it.x_mm, it.lost_us / 1_000_000)),
            _ => None,
        });
        places.collect::<Vec<_>>()
    };
    let sorted = [(1_000, 2), (1_000, 1), (2_000, 3), (90_000, 4)];
    let mixed = vec![event(90_000, 4), event(1_000, 2), event(2_000, 3), event(1_000, 1)];
    assert_eq!(with(mixed), sorted);
    // A file is sorted when it is read; what happens at one place keeps its order.
    let body = r#"event = [{ x_mm = 90000, kind = "obstacle", delay_ms = 4000 },
        { x_mm = 1000, kind = "obstacle", delay_ms = 2000 },
        { x_mm = 2000, kind = "obstacle", delay_ms = 3000 },
        { x_mm = 1000, kind = "obstacle", delay_ms = 1000 }]"#;
    let FaultChoice::Given { faults, .. } = faults(&mission, body) else { unreachable!() };
    assert_eq!(faults.events.iter().map(|it| it.x.0).collect::<Vec<_>>(), sorted.map(|it| it.0));
    assert_eq!(with(faults.events), sorted);
}

/// The shuttle turns once more where its path ends.
fn turning_at_the_end() -> Mission {
    let turn = "[[objective]]\nid = \"end\"\nx_start_mm = 200000\nx_end_mm = 200000\n\
                tasks = [\"TUR\"]\n";
    Mission::parse("shuttle.toml", &format!("{SHUTTLE}\n{turn}")).unwrap()
}

#[test]
fn the_last_place_of_the_path_belongs_to_the_zone_that_ends_there() {
    let mission = turning_at_the_end();
    let powers = |body: &str| {
        let options = Options { monitor_period: Some(Millis(60_000)), ..under(&mission, body) };
        let mut samples = records(&mission, &options).into_iter().filter_map(|it| match it {
            Record::Sample(it) => Some((it.x_mm, it.planned_power_mw, it.real_power_mw)),
            _ => None,
        });
        samples.rfind(|it| it.0 == 200_000).unwrap()
    };
    assert_eq!(powers("power_error_permille = { home = 100 }"), (200_000, 4_000, 4_400));
    assert_eq!(powers("power_error_permille = { far = 100 }"), (200_000, 4_000, 4_000));
}

#[test]
fn where_two_zones_meet_the_second_begins() {
    let mission = shuttle();
    let error = |(zone, permille)| PowerError { zone, permille };
    let power_errors = [(0, -1_000), (1, 100), (2, -2_000)].map(error).to_vec();
    let mut powers = std::collections::BTreeMap::new();
    let options = given(Faults { power_errors, ..Faults::default() });
    let ten = Options { monitor_period: Some(Millis(10_000)), ..options };
    for it in records(&mission, &ten) {
        if let Record::Sample(it) = it {
            powers.insert(it.x_mm, it.real_power_mw * 1000 / it.planned_power_mw);
        }
    }
    // The power of a place: none, a tenth more, and never less than nothing.
    assert_eq!((powers[&45_000], powers[&50_000], powers[&145_000]), (0, 1_100, 1_100));
    assert_eq!((powers[&150_000], powers[&195_000]), (0, 0));
}

#[test]
fn a_rate_of_nothing_gives_nothing_and_a_full_rate_one_a_metre() {
    let mission = patrol();
    let kind = EventKind::Odometry { extra: Millimetres(1) };
    let metres = |per_km: u16, seed: u64| {
        let random = vec![RandomEvent { name: "dust".into(), per_km, kind }];
        let options = Options { seed, ..given(Faults { random, ..Faults::default() }) };
        let places = records(&mission, &options).into_iter().filter_map(|it| match it {
            Record::Event(it) => Some(it.x_mm / 1000),
            _ => None,
        });
        places.collect::<Vec<_>>()
    };
    for seed in 0..200 {
        assert_eq!(metres(0, seed), [0; 0], "seed {seed}");
    }
    assert_eq!(metres(1000, 0), (0..187).collect::<Vec<_>>());
}

/// More than 2^64 pJ: 36 MJ in one stop of 23 days.
#[test]
fn energies_beyond_64_bits_of_picojoules_are_counted() {
    let mission = patrol();
    let kind = EventKind::Obstacle { delay: Millis(2_000_000_000) };
    let events = vec![Event { x: Millimetres(1_000), kind }];
    let end = run(&mission, &given(Faults { events, ..Faults::default() }));
    // 1 m at 410 mm/s and 18.224 W, which ends with the microsecond, then 2,000,000 s of it.
    let us = 2_439_025 + 2_000_000_000_000;
    assert_eq!(end.energy_pj, us * 18_224_000);
    assert!(end.energy_pj > u128::from(u64::MAX));
    assert_eq!(end.used, [2_000_002_439, 36_448_044_449]);
    assert_eq!((end.outcome, end.margins), (Outcome::Safe, [-1_999_402_439, -36_439_404_449]));
}

#[test]
fn a_limit_that_is_just_reached_is_kept() {
    let mission = shuttle();
    let planner = Planner::Exact { aim: Aim::MinEnergy, steps: 100_000 };
    let end = |delay: u64| {
        let events = vec![Event {
            x: Millimetres(200_000),
            kind: EventKind::Obstacle { delay: Millis(delay) },
        }];
        run(&mission, &Options { planner, ..given(Faults { events, ..Faults::default() }) })
    };
    let kept = end(20_000);
    assert_eq!((kept.outcome, kept.reason, kept.margins[0]), (Outcome::Completed, None, 0));
    let passed = end(20_001);
    let reason = Some(Reason::LimitExceeded { axis: 0, by: 1 });
    assert_eq!((passed.outcome, passed.reason, passed.margins[0]), (Outcome::Failed, reason, -1));
}

/// The plan that fills a limit to the last unit is a plan, and its margin is none.
#[test]
fn a_margin_of_nothing_is_no_reason_to_plan_again() {
    let plain = Options { faults: FaultChoice::None, ..with_period(1_000) };
    let whole = run(&shuttle(), &plain);
    let text = SHUTTLE.replace("duration_ms = 440000", "duration_ms = 420000");
    let tight = run(&Mission::parse("shuttle.toml", &text).unwrap(), &plain);
    assert_eq!((tight.outcome, tight.replans), (Outcome::Completed, 0));
    assert_eq!((tight.plans[0].after[0], tight.margins[0]), (0, 0));
    assert_eq!((tight.used, tight.checks), (whole.used, whole.checks));
}
