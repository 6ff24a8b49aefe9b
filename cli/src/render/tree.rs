//! The screens about behaviour trees.

use super::style::{BAD, FAINT, GOOD, HEADING, NAME, NOTICE};
use super::{visible, wrapped};
use crate::answers::check::tree::{
    TreeAnswer, TreeConformAnswer, TreeRow, TreeSpaceAnswer, TreeTickRow,
};
use std::collections::BTreeMap;
use std::fmt::Write;

/// Most ticks of a run on the screen.
const TICKS: usize = 40;

/// Most marked places of a supervisor on the screen.
const MARKED: usize = 6;

/// What was found, the worst first; then what was asked and is so.
pub(crate) fn check(answer: &TreeAnswer, notes: bool, width: usize) -> String {
    let states = answer.results.first().map_or(0, |it| it.states);
    let whole = if answer.complete { "all" } else { "not all" };
    let mut text = format!(
        "{HEADING}{}{HEADING:#}{FAINT}  {}, {} nodes, {states} states, {whole} explored{FAINT:#}\n",
        visible(&answer.model),
        visible(&answer.tree),
        answer.nodes
    );
    for it in &answer.notes {
        text += &wrapped(it, width, "  ");
    }
    for it in &answer.warnings {
        let _ = writeln!(
            text,
            "\n{NOTICE}warning{NOTICE:#}: {}\n  {NAME}{}:{}:{}{NAME:#}",
            visible(&it.message),
            visible(&it.file),
            it.line,
            it.column
        );
        if let Some(help) = &it.help {
            text += &wrapped(&format!("help: {}", visible(help)), width, "  ");
        }
    }
    for it in &answer.unused_assumptions {
        let _ = writeln!(text, "\n{NOTICE}unused{NOTICE:#}: the assumption `{}`", visible(it));
    }
    let mut quiet: BTreeMap<&str, usize> = BTreeMap::new();
    for row in answer.results.iter().filter(|it| it.verdict == "false") {
        if row.level == Some("note") && !notes {
            *quiet.entry(&row.name).or_default() += 1;
        } else {
            finding(row, width, &mut text);
        }
    }
    text.push('\n');
    for row in answer.results.iter().filter(|it| it.verdict != "false") {
        let style = if row.verdict == "true" { GOOD } else { NOTICE };
        let _ = writeln!(text, "{style}{:7}{style:#} {}", row.verdict, visible(&row.property));
    }
    if !quiet.is_empty() {
        let all: Vec<_> = quiet.iter().map(|it| format!("{} {}", it.1, it.0)).collect();
        let said = format!("notes, shown with --notes: {}", all.join(", "));
        text += &wrapped(&said, width, "");
    }
    text
}

fn finding(row: &TreeRow, width: usize, text: &mut String) {
    let level = row.level.unwrap_or("note");
    let style = match level {
        "error" => BAD,
        "warning" => NOTICE,
        _ => FAINT,
    };
    let message = visible(row.message.as_deref().unwrap_or(&row.property));
    let _ = writeln!(text, "\n{style}{level}{style:#}: {message}");
    if let (Some(file), Some(line)) = (&row.file, row.line) {
        let column = row.column.unwrap_or(1);
        let _ = writeln!(text, "  {NAME}{}:{line}:{column}{NAME:#}", visible(file));
    }
    let trace = row.trace.as_deref().unwrap_or_default();
    for it in trace.iter().take(TICKS) {
        if row.repeats_from == Some(it.tick) {
            text.push_str("  again and again:\n");
        }
        *text += &wrapped(tick(it).trim_end(), width, "  ");
    }
    if trace.len() > TICKS {
        let _ = writeln!(text, "  .. {} more ticks, in --json and --html", trace.len() - TICKS);
    }
    if let Some(help) = &row.help {
        *text += &wrapped(&format!("help: {help}"), width, "  ");
    }
}

/// One tick in a line.
pub(crate) fn tick(row: &TreeTickRow) -> String {
    let events = if row.events.is_empty() { "-".to_owned() } else { row.events.join(" ") };
    let marked = match row.marked.len() {
        1..=MARKED => format!("  at {}", visible(&row.marked.join(", "))),
        _ => String::new(),
    };
    format!("{:>4}  {} -> {}{marked}\n", row.tick, visible(&events), visible(&row.status))
}

/// Whether recorded runs are those of a tree.
pub(crate) fn conform(answer: &TreeConformAnswer) -> String {
    let name = visible(&answer.model);
    let Some(departs) = &answer.departs else {
        return format!(
            "{HEADING}{name}{HEADING:#}: {GOOD}conforms{GOOD:#}\n  {} runs, {} rows\n",
            answer.runs, answer.rows
        );
    };
    let mut text = format!(
        "{HEADING}{name}{HEADING:#}: {BAD}departs{BAD:#} at {NAME}{}:{}{NAME:#}, in its {}\n",
        visible(&answer.trace),
        departs.line,
        departs.column
    );
    let _ = writeln!(text, "  found    {}", visible(&departs.found));
    let _ = writeln!(text, "  allowed  {}", visible(&departs.allowed));
    if let Some(asked) = &departs.asked {
        let _ = writeln!(text, "  then     {}", visible(asked));
    }
    text
}

/// How large a tree's behaviour is.
pub(crate) fn statespace(answer: &TreeSpaceAnswer) -> String {
    let ends: Vec<_> = answer.ends.iter().map(|it| format!("{} after {}", it.0, it.1)).collect();
    let minimal = answer.minimal.map_or("not known".to_owned(), |it| it.to_string());
    let complete = if answer.complete { "" } else { "  not complete: a limit was met" };
    format!(
        "{HEADING}{}{HEADING:#}{FAINT}  {}{complete}{FAINT:#}\n  states     {}\n  minimal    {}\n  \
         questions  {}\n  edges      {}\n  ends       {} ticks\n  stuck      {}\n",
        visible(&answer.model),
        visible(&answer.tree),
        answer.states,
        minimal,
        answer.questions,
        answer.edges,
        if ends.is_empty() { "none".to_owned() } else { ends.join(", ") },
        answer.stuck
    )
}
