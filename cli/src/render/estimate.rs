//! The screen of `cotama estimate`.

use super::campaign::{interval, number, percent};
use super::style::{BAD, FAINT, GOOD, HEADING, NOTICE};
use super::{visible, wrapped};
use crate::answers::check::VerdictName;
use crate::answers::estimate::EstimateAnswer;
use std::fmt::Write;

/// Returns the screen of random runs, and of the runs that show a property.
pub(crate) fn screen(answer: &EstimateAnswer, texts: &[Option<String>], width: usize) -> String {
    let mut text = format!(
        "{HEADING}{}{HEADING:#}, {} runs of at most {} steps, seed {}\n",
        visible(&answer.model),
        number(answer.runs),
        number(answer.steps),
        answer.seed
    );
    for note in &answer.notes {
        text += &wrapped(&format!("note: {note}"), width, "  ");
    }
    let indent = " ".repeat(11);
    for row in &answer.results {
        let (style, verdict) = match row.verdict {
            VerdictName::True => (GOOD, "true"),
            VerdictName::False => (BAD, "false"),
            VerdictName::Unknown => (NOTICE, "unknown"),
        };
        let said = wrapped(&visible(&row.property), width, &indent);
        let said = said.get(indent.len()..).unwrap_or_default();
        let _ = write!(text, "  {style}{verdict:<7}{style:#}  {said}");
        let open = match row.open {
            0 => String::new(),
            it => format!("; {} not decided by then", number(it)),
        };
        let share = percent(row.probability.estimate);
        let how = format!("{share} of runs {}{open}", interval(row.probability));
        let how = wrapped(&how, width, &indent);
        let _ = writeln!(text, "{FAINT}{}{FAINT:#}", how.trim_end());
    }
    for (row, said) in answer.results.iter().zip(texts) {
        let (Some(said), Some(run)) = (said, row.run) else { continue };
        let _ = writeln!(text, "\n{HEADING}{}{HEADING:#}, run {run}", visible(&row.property));
        for line in said.lines() {
            let space = if line.is_empty() { "" } else { "  " };
            let _ = writeln!(text, "{space}{line}");
        }
    }
    let confidence = answer.results.first().map_or(0.0, |it| it.probability.confidence);
    let assumed = format!(
        "\nEach enabled transition is equally likely to fire. Intervals hold the truth of such \
         runs at least {} times in 100.",
        (100.0 * confidence * 1e4).round() / 1e4
    );
    text += &wrapped(&assumed, width, "");
    text
}
