//! The screen of `cotama run two-ways`.

use super::numbers::count;
use super::style::{FAINT, HEADING, NAME};
use super::table::{Cell, Table};
use super::wrapped;
use crate::answers::ways::{ConditionRow, MeanRow, ShareRow, WaysAnswer, WaysPolicyRow};
use std::fmt::Write;

/// The training, and what came of each policy.
pub(crate) fn screen(answer: &WaysAnswer, width: usize) -> String {
    let trials = answer.training.iter().map(|it| it.failed.of).sum();
    let head = format!(
        "{HEADING}two ways{HEADING:#}: discs at {} m/s, {} of 40 maps a policy, rule {}, memory \
         {}{}",
        answer.object_speed,
        count(answer.runs, "run"),
        answer.rule,
        answer.memory,
        if answer.online { ", learning on" } else { "" }
    );
    let mut text = wrapped(&head, width, "");
    let _ = writeln!(text, "\nlearned from {}; share that failed", count(trials, "trial"));
    let mut table = Table::new(vec![["discs", "short", "long"].map(Cell::faint).to_vec()]);
    for both in answer.training.chunks(2) {
        let name = both.first().map_or("", |it| it.ratio);
        let cells = both.iter().map(|it| Cell::plain(share(&it.failed)));
        table.row(std::iter::once(Cell::new(ratio(name), NAME)).chain(cells).collect());
    }
    text += &table.render(width);
    text.push_str("\nper map\n");
    let head = ["policy", "reward", "more than the first", "reliability"];
    let mut table = Table::new(vec![head.map(Cell::faint).to_vec()]);
    for it in &answer.policies {
        let some = |it: Option<String>| Cell::plain(it.unwrap_or_default());
        table.row(vec![
            Cell::new(it.policy.clone(), NAME),
            Cell::plain(mean(&it.reward, 1)),
            some(it.gain.map(|it| mean(&it, 1))),
            some(it.reliability.map(|it| share(&it))),
        ]);
    }
    text += &table.render(width);
    for at in 0..2 {
        text.push('\n');
        text += &condition(&answer.policies, at, width);
    }
    text + &format!("{FAINT}in brackets: intervals of 95 %; errors: failed trials{FAINT:#}\n")
}

/// Errors of all policies in a condition, by ratio.
fn condition(policies: &[WaysPolicyRow], at: usize, width: usize) -> String {
    let of = |it: &WaysPolicyRow| -> Option<usize> { it.conditions.get(at).map(|_| at) };
    let name = policies.iter().find_map(|it| it.conditions.get(of(it)?)).map(|it| it.condition);
    let told = if at == 0 { "discs not known" } else { "discs told" };
    let mut text = format!("{}, {told}: errors per map\n", name.unwrap_or_default());
    let mut head = vec![Cell::faint("policy"), Cell::faint("all")];
    let first = policies.first().and_then(|it| it.conditions.get(at));
    let ratios = first.iter().flat_map(|it| &it.ratios);
    head.extend(ratios.map(|it| Cell::faint(ratio(it.ratio))));
    head.extend(["reward", "reliability", "changed way"].map(Cell::faint));
    let mut table = Table::new(vec![head]);
    for (policy, it) in policies.iter().filter_map(|it| Some((&it.policy, it.conditions.get(at)?)))
    {
        table.row(row(policy, it));
    }
    text += &table.render(width);
    text
}

fn row(policy: &str, it: &ConditionRow) -> Vec<Cell> {
    let mut row = vec![Cell::new(policy, NAME), Cell::plain(mean(&it.errors, 2))];
    row.extend(it.ratios.iter().map(|it| Cell::plain(format!("{:.2}", it.errors.mean))));
    let reliability = it.reliability.map_or(String::new(), |it| format!("{:.2}", it.share));
    let switched = match it.switched.of {
        0 => String::new(),
        of => format!("{:.0}% of {of}", 100.0 * it.switched.share),
    };
    row.push(Cell::plain(format!("{:.1}", it.reward.mean)));
    row.extend([reliability, switched].map(Cell::plain));
    row
}

/// The ratio as it is said: 3/1.
fn ratio(name: &str) -> String {
    name.trim_start_matches('r').replace('_', "/")
}

fn share(it: &ShareRow) -> String {
    format!("{:.2} [{:.2}, {:.2}] of {}", it.share, it.low, it.high, it.of)
}

fn mean(it: &MeanRow, decimals: usize) -> String {
    match (it.low, it.high) {
        (Some(low), Some(high)) => {
            format!("{:.decimals$} [{low:.decimals$}, {high:.decimals$}]", it.mean)
        }
        _ => format!("{:.decimals$}", it.mean),
    }
}
