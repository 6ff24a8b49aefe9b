//! The screens of `cotama risk`.

use super::numbers::grouped;
use super::style::{BAD, FAINT, GOOD, HEADING, NAME, NOTICE};
use super::table::{Cell, Table};
use super::{visible, wrapped};
use crate::answers::risk::{
    ArcRow, BootstrapAnswer, ChooseAnswer, CoherenceAnswer, DiscretiseAnswer, InferAnswer,
    LearnAnswer, SeparatedAnswer,
};
use std::fmt::Write;

/// The most pairs that are shown.
const SHOWN: usize = 40;

/// The graph, and what is proven of it.
pub(crate) fn learn(answer: &LearnAnswer, columns: &[&str], width: usize) -> String {
    let proof = match answer.proof {
        "optimal" => format!("{GOOD}optimal{GOOD:#}: no graph scores higher"),
        "local" => format!("{NOTICE}a local optimum{NOTICE:#} of hill climbing"),
        "given order" => {
            format!("{NOTICE}by the given order{NOTICE:#}, one parent after the other")
        }
        _ => format!("{NOTICE}nothing is proven{NOTICE:#}: the best graph of a random walk"),
    };
    let mut text = format!(
        "{HEADING}{} {:.6}{HEADING:#}, {} rows; {proof}\n",
        answer.score,
        answer.value,
        grouped(&answer.rows.to_string()),
    );
    if let Some(bytes) = answer.memory_bytes {
        let mib = bytes.div_ceil(1 << 20);
        let _ = writeln!(text, "  {FAINT}at most {mib} MiB, stated before{FAINT:#}");
    }
    if let Some(limit) = &answer.limit {
        text += &wrapped(&format!("no exact search: {limit}"), width, "  ");
    }
    if let Some(bound) = answer.bound {
        let _ = writeln!(text, "  {FAINT}no graph scores above {bound:.6}{FAINT:#}");
    }
    let mut table = Table::new(vec![["variable", "parents"].map(Cell::faint).to_vec()]).left(1);
    for name in columns {
        let parents = answer.parents.get(*name).map_or(&[][..], Vec::as_slice);
        let shown = |parent: &String| {
            let arc = [parent.as_str(), name];
            let is_compelled = answer.compelled.iter().any(|it| it[0] == arc[0] && it[1] == arc[1]);
            format!("{}{}", visible(parent), if is_compelled { "*" } else { "" })
        };
        let parents: Vec<_> = parents.iter().map(shown).collect();
        let parents =
            if parents.is_empty() { Cell::faint("none") } else { Cell::plain(parents.join(", ")) };
        table.row(vec![Cell::new(visible(name), NAME), parents]);
    }
    text.push('\n');
    text += &table.render(width);
    if let Some(it) = &answer.bootstrap {
        text += &resampled(it, answer, width);
    }
    let about = "* all equally good graphs of this class have this arrow; others could point the \
        other way, and none says what causes what";
    text + "\n" + &wrapped(about, width, "")
}

/// How often arcs came back, those of the graph first.
fn resampled(bootstrap: &BootstrapAnswer, answer: &LearnAnswer, width: usize) -> String {
    let is_learned =
        |it: &&ArcRow| answer.parents.get(&it.to).is_some_and(|parents| parents.contains(&it.from));
    let (mut rows, others): (Vec<_>, Vec<_>) = bootstrap.arcs.iter().partition(is_learned);
    let learned = rows.len();
    let is_other = |it: &&ArcRow| it.joined > 0.5 && it.from < it.to;
    let beside = |it: &&ArcRow| {
        !rows.iter().any(|own| own.from == it.to && own.to == it.from) && is_other(it)
    };
    let more: Vec<_> = others.into_iter().filter(beside).collect();
    rows.extend(more);
    let head = ["arc", "this way", "either way"].map(Cell::faint).to_vec();
    let mut table = Table::new(vec![head]);
    let percent = |share: f64| Cell::plain(format!("{:.1} %", 100.0 * share));
    for (number, it) in rows.iter().enumerate() {
        let arc = format!("{} -> {}", visible(&it.from), visible(&it.to));
        let arc = if number < learned { arc } else { format!("{arc} (not in the graph)") };
        table.row(vec![Cell::plain(arc), percent(it.share), percent(it.joined)]);
    }
    let head = format!("arcs in graphs of {} resamples", bootstrap.resamples);
    format!("\n{HEADING}{head}{HEADING:#}\n{}", table.render(width))
}

/// The posterior, in the order of the states.
pub(crate) fn infer(answer: &InferAnswer, states: &[String], width: usize) -> String {
    let evidence: Vec<_> =
        answer.evidence.iter().map(|it| format!("{}={}", visible(it.0), visible(it.1))).collect();
    let given = if evidence.is_empty() {
        String::new()
    } else {
        let p = answer.probability_of_evidence;
        format!(" given {}, which has probability {p:.6}", evidence.join(", "))
    };
    let head = format!("{HEADING}{}{HEADING:#}{given}", visible(&answer.query));
    let mut text = wrapped(&head, width, "");
    let mut table = Table::new(vec![]);
    for state in states {
        let p = answer.posterior.get(state).copied().unwrap_or(0.0);
        table.row(vec![Cell::new(visible(state), NAME), Cell::plain(format!("{p:.6}"))]);
    }
    text += &table.render(width);
    for name in &answer.without_influence {
        let line = format!("note: {} cannot tell anything of it here", visible(name));
        text += &wrapped(&line, width, "");
    }
    text
}

/// The pairs, the most coherent first.
pub(crate) fn coherence(answer: &CoherenceAnswer, width: usize) -> String {
    let mut text = format!("{HEADING}{}{HEADING:#}\n", visible(&answer.network));
    if let Some(it) = &answer.learned {
        let rows = grouped(&it.rows.to_string());
        let proof = if it.proof == "optimal" { "the best graph" } else { "a good graph" };
        let cut = match it.cut.len() {
            0 => "no column was cut".to_owned(),
            cut => format!("{cut} columns cut into {} steps of equal frequency", it.bins),
        };
        let line = format!("{proof} by BIC of {rows} rows; {cut}");
        text += &wrapped(&line, width, "  ");
    }
    let head = ["", "with", "eta", "information", "joint entropy"].map(Cell::faint).to_vec();
    let mut table = Table::new(vec![head]).left(1);
    for it in answer.pairs.iter().take(SHOWN) {
        table.row(vec![
            Cell::new(visible(&it.x), NAME),
            Cell::new(visible(&it.y), NAME),
            Cell::plain(format!("{:.6}", it.eta)),
            Cell::plain(format!("{:.6}", it.information_nats)),
            Cell::plain(format!("{:.6}", it.entropy_nats)),
        ]);
    }
    text += &table.render(width);
    if answer.pairs.len() > SHOWN {
        let _ = writeln!(text, "  and {} more: see --json", answer.pairs.len() - SHOWN);
    }
    text + &format!("{FAINT}in nats; eta is information over joint entropy{FAINT:#}\n")
}

/// The cuts of each column.
pub(crate) fn discretise(answer: &DiscretiseAnswer, width: usize) -> String {
    let mut text = format!("{} rows\n", grouped(&answer.rows.to_string()));
    let list = |all: Vec<String>| Cell::plain(all.join(" "));
    let head = ["", "cuts", "rows of each step"].map(Cell::faint).to_vec();
    let mut table = Table::new(vec![head]).left(1).left(2);
    for it in &answer.columns {
        table.row(vec![
            Cell::new(visible(&it.name), NAME),
            list(it.cuts.iter().map(ToString::to_string).collect()),
            list(it.counts.iter().map(ToString::to_string).collect()),
        ]);
    }
    text += &table.render(width);
    if !answer.kept.is_empty() {
        let kept: Vec<_> = answer.kept.iter().map(|it| visible(it)).collect();
        text += &wrapped(&format!("as before: {}", kept.join(", ")), width, "");
    }
    text
}

/// Separated, or the open path.
pub(crate) fn separated(answer: &SeparatedAnswer, width: usize) -> String {
    let given: Vec<_> = answer.given.iter().map(|it| visible(it)).collect();
    let given =
        if given.is_empty() { String::new() } else { format!(" given {}", given.join(", ")) };
    let (x, y) = (visible(&answer.x), visible(&answer.y));
    if answer.separated {
        let line = format!("{GOOD}separated{GOOD:#}: {x} tells nothing of {y}{given}");
        return wrapped(&line, width, "");
    }
    let mut path = answer.path.first().map_or_else(String::new, |it| visible(it));
    for (arc, name) in answer.arcs.iter().zip(answer.path.iter().skip(1)) {
        let _ = write!(path, " {arc} {}", visible(name));
    }
    let line = format!("{BAD}open{BAD:#}: {x} can tell of {y}{given}");
    wrapped(&line, width, "") + &wrapped(&path, width, "  ")
}

/// The belief, the costs and the choice.
pub(crate) fn choose(
    answer: &ChooseAnswer,
    hidden: &str,
    states: &[String],
    width: usize,
) -> String {
    let measure = match answer.measure.as_str() {
        "mean" => "mean cost".to_owned(),
        level => format!("{level}-quantile of the cost"),
    };
    let mut text = format!(
        "{HEADING}{}{HEADING:#}, reward {:.6}: {measure}, rule {}, {} left\n",
        visible(&answer.choice),
        answer.reward,
        answer.rule,
        super::numbers::count(answer.trials, "trial"),
    );
    let mut table = Table::new(vec![["way", "cost"].map(Cell::faint).to_vec()]);
    for (way, cost) in &answer.costs {
        table.row(vec![Cell::new(visible(way), NAME), Cell::plain(format!("{cost:.6}"))]);
    }
    text += &table.render(width);
    if !answer.sequence.is_empty() {
        let all: Vec<_> = answer.sequence.iter().map(|it| visible(it)).collect();
        text += &wrapped(&format!("after each failure: {}", all.join(", ")), width, "  ");
    }
    let head = vec![Cell::faint(visible(hidden)), Cell::faint("believed")];
    let mut table = Table::new(vec![head]);
    for state in states {
        let p = answer.belief.get(state).copied().unwrap_or(0.0);
        table.row(vec![Cell::new(visible(state), NAME), Cell::plain(format!("{p:.6}"))]);
    }
    text.push('\n');
    text + &table.render(width)
}
