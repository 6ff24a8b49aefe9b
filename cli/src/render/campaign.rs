//! The screen of a campaign.
#![allow(clippy::cast_precision_loss)] // shares of runs need no more than 52 bits

use super::calibrate::held;
use super::numbers::{count, grouped};
use super::style::{BAD, FAINT, GOOD, NAME, PLAIN};
use super::table::{Cell, Table};
use super::visible;
use crate::answers::campaign::{CampaignAnswer, DecisionRow, Mean, PolicyRow};
use crate::answers::estimate::Measured;
use crate::names::quoted;
use std::fmt::Write;

/// The screen of a campaign, for a window of this width.
pub(crate) fn screen(answer: &CampaignAnswer, width: usize) -> String {
    if !answer.policies.is_empty() {
        return policies(answer, width);
    }
    let mut text = head(answer);
    let _ = writeln!(text, "  {FAINT}planner: {}{FAINT:#}\n", visible(&answer.planner));
    let outcomes = answer.outcomes;
    let mut table = Table::new(Vec::new());
    for (name, count) in
        [("completed", outcomes.completed), ("safe", outcomes.safe), ("failed", outcomes.failed)]
    {
        let share = count as f64 / answer.runs.max(1) as f64;
        table.row(vec![Cell::plain(name), Cell::plain(number(count)), Cell::faint(percent(share))]);
    }
    text += &table.render(usize::MAX);
    text.push('\n');
    let mut table = Table::new(Vec::new()).left(2);
    for row in &answer.requirements {
        let style = if row.violated == 0 { GOOD } else { BAD };
        let words = if row.violated == 0 {
            "holds in all".to_owned()
        } else {
            format!("broken in {}", number(row.violated))
        };
        let interval = row.probability.map_or_else(String::new, interval);
        table.row(vec![
            Cell::plain(visible(&row.requirement)),
            Cell::new(words, style),
            Cell::faint(interval),
        ]);
    }
    text += &table.render(usize::MAX);
    text += &answer.held.as_ref().map_or_else(String::new, |it| held(it, width));
    causes(&mut text, answer);
    if let Some(it) = answer.decision {
        text.push_str(&decided(it, answer.failing));
    } else if answer.failure_probability.is_none() && answer.shard.is_none() {
        text += "\nPlans were chosen, not drawn independently: shares are no probabilities.\n";
    }
    let _ = writeln!(text, "\n{FAINT}digest {}{FAINT:#}", answer.digest);
    if let Some(report) = &answer.report {
        let _ = writeln!(text, "report: {NAME}{}{NAME:#}", visible(report));
    }
    let named = |it: &crate::answers::campaign::FailureRow| {
        let file = it.fault_file.as_deref().filter(|_| it.scenario.contains("\nmission = "))?;
        Some(format!("cotama replay {}", quoted(file)))
    };
    if let Some(next) = answer.failures.first().and_then(named) {
        let _ = writeln!(text, "next: {NAME}{}{NAME:#}", visible(&next));
    }
    text
}

fn decided(it: DecisionRow, failing: u64) -> String {
    let what = if it.exact { "share of failing plans" } else { "probability of failure" };
    let verdict = match it.verdict {
        "at_most" => format!("the {what} is at most {}", it.at_most),
        "more" => format!("the {what} is more than {}", it.at_most),
        _ => format!("it is not decided whether the {what} is at most {}", it.at_most),
    };
    if it.exact {
        let (runs, failing) = (number(it.runs), number(failing));
        return format!("\n{verdict}\n  exactly: {failing} of the {runs} plans that there are\n");
    }
    format!(
        "\n{verdict}\n  after {} runs; wrong at most once in {:.0}, where it is not between {} and \
         {}\n",
        number(it.runs),
        1.0 / (1.0 - it.confidence),
        it.at_most,
        it.more_from
    )
}

fn head(answer: &CampaignAnswer) -> String {
    let part = answer.shard.as_ref().map_or_else(String::new, |it| format!(", part {it}"));
    let verdict = match answer.failing {
        0 => format!("{GOOD}no run breaks a requirement{GOOD:#}"),
        1 => format!("{BAD}1 run breaks a requirement{BAD:#}"),
        it => format!("{BAD}{} runs break a requirement{BAD:#}", number(it)),
    };
    format!(
        "{}, {}, {}, seed {}{part}: {verdict}\n\n",
        visible(&answer.mission),
        count(answer.runs, "run"),
        answer.strategy,
        answer.seed
    )
}

fn causes(text: &mut String, answer: &CampaignAnswer) {
    if answer.failures.is_empty() {
        return;
    }
    let _ = writeln!(
        text,
        "\ncauses, of {} made small in {}",
        count(answer.shrunk, "failing run"),
        count(answer.shrinking_runs, "run")
    );
    let mut table = Table::new(Vec::new()).left(1).left(2).left(3);
    for row in &answer.failures {
        let file = row.fault_file.as_deref().map_or_else(String::new, visible);
        table.row(vec![
            Cell::plain(number(row.count)),
            Cell::plain(visible(&row.requirement)),
            Cell::new(visible(&row.signature), NAME),
            Cell::faint(file),
        ]);
    }
    *text += &table.render(usize::MAX);
    if let Some(first) = answer.failures.first().filter(|it| it.fault_file.is_none()) {
        text.push('\n');
        for line in first.scenario.lines() {
            let _ = writeln!(text, "  {}", visible(line));
        }
    }
}

fn policies(answer: &CampaignAnswer, width: usize) -> String {
    let mut text = format!(
        "{}, {} of faults, {}, seed {}\n\n",
        visible(&answer.mission),
        count(answer.runs, "plan"),
        answer.strategy,
        answer.seed
    );
    let words = ["", "completed", "safe", "failed", "against the first", "time", "energy", "asked"];
    let mut table = Table::new(vec![words.map(Cell::faint).to_vec()]);
    let row = |it: &PolicyRow| {
        let plus = |it: Mean| {
            let half = it.low.zip(it.high).map(|(low, high)| (high - low) / 2.0);
            (it.estimate, half)
        };
        let (time, energy, asked) =
            (plus(it.duration_ms), plus(it.energy_mj), plus(it.operator_requests));
        let thousand = |(value, half): (f64, Option<f64>), unit: &str| {
            let half = half.map_or_else(String::new, |it| format!(" ± {:.1}", it / 1_000.0));
            format!("{:.1}{half} {unit}", value / 1_000.0)
        };
        let against = it.success_difference.map_or("·".to_owned(), |it| {
            format!("{:+.1} to {:+.1} %", 100.0 * it.low, 100.0 * it.high).replace('-', "−")
        });
        let cells = [
            it.policy.to_owned(),
            it.success.map_or_else(
                || number(it.outcomes.completed),
                |success| format!("{} {}", number(it.outcomes.completed), interval(success)),
            ),
            number(it.outcomes.safe),
            number(it.outcomes.failed),
            against,
            thousand(time, "s"),
            thousand(energy, "J"),
            format!(
                "{:.2}{}",
                asked.0,
                asked.1.map_or_else(String::new, |it| format!(" ± {it:.2}"))
            ),
        ];
        cells.map(|it| Cell::new(it, PLAIN)).to_vec()
    };
    answer.policies.iter().for_each(|it| table.row(row(it)));
    text += &table.render(width);
    if answer.policies.iter().any(|it| it.success.is_none()) {
        text += "\nPlans were chosen, not drawn independently: numbers are of these plans alone.\n";
    }
    text
}

pub(crate) fn number(it: u64) -> String {
    grouped(&it.to_string())
}

/// A share in percent, with as many digits as a small one needs.
pub(crate) fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    if percent == 0.0 || percent >= 1.0 {
        format!("{percent:.1} %")
    } else {
        let digits = usize::try_from(-libm::log10(percent).floor() as i64).unwrap_or(1).min(12) + 1;
        format!("{percent:.digits$} %")
    }
}

pub(crate) fn interval(it: Measured) -> String {
    format!("({} to {})", percent(it.low), percent(it.high))
}

#[cfg(test)]
mod tests {
    use super::percent;

    #[test]
    fn small_shares_keep_two_digits() {
        let said = [0.0, 0.5, 0.0123, 0.001_234, 0.000_012_3].map(percent);
        assert_eq!(said, ["0.0 %", "50.0 %", "1.2 %", "0.12 %", "0.0012 %"]);
    }
}
