//! Comma-separated values with the place of each cell.
//!
//! Well-kept libraries for this format tell the line of an error but not its column, and read an
//! open quote to the end of the file; so this reads the few rules of RFC 4180 itself.

use super::row::Row;
use crate::fmeca::analysis::MAX_MODES;
use crate::fmeca::csv::{is_between, is_formula};
use crate::missions::reader::fields::{Reported, Sink};
use crate::missions::{Diagnostic, Spanned};
use crate::names::{MAX_ID, nearest, quoted};
use std::ops::Range;

/// The keys with the other names that their columns may have.
const KEYS: [(&str, &[&str]); 27] = [
    ("id", &[]),
    ("function", &[]),
    ("component", &[]),
    ("failure", &["failure_mode"]),
    ("cause", &[]),
    ("effect", &[]),
    ("severity", &["severity_auto"]),
    ("severity_operator", &["severity_teleop"]),
    ("lost", &["modules_lost"]),
    ("observer", &[]),
    ("detection", &["detection_rule"]),
    ("latency_ms", &["detection_latency_ms"]),
    ("latency_s", &["detection_latency_s"]),
    ("event", &["cs_event_auto"]),
    ("reaction", &[]),
    ("persistence", &[]),
    ("mtbf_h", &[]),
    ("failures_per_million_h", &[]),
    ("rate_label", &[]),
    ("rate_source", &[]),
    ("injection", &[]),
    ("flags", &[]),
    ("sometimes", &[]),
    ("silent", &[]),
    ("alpha_permille", &[]),
    ("beta_permille", &[]),
    ("detection_rank", &[]),
];
/// Columns that are computed anew.
const COMPUTED: [&str; 9] = [
    "s",
    "o",
    "d",
    "rpn",
    "criticality",
    "action_priority",
    "d_measured",
    "rpn_measured",
    "action_priority_measured",
];
/// Columns without which there is no row.
const NEEDED: [&str; 7] = ["id", "function", "component", "failure", "cause", "effect", "severity"];

type Cell = Spanned<String>;

/// A table whose columns are known and whose rows have a cell for each.
pub(super) struct Table {
    columns: Vec<Option<&'static str>>,
    rows: Vec<Vec<Cell>>,
}

impl Table {
    /// Reads a text; reports why it is no such table.
    pub(super) fn read(text: &str, sink: &Sink) -> Option<Self> {
        let mut lines = split(text, sink)?.into_iter();
        let refuse = |span: Range<usize>, message: String, help: &str| {
            sink.report(Diagnostic::new(span, message, "").help(help));
        };
        let Some(heading) = lines.next() else {
            refuse(0..0, "the file is empty".to_owned(), "begin with the names of columns");
            return None;
        };
        if let [only] = heading.as_slice()
            && only.value.contains([';', '\t'])
        {
            let message = "the columns are not separated by commas".to_owned();
            refuse(only.span.clone(), message, "save it as comma-separated values");
            return None;
        }
        let mut rows: Vec<_> = lines.collect();
        if let Some((row, number)) = heading_below(&heading, &rows) {
            let message = "the first row holds the names of the columns, and this one does not";
            let help = format!("{number} of them stand in the row {row}: remove what is above it");
            refuse(place(&heading), message.to_owned(), &help);
            return None;
        }
        let heading = without_nameless(heading, &mut rows);
        let columns = columns(&heading, sink)?;
        let end = text.len()..text.len();
        if rows.is_empty() {
            refuse(end, "there is no row".to_owned(), "write one line a failure mode");
            return None;
        }
        if rows.len() > MAX_MODES {
            let message = format!("there are {} rows; at most {MAX_MODES} are read", rows.len());
            refuse(end, message, "split the file");
            return None;
        }
        for row in rows.iter().filter(|it| it.len() != columns.len()) {
            let (cells, names) = (row.len(), columns.len());
            let found = if cells == 1 { "1 cell".to_owned() } else { format!("{cells} cells") };
            let message = format!("this row has {found}, but there are {names} columns");
            let help = if cells > names {
                "write a text with a comma in it between double quotes"
            } else {
                "an empty cell has its comma, too"
            };
            refuse(place(row), message, help);
        }
        sink.is_empty().then_some(Self { columns, rows })
    }

    /// The rows, to be read key by key.
    pub(super) fn rows<'t>(&'t self, sink: &'t Sink) -> impl Iterator<Item = Line<'t>> {
        self.rows.iter().map(move |cells| Line { columns: &self.columns, cells, sink })
    }
}

fn is_blank(cell: &Cell) -> bool {
    cell.value.trim().is_empty()
}

/// A heading and its rows without the columns in which nothing stands, as spreadsheets write them
/// behind and between those of a table.
fn without_nameless(heading: Vec<Cell>, rows: &mut [Vec<Cell>]) -> Vec<Cell> {
    for row in rows.iter_mut() {
        while row.len() > heading.len() && row.last().is_some_and(is_blank) {
            row.pop();
        }
    }
    let is_kept = |at: usize, name: &Cell, rows: &[Vec<Cell>]| {
        !is_blank(name) || rows.iter().any(|row| row.get(at).is_some_and(|it| !is_blank(it)))
    };
    let kept: Vec<bool> =
        heading.iter().enumerate().map(|(at, name)| is_kept(at, name, rows)).collect();
    if kept.iter().all(|it| *it) {
        return heading;
    }
    let all = kept.len();
    let pruned = |cells: Vec<Cell>| -> Vec<Cell> {
        // A row of another length is refused as it stands.
        let cells = cells.into_iter().zip(kept.iter().chain(std::iter::repeat(&true)));
        cells.filter(|it| *it.1).map(|it| it.0).collect()
    };
    for row in rows.iter_mut().filter(|it| it.len() >= all) {
        *row = pruned(std::mem::take(row));
    }
    // Spreadsheets leave out commas behind the last cell of a row, too.
    for row in rows.iter_mut().filter(|it| it.len() < all) {
        let short = kept.iter().skip(row.len()).all(|it| !it);
        if short {
            *row = pruned(std::mem::take(row));
        }
    }
    pruned(heading)
}

/// The key that a cell of a heading names.
fn key_of(cell: &Cell) -> Option<&'static str> {
    let name = normal(&cell.value);
    KEYS.iter().find(|(key, others)| *key == name || others.contains(&&*name)).map(|it| it.0)
}

/// The name of a column as it is compared.
fn normal(name: &str) -> String {
    name.trim().to_lowercase().replace([' ', '-'], "_")
}

/// Finds the names of columns below the first row: the line, and how many
/// there are.
fn heading_below(heading: &[Cell], rows: &[Vec<Cell>]) -> Option<(String, usize)> {
    const LOOKED_AT: usize = 20;
    let named = |row: &[Cell]| row.iter().filter(|it| key_of(it).is_some()).count();
    if named(heading) > 1 {
        return None;
    }
    let below = rows.iter().take(LOOKED_AT).find(|row| named(row) >= 3)?;
    let first = below.iter().find(|it| !is_blank(it)).map(|it| quoted(it.value.trim()))?;
    Some((format!("that begins with {first}"), named(below)))
}

fn place(cells: &[Cell]) -> Range<usize> {
    let first = cells.first().map_or(0, |it| it.span.start);
    first..cells.last().map_or(first, |it| it.span.end)
}

/// The keys of a heading.
fn columns(heading: &[Cell], sink: &Sink) -> Option<Vec<Option<&'static str>>> {
    let mut columns: Vec<Option<&'static str>> = Vec::new();
    let refuse = |span: &Range<usize>, message: String, help: String| {
        sink.report(Diagnostic::new(span.clone(), message, "this column").help(help));
    };
    for cell in heading {
        let name = normal(&cell.value);
        let key = key_of(cell);
        if name.is_empty() {
            refuse(&cell.span, "this column has no name".to_owned(), "name it, or empty it".into());
        } else if key.is_none() && !COMPUTED.contains(&name.as_str()) {
            let known = KEYS.iter().map(|it| it.0);
            let message = format!("unknown column {}", quoted(&cell.value));
            if let Some(near) = nearest(&name, known.clone()) {
                let message = format!("{message}; did you mean `{near}`?");
                refuse(&cell.span, message, format!("write `{near}`"));
            } else {
                let known = known.collect::<Vec<_>>().join(", ");
                refuse(&cell.span, message, format!("known columns: {known}"));
            }
        }
        if let Some(key) = key.filter(|it| columns.contains(&Some(it))) {
            refuse(
                &cell.span,
                format!("the column `{key}` is there twice"),
                "leave one out".into(),
            );
        }
        columns.push(key);
    }
    let missing = NEEDED.iter().filter(|it| !columns.contains(&Some(it)));
    let missing: Vec<_> = missing.map(|it| format!("`{it}`")).collect();
    if sink.is_empty() && !missing.is_empty() {
        let (word, them) = if missing.len() == 1 { ("column", "it") } else { ("columns", "them") };
        let message = format!("missing {word} {}", missing.join(", "));
        refuse(&place(heading), message, format!("add {them} to the heading"));
    }
    sink.is_empty().then_some(columns)
}

/// The cells of each line; lines without any text are left out.
fn split(text: &str, sink: &Sink) -> Option<Vec<Vec<Cell>>> {
    let mut lines = Vec::new();
    let mut line: Vec<Cell> = Vec::new();
    let mut at = if text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
    while at < text.len() || !line.is_empty() {
        let (cell, end) = cell(text, at, sink)?;
        line.push(cell);
        at = end;
        if text[at..].starts_with(',') {
            at += 1;
            continue;
        }
        // A line ends with \n, \r\n or the file.
        at += text[at..].find('\n').map_or(text.len() - at, |it| it + 1);
        let cells = std::mem::take(&mut line);
        if cells.iter().any(|it| !it.value.trim().is_empty()) {
            lines.push(cells);
        }
    }
    Some(lines)
}

/// The cell that begins at a byte, and the byte of the comma or line end behind it.
fn cell(text: &str, start: usize, sink: &Sink) -> Option<(Cell, usize)> {
    let rest = &text[start..];
    if !rest.starts_with('"') {
        let length = rest.find([',', '\n']).unwrap_or(rest.len());
        let raw = &rest[..length];
        let raw = if rest[length..].starts_with(',') { raw } else { raw.trim_end_matches('\r') };
        let end = start + raw.len();
        return Some((Spanned { value: raw.to_owned(), span: start..end }, start + length));
    }
    let mut value = String::new();
    let mut at = 1;
    loop {
        let Some(quote) = rest[at..].find('"') else {
            let message = "this quote is never closed";
            let open = Diagnostic::new(start..start + 1, message, "opened here");
            sink.report(open.help("close it, and write a quote inside of a text twice"));
            return None;
        };
        value += &rest[at..at + quote];
        at += quote + 1;
        if !rest[at..].starts_with('"') {
            break;
        }
        value.push('"');
        at += 1;
    }
    let end = start + at;
    if !(rest[at..].is_empty() || rest[at..].starts_with([',', '\r', '\n'])) {
        let message = "a comma or the end of the line must follow the closing quote";
        let more = Diagnostic::new(end - 1..end, message, "closed here");
        sink.report(more.help("write a quote inside of a text twice"));
        return None;
    }
    Some((Spanned { value, span: start..end }, end))
}

/// A line of a table, read key by key.
pub(super) struct Line<'t> {
    columns: &'t [Option<&'static str>],
    cells: &'t [Cell],
    sink: &'t Sink,
}

impl Line<'_> {
    /// The cell under a key, unless it is empty.
    fn cell(&self, key: &str) -> Option<Cell> {
        let column = self.columns.iter().position(|it| *it == Some(key))?;
        let mut cell = self.cells.get(column).filter(|it| !it.value.trim().is_empty()).cloned()?;
        // The apostrophe is that of spreadsheets, which makes a text of a formula.
        if let Some(text) = cell.value.strip_prefix('\'')
            && is_formula(text.trim_start_matches('\''))
        {
            cell.value = text.to_owned();
        }
        Some(cell)
    }
}

impl Row for Line<'_> {
    fn needed(&mut self, key: &'static str) -> Option<Cell> {
        let cell = self.cell(key);
        if cell.is_none() {
            let message = format!("`{key}` is empty in this row");
            let empty = Diagnostic::new(self.place(), message, "this row");
            self.report(empty.help("fill the cell"));
        }
        cell
    }

    fn id(&mut self) -> Option<Cell> {
        let mut cell = self.needed("id")?;
        cell.value = cell.value.trim().to_owned();
        let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
        if cell.value.len() <= MAX_ID && cell.value.chars().all(plain) {
            return Some(cell);
        }
        let message = format!("{} is not an id", quoted(&cell.value));
        let help = format!("use 1 to {MAX_ID} ASCII letters, digits, `-`, `_` and `.`");
        self.report(Diagnostic::new(cell.span, message, "not an id").help(help));
        None
    }

    fn text(&mut self, key: &'static str) -> Result<Option<Cell>, Reported> {
        Ok(self.cell(key))
    }

    fn number(&mut self, key: &'static str) -> Result<Option<Cell>, Reported> {
        Ok(self.cell(key))
    }

    fn list(&mut self, key: &'static str) -> Result<Vec<Cell>, Reported> {
        let Some(cell) = self.cell(key) else { return Ok(Vec::new()) };
        let name = |it: &str| Spanned { value: super::words(it), span: cell.span.clone() };
        let between = if cell.value.contains(';') { ';' } else { '\n' };
        let names = cell.value.split(between).filter(|it| !it.trim().is_empty()).map(name);
        let names: Vec<_> = names.collect();
        if let ([one], false) = (names.as_slice(), cell.value.contains(';'))
            && one.value.contains(is_between)
        {
            // Names in lists have been written with these between them, and names have them.
            let apart = one.value.split(is_between).filter(|it| !it.is_empty());
            let apart = apart.collect::<Vec<_>>().join("; ");
            let message = format!("{} is one name, or several", quoted(&one.value));
            let help = format!("write `{};` for one name, `{apart}` for several", one.value);
            let unclear = Diagnostic::new(cell.span.clone(), message, "one or several");
            self.report(unclear.help(help));
            return Err(Reported);
        }
        Ok(names)
    }

    fn latency(&mut self) -> Result<Option<(Cell, bool)>, Reported> {
        let seconds = self.cell("latency_s");
        Ok(self.cell("latency_ms").map(|it| (it, false)).or(seconds.map(|it| (it, true))))
    }

    fn report(&self, diagnostic: Diagnostic) {
        self.sink.report(diagnostic);
    }

    fn place(&self) -> Range<usize> {
        place(self.cells)
    }
}
