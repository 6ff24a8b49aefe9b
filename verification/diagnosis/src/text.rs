//! A diagnosis as text for a terminal or a log.

use super::words::{counted, printable};
use super::{Change, Diagnosis, Step, Tokens};
use std::fmt::{self, Display, Formatter, Write as _};

/// The longest line, where no precision says another: `{:.58}` asks for lines of 58 characters.
const WIDTH: usize = 100;
const LEAST_WIDTH: usize = 30;

/// Longer names are cut in the middle where they stand in columns.
const NAME: usize = 28;

/// Firings that are shown at the beginning and at the end of a stem, and of a cycle.
const HEAD: usize = 8;
const TAIL: usize = 12;

/// The most marked places that are listed.
const MARKED: usize = 40;

impl Display for Diagnosis {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        paragraph(f, "", &self.summary)?;
        if !self.cause.is_empty() {
            paragraph(f, "cause: ", &self.cause)?;
        }
        for note in &self.notes {
            paragraph(f, "       ", note)?;
        }
        let space = if self.doc.is_empty() { "" } else { ": " };
        paragraph(f, "net:   ", &format!("{}{space}{}", plain(&self.net), printable(&self.doc)))?;
        f.write_char('\n')?;
        self.table(f)?;
        if !self.legend.is_empty() {
            f.write_str("\nwhere\n")?;
            let legend = || self.legend.iter().filter(|it| self.shows(&it.name));
            let names: Vec<String> = legend().map(|it| cut(&it.name)).collect();
            let width = names.iter().map(|it| it.chars().count()).max().unwrap_or(0);
            for (name, meaning) in names.iter().zip(legend()) {
                paragraph(f, &format!("  {name:width$}  "), &meaning.doc)?;
            }
        }
        Ok(())
    }
}

/// The firings of a diagnosis, line by line.
struct Steps<'d>(&'d Diagnosis);

impl Display for Steps<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.0.table(f)
    }
}

/// A table with columns that are left out when they are empty.
struct Table {
    widths: Vec<usize>,
}

impl Table {
    /// Columns side by side, the last one broken into lines.
    fn row(&self, f: &mut Formatter<'_>, cells: &[String], last: &str) -> fmt::Result {
        let mut line = String::from(" ");
        for (at, (cell, &width)) in cells.iter().zip(&self.widths).enumerate() {
            if width == 0 {
                continue;
            }
            let space = width.saturating_sub(cell.chars().count());
            // The number and the date to the right.
            let (left, right) = if at < 2 { (space, 0) } else { (0, space) };
            let _ = write!(line, " {:left$}{cell}{:right$} ", "", "");
        }
        line.push(' ');
        paragraph(f, &line, last)
    }
}

impl Diagnosis {
    /// The firings as lines, with the middle of a long run left out.
    pub(super) fn steps_as_text(&self) -> String {
        Steps(self).to_string()
    }

    fn table(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let shown = shown(self.trace.len(), self.cycle_starts_at);
        let mut table = Table { widths: vec![0; 5] };
        let heads = ["step", "ms", "fires", "on", "emits"].map(str::to_owned);
        let rows: Vec<[String; 5]> =
            shown.iter().map(|&at| cells(at + 1, &self.trace[at])).collect();
        for row in &rows {
            for (width, cell) in table.widths.iter_mut().zip(row) {
                *width = (*width).max(cell.chars().count());
            }
        }
        table.widths[0] = table.widths[0].max("start".len());
        table.widths[2] = table.widths[2].max("fires".len());
        for (width, head) in table.widths.iter_mut().zip(&heads) {
            *width = if *width == 0 { 0 } else { (*width).max(head.len()) };
        }
        let edge = |name: &str| {
            [name.to_owned(), String::new(), String::new(), String::new(), String::new()]
        };
        table.row(f, &heads, "changes")?;
        table.row(f, &edge("start"), &self.marking(&self.initial))?;
        let mut next = 0;
        for (cells, at) in rows.iter().zip(shown) {
            if at > next {
                writeln!(f, "  ... {} left out ...", counted(at - next, "step"))?;
            }
            next = at + 1;
            if self.cycle_starts_at == Some(at) {
                let count = self.trace.len();
                let steps = match count - at {
                    1 => format!("step {count} repeats"),
                    2 => format!("steps {next} and {count} repeat"),
                    _ => format!("steps {next} to {count} repeat"),
                };
                writeln!(f, "  from here on {steps} for ever")?;
            }
            table.row(f, cells, &self.changes(&self.trace[at]))?;
        }
        let end = match self.cycle_starts_at {
            Some(0) => "as at the start".to_owned(),
            Some(start) => format!("as after step {start}"),
            None if self.trace.is_empty() => return Ok(()),
            None => self.marking(&self.last),
        };
        table.row(f, &edge("end"), &end)
    }

    /// Returns the changes of a step, and the atoms that it turns beyond those of marked places.
    fn changes(&self, step: &Step) -> String {
        let shown = step.changes.iter().filter(|it| self.shows(&it.place));
        let mut text: Vec<String> = shown.map(change).collect();
        if text.is_empty() {
            text.push("no change".to_owned());
        }
        for turn in self.turns(step) {
            let verb = if turn.holds { "now" } else { "no more" };
            text.push(format!("({verb} {})", printable(&turn.atom)));
        }
        text.join(" ")
    }
}

/// The positions of the firings that are shown, in their order.
fn shown(count: usize, cycle: Option<usize>) -> Vec<usize> {
    let part = |from: usize, to: usize| {
        let long = to - from > HEAD + TAIL + 1;
        (from..to).filter(move |at| !long || *at < from + HEAD || *at >= to - TAIL)
    };
    let start = cycle.unwrap_or(count);
    part(0, start).chain(part(start, count)).collect()
}

fn cells(number: usize, step: &Step) -> [String; 5] {
    [
        number.to_string(),
        step.at.map_or_else(String::new, |it| it.to_string()),
        cut(&step.transition),
        step.event.as_deref().map_or_else(String::new, cut),
        cut(&step.outputs.join(", ")),
    ]
}

/// `+p`, `-p` for a single token, else the numbers.
pub(super) fn change(it: &Change) -> String {
    match (it.before, it.after) {
        (0, 1) => format!("+{}", plain(&it.place)),
        (1, 0) => format!("-{}", plain(&it.place)),
        (before, after) => format!("{} {before}->{after}", plain(&it.place)),
    }
}

impl Diagnosis {
    fn marking(&self, tokens: &[Tokens]) -> String {
        let one = |it: &Tokens| match it.tokens {
            1 => plain(&it.place),
            more => format!("{} {more}", plain(&it.place)),
        };
        let mut all: Vec<String> =
            tokens.iter().filter(|it| self.shows(&it.place)).map(one).collect();
        let more = all.len().saturating_sub(MARKED);
        all.truncate(MARKED);
        if more > 0 {
            all.push(format!("and {more} more places"));
        }
        if all.is_empty() { "nothing is marked".to_owned() } else { all.join(", ") }
    }
}

/// A name outside of sentences: in quotes if it would not be told from what stands beside it.
pub(super) fn plain(name: &str) -> String {
    let text = printable(name);
    if text.is_empty() || text.contains([' ', ',']) { format!("\"{text}\"") } else { text }
}

/// A name for a column: in one line, cut in the middle when it is long.
fn cut(name: &str) -> String {
    let text: Vec<char> = printable(name).chars().collect();
    if text.len() <= NAME {
        return text.into_iter().collect();
    }
    let half = (NAME - 2) / 2;
    text[..half].iter().chain(&['.', '.']).chain(&text[text.len() - half..]).collect()
}

/// Text in lines that begin below each other.
fn paragraph(f: &mut Formatter<'_>, first: &str, text: &str) -> fmt::Result {
    let width = f.precision().unwrap_or(WIDTH).max(LEAST_WIDTH);
    let indent = match first.chars().count() {
        0 => 2,
        more => more.min(width / 2),
    };
    let mut line = first.to_owned();
    let mut used = first.chars().count();
    let mut is_new = true;
    for word in text.split_whitespace() {
        let mut word: Vec<char> = word.chars().collect();
        loop {
            let space = usize::from(!is_new);
            // A prefix can be wider than a line; then the text is, too.
            if used + space + word.len() <= width || used >= width && is_new {
                line.extend(std::iter::repeat_n(' ', space).chain(word.iter().copied()));
                used += space + word.len();
                is_new = false;
                break;
            }
            if is_new {
                // Longer than a line.
                let rest = word.split_off(width - used);
                line.extend(word);
                word = rest;
            }
            writeln!(f, "{}", line.trim_end())?;
            line = " ".repeat(indent);
            (used, is_new) = (indent, true);
        }
    }
    writeln!(f, "{}", line.trim_end())
}
