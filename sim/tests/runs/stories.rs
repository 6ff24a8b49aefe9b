//! Stories of a robot on its mission, one trouble at a time.
#![allow(clippy::unwrap_used)]

#[path = "stories/exact.rs"]
mod exact;

use crate::common::{SHUTTLE, causes, labels, patrol, run, shuttle, under};
use cotama_core::monitor::Upward;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::missions::Mission;
use cotama_models::missions::faults::{Event, EventKind, Faults, PowerError, RandomEvent};
use cotama_sim::options::{Aim, FaultChoice, Options, Planner};
use cotama_sim::run::{MAX_REPLANS, NoPlan, Outcome, Reason};
use cotama_sim::setup::{SetupError, Simulation};
use cotama_sim::trace::{Occurrence, Record};
use cotama_sim::world::World;

const UPWARD: Upward<2> = Upward { growth: [60_000, 600_000], reserve: [5_000, 30_000] };

fn records(mission: &Mission, options: &Options) -> Vec<Record> {
    let mut records = Vec::new();
    Simulation::new(mission, options).unwrap().run_recorded(options.seed, &mut records).unwrap();
    records
}

#[test]
fn a_mission_without_faults_goes_as_planned() {
    for mission in [patrol(), shuttle()] {
        let run = run(&mission, &Options { faults: FaultChoice::None, ..Options::default() });
        assert_eq!((run.outcome, run.replans, run.reason), (Outcome::Completed, 0, None));
        // Each activity is planned to half a millisecond and half a millijoule, and ends on a whole
        // microsecond.
        let activities = mission.scenario().activities.len() as u64;
        let planned = run.plans[0].after;
        assert!(
            run.margins[0].abs_diff(planned[0]) <= activities / 2 + 1,
            "{:?} {planned:?}",
            run.margins
        );
        assert!(
            run.margins[1].abs_diff(planned[1]) <= activities * 10 + 1,
            "{:?} {planned:?}",
            run.margins
        );
    }
}

#[test]
fn a_lost_camera_stops_the_patrol_before_the_valve() {
    let mission = patrol();
    let options = under(
        &mission,
        r#"event = [{ x_mm = 20000, kind = "fault", hardware = "kinect", units_lost = 1 }]"#,
    );
    let end = run(&mission, &options);
    assert_eq!((end.outcome, end.operator_requests, end.replans), (Outcome::Safe, 0, 0));
    assert_eq!(end.reason, Some(Reason::NoPlan(NoPlan::Emptied { activity: 2 })));
    assert_eq!(end.x_mm, 20_000);
    let records = records(&mission, &options);
    assert!(!records.iter().any(|it| matches!(it, Record::Request(_))), "nobody is asked");
    let aborts: Vec<_> = records.iter().filter(|it| matches!(it, Record::Abort(_))).collect();
    let [Record::Abort(abort)] = aborts[..] else { panic!("one abort: {aborts:?}") };
    assert_eq!(abort.cause, "one kinect lost");
    assert_eq!(abort.reason, "no alternative left for A3");
    let Some(Record::End(end)) = records.last() else { panic!("an end") };
    assert_eq!(
        (end.outcome, end.reason.as_deref()),
        (Outcome::Safe, Some("no alternative left for A3"))
    );
}

#[test]
fn an_obstacle_that_never_goes_away_is_a_safe_stop() {
    let mission = patrol();
    let body = r#"event = [{ x_mm = 50000, kind = "obstacle", delay_ms = 1000000000 }]"#;
    let end = run(&mission, &under(&mission, body));
    assert_eq!((end.outcome, end.operator_requests, end.x_mm), (Outcome::Safe, 0, 50_000));
    let Some(Reason::NoPlan(NoPlan::Limit { axis: 0, short })) = end.reason else {
        panic!("{:?}", end.reason)
    };
    // The robot gives up in the first period in which no plan is left, within its limits.
    assert!(short <= 1_000, "{short} ms are missing, of a period");
    assert!(end.margins.iter().all(|&it| it > 0), "{:?}", end.margins);
}

#[test]
fn an_obstacle_on_the_last_millimetre_is_a_failure() {
    let mission = patrol();
    let body = r#"event = [{ x_mm = 187000, kind = "obstacle", delay_ms = 100000 }]"#;
    let end = run(&mission, &under(&mission, body));
    assert_eq!((end.outcome, end.operator_requests, end.replans), (Outcome::Failed, 0, 0));
    let Some(Reason::LimitExceeded { axis: 0, by }) = end.reason else {
        panic!("{:?}", end.reason)
    };
    assert_eq!(by, end.margins[0].unsigned_abs());
}

#[test]
fn a_limit_passed_between_two_checks_is_a_failure() {
    let mission = shuttle();
    let body = "power_error_permille = { home = 900 }";
    let seen = run(&mission, &under(&mission, body));
    assert_eq!(seen.outcome, Outcome::Safe, "checked every second");
    let blind = Options { monitor_period: Some(Millis(3_600_000)), ..under(&mission, body) };
    let blind = run(&mission, &blind);
    assert_eq!((blind.outcome, blind.replans), (Outcome::Failed, 0));
    assert!(matches!(blind.reason, Some(Reason::LimitExceeded { axis: 1, .. })));
}

#[test]
fn a_mission_without_a_plan_does_not_start() {
    let text = SHUTTLE.replace("energy_mj = 3400000", "energy_mj = 1000000");
    let mission = Mission::parse("shuttle.toml", &text).unwrap();
    let options = Options::default();
    let simulation = Simulation::new(&mission, &options).unwrap();
    let mut records: Vec<Record> = Vec::new();
    let none = simulation.run_recorded(0, &mut records).unwrap_err();
    assert_eq!(none.text(&mission), "no plan within the energy limit: 1080 J short");
    assert!(records.is_empty());
}

#[test]
fn events_on_a_border_come_before_the_next_activity() {
    let mission = shuttle();
    let body = r#"event = [{ x_mm = 0, kind = "odometry", extra_mm = 1000 },
        { x_mm = 100000, kind = "fault", hardware = "laser", units_lost = 2 },
        { x_mm = 100000, kind = "obstacle", delay_ms = 5000 }]"#;
    let options = under(&mission, body);
    let records = records(&mission, &options);
    let story: Vec<_> = records
        .iter()
        .filter_map(|record| match record {
            Record::Plan(plan) => {
                Some(format!("{} from {}: {}", plan.x_mm, plan.first_activity, plan.cause))
            }
            Record::Activity(activity) => Some(format!("{} {}", activity.x_mm, activity.activity)),
            Record::Event(event) => Some(match &event.event {
                Occurrence::Obstacle { .. } => {
                    format!("{} obstacle {} us", event.x_mm, event.lost_us)
                }
                Occurrence::Odometry { .. } => {
                    format!("{} odometry {} us", event.x_mm, event.lost_us)
                }
                Occurrence::Fault { units_left, .. } => {
                    format!("{} fault, {units_left} left", event.x_mm)
                }
                Occurrence::Repair { .. } => "repair".into(),
                Occurrence::Detour { .. } => "detour".into(),
            }),
            _ => None,
        })
        .collect();
    assert_eq!(
        story,
        [
            "0 from A1: start",
            "0 odometry 2000000 us",
            "0 A1",
            "0 A2",
            "50000 A3",
            "100000 fault, 0 left",
            "100000 from A4: two lasers lost",
            "100000 obstacle 5000000 us",
            "100000 A4",
            "100000 A5",
            "150000 A6",
        ]
    );
}

#[test]
fn another_random_event_does_not_shift_the_first() {
    let mission = patrol();
    let people = r#"{ name = "people", kind = "obstacle", per_km = 60, delay_ms = 200 }"#;
    let doors = r#"{ name = "doors", kind = "odometry", per_km = 40, extra_mm = 10 }"#;
    let places = |body: &str, seed: u64, name: &str| -> Vec<u64> {
        let options = Options { seed, ..under(&mission, body) };
        let events = records(&mission, &options).into_iter().filter_map(|record| match record {
            Record::Event(event) if event.random.as_deref() == Some(name) => Some(event.x_mm),
            _ => None,
        });
        events.collect()
    };
    for seed in 0..8 {
        let alone = places(&format!("random = [{people}]"), seed, "people");
        let both = format!("random = [{doors}, {people}]");
        assert!((3..40).contains(&alone.len()), "{alone:?}");
        assert_eq!(places(&both, seed, "people"), alone);
        assert_ne!(places(&both, seed, "doors"), alone);
        assert_ne!(places(&both, seed + 1, "people"), alone);
    }
}

/// Two kinds of people, equally many: they do not walk together.
#[test]
fn random_events_of_equal_rates_happen_at_other_places() {
    let mission = patrol();
    let some =
        |name| format!("{{ name = \"{name}\", kind = \"odometry\", per_km = 60, extra_mm = 1 }}");
    let body = format!("random = [{}, {}]", some("guards"), some("guests"));
    let mut places = [Vec::new(), Vec::new()];
    for record in records(&mission, &under(&mission, &body)) {
        let Record::Event(event) = record else { continue };
        places[usize::from(event.random.as_deref() == Some("guests"))].push(event.x_mm);
    }
    assert!(places.iter().all(|it| it.len() > 3), "{places:?}");
    assert!(places[0].iter().all(|it| !places[1].contains(it)), "{places:?}");
}

#[test]
fn random_events_come_as_often_as_the_file_says() {
    let mission = patrol();
    let body = r#"random = [{ name = "dust", kind = "odometry", per_km = 100, extra_mm = 1 }]"#;
    let simulation = Simulation::new(&mission, &under(&mission, body)).unwrap();
    let total: u64 = (0..200).map(|seed| simulation.run(seed).unwrap().events.odometry).sum();
    // 200 missions of 187 m: 3740 expected, standard deviation 58.
    assert!((3_540..3_940).contains(&total), "{total}");
}

#[test]
fn a_clone_of_the_world_goes_on_identically() {
    let mission = patrol();
    let simulation = Simulation::new(&mission, &Options::default()).unwrap();
    let mut nothing = cotama_sim::record::Silent;
    for stop in [1, 63, 200, 311, 480] {
        let mut world = World::start(&simulation, 0, &mut nothing).unwrap();
        for _ in 0..stop {
            assert!(world.step(&mut nothing).is_none());
        }
        let mut twin = world.clone();
        let (mut records, mut twins): (Vec<Record>, Vec<Record>) = (Vec::new(), Vec::new());
        let end = std::iter::from_fn(|| Some(world.step(&mut records))).flatten().next();
        let twin_end = std::iter::from_fn(|| Some(twin.step(&mut twins))).flatten().next();
        assert_eq!((end, records), (twin_end, twins));
    }
}

#[test]
fn repaired_lasers_are_used_again_once() {
    let mission = patrol();
    let body = r#"event = [{ x_mm = 20000, kind = "fault", hardware = "laser", units_lost = 2 },
        { x_mm = 60000, kind = "repair", hardware = "laser", units_back = 2 }]"#;
    let kept = run(&mission, &under(&mission, body));
    assert_eq!(
        causes(&mission, &kept),
        ["start", "two lasers lost"],
        "without the policy nothing goes up"
    );
    assert!(labels(&mission, &kept, 1).iter().all(|choice| !choice.contains("M5")));
    let options = Options { upward: Some(UPWARD), ..under(&mission, body) };
    let end = run(&mission, &options);
    assert_eq!(causes(&mission, &end), ["start", "two lasers lost", "room for a better plan"]);
    assert_eq!(end.plans[2].x_mm, 60_000);
    assert!(labels(&mission, &end, 2).contains(&"M5 L2".to_owned()));
    assert_eq!(end.outcome, Outcome::Completed);
    // The reserve is kept by the plan.
    assert!(end.plans[2].after[0] >= 5_000 && end.plans[2].after[1] >= 30_000);
}

#[test]
fn savings_are_spent_without_flapping() {
    let mission = patrol();
    let body = r#"power_error_permille = { "H1-out" = -150, "H2" = -150, "H1-back" = -150 }"#;
    let end = run(&mission, &Options { upward: Some(UPWARD), ..under(&mission, body) });
    assert_eq!(end.outcome, Outcome::Completed);
    // At most 15 % of 8640 J are saved, and each plan needs 600 J of growth.
    assert!((1..=2).contains(&end.replans), "{:?}", causes(&mission, &end));
    assert!(end.plans[1..].iter().all(|plan| plan.cause == cotama_sim::run::PlanCause::Room));
}

#[test]
fn hardware_that_comes_and_goes_is_given_up_at_last() {
    let mission = patrol();
    let flicker = r#"event = [{ x_mm = 1000, kind = "fault", hardware = "laser", units_lost = 1 },
        { x_mm = 1000, kind = "repair", hardware = "laser", units_back = 1 }]"#;
    let mut options = Options { upward: Some(UPWARD), ..under(&mission, flicker) };
    let FaultChoice::Given { faults, .. } = &mut options.faults else { unreachable!() };
    faults.events = faults.events.repeat(6_000);
    let end = run(&mission, &options);
    assert_eq!((end.outcome, end.reason), (Outcome::Safe, Some(Reason::TooManyReplans)));
    assert_eq!((end.replans, end.operator_requests), (MAX_REPLANS, 0));
}

#[test]
fn a_complete_search_drives_too() {
    let mission = patrol();
    for planner in [
        Planner::PanoramaThenExact { steps: 100_000 },
        Planner::Exact { aim: Aim::Quality, steps: 100_000 },
        Planner::Exact { aim: Aim::MinEnergy, steps: 100_000 },
    ] {
        let end = run(
            &mission,
            &Options { planner: Some(planner), faults: FaultChoice::None, ..Options::default() },
        );
        assert_eq!((end.outcome, end.replans), (Outcome::Completed, 0), "{planner:?}");
        match planner {
            Planner::Exact { aim: Aim::MinEnergy, .. } => {
                assert_eq!(end.plans[0].after[1], 8_640_000 - 4_675_896);
            }
            Planner::Exact { .. } => assert_eq!(end.plans[0].allocator, "exact"),
            _ => assert_eq!(end.plans[0].allocator, "panorama"),
        }
    }
}

#[test]
fn options_that_do_not_fit_are_refused() {
    let (mission, other) = (shuttle(), patrol());
    let options = Options { monitor_period: Some(Millis(0)), ..Options::default() };
    assert_eq!(Simulation::new(&mission, &options).unwrap_err(), SetupError::ZeroPeriod);
    let foreign = under(
        &other,
        r#"event = [{ x_mm = 1, kind = "fault", hardware = "actuators", units_lost = 1 }]"#,
    );
    assert_eq!(Simulation::new(&mission, &foreign).unwrap_err(), SetupError::ForeignFaults);
    // The shuttle has two kinds of hardware and three zones, numbered from 0.
    let zone =
        |zone| Faults { power_errors: vec![PowerError { zone, permille: 1 }], ..Faults::default() };
    let fault = |hardware| {
        let kind = EventKind::Fault { hardware, units: 1 };
        Faults { events: vec![Event { x: Millimetres(1), kind }], ..Faults::default() }
    };
    let ready = |faults: Faults| {
        let faults = FaultChoice::Given { source: "test".into(), faults };
        Simulation::new(&mission, &Options { faults, ..Options::default() }).map(|_| ())
    };
    assert_eq!([zone(2), fault(1)].map(ready), [Ok(()), Ok(())]);
    let foreign = [zone(3), fault(2)].map(|it| ready(it).unwrap_err());
    assert_eq!(foreign, [SetupError::ForeignFaults, SetupError::ForeignFaults]);
}

#[test]
fn random_events_may_take_so_many_draws_and_no_more() {
    let drawn = |text: &str, count: usize| {
        let mission = Mission::parse("shuttle.toml", text).unwrap();
        let kind = EventKind::Obstacle { delay: Millis(1) };
        let random = vec![RandomEvent { name: String::new(), per_km: 1, kind }; count];
        let faults = Faults { random, ..Faults::default() };
        let faults = FaultChoice::Given { source: "test".into(), faults };
        Simulation::new(&mission, &Options { faults, ..Options::default() }).map(|_| ())
    };
    assert_eq!(drawn(SHUTTLE, 50_000), Ok(()));
    assert_eq!(drawn(SHUTTLE, 50_001), Err(SetupError::TooManyDraws { draws: 10_000_200 }));
    // Half of a metre takes a draw as well.
    let longer = SHUTTLE.replace("200000", "200500");
    assert_eq!(drawn(&longer, 49_752), Err(SetupError::TooManyDraws { draws: 10_000_152 }));
}
