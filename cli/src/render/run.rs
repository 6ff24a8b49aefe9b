//! The screen of `cotama run`: the plans as in Table 7 of Lambert et al. 2024, the margins over the
//! run, what happened.

use super::calibrate::held;
use super::numbers::{count, joules, metres, milli, seconds};
use super::reason::reason;
use super::sparkline::{marks, sparkline};
use super::style::{BAD, FAINT, Families, GOOD, HEADING, NAME, NOTICE, PLAIN};
use super::table::{Cell, Table};
use crate::answers::{
    EndDifference, Outcome, PlanMade, RecordDifference, RecordedFailure, ReplayAnswer, RunBody,
};
use cotama_sim::trace::{Margins, Record, RunFaults, Trace};
use std::fmt::Write;

/// The most plans, activities and events that are shown.
const SHOWN_PLANS: usize = 20;
const SHOWN_ACTIVITIES: usize = 200;
const SHOWN_EVENTS: usize = 40;

/// The screen; `next` is the command that suggests itself. There is no trace when the robot never
/// left.
pub(crate) fn screen(
    body: &RunBody,
    trace: Option<&Trace>,
    next: Option<String>,
    width: usize,
) -> String {
    let mut text = headline(body, trace);
    if let Some(supervised) = &body.supervised {
        text += &super::supervised::story(supervised, width);
    }
    if !body.plans.is_empty() {
        text += &plans(body, width);
        text += &choices(body, width);
    }
    if let Some(trace) = trace {
        text += &margins(body, trace, width);
    }
    text += &events(body, width);
    text += &body.held.as_ref().map_or_else(String::new, |it| held(it, width));
    if let Some(why) = &body.infeasible {
        text.push('\n');
        text += &reason(why, width);
    }
    text += &ending(body);
    if let Some(next) = next.filter(|it| super::visible(it) == *it) {
        let _ = writeln!(text, "next: {NAME}{next}{NAME:#}");
    }
    text
}

/// Whether a trace came out the same, or a failure came back.
pub(crate) fn compared(answer: &ReplayAnswer) -> String {
    if let Some(failure) = &answer.failure {
        return returned(failure, answer.returns == Some(true), &answer.planner);
    }
    match answer.identical {
        None => "nothing to compare with: the file records no end; `cotama campaign` writes files \
                 that do\n"
            .to_owned(),
        Some(identical) => records_compared(identical, answer.difference.as_ref()),
    }
}

/// Whether a trace came out the same.
pub(crate) fn records_compared(identical: bool, difference: Option<&RecordDifference>) -> String {
    if identical {
        return format!("{GOOD}identical{GOOD:#}: the run was the same again, in every record\n");
    }
    let place = difference.map_or_else(String::new, different);
    format!("{BAD}not identical{BAD:#}: the run differs from what was stored\n{place}")
}

fn different(it: &RecordDifference) -> String {
    let there = |value: &Option<String>| {
        let value = value.as_deref().map_or_else(|| "nothing".to_owned(), super::visible);
        if value.chars().count() > 60 {
            value.chars().take(59).chain(['…']).collect()
        } else {
            value
        }
    };
    let (line, record) = (it.line, super::visible(&it.record));
    let (stored, now) = (there(&it.stored), there(&it.now));
    match &it.field {
        Some(field) => format!(
            "  line {line}, {record}: `{}` was {stored}, and is {now}\n",
            super::visible(field)
        ),
        None if it.stored.is_some() => {
            format!("  line {line}, {record}: there is no such record now\n")
        }
        None => format!("  line {line}, {record}: there was no such record\n"),
    }
}

pub(crate) fn returned(it: &RecordedFailure, returns: bool, planner: &str) -> String {
    let name = super::visible(&it.requirement);
    let mut text = match (returns, it.broken) {
        (true, _) => format!("{GOOD}returns{GOOD:#}: the failure comes back as it was recorded\n"),
        (false, true) => format!(
            "{BAD}does not return{BAD:#}: `{name}` is broken again, but the run ends otherwise\n"
        ),
        (false, false) => {
            format!("{BAD}does not return{BAD:#}: `{name}` is not broken any more\n")
        }
    };
    let now = if it.broken { "is broken" } else { "holds" };
    let _ = writeln!(text, "  expected: `{name}` is broken, {}", it.expected);
    let _ = writeln!(text, "  found:    `{name}` {now}, {}", it.found);
    for EndDifference { key, expected, found } in &it.differences {
        let _ = writeln!(text, "  {key}: {expected} was recorded, and is {found}");
    }
    let _ = writeln!(text, "  planner:  {planner}");
    text
}

fn outcome(outcome: Outcome) -> String {
    let (style, word) = match outcome {
        Outcome::Completed => (GOOD, "completed"),
        Outcome::Safe => (NOTICE, "stopped safely"),
        Outcome::Failed => (BAD, "failed"),
    };
    format!("{style}{word}{style:#}")
}

fn headline(body: &RunBody, trace: Option<&Trace>) -> String {
    let faults = match trace.map(|trace| &trace.header.options.faults) {
        Some(RunFaults::None) => ", nothing goes wrong".to_owned(),
        Some(RunFaults::File { source, .. }) => format!(", faults from {source}"),
        Some(RunFaults::Script) => ", faults of its script".to_owned(),
        None => String::new(),
    };
    let reason = body.reason.as_ref().map_or_else(String::new, |reason| format!(" ({reason})"));
    let way = match trace {
        Some(_) => format!(" after {} and {}", metres(body.x_mm), seconds(body.duration_ms)),
        None => " before it left".to_owned(),
    };
    format!(
        "{HEADING}{}{HEADING:#}, seed {}{faults}: {}{way}{reason}\n",
        body.mission,
        body.seed,
        outcome(body.outcome),
    )
}

fn margin(value: Option<i64>, words: fn(i64) -> String) -> Cell {
    match value {
        None => Cell::faint("\u{b7}"),
        Some(value) if value < 0 => Cell::new(words(value), BAD),
        Some(value) => Cell::plain(words(value)),
    }
}

/// Why, where, and what each plan did to the margins.
fn plans(body: &RunBody, width: usize) -> String {
    let faint = |cells: [&str; 7]| cells.map(Cell::faint).to_vec();
    let head = faint(["plan", "at", "because", "duration margin", "", "energy margin", ""]);
    let mut table = Table::new(vec![head]).left(2);
    for (number, plan) in body.plans.iter().enumerate().take(SHOWN_PLANS) {
        let arrow = |value: i64, words: fn(i64) -> String| {
            Cell::new(format!("\u{2192} {}", words(value)), if value < 0 { BAD } else { GOOD })
        };
        table.row(vec![
            Cell::new(number.to_string(), HEADING),
            Cell::plain(metres(plan.x_mm)),
            Cell::plain(&plan.cause),
            margin(plan.duration_margin_before_ms, seconds),
            arrow(plan.duration_margin_after_ms, seconds),
            margin(plan.energy_margin_before_mj, joules),
            arrow(plan.energy_margin_after_mj, joules),
        ]);
    }
    let mut text = format!("\n{}", table.render(width));
    if body.plans.len() > SHOWN_PLANS {
        let _ = writeln!(text, "  and {} more plans: see --json", body.plans.len() - SHOWN_PLANS);
    }
    text + &further(body, width)
}

/// Returns the margins of further sums that axes limit, after each plan; nothing where there are
/// none.
fn further(body: &RunBody, width: usize) -> String {
    let Some(first) = body.plans.first().filter(|it| !it.further.is_empty()) else {
        return String::new();
    };
    let names = first.further.iter().map(|it| Cell::faint(&it.constraint));
    let head = [Cell::faint("plan")].into_iter().chain(names);
    let mut table = Table::new(vec![head.collect()]);
    for (number, plan) in body.plans.iter().enumerate().take(SHOWN_PLANS) {
        let margins = plan.further.iter().map(|it| {
            let style = if it.margin < 0 { BAD } else { GOOD };
            Cell::new(it.margin.to_string(), style)
        });
        table.row([Cell::new(number.to_string(), HEADING)].into_iter().chain(margins).collect());
    }
    format!("\nmargins of further sums, after each plan, in their units\n{}", table.render(width))
}

/// Returns the choices of each plan for each activity.
fn choices(body: &RunBody, width: usize) -> String {
    let Some(first) = body.plans.first() else { return String::new() };
    let ids: Vec<_> =
        first.plan.iter().map(|row| row.activity.as_str()).take(SHOWN_ACTIVITIES).collect();
    let mut head = vec![Cell::plain("")];
    head.extend(ids.iter().map(|&id| Cell::new(id, HEADING)));
    let mut table = Table::new(vec![head]);
    let mut families = Families::default();
    for (number, plan) in body.plans.iter().enumerate().take(SHOWN_PLANS) {
        table.row(chosen(plan, number, &ids, &mut families));
    }
    let mut text = format!(
        "\n{}  {FAINT}columns: activities (cotama plan lists them); cells: an option for each task\
         {FAINT:#}\n",
        table.render(width)
    );
    if first.plan.len() > SHOWN_ACTIVITIES {
        let _ = writeln!(
            text,
            "  and {} more activities: see --json",
            first.plan.len() - SHOWN_ACTIVITIES
        );
    }
    text
}

fn chosen(plan: &PlanMade, number: usize, ids: &[&str], families: &mut Families) -> Vec<Cell> {
    let mut row = vec![Cell::new(format!("plan {number}"), HEADING)];
    // A plan is about the last activities, without a gap.
    let start = ids.iter().position(|&id| id == plan.first_activity).unwrap_or(ids.len());
    row.extend((0..start).map(|_| Cell::plain("")));
    let shown = plan.plan.iter().take(ids.len() - start);
    row.extend(shown.map(|it| Cell::new(&it.choice, families.style(&it.choice))));
    row
}

/// The margins over time, with the number of each plan under the time at which it came into force.
fn margins(body: &RunBody, trace: &Trace, width: usize) -> String {
    let samples: Vec<_> = trace
        .records
        .iter()
        .filter_map(|record| match record {
            Record::Sample(sample) => Some((sample.t_us, sample.margins)),
            _ => None,
        })
        .collect();
    let Some(&(end, _)) = samples.last() else { return String::new() };
    // Lines are as long as what is said behind them leaves.
    let said = |values: &[(u64, i64)], left: Option<i64>, words: fn(i64) -> String| {
        let least = values.iter().map(|&(_, value)| value).min().unwrap_or(0);
        format!("least {}, left {}", words(least), words(left.unwrap_or(0)))
    };
    let values = |of: fn(&Margins) -> i64| -> Vec<(u64, i64)> {
        samples.iter().map(|(time, it)| (*time, of(it))).collect()
    };
    let (duration, energy) = (values(|it| it.duration_ms), values(|it| it.energy_mj));
    let said = [
        said(&duration, body.duration_margin_ms, seconds),
        said(&energy, body.energy_margin_mj, joules),
    ];
    let longest = said.iter().map(|it| it.chars().count()).max().unwrap_or(0);
    let room = width.saturating_sub(14 + longest.max(32)).clamp(16, 72);
    let line = |name: &str, values: &[(u64, i64)], said: &str| {
        let drawn = sparkline(values, end, room, super::style::NAME);
        format!("  {name:8}  {drawn}  {said}\n")
    };
    let times: Vec<_> =
        body.plans.iter().take(SHOWN_PLANS).map(|plan| plan.time_ms.saturating_mul(1000)).collect();
    format!(
        "\n{HEADING}margins{HEADING:#} {FAINT}limit less used less planned, over time{FAINT:#}\n\
         {}{}  {FAINT}plan    {FAINT:#}  {}\n",
        line("duration", &duration, &said[0]),
        line("energy", &energy, &said[1]),
        marks(&times, end, room),
    )
}

fn events(body: &RunBody, width: usize) -> String {
    if body.events.is_empty() {
        return String::new();
    }
    let mut table = Table::new(vec![]).left(3);
    for event in body.events.iter().take(SHOWN_EVENTS) {
        let style = if event.kind == "fault" { BAD } else { PLAIN };
        let lost = if event.lost_ms > 0 {
            format!(", {} lost", milli(event.lost_ms.into(), 1, " s"))
        } else {
            String::new()
        };
        table.row(vec![
            Cell::plain(""),
            Cell::plain(metres(event.x_mm)),
            Cell::faint(seconds(event.time_ms)),
            Cell::new(format!("{}{lost}", event.text), style),
        ]);
    }
    let more = match body.events.len().saturating_sub(SHOWN_EVENTS) {
        0 => String::new(),
        more => format!("  and {more} more: see --json\n"),
    };
    format!("\n{HEADING}what happened{HEADING:#}\n{}{more}", table.render(width.max(80)))
}

fn ending(body: &RunBody) -> String {
    let mut text = format!(
        "\n{}: {}, {}",
        outcome(body.outcome),
        count(body.replans, "replan"),
        count(body.operator_requests, "operator request"),
    );
    if let (Some(duration), Some(energy)) = (body.duration_margin_ms, body.energy_margin_mj) {
        let _ = write!(
            text,
            "; left {} and {}",
            milli(duration.into(), 3, " s"),
            milli(energy.into(), 3, " J")
        );
    }
    text.push('\n');
    if let Some(report) = &body.report {
        let _ = writeln!(text, "report: {NAME}{report}{NAME:#}");
    }
    if let Some(trace) = &body.trace {
        let _ = writeln!(text, "trace: {NAME}{trace}{NAME:#}");
    }
    for path in &body.recordings {
        let _ = writeln!(text, "recording: {NAME}{path}{NAME:#}");
    }
    text
}
