//! The screens of `cotama fmeca`.

use super::style::{BAD, FAINT, GOOD, HEADING, NAME, NOTICE, PLAIN};
use super::table::{Cell, Table};
use super::{described, wrapped};
use crate::answers::fmeca::{CountsRow, Diagnosability, FmecaAnswer, FmecaRow, StatusRow};
use anstyle::Style;
use std::fmt::Write;

/// Narrower screens show the rows one below the other, as cells would be too narrow to read.
const LEAST: usize = 90;

/// The columns with words: their titles, the least width of each, and its part of what is left, in
/// hundredths.
const WORDS: [(&str, usize, usize); 4] =
    [("component", 9, 15), ("failure", 12, 27), ("seen by", 10, 18), ("reaction", 14, 40)];

/// The width of everything beside the columns with words: identifiers, severities, spaces.
const FIXED: usize = 2 + 4 + 2 + 6 + 2 + 8 + 4 * 2;

/// How many rows are detected and answered.
pub(crate) fn summary(counts: &CountsRow) -> String {
    format!(
        "{} failure modes of {} functions: {} are detected ({} reported to the contextual \
         supervisor, {} recorded with a reaction of their own), {} are declared undetectable with \
         a reason; none is left out, which is checked while compiling",
        counts.rows,
        counts.functions,
        counts.detected,
        counts.reported,
        counts.recorded,
        counts.undetectable
    )
}

/// What becomes of a failure mode in the decisional level, while the robot drives itself.
pub(crate) fn event(row: &FmecaRow) -> String {
    match (row.report, row.undetectable_reason) {
        (Some(report), _) => format!("report {report}, {} event", row.class),
        (None, Some(_)) => "no event".to_owned(),
        (None, None) => "recorded".to_owned(),
    }
}

/// A time in seconds.
pub(crate) fn seconds(ms: u32) -> String {
    thousandths(ms, "s")
}

/// A time in hours.
pub(crate) fn hours(mh: u32) -> String {
    thousandths(mh, "h")
}

fn thousandths(number: u32, unit: &str) -> String {
    let text = format!("{}.{:03}", number / 1000, number % 1000);
    format!("{}\u{a0}{unit}", text.trim_end_matches('0').trim_end_matches('.'))
}

fn severity(name: &'static str) -> Style {
    match name {
        "fatal" => BAD,
        "hard" => NOTICE,
        "weak" => GOOD,
        _ => PLAIN,
    }
}

/// The table, and the counts.
pub(crate) fn screen(answer: &FmecaAnswer, width: usize) -> String {
    let mut text =
        if width < LEAST { list(&answer.rows, width) } else { table(&answer.rows, width) };
    text.push('\n');
    text += &wrapped(&summary(&answer.counts), width, "");
    let _ = writeln!(
        text,
        "\nnext: {NAME}cotama fmeca --diagnosability{NAME:#}, {NAME}cotama fmeca --output \
         fmeca.html{NAME:#}"
    );
    text
}

fn seen(row: &FmecaRow) -> String {
    match row.undetectable_reason {
        Some(_) => format!("undetectable; {}", row.observer),
        None => format!("{}, {}", row.observer, seconds(row.detection_latency_ms)),
    }
}

fn table(rows: &[FmecaRow], width: usize) -> String {
    let least: usize = WORDS.iter().map(|(_, least, _)| least).sum();
    let spare = width.saturating_sub(FIXED + least);
    let widths = WORDS.map(|(_, least, part)| least + spare * part / 100);
    let [component, failure, seen_by, reaction] = WORDS.map(|(title, ..)| title);
    let head = |cells: [&str; 7]| cells.map(Cell::faint).to_vec();
    let mut table = Table::new(vec![
        head(["", "", "", "robot", "operator", "", ""]),
        head(["id", component, failure, "drives", "drives", seen_by, reaction]),
    ]);
    for column in 1..7 {
        table = table.left(column);
    }
    for row in rows {
        let words =
            [row.component.to_owned(), row.failure.to_owned(), seen(row), row.reaction.to_owned()];
        let columns: Vec<Vec<String>> =
            words.iter().zip(widths).map(|(text, width)| lines(text, width)).collect();
        let most = columns.iter().map(Vec::len).max().unwrap_or(1);
        for at in 0..most {
            let word = |column: usize, style| {
                Cell::new(columns[column].get(at).cloned().unwrap_or_default(), style)
            };
            let first =
                |text: &'static str, style| Cell::new(if at == 0 { text } else { "" }, style);
            table.row(vec![
                first(row.id, HEADING),
                word(0, PLAIN),
                word(1, PLAIN),
                first(row.severity_autonomous, severity(row.severity_autonomous)),
                first(row.severity_operator, severity(row.severity_operator)),
                word(2, FAINT),
                word(3, PLAIN),
            ]);
        }
    }
    table.render(width)
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

fn list(rows: &[FmecaRow], width: usize) -> String {
    let mut text = String::new();
    for row in rows {
        let (one, other) = (severity(row.severity_autonomous), severity(row.severity_operator));
        let head = format!("{}: {}", row.component, row.failure);
        text += &described(row.id, 4, HEADING, &head, width);
        let _ = writeln!(
            text,
            "        {one}{}{one:#}, operator drives: {other}{}{other:#}",
            row.severity_autonomous, row.severity_operator
        );
        text += &wrapped(&format!("seen by {}", seen(row)), width, "        ");
        text += &wrapped(row.reaction, width, "        ");
    }
    text
}

/// What cannot be told apart, status by status, and what would help.
pub(crate) fn diagnosability(it: &Diagnosability, width: usize) -> String {
    let mut text = String::new();
    for row in &it.statuses {
        text += &status(row, width);
        text.push('\n');
    }
    let _ = writeln!(text, "{HEADING}probes{HEADING:#}: observations that could be added");
    let longest = it.probes.iter().map(|it| it.name.len()).max().unwrap_or(0);
    for probe in &it.probes {
        let what = format!("{} Shows {}.", probe.doc, probe.shows.join(" "));
        text += &described(probe.name, longest, NAME, &what, width);
    }
    let case = &it.ambiguous_case;
    let _ = writeln!(text, "\n{HEADING}the ambiguous case{HEADING:#}");
    let which = format!("Point 3 of the published run: {}.", case.candidates.join(", "));
    text += &wrapped(&which, width, "  ");
    for paragraph in &case.text {
        text += &wrapped(paragraph, width, "  ");
    }
    text
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

/// What probes there are against all that is alike, in words.
pub(crate) fn against(row: &StatusRow) -> String {
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
        (_, open) => format!("no probe separates {}; the rest needs: {probes}", open.join(", ")),
    }
}

fn status(row: &StatusRow, width: usize) -> String {
    let mut text = format!("{HEADING}{}{HEADING:#}\n", row.status);
    if !row.modules_unavailable.is_empty() {
        text += &wrapped(&format!("without {}", row.modules_unavailable.join(" ")), width, "  ");
    }
    let impossible = match row.impossible.as_slice() {
        [] => String::new(),
        modes => format!("; {} cannot happen then: {}", modes.len(), modes.join(" ")),
    };
    text += &wrapped(
        &format!(
            "{} failure modes are detected, {} are not{impossible}",
            row.detectable,
            row.undetectable.len()
        ),
        width,
        "  ",
    );
    for pair in &row.pairs {
        let shared = shared(&pair.shared.flags, &pair.shared.flags_optional);
        let probes = match pair.probes.as_slice() {
            [] => "no probe separates them".to_owned(),
            probes => format!("separated by {}", probes.join(", or ")),
        };
        let both = pair.shared.modes.join(" ");
        text +=
            &described(&format!("alike {both}"), 15, NOTICE, &format!("{shared}: {probes}"), width);
    }
    text += &described("probes", 15, GOOD, &against(row), width);
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
