//! Limits, ends of zones, rests and rates: what a unit more or less changes.

use super::records;
use crate::common::{SHUTTLE, faults, patrol, run, shuttle, under, with_period};
use cotama_core::monitor::Upward;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::missions::Mission;
use cotama_models::missions::faults::{Event, EventKind, Faults, PowerError, RandomEvent};
use cotama_sim::options::{Aim, FaultChoice, Options, Planner};
use cotama_sim::run::{EventCounts, MAX_CHECKS, MAX_REPLANS, Outcome, PlanCause, Reason};
use cotama_sim::setup::Simulation;
use cotama_sim::trace::{Occurrence, Record};
use cotama_sim::world::World;

fn given(faults: Faults) -> Options {
    let faults = FaultChoice::Given { source: "test".into(), faults };
    Options { faults, ..Options::default() }
}

/// The savings would pay for a better plan, but no margin has grown enough to look for one.
#[test]
fn a_repair_of_working_hardware_is_no_reason_to_look_for_a_better_plan() {
    let mission = patrol();
    let never = 1_000_000_000_000;
    let upward = Some(Upward { growth: [never, never], reserve: [0, 0] });
    let replans = |lost: &str| {
        let body = format!(
            "power_error_permille = {{ \"H1-out\" = -300 }}\nevent = [{lost}\
             {{ x_mm = 60000, kind = \"repair\", hardware = \"laser\", units_back = 1 }}]"
        );
        let end = run(&mission, &Options { upward, ..under(&mission, &body) });
        end.plans[1..].iter().map(|it| it.cause).collect::<Vec<_>>()
    };
    assert_eq!(replans(""), []);
    let lost = "{ x_mm = 59000, kind = \"fault\", hardware = \"laser\", units_lost = 1 },";
    assert_eq!(replans(lost), [PlanCause::Hardware { hardware: 1, units: 1 }, PlanCause::Room]);
}

/// Both lasers are lost and repaired, where 863.623 J are left, and the rule finds no better plan.
/// In the wide hall a tenth of the power is saved, and soon it would.
#[test]
fn a_refused_better_plan_is_not_asked_for_again_until_it_is_paid_for() {
    let mission = patrol();
    let body = r#"power_error_permille = { "H2" = -100 }
        event = [{ x_mm = 59000, kind = "fault", hardware = "laser", units_lost = 2 },
        { x_mm = 60000, kind = "repair", hardware = "laser", units_back = 2 }]"#;
    let plans = |growth: u64| {
        let upward = Some(Upward { growth: [0, growth], reserve: [0, 0] });
        let end = run(&mission, &Options { upward, ..under(&mission, body) });
        assert_eq!((end.outcome, end.plans[1].after), (Outcome::Completed, [72_076, 863_623]));
        end.plans[1..].iter().map(|it| (it.cause, it.x_mm)).collect::<Vec<_>>()
    };
    let lost = (PlanCause::Hardware { hardware: 1, units: 2 }, 59_000);
    // The repair was a reason once, and what is saved is none.
    assert_eq!(plans(1_000_000_000_000), [lost]);
    assert_eq!(plans(20_000)[..2], [lost, (PlanCause::Room, 69_735)]);
    assert_eq!(plans(150_000), [lost, (PlanCause::Room, 98_025)]);
}

/// On the last activity, of which nothing is left but itself.
#[test]
fn hardware_that_only_the_current_activity_needs_is_missed() {
    let text = SHUTTLE.replace("energy_mj = 3400000", "energy_mj = 9000000");
    let mission = Mission::parse("shuttle.toml", &text).unwrap();
    let planner = Some(Planner::Exact { aim: Aim::Quality, steps: 100_000 });
    let body =
        r#"event = [{ x_mm = 190000, kind = "fault", hardware = "camera", units_lost = 1 }]"#;
    let end = run(&mission, &Options { planner, ..under(&mission, body) });
    assert_eq!(end.plans[1..].iter().map(|it| it.x_mm).collect::<Vec<_>>(), [190_000]);
    assert_eq!(end.plans[1].cause, PlanCause::Hardware { hardware: 1, units: 1 });
}

#[test]
fn a_repair_gives_back_no_more_units_than_the_robot_has() {
    let mission = shuttle();
    let body = r#"event = [{ x_mm = 10000, kind = "fault", hardware = "laser", units_lost = 1 },
        { x_mm = 20000, kind = "repair", hardware = "laser", units_back = 2 },
        { x_mm = 30000, kind = "fault", hardware = "laser", units_lost = 1 },
        { x_mm = 40000, kind = "fault", hardware = "laser", units_lost = 2 },
        { x_mm = 60000, kind = "repair", hardware = "laser", units_back = 2 }]"#;
    let options = under(&mission, body);
    let counted = EventCounts { faults: 3, repairs: 2, ..EventCounts::default() };
    assert_eq!((run(&mission, &options).events, counted.total()), (counted, 5));
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
            Occurrence::Fault { hardware: laser(), units_lost: 1, units_left: 1 },
            Occurrence::Fault { hardware: laser(), units_lost: 1, units_left: 0 },
            Occurrence::Repair { hardware: laser(), units_back: 2, units_left: 2 },
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
    let planner = Some(Planner::Panorama);
    let options = Options { planner, monitor_period: Some(Millis(1)), ..under(&mission, body) };
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
fn events_in_any_order_of_the_file_happen_by_place() {
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
fn the_second_zone_begins_at_the_border_of_two() {
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

/// More than 2^64 pJ: 30 MJ in one stop of 23 days, by a robot that does not give up.
#[test]
fn energies_beyond_64_bits_of_picojoules_are_counted() {
    let mission = patrol();
    let wait = |delay: u64| {
        let kind = EventKind::Obstacle { delay: Millis(delay) };
        let events = vec![Event { x: Millimetres(1_000), kind }];
        let monitor_period = Some(Millis(30_000));
        let faults = given(Faults { events, ..Faults::default() });
        run(&mission, &Options { rigid: true, monitor_period, ..faults })
    };
    let (end, without) = (wait(2_000_000_000), wait(0));
    // 4.89 W of motion at rest, 1.3 W of the sonar, 4.4 W of two lasers, 4.6 W of the Kinect.
    assert_eq!(end.energy_pj - without.energy_pj, 2_000_000_000_000 * 15_190_000);
    assert_eq!(end.time_us - without.time_us, 2_000_000_000_000);
    assert!(end.energy_pj > u128::from(u64::MAX));
    assert_eq!((end.outcome, without.outcome), (Outcome::Failed, Outcome::Completed));
    assert_eq!(end.used[1], without.used[1] + 30_380_000_000);
}

#[test]
fn a_limit_that_is_just_reached_is_kept() {
    let mission = shuttle();
    let planner = Some(Planner::Exact { aim: Aim::MinEnergy, steps: 100_000 });
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
    // Every second from the start on, and as activities start: these start at whole seconds.
    assert_eq!((tight.used, tight.checks), (whole.used, 420));
    assert_eq!(whole.checks, 420);
}

/// Faults that are not answered by a better plan, too: the last of all replans is one of these.
#[test]
fn the_most_replans_are_made_and_not_one_less() {
    let mission = patrol();
    let laser = mission.hardware.iter().position(|it| it.name == "laser").unwrap();
    let x = Millimetres(1_000);
    let lost = Event { x, kind: EventKind::Fault { hardware: laser, units: 1 } };
    let back = Event { x, kind: EventKind::Repair { hardware: laser, units: 1 } };
    let upward = Some(Upward { growth: [60_000, 600_000], reserve: [5_000, 30_000] });
    assert_eq!(MAX_REPLANS, 10_000);
    // In the second run the last replan is not upwards, and no better one is looked for.
    for (first, reason) in [(vec![], Some(Reason::TooManyReplans)), (vec![lost], None)] {
        let events = [first, [lost, back].repeat(6_000)].concat();
        let options = Options { upward, ..given(Faults { events, ..Faults::default() }) };
        let end = run(&mission, &options);
        assert_eq!((end.reason, end.replans), (reason, MAX_REPLANS));
        assert_eq!(end.plans.len() as u64, 1 + MAX_REPLANS);
    }
}

/// With a replan between two events the robot goes on at the speed of the new plan, at once.
#[test]
fn after_a_replan_under_way_the_new_speed_is_driven() {
    let slow = "id = \"lasers\"\nspeed_max_mm_s = 450";
    let text = SHUTTLE.replacen("id = \"lasers\"", slow, 1).replacen(
        "duration_ms = 440000",
        "duration_ms = 480000",
        1,
    );
    let mission = Mission::parse("shuttle.toml", &text).unwrap();
    let mut speeds = std::collections::BTreeSet::new();
    for permille in [20, 50, 100, 150, 200] {
        let body = format!("power_error_permille = {{ near = {permille}, far = {permille} }}");
        let records = records(&mission, &under(&mission, &body));
        for (at, it) in records.iter().enumerate() {
            let Record::Plan(plan) = it else { continue };
            let begins = records[at..].iter().find_map(|it| match it {
                Record::Activity(it) => Some((it.t_us, it.x_mm)),
                Record::Event(_) | Record::Plan(_) if it.t_us() > plan.t_us => Some((0, 0)),
                _ => None,
            });
            let Some((t_us, x_mm)) = begins.filter(|it| it.0 > plan.t_us) else { continue };
            let speed = plan.plan[0].speed_mm_s;
            let way_um = (x_mm - plan.x_mm) * 1_000;
            // The position is known to a millimetre.
            let drove = (t_us - plan.t_us) * speed / 1_000;
            assert!(drove <= way_um && way_um <= drove + 1_000, "{drove} {way_um} {plan:?}");
            let before = records[..at].iter().rev().find_map(|it| match it {
                Record::Sample(it) => Some(it.speed_mm_s),
                _ => None,
            });
            speeds.insert((before, speed));
        }
    }
    assert!(speeds.contains(&(Some(450), 500)), "{speeds:?}");
}

#[test]
fn the_most_checks_are_made_and_not_one_more() {
    let wait = Event { x: Millimetres(1_000), kind: EventKind::Obstacle { delay: Millis(0) } };
    let events = vec![wait; MAX_CHECKS as usize];
    let end = run(&shuttle(), &given(Faults { events, ..Faults::default() }));
    assert_eq!((end.outcome, end.reason), (Outcome::Safe, Some(Reason::TooManyChecks)));
    assert_eq!(end.checks, MAX_CHECKS);
}

/// 76.387 J are left by the first plan; a better one would have to leave 100 J.
#[test]
fn a_plan_that_is_needed_may_use_the_reserve() {
    let never = 1_000_000_000_000;
    let upward = Some(Upward { growth: [never, never], reserve: [0, 100_000] });
    let end = run(&patrol(), &Options { upward, faults: FaultChoice::None, ..Options::default() });
    assert_eq!(end.plans[0].after, [72_076, 76_387]);
}

/// An obstacle where the power changes: who waits there is in the zone that begins.
#[test]
fn an_event_on_a_border_takes_the_power_of_the_zone_behind_it() {
    let mission = shuttle();
    let body = "power_error_permille = { far = 100 }\n\
                event = [{ x_mm = 50000, kind = \"obstacle\", delay_ms = 7000 }]";
    let records = records(&mission, &under(&mission, body));
    let event = records.iter().position(|it| matches!(it, Record::Event(_))).unwrap();
    let sample = |it: &Record| match it {
        Record::Sample(it) => Some(*it),
        _ => None,
    };
    let began = records[event].t_us() - 7_000_000;
    let waits: Vec<_> = records[..event].iter().filter_map(sample).collect();
    let waits: Vec<_> = waits.into_iter().filter(|it| it.t_us >= began).collect();
    let after = sample(&records[event + 1]).unwrap();
    // The margin is checked as the wait begins, and in each of its seconds.
    assert_eq!((waits[0].t_us, waits.len()), (began, 8));
    let rest = waits[0].planned_power_mw;
    assert!(waits.iter().all(|it| it.real_power_mw == rest * 11 / 10 && it.speed_mm_s == 0));
    assert_eq!(after.used.energy_mj - waits[0].used.energy_mj, 7 * rest * 11 / 10);
}

/// The savings ask for a better plan again and again; the present one is as good as it gets, and
/// rounded up to millimetres it costs a little more.
#[test]
fn the_same_plan_rounded_otherwise_is_no_better_plan() {
    let text = SHUTTLE.replace("energy_mj = 3400000", "energy_mj = 9000000");
    let mission = Mission::parse("shuttle.toml", &text).unwrap();
    let upward = Some(Upward { growth: [1, 1], reserve: [0, 0] });
    let body = "power_error_permille = { near = -100, far = -100, home = -100 }";
    let monitor_period = Some(Millis(33));
    let end = run(&mission, &Options { upward, monitor_period, ..under(&mission, body) });
    assert_eq!((end.outcome, end.replans), (Outcome::Completed, 0));
}

/// The robot has lidars that are as good as its lasers: it goes on with them.
#[test]
fn a_plan_that_is_as_good_is_no_better_plan() {
    let lidar = "[hardware.lidar]\nunits = 2\npower_mw = 1000\n[motion_power]";
    let option = "[[tio]]\nid = \"lidars\"\ntask = \"MOV\"\nneeds = { lidar = 2 }\n\
                  quality_per_dm = 3\n[[objective]]\nid = \"start\"";
    let text = SHUTTLE
        .replacen("[motion_power]", lidar, 1)
        .replacen("[[objective]]\nid = \"start\"", option, 1)
        .replace("energy_mj = 3400000", "energy_mj = 9000000");
    let mission = Mission::parse("shuttle.toml", &text).unwrap();
    let upward = Some(Upward { growth: [1, 1], reserve: [0, 0] });
    let body = r#"event = [{ x_mm = 10000, kind = "fault", hardware = "laser", units_lost = 2 },
        { x_mm = 60000, kind = "repair", hardware = "laser", units_back = 2 }]"#;
    let end = run(&mission, &Options { upward, ..under(&mission, body) });
    let causes: Vec<_> = end.plans.iter().map(|it| it.cause).collect();
    assert_eq!(causes, [PlanCause::Start, PlanCause::Hardware { hardware: 0, units: 2 }]);
    let costs = end.plans.iter().map(|it| it.after).collect::<Vec<_>>();
    assert_eq!(costs[0], costs[1], "the lidars cost as much");
}

/// On the last metre of the last activity: what was driven of it is no quality to come.
#[test]
fn a_better_plan_for_the_last_metre_is_a_better_plan() {
    let text = SHUTTLE.replace("energy_mj = 3400000", "energy_mj = 9000000");
    let mission = Mission::parse("shuttle.toml", &text).unwrap();
    let never = 1_000_000_000_000;
    let upward = Some(Upward { growth: [never, never], reserve: [0, 0] });
    let body = r#"event = [{ x_mm = 151000, kind = "fault", hardware = "laser", units_lost = 2 },
        { x_mm = 199000, kind = "repair", hardware = "laser", units_back = 2 }]"#;
    let end = run(&mission, &Options { upward, ..under(&mission, body) });
    let plans: Vec<_> = end.plans[1..].iter().map(|it| (it.cause, it.x_mm)).collect();
    let lost = PlanCause::Hardware { hardware: 0, units: 2 };
    assert_eq!(plans, [(lost, 151_000), (PlanCause::Room, 199_000)]);
}
