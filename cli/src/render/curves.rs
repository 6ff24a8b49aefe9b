//! The screen of `cotama assign --curves`.

use super::numbers::{grouped, milli};
use super::style::{FAINT, GOOD, HEADING, NAME};
use super::table::{Cell, Table};
use super::{visible, wrapped};
use crate::answers::curves::{BenchmarkRow, CurveRow, CurvesAnswer};
use std::fmt::Write;

/// The screen: tables of counts, each under its figure of the thesis.
pub(crate) fn screen(answer: &CurvesAnswer, width: usize) -> String {
    let mut text = wrapped(
        "One task with a plan for each number of robots. To assign z roles to z robots counts as \
         z³ steps.",
        width,
        "",
    );
    let mut part = |title: &str, words: &str, table: &Table| {
        let _ = write!(text, "\n{HEADING}{title}{HEADING:#}\n");
        text += &wrapped(words, width, "");
        text += &table.render(width);
    };
    part(
        "Computation (Fig. 3.4a)",
        "Steps where the auctioneer looks at all coalitions (MuRoCo), of the busiest robot where \
         they are shared out (MuRoCo-D), of one assignment a plan, as `cotama assign` takes them; \
         orderings of an exhaustive search.",
        &computation(&answer.growth),
    );
    part(
        "Bounds and messages (Tables 3.1 and 3.2, Fig. 3.4b, 3.5)",
        "A search with coalitions of k of n robots at most is as slow as MuRoCo from k/n on. A \
         message may cost so many steps before MuRoCo is quicker than MuRoCo-D.",
        &bounds(&answer.growth),
    );
    part(
        "Benchmark (Fig. 3.8)",
        "Steps of the busiest robot for capable coalitions, where so many robots are capable.",
        &benchmark(&answer.benchmark),
    );
    let teams = answer.benchmark.chunk_by(|a, b| a.robots == b.robots);
    let largest = teams.last().unwrap_or_default();
    let robots = largest.first().map_or(0, |it| it.robots);
    part(
        &format!("Conditions on coalitions of {robots} robots (3.16, 3.17)"),
        "Coalitions that meet a condition, and the steps with it first over those without: below \
         100 % it pays.",
        &pay_off(largest),
    );
    if let Some(report) = &answer.report {
        let _ = write!(text, "\n{FAINT}report{FAINT:#}  {}\n", visible(report));
    }
    text
}

fn number(it: u64) -> Cell {
    Cell::plain(grouped(&it.to_string()))
}

fn or_none(it: Option<u64>) -> Cell {
    it.map_or_else(|| Cell::faint("-"), number)
}

fn head(names: &[&str]) -> Vec<Vec<Cell>> {
    vec![names.iter().map(|it| Cell::faint(*it)).collect()]
}

fn robots(it: u64) -> Cell {
    Cell::new(it.to_string(), NAME)
}

fn computation(rows: &[CurveRow]) -> Table {
    let names = ["robots", "coalitions", "MuRoCo", "MuRoCo-D", "orderings", "assignment"];
    let mut table = Table::new(head(&names));
    for it in rows {
        let steps = [it.coalitions, it.central_steps, it.distributed_steps];
        let mut row = vec![robots(it.robots)];
        row.extend(steps.map(number));
        row.extend([or_none(it.orderings), number(it.assignment_steps)]);
        table.row(row);
    }
    table
}

fn bounds(rows: &[CurveRow]) -> Table {
    let above = ["", "bounds", "", "", "", "messages", "", "", "steps a message", ""];
    let names =
        ["robots", "2ⁿn³", "2ⁿn²", "n!", "k/n", "SR", "MuRoCo", "MuRoCo-D", "counted", "bound"];
    let mut table = Table::new([head(&above), head(&names)].concat());
    for it in rows {
        let bounds = &it.bounds;
        let mut row = vec![robots(it.robots)];
        row.extend([bounds.central_steps, bounds.distributed_steps, bounds.orderings].map(number));
        row.push(Cell::plain(milli(bounds.size_limit_permille.into(), 3, "")));
        let sent = &it.messages;
        row.extend([sent.singles, sent.central, sent.distributed].map(number));
        row.extend([or_none(it.steps_a_message), number(bounds.steps_a_message)]);
        table.row(row);
    }
    table
}

fn benchmark(rows: &[BenchmarkRow]) -> Table {
    let teams: Vec<_> = rows.chunk_by(|a, b| a.robots == b.robots).collect();
    let team = |it: &&[BenchmarkRow]| format!("of {}", it.first().map_or(0, |it| it.robots));
    let names = teams.iter().map(|it| Cell::faint(team(it)));
    let mut table = Table::new(vec![[Cell::faint("capable")].into_iter().chain(names).collect()]);
    let most = rows.iter().map(|it| it.capable).max().unwrap_or(0);
    for capable in 0..=most {
        let mut row = vec![robots(capable)];
        row.extend(teams.iter().map(|it| {
            let own = it.iter().find(|it| it.capable == capable);
            own.map_or_else(|| Cell::plain(""), |it| number(it.busiest_steps))
        }));
        table.row(row);
    }
    table
}

fn pay_off(rows: &[BenchmarkRow]) -> Table {
    let above = ["", "", "meet it", "", "", "steps with it", "", ""];
    let names = ["capable", "coalitions", "cap1", "cap2", "cap3", "cap1", "cap2", "cap3"];
    let mut table = Table::new([head(&above), head(&names)].concat());
    for it in rows {
        let mut row = vec![robots(it.capable), number(it.coalitions)];
        row.extend(it.conditions.iter().map(|it| number(it.passed)));
        row.extend(it.conditions.iter().map(|own| {
            let share = milli(i128::from(own.steps * 100_000 / it.steps.max(1)), 1, " %");
            if own.pays { Cell::new(share, GOOD) } else { Cell::plain(share) }
        }));
        table.row(row);
    }
    table
}
