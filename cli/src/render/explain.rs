//! The screen of `cotama explain`.

use super::numbers::short_metres;
use super::style::{BAD, FAINT, GOOD, HEADING, NAME, NOTICE};
use super::table::{Cell, Table};
use super::{visible, wrapped};
use crate::answers::axes::{DroppedRow, InducerRow};
use crate::answers::explain::{BecauseRow, BindingRow, CandidateRow, ExplainAnswer, HeldRow};
use std::fmt::Write;

/// The screen: one activity in full, or a table of all.
pub(crate) fn screen(
    answer: &ExplainAnswer,
    in_full: bool,
    next: Option<String>,
    width: usize,
) -> String {
    let mut text = if in_full {
        answer.because.iter().map(|it| activity(it, width)).collect()
    } else {
        let name = visible(&answer.mission);
        let head = format!("{HEADING}{name}{HEADING:#}: what each core constraint allows alone\n");
        head + &all(answer).render(width) + &super::next(next)
    };
    if answer.limit_reached {
        text += "a limit was reached, the rest is missing: use more `--steps`\n";
    }
    text
}

/// Candidates of an activity with the same reasons, and the first of them.
fn groups(of: &BecauseRow) -> Vec<(&CandidateRow, Vec<&str>)> {
    let mut groups: Vec<(&CandidateRow, Vec<&str>)> = Vec::new();
    for it in &of.candidates {
        let same = |first: &CandidateRow| {
            first.speed_mm_s == it.speed_mm_s && first.constraints == it.constraints
        };
        match groups.iter_mut().find(|group| same(group.0)) {
            Some(group) => group.1.push(&it.options),
            None => groups.push((it, vec![&it.options])),
        }
    }
    groups
}

/// A row for each activity and each reason of a speed in it.
fn all(answer: &ExplainAnswer) -> Table {
    let mut names: Vec<&str> = Vec::new();
    let candidates = answer.because.iter().flat_map(|it| &it.candidates);
    for it in candidates.flat_map(|it| &it.constraints) {
        if !names.contains(&it.constraint.as_str()) {
            names.push(&it.constraint);
        }
    }
    let mut head = ["", "zones", "mm/s", "bounded by"].map(Cell::faint).to_vec();
    head.extend(names.iter().map(|it| Cell::faint(visible(it))));
    head.extend(["candidates", "first"].map(Cell::faint));
    let mut table = Table::new(vec![head]).left(1).left(3).left(names.len() + 5);
    for activity in &answer.because {
        for (first, options) in groups(activity) {
            let speed = match first.speed_mm_s {
                0 => Cell::faint("\u{b7}"),
                speed => Cell::plain(speed.to_string()),
            };
            let mut row = vec![
                Cell::new(&activity.activity, HEADING),
                Cell::plain(visible(&activity.zones.join(", "))),
                speed,
                Cell::new(visible(&binding(first).join(", ")), NAME),
            ];
            row.extend(names.iter().map(|name| {
                let own = first.constraints.iter().find(|it| it.constraint == *name);
                own.map_or_else(
                    || Cell::faint("\u{b7}"),
                    |it| Cell::plain(it.alone_mm_s.to_string()),
                )
            }));
            let label = options.first().copied().unwrap_or_default();
            row.extend([Cell::plain(options.len().to_string()), Cell::faint(visible(label))]);
            table.row(row);
        }
    }
    table
}

fn binding(of: &CandidateRow) -> Vec<&str> {
    of.constraints.iter().filter(|it| it.binds).map(|it| it.constraint.as_str()).collect()
}

fn activity(of: &BecauseRow, width: usize) -> String {
    let metres = |mm: i64| short_metres(mm.unsigned_abs());
    let mut head = format!("{HEADING}{}{HEADING:#} of {}", of.activity, visible(&of.objective));
    if of.x_start_mm < of.x_end_mm {
        let _ = write!(head, ": {} to {} m", metres(of.x_start_mm), metres(of.x_end_mm));
    } else {
        let _ = write!(head, ": stands at {} m", metres(of.x_start_mm));
    }
    let zones: Vec<_> = of.zones.iter().map(|it| visible(it)).collect();
    if !zones.is_empty() {
        let _ = write!(head, ", {}", zones.join(", "));
    }
    let mut text = wrapped(&head, width, "");
    for (first, options) in groups(of) {
        let options: Vec<_> = options.iter().map(|it| visible(it)).collect();
        let speed = match first.speed_mm_s {
            0 => "stands".to_owned(),
            speed => format!("{speed} mm/s"),
        };
        text += "\n";
        text += &wrapped(&format!("{GOOD}{speed}{GOOD:#}: {}", options.join(", ")), width, "  ");
        text += &reasons(first, width);
    }
    text + &removed(&of.dropped, width)
}

fn reasons(of: &CandidateRow, width: usize) -> String {
    let mut text = String::new();
    let binding = binding(of);
    match (of.next_mm_s, binding.len()) {
        (Some(next), _) => {
            for it in &of.constraints {
                if let Some(binding) = &it.binding {
                    text += &bound(it, binding, next, width);
                }
            }
        }
        (None, _) if of.speed_mm_s > 0 => text += "    the robot itself is no faster\n",
        (None, _) => {}
    }
    let others: Vec<_> = of
        .constraints
        .iter()
        .map(|it| format!("{NAME}{}{NAME:#} {}", visible(&it.constraint), it.alone_mm_s))
        .collect();
    if !others.is_empty() {
        let line = format!("alone they allow, in mm/s: {}", others.join(", "));
        text += &wrapped(&line, width, "    ");
    }
    if binding.len() > 1 {
        let names: Vec<_> = binding.iter().map(|it| visible(it)).collect();
        let line = format!(
            "{NOTICE}{}{NOTICE:#} hold it at once: to be faster, each must give way",
            names.join(" and ")
        );
        text += &wrapped(&line, width, "    ");
    }
    text
}

/// Says that a constraint binds, by what, and what would change it.
fn bound(of: &HeldRow, it: &BindingRow, next: i64, width: usize) -> String {
    let name = visible(&of.constraint);
    let unit = visible(&it.unit);
    let line = format!(
        "{NAME}{name}{NAME:#} binds: {} {unit}, and {} {unit} at {next} mm/s; the goal is {} {}",
        it.value, it.value_next, it.relation, it.goal
    );
    let mut text = wrapped(&line, width, "    ");
    let inducer = |it: &InducerRow| {
        let of = if it.of.is_empty() { String::new() } else { format!(" of {}", it.of) };
        visible(&format!("{} {}{of}", it.name, it.value))
    };
    let inducers: Vec<_> =
        it.inducers.iter().filter(|it| it.name != "speed_mm_s").map(inducer).collect();
    if !inducers.is_empty() {
        let line = format!("{FAINT}by {}{FAINT:#}", inducers.join(", "));
        text += &wrapped(&line, width, "      ");
    }
    for raise in &it.raises {
        let way = if raise.needed < raise.now { "at most" } else { "at least" };
        let speed = match raise.speed_mm_s {
            0 => format!("{name} allows {next} mm/s, and another constraint removes it"),
            speed if speed < next => format!("{name} allows {next} mm/s"),
            speed => format!("allows {speed} mm/s"),
        };
        let what = visible(&raise.name);
        let line = format!("{what} {way} {} (now {}): {speed}", raise.needed, raise.now);
        text += &wrapped(&line, width, "      ");
    }
    text
}

/// Says which combinations are none, and what removed them.
fn removed(dropped: &[DroppedRow], width: usize) -> String {
    let mut groups: Vec<(&[String], Vec<String>)> = Vec::new();
    for it in dropped {
        match groups.iter_mut().find(|group| group.0 == it.by) {
            Some(group) => group.1.push(visible(&it.options)),
            None => groups.push((&it.by, vec![visible(&it.options)])),
        }
    }
    let mut text = String::new();
    for (by, options) in groups {
        let by: Vec<_> = by.iter().map(|it| visible(it)).collect();
        let line = format!("{BAD}removed{BAD:#} by {}: {}", by.join(", "), options.join(", "));
        text += "\n";
        text += &wrapped(&line, width, "  ");
    }
    text
}
