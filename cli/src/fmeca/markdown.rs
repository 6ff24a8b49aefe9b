//! The FMECA as a table in Markdown.

use crate::answers::fmeca::{FmecaAnswer, FmecaRow};
use crate::render::fmeca::{event, hours, seconds, summary};
use std::fmt::Write;

const COLUMNS: [&str; 15] = [
    "id",
    "function",
    "component",
    "failure",
    "cause",
    "effect",
    "severity, robot drives",
    "severity, operator drives",
    "modules lost",
    "seen by",
    "detection",
    "within",
    "event",
    "reaction",
    "MTBF",
];

/// A heading, the counts and the table.
pub(crate) fn write(answer: &FmecaAnswer) -> String {
    let mut text = format!("# FMECA of the delivery robot\n\n{}.\n\n", summary(&answer.counts));
    line(&mut text, &COLUMNS.map(str::to_owned));
    line(&mut text, &COLUMNS.map(|_| "---".to_owned()));
    for row in &answer.rows {
        line(&mut text, &cells(row));
    }
    text
}

fn cells(row: &FmecaRow) -> [String; 15] {
    let rate = format!("{} ({})", hours(row.mtbf_mh), row.rate_label);
    [
        row.id,
        row.function,
        row.component,
        row.failure,
        row.cause,
        row.effect,
        row.severity_autonomous,
        row.severity_operator,
        row.loss,
        row.observer,
        row.detection,
        &seconds(row.detection_latency_ms),
        &event(row),
        row.reaction,
        &rate,
    ]
    .map(str::to_owned)
}

fn line(text: &mut String, cells: &[String]) {
    for cell in cells {
        // A bar would end the cell, and these begin HTML, links and emphasis.
        let mut safe = String::with_capacity(cell.len());
        for c in cell.chars() {
            if matches!(c, '|' | '<' | '>' | '[' | ']' | '*' | '_' | '`' | '\\') {
                safe.push('\\');
            }
            safe.push(c);
        }
        let _ = write!(text, "| {safe} ");
    }
    text.push_str("|\n");
}
