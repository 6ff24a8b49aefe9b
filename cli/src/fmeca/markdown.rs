//! The FMECA as a table in Markdown.

use crate::answers::fmeca::{FmecaAnswer, FmecaRow};
use crate::render::fmeca::{heading, hours, seconds, summary, worst};
use cotama_core::text::marked;
use std::fmt::Write;

const COLUMNS: [&str; 24] = [
    "id",
    "function",
    "component",
    "failure",
    "cause",
    "effect",
    "severity, robot drives",
    "severity, operator drives",
    "lost",
    "seen by",
    "detection",
    "within",
    "event",
    "reaction",
    "MTBF",
    "S",
    "O",
    "D",
    "RPN",
    "criticality",
    "AP",
    "D measured",
    "RPN measured",
    "AP measured",
];

/// A heading, the counts and the table; without columns in which nothing stands.
pub(crate) fn write(answer: &FmecaAnswer<'_>) -> String {
    let mut text = format!(
        "# {}\n\n{}. {}\n\n",
        plain(&heading(answer)),
        summary(answer),
        worst(&answer.rows)
    );
    let rows: Vec<_> = answer.rows.iter().map(cells).collect();
    let used: Vec<_> =
        (0..COLUMNS.len()).filter(|&at| rows.iter().any(|it| !it[at].is_empty())).collect();
    let both = answer.rows.iter().any(|it| it.severity_operator.is_some());
    line(&mut text, used.iter().map(|&at| name(COLUMNS[at], both)));
    line(&mut text, used.iter().map(|_| "---"));
    for row in &rows {
        line(&mut text, used.iter().map(|&at| row[at].as_str()));
    }
    text
}

/// Returns the title of a column: without an operator there is one severity.
fn name(column: &'static str, both: bool) -> &'static str {
    match column {
        "severity, robot drives" if !both => "severity",
        _ => column,
    }
}

fn cells(row: &FmecaRow<'_>) -> [String; 24] {
    let rate = format!("{} ({})", hours(row.mtbf_mh), row.rate_label);
    let seen = !row.flags_always.is_empty() || row.detection_latency_ms > 0;
    let within = if seen { seconds(row.detection_latency_ms) } else { String::new() };
    let criticality = row.criticality;
    let measured = criticality.measured;
    [
        row.id,
        row.function,
        row.component,
        row.failure,
        row.cause,
        row.effect,
        row.severity_autonomous,
        row.severity_operator.unwrap_or_default(),
        row.loss,
        row.observer,
        row.detection,
        &within,
        &row.event,
        row.reaction,
        &rate,
        &criticality.severity.to_string(),
        &criticality.occurrence.to_string(),
        &criticality.detection.to_string(),
        &criticality.rpn.to_string(),
        criticality.class,
        criticality.action_priority,
        &measured.map_or_else(String::new, |it| it.detection.to_string()),
        &measured.map_or_else(String::new, |it| it.rpn.to_string()),
        measured.map_or("", |it| it.action_priority),
    ]
    .map(str::to_owned)
}

fn line<'a>(text: &mut String, cells: impl Iterator<Item = &'a str>) {
    for cell in cells {
        let _ = write!(text, "| {} ", plain(cell));
    }
    text.push_str("|\n");
}

/// A text in which a bar would end the cell, and others begin HTML, links and emphasis.
fn plain(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for (c, hidden) in marked(text) {
        if hidden {
            safe.push('\\');
            safe.extend(c.escape_unicode());
            continue;
        }
        if matches!(c, '|' | '<' | '>' | '[' | ']' | '*' | '_' | '`' | '\\') {
            safe.push('\\');
        }
        safe.push(c);
    }
    safe
}
