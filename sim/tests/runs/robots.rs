//! Missions of robots from files: under the supervisors that were checked.
#![allow(clippy::unwrap_used)]

use cotama_core::units::{Millimetres, Millis};
use cotama_models::missions::faults::Faults;
use cotama_models::missions::{Mission, embedded};
use cotama_models::robots::{Decision, Moment, Motion, RobotFile};
use cotama_sim::options::{FaultChoice, Fidelity, Options};
use cotama_sim::robots::{Driven, Injection, Run, Script};
use cotama_sim::run::Outcome;
use cotama_sim::trace::{Record, Trace, replay};
use proptest::prelude::*;
use std::sync::LazyLock;

static SHIFT: LazyLock<Mission> = LazyLock::new(|| {
    let shift = embedded::mission("shift").unwrap();
    Mission::parse(shift.name, shift.text).unwrap()
});

static PATROL: LazyLock<Mission> = LazyLock::new(|| {
    let patrol = embedded::mission("patrol").unwrap();
    let robot = RobotFile::shipped("p3dx-patrol");
    Mission::parse_under(patrol.name, patrol.text, robot).unwrap()
});

/// The number of a failure of a mission's robot.
fn row(mission: &Mission, id: &str) -> usize {
    let robot = mission.robot().unwrap().robot();
    robot.failures.iter().position(|it| it.id == id).unwrap()
}

fn failing(mission: &Mission, id: &str, x_mm: u64) -> Run {
    let when = Moment::Place(Millimetres(x_mm));
    let injections = vec![Injection { when, failure: row(mission, id), until: None }];
    let script = Script { injections, ..Script::default() };
    Driven::new(mission).unwrap().run(&script).unwrap()
}

#[test]
fn a_shift_goes_on_slower_asks_twice_and_is_completed() {
    let script = Script::of(&SHIFT.run.faults, &SHIFT);
    let run = Driven::new(&SHIFT).unwrap().run(&script).unwrap();
    assert_eq!((run.outcome, run.operator_requests, run.plans.len()), (Outcome::Completed, 2, 2));
    let decided: Vec<_> = run.conduct.iter().map(|it| it.decided.unwrap().1).collect();
    assert_eq!(decided, [Decision::Adapt, Decision::Ask, Decision::Ask]);
    let names = |it: &Option<usize>| {
        it.map(|it| SHIFT.robot().unwrap().robot().configurations[it].name.as_str())
    };
    let ran: Vec<_> = run.configurations.iter().filter_map(|it| names(&it.1)).collect();
    assert_eq!(ran[..4], ["Plan.Full", "Follow.Full", "Follow.Low", "Handle.Full"]);
    assert_eq!(ran[ran.len() - 1], "Manual.Guarded");
}

#[test]
fn a_fatal_failure_ends_the_shift_and_the_robot_stands() {
    let run = failing(&SHIFT, "DRV1", 20_000);
    let id = run.ended_by.map(|it| run.conduct[it].failure);
    assert_eq!((run.outcome, id), (Outcome::Safe, Some(row(&SHIFT, "DRV1"))));
    assert_eq!(
        run.summary(&SHIFT).reason.unwrap().text(&SHIFT),
        "the global supervisor ended the mission: drive reports an error (DRV1)"
    );
}

#[test]
fn a_laser_found_lost_gives_the_four_plans_of_table_7() {
    let plans = |mission: &Mission| {
        let (trace, run) = Trace::record(mission, &Options::default()).unwrap();
        let plans = trace.records.iter().filter_map(|it| match it {
            Record::Plan(it) => Some(it.plan.iter().map(|it| it.choice.clone()).collect()),
            _ => None,
        });
        (plans.collect::<Vec<Vec<_>>>(), run.outcome)
    };
    let patrol = embedded::mission("patrol").unwrap();
    let told = plans(&Mission::parse(patrol.name, patrol.text).unwrap());
    let found = plans(&PATROL);
    assert_eq!((found.1, found.0.len()), (Outcome::Completed, 4));
    assert_eq!(found.0, told.0);
    // 118 m, and a latency of 0.3 s.
    let run = failing(&PATROL, "LAS1", 118_000);
    let lost = &run.conduct[0];
    assert_eq!((lost.x.0 / 100, lost.detected.unwrap().0 - lost.injected.0), (1_180, 290));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// A mission without a robot has an exact world of its own; this is what holds both together.
    #[test]
    fn the_patrol_under_supervision_costs_what_the_exact_world_says(
        obstacles in prop::collection::btree_map(0_u32..187_000, 0_u32..20_000, 0..4)
    ) {
        let event = |(x, delay): (&u32, &u32)| {
            format!("{{ x_mm = {x}, kind = \"obstacle\", delay_ms = {delay} }}")
        };
        let events: Vec<_> = obstacles.iter().map(event).collect();
        let text = format!("format = \"panorama-faults/1\"\nevent = [{}]\n", events.join(", "));
        let patrol = embedded::mission("patrol").unwrap();
        let exact = Mission::parse(patrol.name, patrol.text).unwrap();
        // Where a limit binds, a tenth of a second decides on a replan.
        let used = |mission: &Mission| {
            let mission = mission.clone().with_limits([Some(700_000), Some(12_000_000)]).unwrap();
            let faults = Faults::parse("obstacles", &text, &mission).unwrap();
            let faults = FaultChoice::Given { source: "drawn".into(), faults };
            let run = Trace::record(&mission, &Options { faults, ..Options::default() }).unwrap().1;
            (run.outcome, run.plans.len(), run.used)
        };
        let (exact, supervised) = (used(&exact), used(&PATROL));
        prop_assert_eq!((exact.0, exact.1), (supervised.0, supervised.1));
        // 17 periods of 10 ms for 17 activities, and up to 3 where it is held up: there it brakes
        // and speeds up. A delay is rounded up to whole periods.
        let more = |axis: usize| supervised.2[axis] - exact.2[axis];
        let most = 170 + 40 * obstacles.len() as u64;
        prop_assert!((150..=most).contains(&more(0)), "{} ms", more(0));
        prop_assert!(more(1) <= most * 18, "{} mJ", more(1)); // at most 18 W
    }
}

#[test]
fn a_lost_localisation_algorithm_is_planned_around_as_well() {
    let run = failing(&PATROL, "LOC2", 118_000);
    assert_eq!((run.outcome, run.plans.len()), (Outcome::Completed, 2));
    let plan = &run.plans[1];
    assert_eq!(plan.cause.text(&PATROL), "the pose by codes is astray (LOC2)");
    let rows = plan.rows(&PATROL);
    assert!(rows.iter().all(|it| !it.choice.contains("L2")), "{rows:?}");
}

#[test]
fn the_operator_is_asked_when_no_plan_is_left() {
    // Somebody stands in the way for longer than the limit leaves.
    let patrol = PATROL.clone().with_limits([Some(500_000), None]).unwrap();
    let text = "format = \"panorama-faults/1\"\n\
        event = [{ x_mm = 1000, kind = \"obstacle\", delay_ms = 20000 }]\n";
    let faults = Faults::parse("obstacle", text, &patrol).unwrap();
    let run = Driven::new(&patrol).unwrap().run(&Script::of(&faults, &patrol)).unwrap();
    let plan = row(&PATROL, "PLN1");
    let told = run.conduct.iter().find(|it| it.failure == plan).unwrap();
    assert_eq!((told.decided.unwrap().1, run.operator_requests), (Decision::Ask, 1));
}

#[test]
fn a_recorded_shift_is_run_again_from_its_trace_alone() {
    let (trace, _) = Trace::record(&SHIFT, &Options::default()).unwrap();
    let read = Trace::parse("shift.jsonl", &trace.to_json_lines()).unwrap();
    assert!(replay(&read).unwrap().identical);
    assert_eq!(read.header.robot.unwrap().source, "transport");
}

#[test]
fn nothing_fails_and_nobody_is_asked() {
    for mission in [&*SHIFT, &*PATROL] {
        let options = Options { faults: FaultChoice::None, ..Options::default() };
        let run = Trace::record(mission, &options).unwrap().1;
        assert_eq!((run.outcome, run.operator_requests), (Outcome::Completed, 0));
    }
}

#[test]
fn a_setting_slows_the_robot_while_its_failure_lasts_and_five_seconds_more() {
    let when = Moment::At(Millis(20_000));
    let injections = vec![Injection { when, failure: row(&SHIFT, "SLP1"), until: None }];
    let mut records: Vec<Record> = Vec::new();
    let script = Script { injections, ..Script::default() };
    Driven::new(&SHIFT).unwrap().run_recorded(&script, Millis(100), &mut records).unwrap();
    let speed_at = |t_ms: u64| {
        let mut samples = records.iter().filter_map(|it| match it {
            Record::Sample(it) if it.t_us == t_ms * 1_000 => Some(it.speed_mm_s),
            _ => None,
        });
        samples.next().unwrap()
    };
    // The robot slips from 20.0 s to 23.0 s, at 70 % of what it is told: 60 % of 1.5 m/s.
    assert_eq!([speed_at(19_900), speed_at(22_000), speed_at(26_000)], [1_500, 630, 900]);
    // The last period in which it is seen is the one that ends at 23.0 s.
    assert!(speed_at(27_900) == 900 && speed_at(28_200) > 900, "{:?}", speed_at(28_200));
}

#[test]
fn a_loss_that_comes_back_is_used_again_by_the_next_start() {
    // The camera comes back: its loss is transient here.
    let robot = embedded_robot("transport").replace(
        "flags = [\"depth_late\"]",
        "persistence = \"transient\"\nends_ms = 20_000\nflags = [\"depth_late\"]",
    );
    let robot = RobotFile::parse("transport.toml", &robot).unwrap();
    let shift = embedded::mission("shift").unwrap();
    let mission = Mission::parse_under(shift.name, shift.text, Some(robot)).unwrap();
    let run = failing(&mission, "CAM1", 30_000);
    let robot = mission.robot().unwrap().robot();
    let ran: Vec<_> = run.configurations.iter().filter_map(|it| it.1).collect();
    let ran: Vec<_> = ran.iter().map(|it| robot.configurations[*it].name.as_str()).collect();
    let drives: Vec<_> = ran.iter().filter(|it| it.starts_with("Follow")).collect();
    assert_eq!(drives, [&"Follow.Full", &"Follow.Low", &"Follow.Full", &"Follow.Full"]);
    let causes: Vec<_> = run.plans.iter().map(|it| it.cause.text(&mission)).collect();
    assert_eq!(causes, ["start", "no depth image (CAM1)", "camera back"]);
}

/// A shift of the transport robot with more in the row of a flag.
fn shift_with(flag: &str, more: &str) -> Mission {
    let flags = format!("flags = [\"{flag}\"]");
    let robot = embedded_robot("transport").replace(&flags, &format!("{flags}\n{more}"));
    let robot = RobotFile::parse("transport.toml", &robot).unwrap_or_else(|it| panic!("{it}"));
    let shift = embedded::mission("shift").unwrap();
    Mission::parse_under(shift.name, shift.text, Some(robot)).unwrap()
}

#[test]
fn a_row_that_asks_first_stops_the_robot_and_adapts_once_the_operator_is_done() {
    let mission = shift_with("depth_late", "ask = { times = 1 }");
    let run = failing(&mission, "CAM1", 30_000);
    assert_eq!((run.outcome, run.operator_requests), (Outcome::Completed, 1));
    assert_eq!(run.conduct[0].decided.unwrap().1, Decision::Ask);
    let robot = mission.robot().unwrap().robot();
    let ran = run.configurations.iter().map(|it| it.1.map(|it| &robot.configurations[it].name));
    let ran: Vec<_> = ran.map(|it| it.map_or("", String::as_str)).collect();
    let asked = ran.iter().skip(1).position(|it| it.is_empty()).unwrap() + 1;
    assert_eq!(ran[asked - 1], "Follow.Full");
    assert!(ran[asked..].iter().all(|it| *it != "Follow.Full"), "{ran:?}");
}

#[test]
fn a_flag_that_the_operator_masks_asks_him_again_only_when_the_mask_is_over() {
    let requests = |mask: &str| {
        let mission = shift_with("load_shift", mask);
        let at = |x_mm| Injection {
            when: Moment::Place(Millimetres(x_mm)),
            failure: row(&mission, "LOD1"),
            until: None,
        };
        let script = Script { injections: vec![at(20_000), at(60_000)], ..Script::default() };
        Driven::new(&mission).unwrap().run(&script).unwrap().operator_requests
    };
    assert_eq!(requests(""), 2);
    assert_eq!(requests("mask = { flags = [\"load_shift\"], on = \"order\" }"), 1);
    let for_10_s = "mask = { flags = [\"load_shift\"], on = \"order\", lasts_ms = 10_000 }";
    assert_eq!(requests(for_10_s), 2);
}

#[test]
fn a_report_tells_what_was_asked_first_and_what_is_masked() {
    let more = "ask = { times = 1 }\nmask = { flags = [\"depth_late\"], on = \"order\" }";
    let mission = shift_with("depth_late", more);
    let when = Moment::Place(Millimetres(30_000));
    let injections = vec![Injection { when, failure: row(&mission, "CAM1"), until: None }];
    let script = Script { injections, ..Script::default() };
    let mut records: Vec<Record> = Vec::new();
    let ready = Driven::new(&mission).unwrap();
    ready.run_recorded(&script, Millis(1_000), &mut records).unwrap();
    let points = cotama_sim::story::points(&records);
    let decided = points[1].decided().unwrap();
    assert!(decided.contains("medium, but its row asks first, so"), "{decided}");
    let done = points[1].done().unwrap();
    assert!(done.contains("; mask `depth_late` on his order"), "{done}");
}

/// The longest time from a failure to the reaction of a supervisor, failure by failure at many
/// places, and how far each is within the time that its row allows.
fn reaction_times(mission: &Mission) -> Vec<(String, u64, u64)> {
    let robot = mission.robot().unwrap().robot();
    let ready = Driven::new(mission).unwrap();
    let mut all = Vec::new();
    for (number, it) in robot.failures.iter().enumerate() {
        // What shows in motion alone is seen where the robot moves.
        let is_seen = !matches!(it.motion, Motion::Blocked | Motion::Slowed(_) | Motion::Mindless);
        let Some(within) = robot.reacts_within(number).filter(|_| is_seen) else { continue };
        let taken = (0..40).filter_map(|place| {
            let when = Moment::At(Millis(1_000 + 3_170 * place));
            let injections = vec![Injection { when, failure: number, until: None }];
            let run = ready.run(&Script { injections, ..Script::default() }).unwrap();
            let it = run.conduct.first()?;
            Some(it.answered?.0 - it.injected.0)
        });
        all.extend(taken.max().map(|most| (it.id.clone(), most, within.0)));
    }
    all
}

#[test]
fn no_reaction_takes_longer_than_its_row_allows_and_some_take_as_long() {
    let delivery = embedded::mission("delivery").unwrap();
    let delivery = Mission::parse(delivery.name, delivery.text).unwrap();
    for (mission, answered) in [(&*SHIFT, 7), (&*PATROL, 1), (&delivery, 24)] {
        let all = reaction_times(mission);
        // What fails in the middle of a period is looked at as long later.
        let period = mission.robot().unwrap().robot().body.as_ref().unwrap().period.0;
        assert!(all.iter().all(|it| it.1 + period <= it.2), "{all:?}");
        assert!(all.iter().any(|it| it.1 + period == it.2), "{all:?}");
        assert_eq!(all.len(), answered, "{all:?}");
    }
}

fn embedded_robot(name: &str) -> String {
    cotama_models::robots::embedded(name).unwrap().text.to_owned()
}

fn script() -> impl Strategy<Value = Script> {
    let failures = SHIFT.robot().unwrap().robot().failures.len();
    let when = prop_oneof![
        (0..180_000u64).prop_map(|it| Moment::Place(Millimetres(it))),
        (0..400_000u64).prop_map(|it| Moment::At(Millis(it))),
        (0..5usize, 0..20_000u64).prop_map(|(part, it)| Moment::During(part, Millis(it))),
        (0..20_000u64).prop_map(|it| Moment::Waiting(Millis(it))),
    ];
    let one = (when.clone(), 0..failures, prop::option::of(when))
        .prop_map(|(when, failure, until)| Injection { when, failure, until });
    let all = prop::collection::vec(one, 0..4);
    all.prop_map(|injections| Script { injections, ..Script::default() })
}

/// Runs without a record pass over quiet periods, others do not.
fn same_with_and_without_a_record(script: &Script, fidelity: Fidelity) {
    let options = Options { fidelity, ..Options::default() };
    let ready = Driven::with(&SHIFT, &options).unwrap();
    let mut records: Vec<Record> = Vec::new();
    let step_by_step = ready.run_recorded(script, Millis(1_000), &mut records).unwrap();
    assert_eq!(ready.run(script).unwrap(), step_by_step);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn quiet_periods_that_are_passed_over_change_nothing(script in script()) {
        same_with_and_without_a_record(&script, Fidelity::Line);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn quiet_periods_that_are_passed_over_in_the_plane_change_nothing(script in script()) {
        same_with_and_without_a_record(&script, Fidelity::Plane);
    }
}
