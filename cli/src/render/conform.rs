//! The screens of `cotama conform`.

use super::numbers::{count, milli};
use super::style::{BAD, FAINT, GOOD, HEADING, NAME};
use super::{named, visible, wrapped};
use crate::answers::conform::{AllowedRow, ConformAnswer, MayFireRow};
use std::fmt::Write;

/// The most names of one kind.
const SHOWN: usize = 12;

/// Whether it conforms; where not, the line, why, and what was allowed.
pub(crate) fn screen(answer: &ConformAnswer, text: &str, width: usize) -> String {
    let mut said = format!("{HEADING}{}{HEADING:#}", visible(&answer.model));
    if let Some(line) = answer.unknown_from {
        let _ = writeln!(said, ": {BAD}unknown{BAD:#}");
        let whole = format!(
            "too many states are possible by line {line} of {}: log what fires, or allow more with \
             `--max-states`",
            visible(&answer.trace)
        );
        return said + &wrapped(&whole, width, "  ") + "\n";
    }
    let Some(departs) = &answer.departs else {
        let _ = writeln!(said, ": {GOOD}conforms{GOOD:#}");
        let mut counts = vec![count(answer.events, "event"), count(answer.fired, "firing")];
        if answer.outputs > 0 {
            counts.push(count(answer.outputs, "output"));
        }
        if answer.rounds > 0 {
            counts.push(count(answer.rounds, "round"));
        }
        let until = milli(answer.until_ms.into(), 3, " s");
        let whole = format!("{} until {until}: a run of the model", counts.join(", "));
        return said + &wrapped(&whole, width, "  ");
    };
    let _ = writeln!(
        said,
        ": {BAD}departs{BAD:#} at {NAME}{}:{}{NAME:#}",
        visible(&answer.trace),
        departs.line
    );
    let line = text.lines().nth((departs.line as usize).saturating_sub(1)).unwrap_or_default();
    let mut cut: String = line.chars().take(width.saturating_sub(4)).collect();
    if cut.len() < line.len() {
        cut.pop();
        cut.push('…');
    }
    let _ = writeln!(said, "  {FAINT}{}{FAINT:#}", visible(&cut));
    said += &wrapped(&visible(&departs.reason), width, "  ");
    said.push('\n');
    said + &allowed(&departs.allowed, width)
}

fn allowed(allowed: &AllowedRow, width: usize) -> String {
    let fired = allowed.fired.iter().map(window);
    let events = allowed.events.iter().map(|it| {
        let by =
            if it.event == it.transition { String::new() } else { format!(" ({})", it.transition) };
        format!("{}{by}", it.event)
    });
    let said = line("could fire", fired, width) + &line("events with an effect", events, width);
    if said.is_empty() { "  nothing was allowed there\n".to_owned() } else { said }
}

fn window(it: &MayFireRow) -> String {
    let at = |ms: u64| milli(ms.into(), 3, " s");
    match it.latest_ms {
        Some(latest) if latest == it.earliest_ms => format!("{} at {}", it.transition, at(latest)),
        Some(latest) => format!("{} from {} to {}", it.transition, at(it.earliest_ms), at(latest)),
        None => format!("{} from {} on", it.transition, at(it.earliest_ms)),
    }
}

/// A title and names; nothing without names.
fn line(title: &str, names: impl Iterator<Item = String>, width: usize) -> String {
    named(title, 21, names, SHOWN, width)
}
