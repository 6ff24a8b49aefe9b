//! The screens of `cotama fmeca`.

use super::style::{BAD, FAINT, GOOD, HEADING, NAME, NOTICE, PLAIN, Style};
use super::table::{Cell, Table};
use super::{described, wrapped};
use crate::answers::fmeca::{CriticalityRow, Diagnosability, FmecaAnswer, FmecaRow, StatusRow};
use std::fmt::Write;

/// Narrower screens show the rows one below the other, as cells would be too narrow to read.
const LEAST: usize = 90;

/// The columns with words: their titles, the least width of each, and its part of what is left, in
/// hundredths.
const WORDS: [(&str, usize, usize); 4] =
    [("component", 9, 15), ("failure", 12, 27), ("seen by", 12, 18), ("reaction", 12, 40)];

/// The width of everything beside the columns with words and the ids: severities, numbers, spaces.
const FIXED: usize = 2 + 2 + 6 + 2 + 8 + 2 + 4 + 2 + 2 + 4 * 2;
/// The width of what runs have shown, behind an arrow in two columns.
const BY_RUNS: usize = 4;
/// Longer ids leave no place for words beside them.
const LONGEST_ID: usize = 12;

/// Returns the heading of the analysis.
pub(crate) fn heading(answer: &FmecaAnswer<'_>) -> String {
    format!("FMECA: {}", answer.title)
}

/// How many rows are detected and answered.
pub(crate) fn summary(answer: &FmecaAnswer<'_>) -> String {
    let counts = answer.counts;
    let modes = |number: usize| if number == 1 { "mode" } else { "modes" };
    let functions = if counts.functions == 1 { "function" } else { "functions" };
    let total = format!(
        "{} failure {} of {} {functions}",
        counts.rows,
        modes(counts.rows),
        counts.functions
    );
    let unexplained = match counts.unexplained {
        0 => String::new(),
        number => format!(", {number} not detected and without a reason"),
    };
    format!(
        "{total}: {} detected, {} declared undetectable with a reason{unexplained}",
        counts.detected, counts.undetectable
    )
}

/// How many rows are in each class of criticality, and the highest numbers.
pub(crate) fn worst(rows: &[FmecaRow<'_>]) -> String {
    let count = |class| rows.iter().filter(|it| it.criticality.class == class).count();
    let classes = ["intolerable", "undesirable", "tolerable", "negligible"]
        .map(|class| (count(class), class))
        .into_iter()
        .filter(|it| it.0 > 0)
        .map(|(count, class)| format!("{count} {class}"));
    let mut highest: Vec<_> = rows.iter().map(|it| (it.criticality.rpn, it.id)).collect();
    highest.sort_by_key(|it| std::cmp::Reverse(it.0));
    let highest = highest.iter().take(3).map(|(rpn, id)| format!("{id} {rpn}"));
    let assumed = priorities(rows, |it| Some(it.action_priority));
    let measured = rows.iter().filter(|it| it.criticality.measured.is_some()).count();
    let measured = if measured == 0 {
        String::new()
    } else {
        let by = |it: CriticalityRow| it.measured.map(|it| it.action_priority);
        format!("; of the {measured} rows with runs, behind the arrow, {}", priorities(rows, by))
    };
    format!(
        "Criticality: {}; highest risk priority numbers (RPN): {}. Action Priority (AP): \
         {assumed}{measured}.",
        classes.collect::<Vec<_>>().join(", "),
        highest.collect::<Vec<_>>().join(", ")
    )
}

/// How many rows have each Action Priority.
fn priorities(
    rows: &[FmecaRow<'_>],
    of: impl Fn(CriticalityRow) -> Option<&'static str>,
) -> String {
    let count = |name| rows.iter().filter(|it| of(it.criticality) == Some(name)).count();
    let all = [("H", "high"), ("M", "medium"), ("L", "low")].map(|it| (count(it.0), it.1));
    let said = all.iter().filter(|it| it.0 > 0).map(|it| format!("{} {}", it.0, it.1));
    said.collect::<Vec<_>>().join(", ")
}

/// A time in seconds.
pub(crate) fn seconds(ms: u32) -> String {
    thousandths(ms.into(), "s")
}

/// A time in hours.
pub(crate) fn hours(mh: u64) -> String {
    thousandths(mh, "h")
}

fn thousandths(number: u64, unit: &str) -> String {
    let text = format!("{}.{:03}", number / 1000, number % 1000);
    format!("{}\u{a0}{unit}", text.trim_end_matches('0').trim_end_matches('.'))
}

fn severity(name: &str) -> Style {
    match name {
        "fatal" => BAD,
        "hard" => NOTICE,
        "weak" => GOOD,
        _ => PLAIN,
    }
}

fn class(name: &str) -> Style {
    match name {
        "intolerable" => BAD,
        "undesirable" => NOTICE,
        "negligible" => GOOD,
        _ => PLAIN,
    }
}

/// The risk priority number; behind an arrow the one that runs have shown.
pub(crate) fn rpn(it: CriticalityRow) -> String {
    let measured = it.measured.map_or_else(String::new, |it| format!("→{}", it.rpn));
    format!("{}{measured}", it.rpn)
}

/// The Action Priority; behind an arrow the one that runs have shown.
pub(crate) fn priority(it: CriticalityRow) -> String {
    let measured = it.measured.map_or_else(String::new, |it| format!("→{}", it.action_priority));
    format!("{}{measured}", it.action_priority)
}

/// The style of the Action Priority that holds: that of runs, where they were made.
fn urgent(it: CriticalityRow) -> Style {
    match it.measured.map_or(it.action_priority, |it| it.action_priority) {
        "H" => BAD,
        "M" => NOTICE,
        _ => PLAIN,
    }
}

/// The table, and the counts.
pub(crate) fn screen(answer: &FmecaAnswer<'_>, file: Option<&str>, width: usize) -> String {
    let longest = answer.rows.iter().map(|it| it.id.len()).max().unwrap_or(0);
    let mut text = if width < LEAST || longest > LONGEST_ID {
        list(&answer.rows, longest.min(LONGEST_ID), width)
    } else {
        table(&answer.rows, longest, width)
    };
    text.push('\n');
    text += &wrapped(&summary(answer), width, "");
    text += &wrapped(&worst(&answer.rows), width, "");
    let file = file.map_or_else(String::new, |it| format!(" {it}"));
    let _ = writeln!(
        text,
        "\nnext: {NAME}cotama fmeca{file} --diagnosability{NAME:#}, {NAME}cotama fmeca{file} \
         --output fmeca.html{NAME:#}"
    );
    text
}

fn seen(row: &FmecaRow<'_>) -> String {
    let by = |words: String| if row.observer.is_empty() { words } else { row.observer.to_owned() };
    match row.undetectable_reason {
        Some(_) if row.observer.is_empty() => "undetectable".to_owned(),
        Some(_) => format!("undetectable; {}", row.observer),
        None if row.flags_always.is_empty() => "not detected".to_owned(),
        None => {
            let flags = row.flags_always.join(", ");
            format!("{}, {}", by(flags), seconds(row.detection_latency_ms))
        }
    }
}

fn table(rows: &[FmecaRow<'_>], longest: usize, width: usize) -> String {
    let least: usize = WORDS.iter().map(|(_, least, _)| least).sum();
    let by_runs = rows.iter().any(|it| it.criticality.measured.is_some());
    let fixed = FIXED + if by_runs { BY_RUNS } else { 0 };
    let spare = width.saturating_sub(fixed + longest + least);
    let widths = WORDS.map(|(_, least, part)| least + spare * part / 100);
    let [component, failure, seen_by, reaction] = WORDS.map(|(title, ..)| title);
    let head = |cells: [&str; 9]| cells.map(Cell::faint).to_vec();
    let both = rows.iter().any(|it| it.severity_operator.is_some());
    let heads = if both {
        vec![
            head(["", "", "", "robot", "operator", "", "", "", ""]),
            head(["id", component, failure, "drives", "drives", "RPN", "AP", seen_by, reaction]),
        ]
    } else {
        vec![head(["id", component, failure, "severity", "", "RPN", "AP", seen_by, reaction])]
    };
    let mut table = Table::new(heads.into_iter().map(|it| without(it, both)).collect());
    for column in if both { [1, 2, 3, 4, 6, 7, 8] } else { [1, 2, 3, 5, 6, 7, 7] } {
        table = table.left(column);
    }
    for row in rows {
        let words =
            [row.component.to_owned(), row.failure.to_owned(), seen(row), row.reaction.to_owned()];
        let columns: Vec<Vec<String>> =
            words.iter().zip(widths).map(|(text, width)| lines(text, width)).collect();
        let most = columns.iter().map(Vec::len).max().unwrap_or(1);
        let (rpn, priority) = (rpn(row.criticality), priority(row.criticality));
        let operator = row.severity_operator.unwrap_or_default();
        for at in 0..most {
            let word = |column: usize, style| {
                Cell::new(columns[column].get(at).cloned().unwrap_or_default(), style)
            };
            let first = |text: &str, style| Cell::new(if at == 0 { text } else { "" }, style);
            let cells = vec![
                first(row.id, HEADING),
                word(0, PLAIN),
                word(1, PLAIN),
                first(row.severity_autonomous, severity(row.severity_autonomous)),
                first(operator, severity(operator)),
                first(&rpn, class(row.criticality.class)),
                first(&priority, urgent(row.criticality)),
                word(2, FAINT),
                word(3, PLAIN),
            ];
            table.row(without(cells, both));
        }
    }
    table.render(width)
}

/// The cells of a row, without the second severity where no row has one.
fn without(mut cells: Vec<Cell>, both: bool) -> Vec<Cell> {
    if !both {
        cells.remove(4);
    }
    cells
}

/// A text in lines of at most `width`; a longer word is cut.
fn lines(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let mut word: Vec<char> = word.chars().collect();
        loop {
            let line = lines.last_mut().map_or(0, |it| it.chars().count());
            let space = usize::from(line > 0);
            if line + space + word.len() <= width {
                break;
            }
            if line > 0 {
                lines.push(String::new());
            } else {
                let rest = word.split_off(width);
                lines.push(word.iter().collect());
                lines.swap_remove(lines.len() - 2);
                lines.push(String::new());
                word = rest;
            }
        }
        if let Some(line) = lines.last_mut() {
            if !line.is_empty() {
                line.push(' ');
            }
            line.extend(word);
        }
    }
    lines
}

fn list(rows: &[FmecaRow<'_>], longest: usize, width: usize) -> String {
    let mut text = String::new();
    let indent = " ".repeat(longest + 4);
    for row in rows {
        let one = severity(row.severity_autonomous);
        let head = format!("{}: {}", row.component, row.failure);
        text += &described(row.id, longest, HEADING, &head, width);
        let _ = write!(text, "{indent}{one}{}{one:#}", row.severity_autonomous);
        if let Some(operator) = row.severity_operator {
            let other = severity(operator);
            let _ = write!(text, ", operator drives: {other}{operator}{other:#}");
        }
        let (it, style) = (row.criticality, class(row.criticality.class));
        let (rpn, priority, urgent) = (rpn(it), priority(it), urgent(it));
        let _ = writeln!(text, "; RPN {style}{rpn}{style:#}, AP {urgent}{priority}{urgent:#}");
        let by = if row.flags_always.is_empty() { "" } else { "seen by " };
        text += &wrapped(&format!("{by}{}", seen(row)), width, &indent);
        if !row.reaction.is_empty() {
            text += &wrapped(row.reaction, width, &indent);
        }
    }
    text
}

/// Returns the failure modes that cannot be told apart, status by status, and the probes that would
/// help.
pub(crate) fn diagnosability(it: &Diagnosability<'_>, width: usize) -> String {
    let mut text = String::new();
    for row in &it.statuses {
        text += &status(row, it.probes.is_empty(), width);
        text.push('\n');
    }
    if !it.probes.is_empty() {
        let _ = writeln!(text, "{HEADING}probes{HEADING:#}: observations that could be added");
    }
    let longest = it.probes.iter().map(|it| it.name.chars().count()).max().unwrap_or(0).min(24);
    for probe in &it.probes {
        let shows = format!("Shows {}.", probe.shows.join(" "));
        let what =
            if probe.doc.is_empty() { shows } else { format!("{} {shows}", sentence(probe.doc)) };
        text += &described(probe.name, longest, NAME, &what, width);
    }
    text
}

/// Words with a full stop behind them.
pub(crate) fn sentence(words: &str) -> String {
    format!("{}.", words.trim_end_matches('.'))
}

/// Flags that leave something open, in words.
pub(crate) fn shared(flags: &[&str], optional: &[&str]) -> String {
    let more = if optional.is_empty() {
        String::new()
    } else {
        format!(" (or with {})", optional.join(", "))
    };
    format!("{}{more}", flags.join(" + "))
}

/// Returns the probes against all pairs that look alike, in words.
pub(crate) fn against(row: &StatusRow<'_>) -> String {
    let open: Vec<_> = row
        .pairs
        .iter()
        .filter(|it| it.probes.is_empty())
        .map(|it| it.shared.modes.join(" and "))
        .collect();
    let probes = row.least_probes.join(", ");
    match (row.least_probes.len(), open.as_slice()) {
        (0, []) => "nothing is alike".to_owned(),
        (1, []) => format!("one probe tells all apart: {probes}"),
        (number, []) => format!("{number} probes tell all apart, and no fewer: {probes}"),
        (0, [open]) => format!("no probe separates {open}"),
        (0, open) => format!("no probe separates any of the {} pairs", open.len()),
        (_, open) => format!("no probe separates {}; the rest needs: {probes}", open.join(", ")),
    }
}

/// How many failure modes are detected, and how many not.
pub(crate) fn detected(row: &StatusRow<'_>) -> String {
    let seen = if row.detectable == 1 { "failure mode is" } else { "failure modes are" };
    let not = if row.undetectable.len() == 1 { "is" } else { "are" };
    format!("{} {seen} detected, {} {not} not", row.detectable, row.undetectable.len())
}

/// Returns the parts that a limit keeps back, in words.
pub(crate) fn left_out(row: &StatusRow<'_>) -> Option<String> {
    let pairs = match row.pairs_left_out {
        0 => None,
        number => Some(format!("{number} further pairs are alike and not listed")),
    };
    let groups = (!row.groups_complete).then(|| {
        format!("more groups are alike than the {} that are told: a limit", row.groups.len())
    });
    let said: Vec<_> = pairs.into_iter().chain(groups).collect();
    (!said.is_empty()).then(|| said.join("; "))
}

/// One status; without any probe nothing is said of them.
fn status(row: &StatusRow<'_>, no_probes: bool, width: usize) -> String {
    let mut text = format!("{HEADING}{}{HEADING:#}\n", row.status);
    if !row.modules_unavailable.is_empty() {
        text += &wrapped(&format!("without {}", row.modules_unavailable.join(" ")), width, "  ");
    }
    let impossible = match row.impossible.as_slice() {
        [] => String::new(),
        modes => format!("; {} cannot happen then: {}", modes.len(), modes.join(" ")),
    };
    text += &wrapped(&format!("{}{impossible}", detected(row)), width, "  ");
    for pair in &row.pairs {
        let shared = shared(&pair.shared.flags, &pair.shared.flags_optional);
        let probes = match pair.probes.as_slice() {
            [] if no_probes => String::new(),
            [] => ": no probe separates them".to_owned(),
            probes => format!(": separated by {}", probes.join(", or ")),
        };
        let both = pair.shared.modes.join(" ");
        text +=
            &described(&format!("alike {both}"), 15, NOTICE, &format!("{shared}{probes}"), width);
    }
    if let Some(more) = left_out(row) {
        text += &described("", 15, NOTICE, &more, width);
    }
    if !no_probes {
        text += &described("probes", 15, GOOD, &against(row), width);
    }
    for unseen in &row.undetectable {
        text += &described(&format!("unseen {}", unseen.id), 15, BAD, &unseen.reason, width);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::{hours, lines, seconds};

    #[test]
    fn cells_are_wrapped_and_long_words_cut() {
        assert_eq!(lines("one two three", 7), ["one two", "three"]);
        assert_eq!(lines("a incomprehensibly b", 8), ["a", "incompre", "hensibly", "b"]);
        assert_eq!(lines("", 4), [""]);
    }

    #[test]
    fn thousandths_are_written_without_needless_zeros() {
        assert_eq!(
            [seconds(1_500), seconds(100), seconds(120_000)],
            ["1.5\u{a0}s", "0.1\u{a0}s", "120\u{a0}s"]
        );
        assert_eq!(hours(8_000), "8\u{a0}h");
    }
}
