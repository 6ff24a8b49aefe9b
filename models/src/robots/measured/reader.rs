//! Reading a measurement.

use super::{Detection, MAX_MEASURED_RUNS, MEASURED_FORMAT, Measurement};
use crate::missions::reader::fields::{self, Fields, Sink};
use crate::missions::{Diagnostic, MissionErrors};
use crate::names::quoted;
use crate::robots::{MAX_FAILURES, Robot};
use cotama_core::units::{Millimetres, Millis};
use std::collections::BTreeMap;

/// A mission lasts at most so long, in ms, and its path is at most so long, in mm.
const LONGEST: i64 = 1_000_000_000;

impl Measurement {
    /// Reads a measurement of a robot. `source_name` is its name in messages.
    ///
    /// # Errors
    /// All errors of the file, with their places: of another robot, unknown failures, counts that
    /// do not add.
    ///
    /// ```
    /// use cotama_models::robots::{Measurement, Robot};
    /// let robot = Robot::shipped("p3dx-delivery").unwrap();
    /// let text = "format = 'cotama-measurement/1'\nrobot = 'p3dx-delivery'\nmission = 'delivery'
    /// seeds = 2\nx_mm = 9000\nwindow_ms = 120000
    /// [[failure]]\nid = 'SON1'\nruns = 2\nmissed = 1\n\
    /// taken = [{ for = ['SNO1'], delays_ms = [5] }]";
    /// let errors = Measurement::parse("it.toml", text, &robot).unwrap_err().to_string();
    /// let first = "it.toml:11:19: unknown failure `SNO1`; did you mean `SON1`?";
    /// assert_eq!(errors.lines().next(), Some(first));
    /// ```
    pub fn parse(source_name: &str, text: &str, robot: &Robot) -> Result<Self, MissionErrors> {
        let sink = Sink::default();
        let read = fields::document(text, &sink, MEASURED_FORMAT, |root| read(root, robot));
        match read {
            Some(it) if sink.is_empty() => Ok(it),
            _ => Err(MissionErrors::new(source_name, text, sink.into_diagnostics())),
        }
    }
}

fn read(mut root: Fields<'_>, robot: &Robot) -> Option<Measurement> {
    let name = root.text("robot");
    if let Some(name) = name.as_ref().filter(|it| it.value != robot.name) {
        let message = format!(
            "this measures the robot {}, and {} is needed here",
            quoted(&name.value),
            quoted(&robot.name)
        );
        let help = "measure this one: cotama fmeca --measure MISSION --output FILE.toml";
        root.report(Diagnostic::new(name.span.clone(), message, "another robot").help(help));
        // Failures are those of the other one.
        return None;
    }
    let mission = root.text("mission");
    let seeds = root.integer("seeds", 1..=i64::from(MAX_MEASURED_RUNS));
    let x = root.integer("x_mm", 0..=LONGEST);
    let window = root.integer("window_ms", 1..=LONGEST);
    let mut rows = BTreeMap::new();
    let failures = root.tables_up_to("failure", true, MAX_FAILURES);
    for mut it in failures.into_iter().flatten() {
        let at = it.span_of("id");
        let row = failure(&mut it, robot, window);
        it.finish();
        let Some((row, detection)) = row else { continue };
        if rows.insert(row, detection).is_some() {
            let id = robot.failures.get(row).map_or("", |it| it.id.as_str());
            let message = format!("the failure {} is measured twice", quoted(id));
            root.report(Diagnostic::new(at, message, "again").help("leave one of them out"));
        }
    }
    root.finish();
    let (robot, mission) = (name?.value, mission?.value);
    let (x, window) = (Millimetres(x?), Millis(u64::from(window?)));
    Some(Measurement { robot, mission, seeds: seeds?, x, window, rows })
}

fn failure(it: &mut Fields<'_>, robot: &Robot, window: Option<u32>) -> Option<(usize, Detection)> {
    let ids = || robot.failures.iter().map(|it| it.id.as_str());
    let id = it.text("id");
    let row = id.as_ref().and_then(|id| it.index_of(id, "failure", ids()));
    let most = i64::from(MAX_MEASURED_RUNS);
    let runs = it.integer::<u32>("runs", 1..=most);
    let missed = it.integer::<u64>("missed", 0..=most);
    let false_alarms = it.optional_integer("false_alarms", 0..=runs.map_or(most, i64::from));
    let mut taken_for = BTreeMap::new();
    let taken = it.tables_up_to("taken", false, MAX_MEASURED_RUNS as usize);
    let mut whole = taken.is_some();
    for mut entry in taken.into_iter().flatten() {
        let at = entry.span_of("for");
        let names = entry.texts("for");
        let rows = names.map(|names| {
            let rows: Vec<_> =
                names.iter().map(|name| entry.index_of(name, "failure", ids())).collect();
            rows.into_iter().collect::<Option<Vec<_>>>()
        });
        let latest = window.map_or(LONGEST, i64::from);
        let delays =
            entry.integers_up_to::<u64>("delays_ms", 0..=latest, MAX_MEASURED_RUNS as usize);
        entry.finish();
        let (Some(Some(rows)), Some(delays)) = (rows, delays) else {
            whole = false;
            continue;
        };
        let mut delays: Vec<_> = delays.into_iter().map(Millis).collect();
        delays.sort_unstable();
        if taken_for.insert(rows, delays).is_some() {
            let help = "put all delays of one diagnosis into one entry";
            it.report(Diagnostic::new(at, "the same diagnosis is there twice", "again").help(help));
            whole = false;
        }
    }
    let (row, runs, missed) = (row?, u64::from(runs?), missed?);
    let detection = Detection { runs, false_alarms: false_alarms.ok()?.unwrap_or(0), taken_for };
    let found = detection.found();
    if whole && found + missed != runs {
        let message = format!(
            "{runs} runs, and {found} with a delay and {missed} missed: {}",
            found + missed
        );
        let label = "does not add";
        let help = "each run has a delay in `taken`, or is in `missed`";
        it.report(Diagnostic::new(it.span_of("runs"), message, label).help(help));
    }
    Some((row, detection))
}
