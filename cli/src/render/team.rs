//! The screens of `cotama run fleet` and `cotama run service`.

use super::numbers::{count, grouped, milli, seconds};
use super::style::{BAD, FAINT, GOOD, HEADING, NAME, NOTICE, PLAIN};
use super::table::{Cell, Table};
use crate::answers::team::{Compared, Interval, TeamAnswer, TeamRun};
use cotama_sim::fleet::record::Record;
use cotama_sim::fleet::trace::Trace;
use std::fmt::Write;

/// The most rows of what happened.
const SHOWN: usize = 24;

/// One run.
pub(crate) fn screen(
    answer: &TeamAnswer,
    trace: &Trace,
    next: Option<&str>,
    width: usize,
) -> String {
    let Some(run) = &answer.run else { return String::new() };
    let mut text = headline(answer, run);
    text += &happened(answer, trace, width);
    let _ = writeln!(text, "\n{HEADING}messages{HEADING:#}");
    let mut table = Table::new(vec![]);
    let sent: u64 = run.messages.values().sum();
    for (kind, number) in run.messages.iter().filter(|it| *it.1 > 0) {
        let number = Cell::plain(grouped(&number.to_string()));
        table.row(vec![Cell::plain(format!("{kind:8}")), number]);
    }
    let lost = grouped(&run.messages_lost.to_string());
    table.row(vec![
        Cell::new("all", HEADING),
        Cell::new(grouped(&sent.to_string()), HEADING),
        Cell::faint(format!("{lost} of these lost")),
    ]);
    text += &table.render(width);
    text.push('\n');
    for (name, path) in [("report", &run.report), ("trace", &run.trace)] {
        if let Some(path) = path {
            let _ = writeln!(text, "{name}: {}", super::visible(path));
        }
    }
    if let Some(next) = next {
        let _ = writeln!(text, "next: {NAME}{}{NAME:#}", super::visible(next));
    }
    text
}

fn headline(answer: &TeamAnswer, run: &TeamRun) -> String {
    let TeamAnswer { tasks, robots, .. } = answer;
    let scenario = super::visible(&answer.scenario);
    let (style, word) = match answer.outcome {
        "completed" => (GOOD, "completed"),
        "failed" => (BAD, "failed"),
        _ => (NOTICE, "not all done"),
    };
    let mut text = format!(
        "{HEADING}{scenario}{HEADING:#} {style}{word}{style:#}: {} of {} done",
        run.done,
        count(*tasks, "task")
    );
    if run.reported > 0 {
        let _ = write!(text, ", {} reported", run.reported);
    }
    let _ = writeln!(text, " by {} in {}", count(*robots, "robot"), seconds(run.duration_ms));
    let _ = writeln!(
        text,
        "  {FAINT}allocation {}, {} % of messages lost, seed {}{FAINT:#}",
        run.allocation,
        milli(i128::from(answer.loss_permille) * 100, 1, ""),
        answer.seed
    );
    let rows = [
        ("a task takes", seconds(run.mean_time_ms), "on average, from when it is known"),
        ("robots worked", seconds(run.robot_time_ms), "all together"),
        ("energy", kilojoules(run.energy_mj), "drawn until the end"),
        ("auctions", run.auctions.to_string(), ""),
        ("awards", run.awards.len().to_string(), ""),
        ("put up again", run.reopened.to_string(), "given back, or the robot was silent"),
        ("out of work", run.robots_out.to_string(), "robots, at the end"),
    ];
    let performance = run.performance_permille.map(|it| {
        let words = "of the utility of all tasks is left, less the time of robots (2.7)";
        ("performance", milli(i128::from(it) * 100, 1, " %"), words)
    });
    let failed = (run.failed_uses > 0).then(|| {
        (
            "uses failed",
            run.failed_uses.to_string(),
            "an action was repeated, or its task given back",
        )
    });
    let taken_over = (run.takeovers > 0).then(|| {
        let words = "the next robot gives tasks out, as who did was silent";
        ("taken over", run.takeovers.to_string(), words)
    });
    let charged = (run.charges > 0)
        .then(|| ("charged", run.charges.to_string(), "times that a robot was at its charger"));
    let more = charged.into_iter().chain(taken_over).chain(failed).chain(performance);
    let mut table = Table::new(vec![]).left(2);
    for (name, value, words) in rows.into_iter().chain(more) {
        table.row(vec![Cell::plain(name), Cell::plain(value), Cell::faint(words)]);
    }
    text + &table.render(100) + &skills(run)
}

/// Skills that may fail or are counted, as their robots have come to know them.
fn skills(run: &TeamRun) -> String {
    if run.skills.is_empty() {
        return String::new();
    }
    let head = ["robot", "skill", "uses", "failed", "taken to work"].map(Cell::faint).to_vec();
    let mut table = Table::new(vec![head]).left(1);
    for it in run.skills.iter().take(SHOWN) {
        table.row(vec![
            Cell::plain(super::visible(&it.robot)),
            Cell::plain(super::visible(&it.skill)),
            Cell::plain(it.uses.to_string()),
            Cell::plain(it.failed.to_string()),
            Cell::plain(milli(i128::from(it.reliability / 1_000_000) * 100, 1, " %")),
        ]);
    }
    let mut text = format!("\n{HEADING}skills{HEADING:#}\n{}", table.render(100));
    if run.skills.len() > SHOWN {
        let more = run.skills.len() - SHOWN;
        let _ = writeln!(text, "  {FAINT}and {more} more: see --json{FAINT:#}");
    }
    text
}

/// Returns the faults, and in a small run the awards.
fn happened(answer: &TeamAnswer, trace: &Trace, width: usize) -> String {
    let small = answer.tasks <= 8;
    let (words, mut rows) = (trace.words(), Vec::new());
    for record in &trace.records {
        let row = match record {
            Record::Awarded { t_ms, task, plan, robots, round, .. } if small => {
                let robots: Vec<&str> = robots.iter().map(|it| trace.robot(*it)).collect();
                let what = format!("auction {round}: <{plan}>");
                (*t_ms, robots.join(", "), trace.task(*task), what, PLAIN)
            }
            Record::Done { t_ms, task, .. } if small => {
                (*t_ms, String::new(), trace.task(*task), "done".to_owned(), GOOD)
            }
            Record::Fails { t_ms, robot, mode } => {
                let what = format!("fails: {}", words(*robot, mode));
                (*t_ms, trace.robot(*robot).to_owned(), "", what, NOTICE)
            }
            Record::Shifted { t_ms, task } => {
                (*t_ms, String::new(), trace.task(*task), "its object is shifted".into(), NOTICE)
            }
            Record::Turned { t_ms, task } => {
                (*t_ms, String::new(), trace.task(*task), "its object is turned".into(), NOTICE)
            }
            Record::Error { t_ms, robot, task, class, why } => {
                let (robot, task) = (trace.robot(*robot).to_owned(), trace.task(*task));
                (*t_ms, robot, task, format!("{}: {why}", class.name()), NOTICE)
            }
            Record::Silent { t_ms, robot, task } => {
                let what = "is silent; its award has run out".to_owned();
                (*t_ms, trace.robot(*robot).to_owned(), trace.task(*task), what, NOTICE)
            }
            Record::GoesHome { t_ms, robot, charge_mj } if small => {
                let what = format!("drives home with {}", kilojoules(*charge_mj));
                (*t_ms, trace.robot(*robot).to_owned(), "", what, PLAIN)
            }
            Record::Charged { t_ms, robot } if small => {
                (*t_ms, trace.robot(*robot).to_owned(), "", "is charged".to_owned(), PLAIN)
            }
            Record::Empty { t_ms, robot } => {
                let what = "its battery is empty".to_owned();
                (*t_ms, trace.robot(*robot).to_owned(), "", what, BAD)
            }
            Record::TakesOver { t_ms, robot, copied } => {
                let what = takes_over(*copied);
                (*t_ms, trace.robot(*robot).to_owned(), "", what.to_owned(), NOTICE)
            }
            Record::Reported { t_ms, task, why } => {
                (*t_ms, String::new(), trace.task(*task), format!("reported: {why}"), BAD)
            }
            _ => continue,
        };
        rows.push(row);
    }
    if rows.is_empty() {
        return String::new();
    }
    let title = if small { "what happened" } else { "what went wrong" };
    let mut table = Table::new(vec![]).left(1).left(2).left(3);
    for (t_ms, robot, task, what, style) in rows.iter().take(SHOWN) {
        table.row(vec![
            Cell::plain(seconds(*t_ms)),
            Cell::plain(robot.as_str()),
            Cell::plain(*task),
            Cell::new(what.as_str(), *style),
        ]);
    }
    let mut text = format!("\n{HEADING}{title}{HEADING:#}\n{}", table.render(width));
    if rows.len() > SHOWN {
        let _ = writeln!(text, "  {FAINT}and {} more: see the report{FAINT:#}", rows.len() - SHOWN);
    }
    text
}

fn kilojoules(energy_mj: u64) -> String {
    milli(i128::from(energy_mj / 1_000), 1, " kJ")
}

const fn takes_over(copied: bool) -> &'static str {
    if copied {
        "gives tasks out from now on"
    } else {
        "gives tasks out from now on, without a copy"
    }
}

/// Many seeds.
pub(crate) fn compared(answer: &TeamAnswer, faults: usize, next: &str, width: usize) -> String {
    let Some(compared) = &answer.compared else { return String::new() };
    let unsound = compared.allocations.iter().map(|it| it.unsound);
    let unsound: u64 = unsound.chain(compared.trusts.iter().map(|it| it.unsound)).sum();
    let (style, word) = if unsound == 0 {
        (GOOD, "sound".to_owned())
    } else {
        (BAD, format!("{unsound} runs are not sound"))
    };
    let mut text = format!(
        "{HEADING}{}{HEADING:#} {style}{word}{style:#}: {}, {}, {}, each task done once or \
         reported\n  {FAINT}{}, {} % of messages lost, seeds {} to {}{FAINT:#}\n\n",
        super::visible(&answer.scenario),
        count(compared.seeds, "seed"),
        count(answer.robots, "robot"),
        count(answer.tasks, "task"),
        count(faults as u64, "fault"),
        milli(i128::from(answer.loss_permille) * 100, 1, ""),
        answer.seed,
        answer.seed + compared.seeds - 1
    );
    if compared.trusts.is_empty() {
        text += &by_allocation(compared).render(width);
    } else {
        text += &by_trust(compared, width);
    }
    let _ = writeln!(
        text,
        "  {FAINT}means with intervals of 95 %; robot time counts what is not done with its \
         utility{FAINT:#}"
    );
    let _ = writeln!(text, "\nnext: {NAME}{}{NAME:#}", super::visible(next));
    text
}

fn by_allocation(compared: &Compared) -> Table {
    let head = ["allocation", "robot time", "more than first", "", "a task takes", "reported"];
    let mut table = Table::new(vec![head.iter().map(|it| Cell::new(*it, HEADING)).collect()]);
    for it in &compared.allocations {
        let first = it.more_ms.mean == 0 && it.more_ms.low == 0 && it.more_ms.high == 0;
        let more = if first { "–".into() } else { interval(it.more_ms, " s") };
        let share = if first { String::new() } else { percent(it.more_permille) };
        table.row(vec![
            Cell::plain(it.allocation),
            Cell::plain(interval(it.cost_ms, " s")),
            Cell::plain(more),
            Cell::plain(share),
            Cell::plain(interval(it.mean_time_ms, " s")),
            Cell::plain(it.reported.to_string()),
        ]);
    }
    table
}

/// What bids take the reliability of skills to be: what it costs, and what failed.
fn by_trust(compared: &Compared, width: usize) -> String {
    let head = ["reliability", "robot time", "more than first", "a task takes", "more", "reported"];
    let mut costs = Table::new(vec![head.iter().map(|it| Cell::new(*it, HEADING)).collect()]);
    let head = ["reliability", "uses", "of these failed", "more than first", "undue awards"];
    let mut uses = Table::new(vec![head.iter().map(|it| Cell::new(*it, HEADING)).collect()]);
    for (number, it) in compared.trusts.iter().enumerate() {
        let more = |it: Interval, decimals, unit| {
            if number == 0 { "–".to_owned() } else { spread(it, decimals, unit) }
        };
        costs.row(vec![
            Cell::plain(it.trust),
            Cell::plain(interval(it.cost_ms, " s")),
            Cell::plain(more(it.more_ms, 1, " s")),
            Cell::plain(spread(it.mean_time_ms, 1, " s")),
            Cell::plain(more(it.more_time_ms, 1, " s")),
            Cell::plain(it.reported.to_string()),
        ]);
        uses.row(vec![
            Cell::plain(it.trust),
            Cell::plain(spread(it.uses_milli, 2, "")),
            Cell::plain(spread(it.failed_milli, 2, "")),
            Cell::plain(more(it.more_failed_milli, 2, "")),
            Cell::plain(spread(it.undue_milli, 2, "")),
        ]);
    }
    let last = compared.trusts.first().map_or(0, |it| it.undue_by_uses.len().saturating_sub(1));
    let group = |at: usize| match at {
        _ if at == last => format!("{} and more", at * 10),
        _ => format!("{} to {}", at * 10, at * 10 + 9),
    };
    let head = ["undue by uses before".to_owned()].into_iter().chain((0..=last).map(group));
    let mut undue = Table::new(vec![head.map(|it| Cell::new(it, HEADING)).collect()]);
    for it in &compared.trusts {
        let counts = it.undue_by_uses.iter().map(u64::to_string);
        undue.row([it.trust.to_owned()].into_iter().chain(counts).map(Cell::plain).collect());
    }
    format!(
        "{}\n{}\n{}  {FAINT}uses and failures a run, of skills that may fail; an award is undue \
         that another robot would have\n  got had all known how often they do; below, all of them \
         over all runs{FAINT:#}\n",
        costs.render(width),
        uses.render(width),
        undue.render(width)
    )
}

/// A mean with the half width of its interval, in thousandths.
fn spread(it: Interval, decimals: u32, unit: &str) -> String {
    let half = milli(i128::from(it.high - it.mean), decimals, "");
    format!("{} ± {half}{unit}", milli(it.mean.into(), decimals, ""))
}

fn interval(it: Interval, unit: &str) -> String {
    let half = milli(i128::from(it.high - it.mean), 0, "");
    format!("{} ± {half}{unit}", milli(it.mean.into(), 0, ""))
}

/// Thousandths as percent.
fn percent(it: Interval) -> String {
    let half = milli(i128::from(it.high - it.mean) * 100, 1, "");
    format!("{} ± {half} %", milli(i128::from(it.mean) * 100, 1, ""))
}
