//! The delivery with its seven incidents (Durand et al., TAROS 2010, Section VI), under the
//! supervisors that its robot's file makes.
//!
//! `UPDATE_GOLDEN=1 cargo test -p cotama-sim --test runs delivery` rewrites the golden files.
#![allow(clippy::unwrap_used, clippy::format_push_string)]

use cotama_core::units::{Millimetres, Millis};
use cotama_models::missions::faults::Faults;
use cotama_models::missions::{Mission, embedded};
use cotama_models::robots::{Decision, Moment, Robot};
use cotama_sim::options::{FaultChoice, Options};
use cotama_sim::robots::{Driven, Injection, Run, Script};
use cotama_sim::run::{Outcome, Reason};
use cotama_sim::story;
use cotama_sim::trace::{Record, Sample, Trace, replay};
use proptest::prelude::*;
use std::fmt::Write;
use std::sync::LazyLock;

static DELIVERY: LazyLock<Mission> = LazyLock::new(|| with(&[]));

/// The delivery with other words in place of some.
fn with(edits: &[(&str, &str)]) -> Mission {
    let delivery = embedded::mission("delivery").unwrap();
    let edit = |text: String, (old, new): &(&str, &str)| {
        assert!(text.contains(old), "{old}");
        text.replacen(old, new, 1)
    };
    let text = edits.iter().fold(delivery.text.to_owned(), edit);
    Mission::parse(delivery.name, &text).unwrap()
}

fn within(duration_ms: u64, energy_mj: u64) -> Mission {
    let (duration, energy) =
        (format!("duration_ms = {duration_ms}"), format!("energy_mj = {energy_mj}"));
    with(&[("duration_ms = 900000", &duration), ("energy_mj = 7200000", &energy)])
}

fn robot() -> &'static Robot {
    DELIVERY.robot().unwrap().robot()
}

fn script(id: &str, x_mm: u64) -> Script {
    let when = Moment::Place(Millimetres(x_mm));
    let injections = vec![Injection::new(when, robot().failure(id).unwrap())];
    Script { injections, ..Script::default() }
}

fn run(mission: &Mission, script: &Script) -> Run {
    Driven::new(mission).unwrap().run(script).unwrap()
}

fn seven_points() -> Run {
    run(&DELIVERY, &Script::of(&DELIVERY.run.faults, &DELIVERY))
}

fn record(faults: FaultChoice) -> Trace {
    Trace::record(&DELIVERY, &Options { faults, ..Options::default() }).unwrap().0
}

fn samples(trace: &Trace) -> impl Iterator<Item = &Sample> {
    trace.records.iter().filter_map(|it| match it {
        Record::Sample(it) => Some(it),
        _ => None,
    })
}

#[test]
fn each_point_has_its_modules() {
    let configured = seven_points().configurations;
    let names = configured.iter().filter_map(|it| it.1);
    let names: Vec<_> = names.map(|it| robot().configurations[it].name.as_str()).collect();
    let first_drive = ["PP", "PF.OPT"];
    let second_drive = [
        "PP",      // point 1
        "PF.OPT",  // still point 1; in point 2 it runs on, with fewer particles
        "TO.FULL", // point 4, after the hand-over of point 3
        "TP",      // point 5: the operator gives a path
        "PP",      // which is planned
        "PF.OPT",  // and followed
        "PF.DEG",  // point 6: odometry, no avoidance, slower
        "TO.DEG",  // point 7
    ];
    assert_eq!(names, [&first_drive[..], &second_drive].concat());
}

#[test]
fn each_failure_is_diagnosed_and_answered_as_published() {
    let run = seven_points();
    let id = |it: &usize| robot().failures[*it].id.as_str();
    let taken: Vec<Vec<_>> =
        run.conduct.iter().map(|it| it.taken_for.iter().map(id).collect()).collect();
    assert_eq!(taken, [&["RT1"][..], &["LOC2"], &["SON1"], &["LOC3", "COL1"]]);
    let decided: Vec<_> = run.conduct.iter().map(|it| it.decided.map(|it| it.1)).collect();
    // A setting answers the first one: nothing is to be decided.
    let asked = Some(Decision::Ask);
    assert_eq!(decided, [None, asked, Some(Decision::Adapt), asked]);
    // From the flags to the decision one round, to the reaction another one.
    for it in run.conduct.iter().filter(|it| it.decided.is_some()) {
        let (detected, decided) = (it.detected.unwrap(), it.decided.unwrap().0);
        let answered = it.answered.unwrap();
        assert_eq!((decided.0 - detected.0, answered.0 - decided.0), (100, 100), "{it:?}");
    }
}

#[test]
fn the_object_is_delivered_after_two_requests() {
    let run = seven_points();
    assert_eq!((run.outcome, run.operator_requests), (Outcome::Completed, 2));
    assert_eq!((run.x, run.time), (Millimetres(80_000), Millis(415_200)));
    assert!(!run.moved_when_safe && !run.planned_with_lost);
    let quiet = self::run(&DELIVERY, &Script::default());
    assert_eq!((quiet.operator_requests, quiet.exposed), (0, Millis(0)));
}

#[test]
fn the_delivery_leaves_the_golden_trace_and_tells_the_golden_story() {
    let trace = record(FaultChoice::Script);
    let sparse = trace.records.iter().filter(|it| !matches!(it, Record::Sample(_))).cloned();
    let sparse = Trace { records: sparse.collect(), ..trace.clone() }.to_json_lines();
    // Without the header, which holds the files with all their comments.
    golden("delivery.jsonl", sparse.split_once('\n').unwrap().1);
    let mut text = String::new();
    for point in story::points(&trace.records) {
        let (number, at, t_ms) = (point.number, point.x_mm, point.t_us / 1_000);
        writeln!(text, "{number}  {at} mm  {t_ms} ms  {}", point.title()).unwrap();
        for line in [point.found(), point.decided(), point.done()].into_iter().flatten() {
            writeln!(text, "   {line}").unwrap();
        }
    }
    golden("delivery_story.txt", &text);
}

fn golden(name: &str, found: &str) {
    cotama_golden::compare(std::path::Path::new("tests/golden").join(name), found);
}

#[test]
fn a_trace_is_read_and_run_again_and_one_that_was_changed_is_told_apart() {
    let trace = record(FaultChoice::Script);
    let text = trace.to_json_lines();
    assert!(replay(&Trace::parse("run.jsonl", &text).unwrap()).unwrap().identical);
    let changed = text.replacen("\"event\":\"operator.choose_Tele", "\"event\":\"operator.tele", 1);
    let replayed = replay(&Trace::parse("run.jsonl", &changed).unwrap()).unwrap();
    assert!(!replayed.identical && replayed.difference.is_some());
}

/// Ticks stop at full speed: the operator is asked, and the permit taken back. From 300 mm/s the
/// robot takes a second and 150 mm.
#[test]
fn a_withdrawn_permit_costs_the_braking_distance() {
    assert_eq!(run(&DELIVERY, &script("ODO1", 5_000)).braked, Millimetres(150));
    // Each goal is reached at full speed, and the permit given back there.
    assert_eq!(run(&DELIVERY, &Script::default()).braked, Millimetres(0));
    // Motors without power stand at once.
    assert_eq!(run(&DELIVERY, &script("BAT2", 5_000)).braked, Millimetres(0));
}

#[test]
fn nothing_moves_for_a_minute_after_a_mission_was_ended() {
    let watched = Driven::new(&DELIVERY).unwrap().watched_for(Millis(60_000));
    for id in ["MOT1", "BAT2", "MOT4", "PWR1"] {
        let run = watched.run(&script(id, 5_000)).unwrap();
        assert_eq!((run.outcome, run.moved_when_safe), (Outcome::Safe, false), "{id}");
        assert_eq!(run.x, self::run(&DELIVERY, &script(id, 5_000)).x, "to watch changes nothing");
    }
}

#[test]
fn a_delivery_that_just_keeps_its_limits_is_completed() {
    let [ms, mj] = run(&DELIVERY, &Script::default()).used;
    let kept = run(&within(ms, mj), &Script::default());
    assert_eq!((kept.outcome, kept.used), (Outcome::Completed, [ms, mj]));
    for (axis, mission) in [within(ms - 1, mj), within(ms, mj - 1)].into_iter().enumerate() {
        let passed = run(&mission, &Script::default());
        assert_eq!((passed.outcome, passed.used), (Outcome::Failed, [ms, mj]));
        let reason = passed.summary(&mission).reason;
        assert_eq!(reason, Some(Reason::LimitExceeded { axis, by: 1 }));
    }
}

#[test]
fn each_repair_of_a_file_ends_the_last_failure_of_its_kind() {
    let event = |(x, kind): (u64, &str)| {
        format!("[[event]]\nx_mm = {x}\nkind = \"{kind}\"\nmode = \"SON2\"\n")
    };
    let events = [(5_000, "failure"), (10_000, "repair"), (15_000, "failure"), (20_000, "repair")];
    let text = format!("format = \"panorama-faults/1\"\n{}", events.map(event).concat());
    let script = Script::of(&Faults::parse("faults.toml", &text, &DELIVERY).unwrap(), &DELIVERY);
    let spans: Vec<_> = script.injections.iter().map(|it| (it.when, it.until)).collect();
    let at = |mm| Moment::Place(Millimetres(mm));
    assert_eq!(spans, [(at(5_000), Some(at(10_000))), (at(15_000), Some(at(20_000)))]);
}

/// A link that is lost, and a camera, are used by no plan (Lambert et al. 2024, 7.3.2): nothing is
/// planned again. Sonars are.
#[test]
fn only_losses_that_the_plan_uses_are_planned_around() {
    for x in [1_000, 10_000, 39_000, 45_000, 70_000] {
        let plans = |id: &str| {
            let run = run(&DELIVERY, &script(id, x));
            let causes = run.plans.iter().map(|it| it.cause.text(&DELIVERY));
            causes.collect::<Vec<_>>()
        };
        for id in ["COM1", "COM2", "CAM1"] {
            assert_eq!(plans(id), ["start"], "{id} at {x}");
        }
        assert_eq!(plans("SON2")[..2], ["start", "whole array silent (SON2)"], "{x}");
    }
}

/// Every row of the file is found in some place of the drive, unless it says that nothing shows it.
#[test]
fn every_row_is_found_where_it_can_be() {
    let parts = (0..robot().sub_objectives.len()).map(|it| Moment::During(it, Millis(500)));
    let moments: Vec<_> = parts.chain([Moment::Waiting(Millis(500))]).collect();
    for (failure, row) in robot().failures.iter().enumerate() {
        let found = moments.iter().any(|when| {
            let mut script = script("LOC2", 6_000);
            script.injections.push(Injection::new(*when, failure));
            run(&DELIVERY, &script)
                .conduct
                .iter()
                .any(|it| it.failure == failure && it.detected.is_some())
        });
        assert_eq!(found, row.unseen.is_none() && !row.no_plan, "{}", row.id);
    }
}

/// The obstacle is found and the operator asked; two minutes later he counts as silent.
#[test]
fn a_silent_operator_ends_the_mission_after_two_minutes() {
    let mut script = script("LOC2", 6_000);
    let silent = robot().failure("OPR1").unwrap();
    script.injections.push(Injection::new(Moment::At(Millis(0)), silent));
    let run = run(&DELIVERY, &script);
    assert_eq!((run.outcome, run.operator_requests), (Outcome::Safe, 1));
    let of = |silence: bool| run.conduct.iter().find(|it| (it.failure == silent) == silence);
    let (asked, found) =
        (of(false).unwrap().answered.unwrap(), of(true).unwrap().detected.unwrap());
    assert!((119_900..=120_100).contains(&(found.0 - asked.0)), "{asked:?} {found:?}");
    assert!((run.time.0 - found.0) <= 1_000, "{found:?} {:?}", run.time);
}

/// 4.6 W and the hardware of the configuration, where driving takes more.
#[test]
fn a_robot_that_waits_for_the_operator_draws_the_power_of_rest() {
    for delay in [1_000u64, 10_000, 20_000, 40_000, 60_000] {
        let body = format!(
            "format = 'panorama-faults/1'\n[[event]]\nx_mm = 20000\nkind = \"failure\"\nmode = \
             \"BMP2\"\n[[event]]\nx_mm = 0\nkind = \"operator\"\nanswers = [\"Teleprogramming\", \
             \"done\"]\ndelay_ms = {delay}\n"
        );
        let faults = Faults::parse("f", &body, &DELIVERY).unwrap();
        let trace = record(FaultChoice::Given { source: "f".into(), faults });
        let drives = |it: &&Sample| (1..40_000).contains(&it.x_mm);
        let (stands, moves): (Vec<&Sample>, Vec<&Sample>) =
            samples(&trace).filter(drives).partition(|it| it.speed_mm_s == 0);
        let most = stands.iter().map(|it| it.real_power_mw).max().unwrap();
        let least = moves.iter().map(|it| it.real_power_mw).min().unwrap();
        assert!(most < least, "{delay} ms: standing {most} mW, driving {least} mW");
        assert!(most >= DELIVERY.motion_power.c0);
    }
}

fn answers() -> impl Strategy<Value = &'static str> {
    prop_oneof![
        Just("\"Teleoperation\", \"done\""),
        Just("\"Teleprogramming\", \"done\""),
        Just("\"give_up\""),
        Just("\"Teleoperation\", \"Teleprogramming\", \"done\""),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(120))]

    /// Whatever fails and however long the operator takes.
    #[test]
    fn no_run_beyond_a_limit_is_safe_or_completed_and_samples_come_in_time(
        limits in (290_000u64..900_000, 1_600_000u64..3_000_000),
        rows in prop::collection::vec((0..39usize, 0u64..80_000), 0..4),
        answers in prop::collection::vec((0u64..80_000, answers(), 0u64..90_000), 0..3),
        period in prop_oneof![Just(100u64), Just(1_000), 100u64..5_000],
    ) {
        let mission = within(limits.0, limits.1);
        let mut body = String::from("format = 'panorama-faults/1'\n");
        for (row, x) in rows {
            let id = &robot().failures[row].id;
            body += &format!("[[event]]\nx_mm = {x}\nkind = \"failure\"\nmode = \"{id}\"\n");
        }
        for (x, answers, delay) in answers {
            body += &format!(
                "[[event]]\nx_mm = {x}\nkind = \"operator\"\nanswers = [{answers}]\ndelay_ms = \
                 {delay}\n"
            );
        }
        let faults = Faults::parse("f", &body, &mission).unwrap();
        let faults = FaultChoice::Given { source: "f".into(), faults };
        let options =
            Options { faults, monitor_period: Some(Millis(period)), ..Options::default() };
        let Ok((trace, run)) = Trace::record(&mission, &options) else { return Ok(()) };
        let within = run.used.iter().zip(mission.limits).all(|(used, limit)| *used <= limit);
        prop_assert!(within || run.outcome == Outcome::Failed, "{:?}", run.used);
        // A robot is looked at in whole rounds of 100 ms.
        let (most, mut last) = (period.div_ceil(100) * 100_000 + 100_000, 0);
        for it in samples(&trace) {
            prop_assert!(it.t_us.saturating_sub(last) <= most, "{last} to {} µs", it.t_us);
            last = last.max(it.t_us);
            prop_assert!(it.real_power_mw > 0);
        }
    }
}

#[test]
fn a_weak_motor_is_the_same_run_with_quiet_periods_passed_over() {
    let script = Script {
        injections: vec![Injection::new(Moment::At(Millis(0)), robot().failure("MOT2").unwrap())],
        ..Script::default()
    };
    let driven = Driven::new(&DELIVERY).unwrap();
    let mut records: Vec<Record> = Vec::new();
    let each = driven.run_recorded(&script, Millis(1_000), &mut records).unwrap();
    assert_eq!(driven.run(&script).unwrap(), each);
}
