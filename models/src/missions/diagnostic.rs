//! Errors of mission files: cause, position and remedy.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::ops::Range;

/// A value and where in the file it stands, in bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Spanned<T> {
    /// The value.
    pub value: T,
    /// Position in the file, in bytes.
    pub span: Range<usize>,
}

/// One error of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// The cause of the error.
    pub message: String,
    /// Position of the error, in bytes; both ends are between characters of the text.
    pub span: Range<usize>,
    /// A few words to write under the place.
    pub label: String,
    /// The remedy, in words.
    pub help: Option<String>,
    /// How often the file has an error of this cause; the place is that of the first.
    pub times: usize,
    /// The places of the next few of them.
    pub also: Vec<Range<usize>>,
}

/// So many further places of a cause are told.
const ALSO: usize = 4;

/// So many errors that differ in nothing but numbers are one.
const MANY: usize = 3;

/// Errors of so many names that differ in nothing else are one.
const SIMILAR: usize = 8;

/// Which errors of a file, each a message and a help, have one cause: of each the position of the
/// error that it is told with, which is its own for the first and for those that stand alone.
///
/// A message without the numbers in it is a cause, from three of them on; one without the names in
/// it, from eight names on. Helps may differ in numbers alone.
///
/// ```
/// use cotama_models::missions::told_with;
/// let cost = |at: usize| format!("tasks[{at}].cost[7]: `0.{at}` is not whole");
/// let said = [cost(0), "`name` is missing".to_owned(), cost(1), cost(25)];
/// let errors: Vec<_> = said.iter().map(|it| (it.as_str(), None)).collect();
/// assert_eq!(told_with(&errors), [0, 1, 0, 0]);
/// // Each help says what to write there.
/// let helps = ["write `x_mm = 0`", "write `x_mm = 1000`", "write `y_mm = 9`", "write `x_mm = 7`"];
/// assert_eq!(told_with(&helps.map(|it| ("unknown key", Some(it)))), [0, 0, 2, 0]);
/// ```
pub fn told_with(errors: &[(&str, Option<&str>)]) -> Vec<usize> {
    let helps: Vec<_> = errors.iter().map(|it| it.1.map(without_numbers)).collect();
    let keys: Vec<_> = errors.iter().map(|it| [cause(it.0, false), cause(it.0, true)]).collect();
    let (mut counts, mut names) = (BTreeMap::new(), BTreeMap::new());
    for ([one, similar], help) in keys.iter().zip(&helps) {
        *counts.entry((one, help)).or_insert(0_usize) += 1;
        names.entry((similar, help)).or_insert_with(BTreeSet::new).insert(one);
    }
    let mut first = BTreeMap::new();
    let mut all = Vec::with_capacity(errors.len());
    for (at, ([one, similar], help)) in keys.iter().zip(&helps).enumerate() {
        let is_similar = names.get(&(similar, help)).is_some_and(|it| it.len() >= SIMILAR);
        let is_many = counts.get(&(one, help)).is_some_and(|it| *it >= MANY);
        let key = if is_similar { similar } else { one };
        let with = first.entry((key, is_similar, help)).or_insert(at);
        all.push(if is_similar || is_many { *with } else { at });
    }
    all
}

/// Returns a message without the numbers in it, and without the names if that is wanted.
fn cause(message: &str, without_names: bool) -> String {
    let mut cause = String::with_capacity(message.len());
    for (at, part) in message.split('`').enumerate() {
        let is_name = at % 2 == 1;
        let is_number = part.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c));
        if is_name {
            cause.push('`');
            cause += if is_number || without_names { "" } else { part };
            cause.push('`');
            continue;
        }
        push_without_numbers(&mut cause, part);
    }
    cause
}

fn without_numbers(text: &str) -> String {
    let mut without = String::with_capacity(text.len());
    push_without_numbers(&mut without, text);
    without
}

/// Adds a text in which each number is `0`.
fn push_without_numbers(to: &mut String, text: &str) {
    for c in text.chars() {
        match c {
            '0'..='9' if to.ends_with('0') => {}
            '0'..='9' => to.push('0'),
            c => to.push(c),
        }
    }
}

impl Diagnostic {
    /// An error without a remedy yet.
    pub fn new(span: Range<usize>, message: impl Into<String>, label: impl Into<String>) -> Self {
        let (message, label) = (message.into(), label.into());
        Self { message, span, label, help: None, times: 1, also: Vec::new() }
    }

    /// The same error with a remedy.
    #[must_use]
    pub fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }
}

/// The errors with those of one cause, if they are many, as one.
fn folded(diagnostics: Vec<Diagnostic>) -> Vec<Diagnostic> {
    let said: Vec<_> =
        diagnostics.iter().map(|it| (it.message.as_str(), it.help.as_deref())).collect();
    let told = told_with(&said);
    let mut places: BTreeMap<usize, usize> = BTreeMap::new();
    let mut kept: Vec<Diagnostic> = Vec::new();
    for (at, (it, with)) in diagnostics.into_iter().zip(told).enumerate() {
        let Some(one) = places.get(&with).and_then(|place| kept.get_mut(*place)) else {
            places.insert(at, kept.len());
            kept.push(it);
            continue;
        };
        one.times += 1;
        if one.also.len() < ALSO {
            one.also.push(it.span);
        }
    }
    kept
}

/// A place in a text, as people count: both from one, the column in characters.
///
/// ```
/// use cotama_models::missions::Position;
/// let text = "ä = 1\nb = 2";
/// assert_eq!(Position::of(text, 3), Position { line: 1, column: 3 }); // characters, not bytes
/// assert_eq!(Position::of(text, 7), Position { line: 2, column: 1 });
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    /// The line, from 1.
    pub line: usize,
    /// The column in characters, from 1.
    pub column: usize,
}

impl Position {
    /// The position of a byte offset; offsets inside a character or behind the end are moved back.
    pub fn of(text: &str, offset: usize) -> Self {
        let before = &text[..boundary(text, offset)];
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        Self {
            line: before.bytes().filter(|&byte| byte == b'\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
        }
    }
}

/// The last character boundary at or before `offset`.
fn boundary(text: &str, offset: usize) -> usize {
    let mut offset = offset.min(text.len());
    while !text.is_char_boundary(offset) {
        offset -= 1;
    }
    offset
}

/// How many errors of one file are kept, each of another cause; the rest are counted.
pub const MAX_DIAGNOSTICS: usize = 100;

/// All errors of one file: at least one, sorted by place; many of one cause are one.
///
/// Its `Display` is plain text, one line `file:line:column: message` for each error and a line of
/// help where there is some.
///
/// ```
/// use cotama_models::missions::{Mission, MissionErrors};
/// let errors: MissionErrors = Mission::parse("mine.toml", "format = 'x'").unwrap_err();
/// let first = &errors.diagnostics()[0];
/// assert_eq!((errors.position(first).line, errors.position(first).column), (1, 10));
/// assert!(errors.to_string().starts_with("mine.toml:1:10: "));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MissionErrors {
    source_name: String,
    text: String,
    diagnostics: Vec<Diagnostic>,
    omitted: usize,
}

impl MissionErrors {
    pub(crate) fn new(source_name: &str, text: &str, mut diagnostics: Vec<Diagnostic>) -> Self {
        for diagnostic in &mut diagnostics {
            let start = boundary(text, diagnostic.span.start);
            diagnostic.span = start..boundary(text, diagnostic.span.end).max(start);
        }
        diagnostics.sort_by_key(|diagnostic| (diagnostic.span.start, diagnostic.span.end));
        diagnostics.dedup();
        let mut diagnostics = folded(diagnostics);
        let omitted = diagnostics.len().saturating_sub(MAX_DIAGNOSTICS);
        diagnostics.truncate(MAX_DIAGNOSTICS);
        if diagnostics.is_empty() {
            diagnostics.push(Diagnostic::new(0..0, "the file cannot be read", ""));
        }
        Self { source_name: source_name.into(), text: text.into(), diagnostics, omitted }
    }

    /// The name of the file, as the caller gave it.
    pub fn source_name(&self) -> &str {
        &self.source_name
    }

    /// The text of the file.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The errors, sorted by place; at least one, at most [`MAX_DIAGNOSTICS`].
    pub fn diagnostics(&self) -> &[Diagnostic] {
        &self.diagnostics
    }

    /// How many further errors were left out.
    pub fn omitted(&self) -> usize {
        self.omitted
    }

    /// Returns the line and column where an error starts.
    pub fn position(&self, diagnostic: &Diagnostic) -> Position {
        Position::of(&self.text, diagnostic.span.start)
    }
}

impl fmt::Display for MissionErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, diagnostic) in self.diagnostics.iter().enumerate() {
            let Position { line, column } = self.position(diagnostic);
            let separator = if index == 0 { "" } else { "\n" };
            write!(f, "{separator}{}:{line}:{column}: {}", self.source_name, diagnostic.message)?;
            if diagnostic.times > 1 {
                write!(f, " (so at {} places)", diagnostic.times)?;
            }
            if let Some(help) = &diagnostic.help {
                write!(f, "\n  help: {help}")?;
            }
        }
        if self.omitted > 0 {
            write!(f, "\n{}: {} further errors", self.source_name, self.omitted)?;
        }
        Ok(())
    }
}

impl std::error::Error for MissionErrors {}
