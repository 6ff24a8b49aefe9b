//! The screen of `cotama fmeca --measure`.

use super::style::{BAD, FAINT, GOOD, HEADING, NAME};
use super::table::{Cell, Table};
use super::{visible, wrapped};
use crate::answers::fmeca::{MeasureAnswer, MeasureRow, RateRow};

/// Returns the screen of measured detections.
pub(crate) fn screen(answer: &MeasureAnswer, width: usize) -> String {
    let head = ["", "found", "named", "95 %", "median", "worst", "assumed", "D", "why"];
    let mut table = Table::new(vec![head.map(Cell::faint).to_vec()]).left(8);
    for it in &answer.rows {
        let style = |it: u64, runs: u64| if it * 20 >= runs * 19 { GOOD } else { BAD };
        table.row(vec![
            Cell::new(visible(&it.id), NAME),
            Cell::new(format!("{} of {}", it.found, it.runs), style(it.found, it.runs)),
            Cell::new(it.named.to_string(), style(it.named, it.runs)),
            Cell::new(interval(it.named_rate), FAINT),
            Cell::plain(seconds(it.median_ms)),
            Cell::plain(seconds(it.worst_ms)),
            Cell::faint(seconds(Some(it.assumed_ms))),
            Cell::plain(it.detection.map_or_else(String::new, |it| it.to_string())),
            Cell::plain(visible(&reason(it))),
        ]);
    }
    let title = format!(
        "{HEADING}{}{HEADING:#} on {}: each failure at {} m, {} runs, diagnosed within {} s\n\n",
        visible(&answer.robot),
        visible(&answer.mission),
        answer.x_mm / 1_000,
        answer.seeds,
        answer.window_ms / 1_000
    );
    let alarms: u64 = answer.rows.iter().map(|it| it.false_alarms).sum();
    let runs: u64 = answer.rows.iter().map(|it| it.runs).sum();
    let after = format!(
        "\n95 %: the exact interval of the share in which it was named. D: the detection rank that \
         runs show. Something was diagnosed before anything failed in {alarms} of {runs} runs. \
         Told, as they harm no device here: {}.",
        answer.told.join(", ")
    );
    title + &table.render(width) + &wrapped(&after, width, "")
}

/// Returns what is not as assumed, or else the rows that were named beside it.
fn reason(it: &MeasureRow) -> String {
    let together = it.taken_for.iter().find(|it| it.rows.len() > 1);
    it.why.clone().unwrap_or_else(|| {
        together.map_or_else(String::new, |it| format!("as one of {}", it.rows.join(" ")))
    })
}

fn interval(it: RateRow) -> String {
    format!("{}–{} %", (it.low + 5) / 10, (it.high + 5) / 10)
}

fn seconds(it: Option<u64>) -> String {
    it.map_or_else(|| "\u{b7}".to_owned(), |it| format!("{}.{} s", it / 1_000, it % 1_000 / 100))
}
