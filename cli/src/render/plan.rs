//! The screen of `cotama plan`: the activities and the plan as in Tables 5 and 6 of Lambert et al.
//! 2024.

use super::numbers::{count, grouped, milli, short_metres};
use super::reason::reason;
use super::style::{BAD, FAINT, Families, GOOD, HEADING, NOTICE};
use super::table::{Cell, Table};
use crate::answers::{FrontRow, PlanAnswer, Status};
use std::fmt::Write;

/// The most activities and plans of a front that are shown.
const SHOWN: usize = 200;
const SHOWN_FRONT: usize = 20;

/// A status in a word, with its style.
pub(crate) fn status(status: Status) -> String {
    let (style, word) = match status {
        Status::Optimal => (GOOD, "optimal"),
        Status::Feasible => (GOOD, "feasible"),
        Status::Infeasible => (BAD, "infeasible"),
        Status::Unknown => (NOTICE, "unknown"),
    };
    format!("{style}{word}{style:#}")
}

/// The screen; `next` is the command that suggests itself.
pub(crate) fn screen(answer: &PlanAnswer, next: Option<String>, width: usize) -> String {
    let length = answer.activities.iter().map(|it| it.x_end_mm).max().unwrap_or(0);
    let mut text = format!(
        "{HEADING}{}{HEADING:#}: {} m, {}, {} combinations\n\n",
        answer.mission,
        short_metres(length),
        count(answer.activities.len() as u64, "activity").replace("activitys", "activities"),
        grouped(&answer.combinations),
    );
    text += &activities(answer).render(width);
    text += &harmless(answer);
    if answer.activities.len() > SHOWN {
        let _ =
            writeln!(text, "  and {} more activities: see --json", answer.activities.len() - SHOWN);
    }
    let who = match (answer.allocator, answer.objective) {
        (Some("panorama"), _) => ", by the rule of PANORAMA, Lambert et al. 2024".to_owned(),
        (_, "paper") => String::new(),
        (_, objective) => format!(" for the objective {objective}"),
    };
    let steps = match answer.steps {
        0 => String::new(),
        steps => format!(" {FAINT}({} steps){FAINT:#}", grouped(&steps.to_string())),
    };
    let _ = writeln!(text, "\n{}{who}{steps}", status(answer.status));
    text += &totals(answer);
    if let Some(rows) = &answer.front {
        text += &front(rows, width);
    }
    if let Some(why) = &answer.reason {
        text += &reason(why, width);
    }
    text + &super::next(next)
}

/// Says why no activity is as fast as the robot can be, where that is so.
fn harmless(answer: &PlanAnswer) -> String {
    let (most, harmless) = (answer.speed_robot_mm_s, answer.speed_harmless_mm_s);
    let is_limit = |it: &crate::answers::ActivityRow| it.speed_max_mm_s == harmless;
    if harmless >= most || !answer.activities.iter().any(is_limit) {
        return String::new();
    }
    format!(
        "  {FAINT}not {most} mm/s: above {harmless} mm/s an impact reaches impact_energy_max_mj\
         {FAINT:#}\n"
    )
}

fn activities(answer: &PlanAnswer) -> Table {
    let shown = || answer.activities.iter().take(SHOWN);
    let line = |name: &str, cells: Vec<Cell>| {
        let mut row = vec![Cell::faint(name)];
        row.extend(cells);
        row
    };
    let dash = || Cell::faint("\u{b7}");
    let mut table =
        Table::new(vec![line("", shown().map(|it| Cell::new(&it.id, HEADING)).collect())]);
    table.row(line("objective", shown().map(|it| Cell::plain(&it.objective)).collect()));
    table.row(line("from m", shown().map(|it| Cell::plain(short_metres(it.x_start_mm))).collect()));
    table.row(line("to m", shown().map(|it| Cell::plain(short_metres(it.x_end_mm))).collect()));
    let candidates = shown().map(|it| match it.candidates {
        0 => Cell::new("none", BAD),
        all if all == it.candidates_before => Cell::plain(all.to_string()),
        some => Cell::plain(format!("{some}/{}", it.candidates_before)),
    });
    table.row(line("candidates", candidates.collect()));
    let limits = shown().map(|it| match it.speed_max_mm_s {
        0 => dash(),
        speed => Cell::plain(speed.to_string()),
    });
    table.row(line("most mm/s", limits.collect()));
    if answer.plan.is_empty() {
        return table;
    }
    let plan = || answer.plan.iter().take(SHOWN);
    let mut families = Families::default();
    let choices = plan().map(|row| Cell::new(&row.choice, families.style(&row.choice)));
    let mut row = vec![Cell::new("plan", HEADING)];
    row.extend(choices);
    table.row(row);
    let speeds = plan().map(|row| match row.speed_mm_s {
        0 => dash(),
        speed => Cell::plain(speed.to_string()),
    });
    table.row(line("mm/s", speeds.collect()));
    table.row(line(
        "s",
        plan().map(|row| Cell::plain(milli(row.duration_ms.into(), 1, ""))).collect(),
    ));
    table.row(line(
        "J",
        plan().map(|row| Cell::plain(milli(row.energy_mj.into(), 0, ""))).collect(),
    ));
    table
}

fn totals(answer: &PlanAnswer) -> String {
    let (Some(duration), Some(energy), Some(quality)) =
        (answer.duration_ms, answer.energy_mj, answer.quality)
    else {
        return String::new();
    };
    let mut table = Table::new(vec![]).left(2);
    let mut axis = |name: &str, used: u64, limit: u64, margin: Option<i64>, unit: &str| {
        let amount = |value: u64| milli(value.into(), 3, unit);
        table.row(vec![
            Cell::plain(name),
            Cell::plain(amount(used)),
            Cell::plain(format!("of {}", amount(limit))),
            Cell::new(format!("margin {}", milli(margin.unwrap_or(0).into(), 3, unit)), GOOD),
        ]);
    };
    axis("duration", duration, answer.duration_limit_ms, answer.duration_margin_ms, " s");
    axis("energy", energy, answer.energy_limit_mj, answer.energy_margin_mj, " J");
    let bound = match (answer.bound, answer.objective) {
        (Some(bound), "quality") if answer.status != Status::Optimal => format!("at most {bound}"),
        _ => String::new(),
    };
    let of = if bound.is_empty() { "sum of options".to_owned() } else { bound };
    table.row(vec![Cell::plain("quality"), Cell::plain(quality.to_string()), Cell::faint(of)]);
    table.render(usize::MAX)
}

fn front(rows: &[FrontRow], width: usize) -> String {
    let head = ["", "duration s", "energy J", "quality"].map(Cell::faint).to_vec();
    let mut table = Table::new(vec![head]);
    // As many as are shown, evenly from the first to the last.
    let shown = rows.len().min(SHOWN_FRONT);
    for place in 0..shown {
        let number = if shown > 1 { place * (rows.len() - 1) / (shown - 1) } else { 0 };
        let row = &rows[number];
        table.row(vec![
            Cell::faint((number + 1).to_string()),
            Cell::plain(milli(row.duration_ms.into(), 3, "")),
            Cell::plain(milli(row.energy_mj.into(), 3, "")),
            Cell::plain(row.quality.to_string()),
        ]);
    }
    let all = count(rows.len() as u64, "plan");
    let some = if shown < rows.len() {
        format!(", {shown} of them shown (all: --json)")
    } else {
        String::new()
    };
    format!(
        "  {all}, none of them worse than another in duration, energy and quality{some}\n\n{}",
        table.render(width)
    )
}
