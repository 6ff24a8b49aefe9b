//! Detection on the line, drawn from runs by signals, beside the runs that it was drawn from.
#![allow(clippy::unwrap_used, clippy::indexing_slicing, clippy::panic)]
#![allow(clippy::cast_precision_loss)] // numbers of runs

use cotama_core::units::{Millimetres, Millis};
use cotama_models::missions::{Mission, embedded};
use cotama_models::robots::{Detection, Measurement, Moment, Robot, embedded_measurement};
use cotama_sim::options::{FaultChoice, Fidelity, Options};
use cotama_sim::robots::{Driven, WINDOW};
use cotama_sim::trace::{Trace, replay};
use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock};

static DELIVERY: LazyLock<Mission> = LazyLock::new(|| {
    let delivery = embedded::mission("delivery").unwrap();
    Mission::parse(delivery.name, delivery.text).unwrap()
});

fn robot() -> &'static Robot {
    DELIVERY.robot().unwrap().robot()
}

fn middle_of_the_first_drive() -> Moment {
    let drive = DELIVERY.objectives.iter().find(|it| it.travels()).unwrap();
    Moment::Place(Millimetres(u64::midpoint(drive.x_start.0, drive.x_end.0)))
}

fn detections(driven: &Driven<'_>, rows: &[usize], seeds: u64) -> BTreeMap<usize, Detection> {
    let at = middle_of_the_first_drive();
    rows.iter().map(|it| (*it, driven.measure(*it, at, 0..seeds).unwrap())).collect()
}

/// A measurement of these rows.
fn measurement(rows: BTreeMap<usize, Detection>, seeds: u64) -> Measurement {
    let Moment::Place(x) = middle_of_the_first_drive() else { panic!("a place") };
    let (robot, mission) = (robot().name.clone(), DELIVERY.name.clone());
    Measurement { robot, mission, seeds, x, window: WINDOW, rows }
}

fn on_the_line(by: Measurement, fidelity: Fidelity) -> Driven<'static> {
    let measured = Some(Arc::new(by));
    Driven::with(&DELIVERY, &Options { fidelity, measured, ..Options::default() }).unwrap()
}

/// The probability of at most so many hits in so many draws of a share.
fn at_most(hits: u64, draws: u64, share: f64) -> f64 {
    let (mut all, mut choose) = (0.0, 1.0);
    for k in 0..=hits {
        all += choose * libm::pow(share, k as f64) * libm::pow(1.0 - share, (draws - k) as f64);
        choose *= (draws - k) as f64 / (k + 1) as f64;
    }
    all
}

/// Whether so many hits are within the binomial interval of a share that holds 99.9 %.
fn is_binomial(hits: u64, draws: u64, share: f64) -> bool {
    let below = at_most(hits, draws, share);
    let above = if hits == 0 { 1.0 } else { 1.0 - at_most(hits - 1, draws, share) };
    below > 0.000_5 && above > 0.000_5
}

/// The line draws from what it is given: of every row the share that is found, the share that is
/// named, and the median are within the binomial interval of the measured ones.
fn assert_alike(measured: &BTreeMap<usize, Detection>, drawn: &BTreeMap<usize, Detection>) {
    for (row, by) in measured {
        let (id, it) = (&robot().failures[*row].id, &drawn[row]);
        let share = |hits: u64| hits as f64 / by.runs as f64;
        assert!(is_binomial(it.found(), it.runs, share(by.found())), "{id}: {by:?} {it:?}");
        assert!(is_binomial(it.named(*row), it.runs, share(by.named(*row))), "{id}: {by:?} {it:?}");
        // Half of the draws are at most the median: as many as that, within the interval.
        let Some(median) = by.median() else { continue };
        let all = by.delays();
        let until = |all: &[Millis]| all.iter().filter(|it| **it <= median).count() as u64;
        let half = until(&all) as f64 / all.len() as f64;
        assert!(is_binomial(until(&it.delays()), it.found(), half), "{id}: {by:?} {it:?}");
    }
}

#[test]
fn a_line_finds_failures_as_often_and_as_late_as_the_signals_that_were_measured() {
    let options = Options { fidelity: Fidelity::Signal, ..Options::default() };
    let by_signals = Driven::with(&DELIVERY, &options).unwrap();
    let rows = ["SON2", "ODO2", "BMP2", "CAM1", "MOT3", "BAT2", "LOC2", "COM1"];
    let rows = rows.map(|id| robot().failure(id).unwrap());
    let measured = detections(&by_signals, &rows, 8);
    for fidelity in [Fidelity::Line, Fidelity::Plane] {
        let told = on_the_line(measurement(measured.clone(), 8), fidelity);
        assert_alike(&measured, &detections(&told, &rows, 24));
    }
}

#[test]
fn the_measured_robot_that_comes_with_the_program_is_drawn_from_as_it_is() {
    let file = embedded_measurement("p3dx-delivery").unwrap();
    let shipped = Measurement::parse(file.name, file.text, robot()).unwrap();
    let told = on_the_line(shipped.clone(), Fidelity::Line);
    // What is over before it is found is not found on a line: one late job (RT2) alone.
    let is_over = |row: usize, it: &Detection| robot().failures[row].ends <= it.median();
    let (over, rest): (BTreeMap<_, _>, BTreeMap<_, _>) = shipped
        .rows
        .into_iter()
        .partition(|(row, it)| robot().failures[*row].ends.is_some() && is_over(*row, it));
    let over: Vec<_> = over.keys().map(|it| robot().failures[*it].id.as_str()).collect();
    assert_eq!(over, ["RT2"]);
    let rows: Vec<_> = rest.keys().copied().collect();
    assert_alike(&rest, &detections(&told, &rows, 40));
}

#[test]
fn a_failure_that_is_never_found_or_taken_for_another_is_so_on_the_line() {
    let [son1, hum1] = ["SON1", "HUM1"].map(|id| robot().failure(id).unwrap());
    let detection = |taken: Option<(Vec<usize>, Millis)>| {
        let mut it = Detection::default();
        it.note(taken);
        it
    };
    let missed = [(son1, detection(None))].into();
    let told = on_the_line(measurement(missed, 1), Fidelity::Line);
    let it = &detections(&told, &[son1], 3)[&son1];
    assert_eq!((it.runs, it.found()), (3, 0));

    let taken = [(son1, detection(Some((vec![hum1], Millis(20_400)))))].into();
    let told = on_the_line(measurement(taken, 1), Fidelity::Line);
    let it = &detections(&told, &[son1], 3)[&son1];
    assert_eq!((it.found(), it.named(son1), it.named(hum1)), (3, 0, 3));
    assert_eq!((it.median(), it.worst()), (Some(Millis(20_400)), Some(Millis(20_400))));
}

#[test]
fn a_run_with_measured_detections_is_run_again_from_its_trace_alone() {
    let file = embedded_measurement("p3dx-delivery").unwrap();
    let measured = Measurement::parse(file.name, file.text, robot()).unwrap();
    let options = Options {
        seed: 7,
        faults: FaultChoice::Script,
        measured: Some(Arc::new(measured)),
        ..Options::default()
    };
    let trace = Trace::record(&DELIVERY, &options).unwrap().0;
    let read = Trace::parse("delivery.jsonl", &trace.to_json_lines()).unwrap();
    assert!(replay(&read).unwrap().identical);
    // The seed draws from the measurement: assumed latencies lead elsewhere.
    let assumed = Options { measured: None, ..options };
    assert_ne!(Trace::record(&DELIVERY, &assumed).unwrap().0.records, trace.records);
}
