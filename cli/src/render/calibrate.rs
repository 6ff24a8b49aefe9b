//! The screen of `cotama risk calibrate`.
#![allow(clippy::cast_precision_loss)] // numbers of runs need no more than 52 bits

use super::numbers::grouped;
use super::style::{BAD, FAINT, GOOD, HEADING, NAME, NOTICE};
use super::table::{Cell, Table};
use super::{visible, wrapped};
use crate::answers::risk::{CalibrateAnswer, DriftRow, PromiseRow, WatchedRow};

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
    let verdict = if holds {
        format!("{GOOD}the calibration holds{GOOD:#}")
    } else {
        format!("{BAD}the calibration no longer holds{BAD:#}")
    };
    let mut text = wrapped(&format!("{head}: {verdict}"), width, "") + "\n";
    let names = ["from", "", "within", "promised", "", "missed", ""];
    let mut table = Table::new(vec![names.map(Cell::faint).to_vec()]).left(1).left(6);
    for it in &answer.watched {
        table.row(row(it));
    }
    text += &table.render(width);
    let broken = answer.watched.iter().filter_map(|it| it.broken_after).min();
    if let Some(after) = broken {
        let line = format!(
            "more runs passed their bound than runs like those of the calibration do, said after \
             {} of them and wrongly at most once in 1 000 tables: learn it anew",
            grouped(&after.to_string())
        );
        text += &wrapped(&line, width, "");
    }
    text
}

fn row(it: &WatchedRow) -> Vec<Cell> {
    let within = (it.runs - it.missed) as f64 / it.runs.max(1) as f64;
    let said = it.broken_after.map_or_else(
        || Cell::plain(""),
        |after| Cell::new(format!("broken, after {}", grouped(&after.to_string())), BAD),
    );
    vec![
        Cell::new(visible(&it.activity), NAME),
        Cell::plain(it.axis),
        Cell::plain(format!("{} %", percent(within))),
        Cell::plain(format!("{} %", percent(it.promised.estimate))),
        Cell::faint(format!("{} to {}", percent(it.promised.low), percent(it.promised.high))),
        Cell::plain(format!(
            "{} of {}",
            grouped(&it.missed.to_string()),
            grouped(&it.runs.to_string())
        )),
        said,
    ]
}

/// A share in hundredths, with two digits, without zeros at its end.
fn percent(share: f64) -> String {
    let text = format!("{:.2}", share * 100.0);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
