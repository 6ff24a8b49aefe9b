//! The screen of `cotama run` for a mission with axes.

use super::numbers::{count, grouped, seconds, short_metres};
use super::style::{BAD, GOOD, HEADING};
use super::table::{Cell, Table};
use super::visible;
use crate::answers::axes_run::{AxesOutcome, AxesPlanRow, AxesRunAnswer, MomentRow};
use std::fmt::Write;

/// The screen; `no_return` is where no way home is left.
pub(crate) fn screen(answer: &AxesRunAnswer, no_return: Option<i64>, width: usize) -> String {
    let mut text =
        format!("{HEADING}{}{HEADING:#}: {}\n", visible(&answer.mission), end(answer, no_return));
    for it in &answer.plans {
        let _ = writeln!(
            text,
            "\n{HEADING}plan at {}{HEADING:#}, {}: {}",
            metres(it.x_mm),
            seconds(it.t_ms),
            visible(&it.cause)
        );
        text += &choices(it).render(width);
    }
    let mut moment = |words: &str, at: &Option<MomentRow>| {
        if let Some(it) = at {
            let _ = writeln!(text, "\n{words} at {}, {}", metres(it.x_mm), seconds(it.t_ms));
        }
    };
    moment("turned round", &answer.turned);
    moment("went on by the cheapest safe options", &answer.hurried);
    if !answer.margins.is_empty() {
        let _ = writeln!(text, "\n{HEADING}margins{HEADING:#} at the end");
        let mut table = Table::new(vec![]).left(0);
        for it in &answer.margins {
            let style = if it.value < 0 { BAD } else { GOOD };
            let value = format!("{} {}", signed(it.value), visible(&it.unit));
            table.row(vec![Cell::plain(visible(&it.constraint)), Cell::new(value, style)]);
        }
        text += &table.render(width);
    }
    text
}

fn end(answer: &AxesRunAnswer, no_return: Option<i64>) -> String {
    let place = format!("at {} after {}", metres(answer.x_mm), seconds(answer.t_ms));
    let replans = count(answer.plans.len().saturating_sub(1) as u64, "replan");
    let limit = answer.constraint.as_deref().map_or_else(String::new, visible);
    match answer.outcome {
        AxesOutcome::Completed => format!("{GOOD}completed{GOOD:#} {place}, {replans}"),
        AxesOutcome::Missed => format!("{BAD}done, but {limit} does not hold{BAD:#}, {replans}"),
        AxesOutcome::Returned => format!("{GOOD}home{GOOD:#} after {}", seconds(answer.t_ms)),
        AxesOutcome::Stopped => format!("{BAD}stopped{BAD:#} {place}: no plan is left"),
        AxesOutcome::Stranded => format!("{BAD}stranded{BAD:#} {place}: {limit} is used up"),
        AxesOutcome::Unknown => "unknown: the steps of the search do not suffice".into(),
        AxesOutcome::Infeasible => match no_return {
            None => format!("{BAD}no plan{BAD:#}: `cotama plan` says why"),
            Some(it) => format!(
                "{BAD}no return{BAD:#}: from {} on all options need what may be lost",
                metres(it)
            ),
        },
    }
}

fn choices(plan: &AxesPlanRow) -> Table {
    let mut table = Table::new(vec![]).left(0).left(2);
    let mut before: Option<(&str, &str, i64)> = None;
    for it in &plan.choices {
        let row = (it.objective.as_str(), it.options.as_str(), it.speed_mm_s);
        if before == Some(row) {
            continue;
        }
        before = Some(row);
        let speed = if it.speed_mm_s == 0 {
            Cell::faint("stands")
        } else {
            Cell::plain(format!("{} mm/s", it.speed_mm_s))
        };
        table.row(vec![
            Cell::plain(visible(&it.objective)),
            Cell::faint(format!("from {}", metres(it.x_start_mm))),
            Cell::plain(visible(&it.options)),
            speed,
        ]);
    }
    table
}

fn metres(mm: i64) -> String {
    format!("{} m", short_metres(mm.unsigned_abs()))
}

fn signed(value: i64) -> String {
    let digits = grouped(&value.unsigned_abs().to_string());
    if value < 0 { format!("−{digits}") } else { digits }
}
