//! What a campaign comes to.
#![allow(clippy::cast_precision_loss)] // shares of runs need no more than 52 bits

use super::numbers::grouped;
use super::style::{BAD, FAINT, GOOD, NAME, PLAIN};
use super::table::{Cell, Table};
use super::visible;
use crate::answers::campaign::{CampaignAnswer, Measured, PolicyRow};
use std::fmt::Write;

/// The screen of a campaign.
pub(crate) fn screen(answer: &CampaignAnswer) -> String {
    if !answer.policies.is_empty() {
        return policies(answer);
    }
    let mut text = head(answer);
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
    causes(&mut text, answer);
    if let Some(it) = answer.decision {
        let verdict = match it.verdict {
            "at_most" => format!("the probability of failure is at most {}", it.at_most),
            "more" => format!("the probability of failure is more than {}", it.at_most),
            _ => format!("it is not decided whether the probability is at most {}", it.at_most),
        };
        let _ = writeln!(
            text,
            "\n{verdict}\n  after {} runs; wrong at most once in {:.0}, where it is not between {} \
             and {}",
            number(it.runs),
            1.0 / (1.0 - it.confidence),
            it.at_most,
            it.more_from
        );
    }
    if answer.failure_probability.is_none() && answer.decision.is_none() && answer.shard.is_none() {
        text += "\nPlans were not drawn independently: shares are no probabilities.\n";
    }
    let _ = writeln!(text, "\n{FAINT}digest {}{FAINT:#}", answer.digest);
    if let Some(report) = &answer.report {
        let _ = writeln!(text, "report: {NAME}{}{NAME:#}", visible(report));
    }
    text
}

fn head(answer: &CampaignAnswer) -> String {
    let part = answer.shard.as_ref().map_or_else(String::new, |it| format!(", part {it}"));
    let verdict = match answer.failing {
        0 => format!("{GOOD}no run breaks a requirement{GOOD:#}"),
        1 => format!("{BAD}1 run breaks a requirement{BAD:#}"),
        it => format!("{BAD}{} runs break a requirement{BAD:#}", number(it)),
    };
    format!(
        "{}, {} runs, {}, seed {}{part}: {verdict}\n\n",
        visible(&answer.mission),
        number(answer.runs),
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
        "\ncauses, of {} failing runs made small in {} runs",
        number(answer.shrunk),
        number(answer.shrinking_runs)
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

fn policies(answer: &CampaignAnswer) -> String {
    let mut text = format!(
        "{}, {} plans of faults, {}, seed {}\n\n",
        visible(&answer.mission),
        number(answer.runs),
        answer.strategy,
        answer.seed
    );
    let words = ["", "completed", "safe", "failed", "against the first", "time", "energy", "asked"];
    let mut table = Table::new(vec![words.map(Cell::faint).to_vec()]);
    let row = |it: &PolicyRow| {
        let plus = |it: Measured| {
            let half = (it.high - it.low) / 2.0;
            (it.estimate, half)
        };
        let (time, energy, asked) =
            (plus(it.duration_ms), plus(it.energy_mj), plus(it.operator_requests));
        let thousand = |(value, half): (f64, f64), unit: &str| {
            format!("{:.1} ± {:.1} {unit}", value / 1_000.0, half / 1_000.0)
        };
        let against = it.success_difference.map_or("·".to_owned(), |it| {
            format!("{:+.1} to {:+.1} %", 100.0 * it.low, 100.0 * it.high)
        });
        let cells = [
            it.policy.to_owned(),
            format!("{} {}", number(it.outcomes.completed), interval(it.success)),
            number(it.outcomes.safe),
            number(it.outcomes.failed),
            against,
            thousand(time, "s"),
            thousand(energy, "J"),
            format!("{:.2} ± {:.2}", asked.0, asked.1),
        ];
        cells.map(|it| Cell::new(it, PLAIN)).to_vec()
    };
    answer.policies.iter().for_each(|it| table.row(row(it)));
    text += &table.render(usize::MAX);
    text
}

pub(super) fn number(it: u64) -> String {
    grouped(&it.to_string())
}

/// A share in percent, with as many digits as a small one needs.
pub(crate) fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    if percent == 0.0 || percent >= 1.0 {
        format!("{percent:.1} %")
    } else {
        let digits = usize::try_from(-percent.log10().floor() as i64).unwrap_or(1).min(12) + 1;
        format!("{percent:.digits$} %")
    }
}

pub(super) fn interval(it: Measured) -> String {
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
