//! The screen of `cotama check`.

use super::numbers::grouped;
use super::style::{BAD, FAINT, GOOD, HEADING, NOTICE, Style};
use super::{visible, wrapped};
use crate::answers::check::{
    Amount, CheckAnswer, EvidenceName, ResponseRow, ResultRow, VerdictName,
};
use std::fmt::Write;

/// Returns the head of a check: the model.
pub(crate) fn head(model: &str, timed: bool, notes: &[String], width: usize) -> String {
    let how = if timed { "  with its intervals of time" } else { "" };
    let mut text = format!("{HEADING}{}{HEADING:#}{FAINT}{how}{FAINT:#}\n", visible(model));
    for note in notes {
        text += &wrapped(&format!("note: {note}"), width, "  ");
    }
    text
}

/// How verdicts came about, as far as there is a text for each, and what else is known.
pub(crate) fn reasons(answer: &CheckAnswer, explained: &[Option<String>], width: usize) -> String {
    let mut text = String::new();
    for (row, explained) in answer.results.iter().zip(explained) {
        if let Some(explained) = explained {
            let _ = write!(text, "\n{}", titled(row, answer.results.len()));
            for line in explained.lines() {
                let _ = writeln!(
                    text,
                    "{}",
                    if line.is_empty() { String::new() } else { format!("  {line}") }
                );
            }
        }
    }
    if !answer.left_out.is_empty() {
        text += &wrapped(
            &format!(
                "\nchecked only while a program is compiled: {}",
                visible_list(&answer.left_out)
            ),
            width,
            "",
        );
    }
    text
}

fn titled(row: &ResultRow, of: usize) -> String {
    if of == 1 { String::new() } else { format!("{HEADING}{}{HEADING:#}\n", visible(&row.name)) }
}

fn visible_list(names: &[String]) -> String {
    names.iter().map(|it| visible(it)).collect::<Vec<_>>().join(", ")
}

/// One line of verdict, and what is to be said of it; `unit` is that of times. Laws and usual
/// questions have names that say enough.
pub(crate) fn result(row: &ResultRow, is_usual: bool, unit: Option<&str>, width: usize) -> String {
    let (style, verdict): (Style, String) = match (row.verdict, row.bound, row.response) {
        (VerdictName::True, Some(bound), _) => (GOOD, shown(bound)),
        (VerdictName::True, _, Some(ResponseRow { min: Some(min), max: Some(max) })) => {
            (GOOD, times([min, max], unit))
        }
        (VerdictName::True, _, Some(_)) => (NOTICE, "never fires".to_owned()),
        (VerdictName::True, ..) => (GOOD, "true".to_owned()),
        (VerdictName::False, ..) => (BAD, "false".to_owned()),
        (VerdictName::Unknown, ..) => (NOTICE, "unknown".to_owned()),
    };
    let (name, property) = (visible(&row.name), visible(&row.property));
    let claim = if let Some(sentence) = &row.sentence {
        format!("{name}: {sentence}")
    } else if is_usual {
        name
    } else if name == property {
        property
    } else {
        format!("{name}: {property}")
    };
    let indent = " ".repeat(11);
    let space = " ".repeat(9_usize.saturating_sub(verdict.chars().count()).max(2));
    let said = wrapped(&claim, width, &indent);
    let said = said.get(indent.len()..).unwrap_or_default();
    let mut text = format!("  {style}{verdict}{style:#}{space}{said}");
    let mut how = Vec::new();
    how.extend(row.reason.clone());
    how.extend(row.way_out.map(str::to_owned));
    if !row.techniques.is_empty() {
        how.push(format!("by {}", row.techniques.join(", ")));
    }
    if row.sentence.is_some() && row.evidence != EvidenceName::None {
        how.push(format!("evidence: {}", row.evidence.name()));
    }
    if row.states > 0 {
        let states = if row.states == 1 { "state" } else { "states" };
        how.push(format!("{} {states}", grouped(&row.states.to_string())));
    }
    if !how.is_empty() {
        let how = wrapped(&how.join("; "), width, &indent);
        let _ = writeln!(text, "{FAINT}{}{FAINT:#}", how.trim_end());
    }
    if let Some(vacuous) = &row.vacuous {
        text += &wrapped(&visible(vacuous), width, &indent);
    }
    text
}

/// The least and the most of a time.
fn times(ends: [Amount; 2], unit: Option<&str>) -> String {
    let [min, max] = ends.map(|it| match (it, unit) {
        (Amount::Finite(_), Some(unit)) => format!("{} {unit}", shown(it)),
        _ => shown(it),
    });
    let whose = if unit.is_none() { ", in the unit of the file" } else { "" };
    format!("{min} to {max}{whose}")
}

fn shown(amount: Amount) -> String {
    match amount {
        Amount::Finite(number) => grouped(&number.to_string()),
        Amount::Infinite(_) => "no limit".to_owned(),
    }
}
