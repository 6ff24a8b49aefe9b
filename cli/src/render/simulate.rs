//! The screens of `cotama simulate`.

use super::numbers::{count, grouped, milli};
use super::style::{FAINT, GOOD, HEADING, NAME, NOTICE, PLAIN};
use super::table::{Cell, Table};
use super::{named, visible, wrapped};
use crate::answers::model::{RefusalReason, SimulateAnswer, StepRow, TokensRow};
use cotama_core::net::{Net, Role};
use std::collections::BTreeSet;
use std::fmt::Write;

/// The most steps, and names of one kind, that are shown.
const SHOWN_STEPS: usize = 200;
const SHOWN: usize = 20;
/// The most names in one cell.
const SHOWN_IN_CELL: usize = 4;

/// Returns the events so far, and the present marking of the net.
pub(crate) fn screen(answer: &SimulateAnswer, net: &Net<'_>, width: usize) -> String {
    let how = match (answer.rounds, answer.by_name) {
        (true, true) => ", in rounds; its transitions are fired by name",
        (true, false) => ", in rounds",
        (false, true) => ": neither events nor time, so its transitions are fired by name",
        (false, false) => "",
    };
    let mut text = format!("{HEADING}{}{HEADING:#}{how}\n", visible(&answer.model));
    text += &steps(&answer.steps, net, width);
    text.push('\n');
    text += &state(answer, net, width, false);
    if !answer.complete {
        let fired = grouped(&answer.fired.len().to_string());
        let _ = writeln!(
            text,
            "\n{NOTICE}stopped{NOTICE:#}: {fired} transitions fired, and the net goes on by itself"
        );
    }
    text
}

/// Returns the last events, the present marking, and the events possible: the text before the
/// prompt of a game by hand.
pub(crate) fn position(answer: &SimulateAnswer, net: &Net<'_>, width: usize) -> String {
    format!("{}\n{}", steps(&answer.steps, net, width), state(answer, net, width, true))
}

/// All places with their tokens.
pub(crate) fn whole_marking(answer: &SimulateAnswer, width: usize) -> String {
    let places =
        answer.marking.iter().map(|(place, tokens)| format!("{} {tokens}", visible(place)));
    wrapped(&places.collect::<Vec<_>>().join("  "), width, "  ")
}

fn time(ms: u64) -> String {
    milli(ms.into(), 3, " s")
}

fn steps(steps: &[StepRow], net: &Net<'_>, width: usize) -> String {
    if steps.is_empty() {
        return String::new();
    }
    let complements: BTreeSet<_> = complements(net).collect();
    let mut text = String::new();
    let left_out = steps.len().saturating_sub(SHOWN_STEPS);
    if left_out > 0 {
        let _ = writeln!(
            text,
            "  {FAINT}{} before these: see --json{FAINT:#}",
            count(left_out as u64, "step")
        );
    }
    let head = ["time", "event", "fired", "emitted", "marking after"].map(Cell::faint).to_vec();
    let mut table = Table::new(vec![head]).left(1).left(2).left(3).left(4);
    for step in &steps[left_out..] {
        let tokens = |it: &&TokensRow| !complements.contains(it.place.as_str());
        let changed =
            step.changed.iter().filter(tokens).map(|it| format!("{} {}", it.place, it.tokens));
        let fired = if step.fired.is_empty() && step.ignored.is_empty() {
            Cell::faint("nothing")
        } else if step.fired.is_empty() {
            Cell::new("ignored", NOTICE)
        } else {
            Cell::new(listed(step.fired.iter().cloned()), GOOD)
        };
        table.row(vec![
            Cell::plain(time(step.time_ms)),
            if step.round {
                Cell::faint("(round)")
            } else {
                Cell::new(
                    listed(step.events.iter().cloned()),
                    if step.events.is_empty() { PLAIN } else { NAME },
                )
            },
            fired,
            Cell::plain(listed(step.emitted.iter().cloned())),
            Cell::plain(listed(changed)),
        ]);
    }
    text += &table.render(width);
    for step in &steps[left_out..] {
        for ignored in &step.ignored {
            let said = format!("{} at {}: {}", ignored.event, time(step.time_ms), ignored.text);
            text += &wrapped(&visible(&said), width, "  ");
        }
    }
    text
}

fn complements<'n>(net: &Net<'n>) -> impl Iterator<Item = &'n str> {
    net.places.iter().filter(|it| matches!(it.role, Role::Complement(_))).map(|it| it.name)
}

/// Some names, in one cell.
fn listed(names: impl Iterator<Item = String>) -> String {
    let mut names: Vec<_> = names.map(|it| visible(&it)).collect();
    let more = names.len().saturating_sub(SHOWN_IN_CELL);
    if more > 0 {
        names.truncate(SHOWN_IN_CELL);
        names.push(format!("and {more} more"));
    }
    names.join(", ")
}

/// The marking, and what becomes of each event; with the numbers of the events for a game by hand.
fn state(answer: &SimulateAnswer, net: &Net<'_>, width: usize, numbered: bool) -> String {
    let complements: BTreeSet<_> = complements(net).collect();
    let marked = answer
        .marking
        .iter()
        .filter(|(place, tokens)| *tokens > 0 && !complements.contains(place.as_str()));
    let place = |(place, tokens): &(String, u32)| match tokens {
        1 => place.clone(),
        tokens => format!("{place} {tokens}"),
    };
    let number = |event: &str| {
        let at = net.events.iter().position(|it| it.name == event).filter(|_| numbered);
        at.map_or_else(String::new, |at| format!("{} ", at + 1))
    };
    let reason = |wanted: bool| {
        let refused = answer
            .unused
            .iter()
            .filter(move |it| (it.reason == RefusalReason::OnPurpose) == wanted);
        refused.map(|it| it.event.clone())
    };
    let used = answer.enabled.iter().map(|it| {
        let by =
            if it.event == it.transition { String::new() } else { format!(" ({})", it.transition) };
        format!("{}{}{by}", number(&it.event), it.event)
    });
    let deadline = match &answer.deadline {
        Some(next) => format!("{} at {}", next.transition, time(next.time_ms)),
        None => "nothing".to_owned(),
    };
    let mut text = line(&format!("marking at {}", time(answer.time_ms)), marked.map(place), width);
    text += &line("would be used", used, width);
    text += &line("ignored on purpose", reason(true), width);
    text += &line("not used", reason(false), width);
    text + &line("next by itself", std::iter::once(deadline), width)
}

/// A title and names; nothing without names.
fn line(title: &str, names: impl Iterator<Item = String>, width: usize) -> String {
    named(title, 22, names, SHOWN, width)
}
