//! The screen of `cotama explain` of a team.

use super::assign::amount;
use super::numbers::{grouped, metres, milli, seconds};
use super::style::{BAD, FAINT, GOOD, HEADING, NAME, PLAIN};
use super::table::{Cell, Table};
use super::{described, visible, wrapped};
use crate::answers::explain::bids::{BidPlanRow, BidRow, BidsAnswer, ContestRow, OfferRow};
use std::fmt::Write;

/// The most tasks of a table.
const SHOWN: usize = 100;

/// The screen: one task in full, or a table of all.
pub(crate) fn screen(
    answer: &BidsAnswer,
    in_full: bool,
    next: Option<String>,
    width: usize,
) -> String {
    if in_full {
        return answer.because.iter().map(|it| contest(it, width)).collect();
    }
    let name = visible(&answer.team);
    let mut text = format!("{HEADING}{name}{HEADING:#}: the best coalition of each task alone\n");
    text += &all(answer).render(width);
    if answer.because.len() > SHOWN {
        let _ = writeln!(text, "  and {} more tasks: see --json", answer.because.len() - SHOWN);
    }
    text + &super::next(next)
}

/// A row for each task.
fn all(answer: &BidsAnswer) -> Table {
    let head = ["task", "by", "plan", "cost in ms", "second best", "more"];
    let mut table = Table::new(vec![head.map(Cell::faint).to_vec()]).left(1).left(2).left(4);
    for it in answer.because.iter().take(SHOWN) {
        let name = Cell::new(visible(&it.task), NAME);
        let Some(best) = &it.best else {
            table.row(vec![name, Cell::new("nobody can", BAD)]);
            continue;
        };
        let mut row = vec![name, Cell::plain(members(best)), Cell::plain(visible(&best.plan))];
        row.push(Cell::plain(amount(best.cost, it.cost_denominator)));
        if let (Some(second), Some(more)) = (&it.second, it.second_costs_more) {
            row.push(Cell::plain(format!("{}: {}", visible(&second.plan), members(second))));
            row.push(Cell::plain(amount(more, it.cost_denominator)));
        } else {
            row.push(Cell::faint("none"));
        }
        table.row(row);
    }
    table
}

fn members(offer: &OfferRow) -> String {
    offer.robots.iter().map(|it| visible(it)).collect::<Vec<_>>().join(", ")
}

/// A task in full.
fn contest(it: &ContestRow, width: usize) -> String {
    let mut text = format!("{HEADING}{}{HEADING:#}\n", visible(&it.task));
    let (from, to) = (visible(&it.from), visible(&it.to));
    let way = if from == to { format!("at {from}") } else { format!("from {from} to {to}") };
    let skip = seconds(it.skip_ms);
    text += &wrapped(
        &format!(
            "{way}; undone it costs {skip}; of a plan the {} of its roles counts",
            match it.combine {
                "max" => "largest cost",
                other => other,
            }
        ),
        width,
        "  ",
    );
    for plan in &it.plans {
        text += &bids(plan, it.cost_denominator, width);
    }
    text.push('\n');
    let mut line = |name: &str, said: &str| text += &described(name, 7, FAINT, said, width);
    let parts = it.cost_denominator;
    let offer = |it: &OfferRow| {
        let plan = visible(&it.plan);
        format!("{} by {plan}: {} ms", members(it), amount(it.cost, parts))
    };
    let Some(best) = &it.best else {
        line("best", "no plan has a robot of its own for each role");
        return text;
    };
    let but = if it.worth_it { "" } else { "; it costs less to leave the task undone" };
    line("best", &format!("{}{but}", offer(best)));
    if let Some(pledge) = it.pledge_ms {
        line(
            "pledge",
            &format!("a role that comes to cost more than {} ms is given back", whole(pledge)),
        );
    }
    match (&it.second, it.second_costs_more) {
        (Some(second), Some(more)) => {
            line("second", &format!("{}, {} more", offer(second), amount(more, parts)));
        }
        _ => line("second", "nobody else can"),
    }
    for without in &it.without {
        let robot = visible(&without.robot);
        let said = match (without.cost, without.more) {
            (Some(cost), Some(more)) => {
                format!("{robot}: {} ms, {} more", amount(cost, parts), amount(more, parts))
            }
            _ => format!("{robot}: nobody can do it"),
        };
        line("without", &said);
    }
    text
}

/// The bids for a plan, role after role.
fn bids(plan: &BidPlanRow, parts: u32, width: usize) -> String {
    let mut text = format!("\n{HEADING}{}{HEADING:#}", visible(&plan.plan));
    let _ = match &plan.best {
        Some(best) => write!(text, ": {} ms by {}", amount(best.cost, parts), members(best)),
        None => write!(text, ": {BAD}nobody can{BAD:#}"),
    };
    if plan.extra_ms > 0 {
        let _ = write!(text, ", of which {} ms are what it yields less", whole(plan.extra_ms));
    }
    text.push('\n');
    // Teams without crowded ways need no column of delays.
    let mut counted = plan.roles.iter().flat_map(|it| &it.bids).filter_map(|it| it.counts.as_ref());
    let crowded = counted.any(|it| it.delays_ms != [0; 2]);
    let mut head = vec!["", "robot", "bid in ms", "ways", "drives"];
    head.extend(crowded.then_some("delays"));
    head.extend(["rounds", "take", "give", "failures"]);
    let mut table = Table::new(vec![head.into_iter().map(Cell::faint).collect()]).left(1);
    let mut told = String::new();
    for (place, role) in plan.roles.iter().enumerate() {
        let winner = plan.best.as_ref().and_then(|it| it.robots.get(place));
        let mut name = Cell::new(visible(&role.role), NAME);
        // Robots that lack the same are named together.
        let mut lacking: Vec<(String, Vec<String>)> = Vec::new();
        for it in &role.bids {
            let robot = visible(&it.robot);
            let (Some(bid), Some(own)) = (it.bid_ms, &it.counts) else {
                let why = why_not(it);
                match lacking.iter_mut().find(|it| it.0 == why) {
                    Some(same) => same.1.push(robot),
                    None => lacking.push((why, vec![robot])),
                }
                continue;
            };
            let style = if winner == Some(&it.robot) { GOOD } else { PLAIN };
            let numbers = [own.rounds_ms, own.take_ms, own.give_ms, it.failures_ms.unwrap_or(0)];
            let mut row = vec![std::mem::replace(&mut name, Cell::plain(""))];
            row.push(Cell::new(robot, style));
            row.push(Cell::plain(whole(bid)));
            row.push(Cell::plain(own.ways_mm.map(metres).join(" + ")));
            row.push(Cell::plain(own.drives_ms.map(whole).join(" + ")));
            if crowded {
                row.push(Cell::plain(own.delays_ms.map(whole).join(" + ")));
            }
            row.extend(numbers.map(|it| Cell::plain(whole(it))));
            table.row(row);
            if it.success_permille.is_some_and(|it| it < 1_000) {
                told += &actions(&role.role, it, width);
            }
        }
        for (why, robots) in lacking {
            let said = format!("no bid as {}: {}: {why}", visible(&role.role), robots.join(", "));
            told += &wrapped(&said, width, "  ");
        }
    }
    if table.len() > 0 {
        text += &table.render(width);
    }
    text + &told
}

/// A whole number.
fn whole(it: impl std::fmt::Display) -> String {
    grouped(&it.to_string())
}

/// Why a robot does not bid.
fn why_not(it: &BidRow) -> String {
    match it.why_not {
        Some(why) => why.to_owned(),
        None => format!("no {}", visible(&it.lacks.join(", no "))),
    }
}

/// Addition of failures to a bid, action after action.
fn actions(role: &str, it: &BidRow, width: usize) -> String {
    let risky = it.actions.iter().enumerate().filter(|it| it.1.failures_ms > 0);
    let said: Vec<String> = risky
        .map(|(at, own)| {
            let works = milli(i128::from(own.success_permille) * 100, 1, " %");
            let uses = visible(&own.uses.join(", "));
            format!(
                "action {} ({uses}) works {works}, else {} ms are repeated: {} ms",
                at + 1,
                whole(own.repeated_ms),
                whole(own.failures_ms)
            )
        })
        .collect();
    let success = milli(i128::from(it.success_permille.unwrap_or(0)) * 100, 1, " %");
    let (robot, role) = (visible(&it.robot), visible(role));
    let text =
        format!("failures of {robot} as {role}: {}. All goes well {success}", said.join("; "));
    wrapped(&text, width, "  ")
}
