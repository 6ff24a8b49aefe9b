//! What is wrong with a mission file, where, and what to do about it.

use std::fmt;
use std::ops::Range;

/// A value and where in the file it stands, in bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Spanned<T> {
    /// The value.
    pub value: T,
    /// Its place in the file, in bytes.
    pub span: Range<usize>,
}

/// One error of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// What is wrong.
    pub message: String,
    /// Where, in bytes; it starts and ends between characters of the text.
    pub span: Range<usize>,
    /// A few words to write under the place.
    pub label: String,
    /// What to do about it.
    pub help: Option<String>,
}

impl Diagnostic {
    pub(crate) fn new(
        span: Range<usize>,
        message: impl Into<String>,
        label: impl Into<String>,
    ) -> Self {
        Self { message: message.into(), span, label: label.into(), help: None }
    }

    pub(crate) fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }
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

/// How many errors of one file are kept; the rest are counted.
pub const MAX_DIAGNOSTICS: usize = 100;

/// All errors of one file: at least one, sorted by place.
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

    /// Where an error starts.
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
