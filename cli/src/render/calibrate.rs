//! The screen of `cotama risk calibrate`.
#![allow(clippy::cast_precision_loss)] // numbers of runs need no more than 52 bits

use super::numbers::{count, grouped};
use super::style::{BAD, FAINT, GOOD, HEADING, NAME, NOTICE};
use super::table::{Cell, Table};
use super::{visible, wrapped};
use crate::answers::estimate::Measured;
use crate::answers::risk::{CalibrateAnswer, DriftRow, HeldAnswer, PromiseRow, WatchedRow};

/// Returns the screen of bounds that were learned, or held against later runs.
pub(crate) fn screen(answer: &CalibrateAnswer, width: usize) -> String {
    let head = format!(
        "{HEADING}{}{HEADING:#}, {} runs, margins for {} %",
        visible(&answer.mission),
        grouped(&answer.runs.to_string()),
        percent(answer.coverage)
    );
    match answer.holds {
        None => learned(answer, &head, width),
        Some(holds) => watched(answer, &head, holds, width),
    }
}

fn learned(answer: &CalibrateAnswer, head: &str, width: usize) -> String {
    let all = answer.promises.iter().all(|it| it.rank.is_some());
    let mut text = if all {
        wrapped(head, width, "")
    } else {
        let line = format!("{head}: {NOTICE}so few runs bound nothing yet{NOTICE:#}");
        wrapped(&line, width, "")
    };
    if let Some(it) = answer.promises.first().and_then(|it| it.coverage) {
        let line = format!(
            "kept by the next run in {} % of all sets of runs; of one set between {} % and {} %",
            percent(it.estimate),
            percent(it.low),
            percent(it.high)
        );
        text += &wrapped(&format!("{FAINT}{line}{FAINT:#}"), width, "  ");
    }
    text.push('\n');
    let over = ["", "time:", "", "", "energy:", "", ""].map(Cell::faint).to_vec();
    let names = ["from", "rest", "alone", "median", "rest", "alone", "median"];
    let mut table = Table::new(vec![over, names.map(Cell::faint).to_vec()]);
    let row = |it: &PromiseRow| {
        let ratio = |it: Option<f64>| {
            it.map_or_else(|| Cell::faint("none"), |it| Cell::plain(format!("{it:.4}")))
        };
        let axis = |it: &DriftRow| [it.rest, it.alone, it.median].map(ratio).to_vec();
        let mut cells = vec![Cell::new(visible(&it.activity), NAME)];
        cells.extend(axis(&it.duration));
        cells.extend(axis(&it.energy));
        cells
    };
    answer.promises.iter().for_each(|it| table.row(row(it)));
    text += &table.render(width);
    let about = "times what is planned: rest, the bound of all from this activity on; alone, that \
        of the activity by itself; median, half of the runs";
    text + &wrapped(about, width, "")
}

fn watched(answer: &CalibrateAnswer, head: &str, holds: bool, width: usize) -> String {
    let text = wrapped(&format!("{head}: {}", verdict(holds)), width, "") + "\n";
    text + &table(answer.watched.iter(), width) + &alarm(&answer.watched, width)
}

/// Returns the block of margins that runs held back: the rest of the whole mission, and the promise
/// that broke first.
pub(crate) fn held(it: &HeldAnswer, width: usize) -> String {
    let promise = percent(it.coverage);
    let mut text = format!("\nmargins for {promise} %: {}\n\n", verdict(it.holds));
    let first = it.watched.first().map_or("", |it| it.activity.as_str());
    let broken = |it: &WatchedRow| it.broken_after.is_some();
    let (mut shown, others): (Vec<_>, Vec<_>) =
        it.watched.iter().partition(|it| it.activity == first);
    if !shown.iter().any(|it| broken(it)) {
        shown.extend(others.iter().filter(|it| broken(it)).min_by_key(|it| it.broken_after));
    }
    text += &table(shown.into_iter(), width);
    if !others.is_empty() {
        let of = |kind: &dyn Fn(&WatchedRow) -> bool| others.iter().filter(|it| kind(it)).count();
        // Of one run it is plain which were missed; of many most are, now and then.
        let what = match it.watched.iter().map(|it| it.runs).max() {
            Some(0 | 1) => format!("{} missed", of(&|it| it.missed > 0)),
            _ => format!("{} broken", of(&broken)),
        };
        let later = count(others.len() as u64, "promise");
        let line = format!("and {later} from later activities on, {what}: see --json");
        text += &wrapped(&format!("{FAINT}{line}{FAINT:#}"), width, "  ");
    }
    text + &alarm(&it.watched, width)
}

fn verdict(holds: bool) -> String {
    if holds {
        format!("{GOOD}the calibration holds{GOOD:#}")
    } else {
        format!("{BAD}the calibration no longer holds{BAD:#}")
    }
}

fn table<'r>(rows: impl Iterator<Item = &'r WatchedRow>, width: usize) -> String {
    let names = ["from", "", "promised", "", "within", "missed", "", ""];
    let mut table = Table::new(vec![names.map(Cell::faint).to_vec()]).left(1).left(7);
    rows.for_each(|it| table.row(row(it)));
    table.render(width)
}

fn alarm(watched: &[WatchedRow], width: usize) -> String {
    let Some(after) = watched.iter().filter_map(|it| it.broken_after).min() else {
        return String::new();
    };
    let line = format!(
        "more runs passed their bound than runs like those of the calibration do, said after {} \
         of them and wrongly at most once in 1 000 tables: learn it anew",
        grouped(&after.to_string())
    );
    wrapped(&line, width, "")
}

fn row(it: &WatchedRow) -> Vec<Cell> {
    let within = (it.runs - it.missed) as f64 / it.runs.max(1) as f64;
    let said = it.broken_after.map_or_else(
        || Cell::plain(""),
        |after| Cell::new(format!("broken, after {}", grouped(&after.to_string())), BAD),
    );
    let between = |it: &Measured| format!("{} to {}", percent(it.low), percent(it.high));
    vec![
        Cell::new(visible(&it.activity), NAME),
        Cell::plain(it.axis),
        Cell::plain(format!("{} %", percent(it.promised.estimate))),
        Cell::faint(between(&it.promised)),
        Cell::plain(format!("{} %", percent(within))),
        Cell::plain(format!(
            "{} of {}",
            grouped(&it.missed.to_string()),
            grouped(&it.runs.to_string())
        )),
        Cell::faint(between(&it.missed_share)),
        said,
    ]
}

/// A share in hundredths, with two digits, without zeros at its end.
fn percent(share: f64) -> String {
    let text = format!("{:.2}", share * 100.0);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
