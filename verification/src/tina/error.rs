//! What is wrong with a file, where, and what to do about it.

use std::fmt;

/// The first error of a file. Its `Display` is `file:line:column: message`, and a line of help
/// where there is some.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TinaError {
    /// The name of the file, as the caller gave it.
    pub source_name: String,
    /// The line, from 1.
    pub line: usize,
    /// The column in characters, from 1.
    pub column: usize,
    /// What is wrong.
    pub message: String,
    /// What to do about it.
    pub help: Option<String>,
}

impl fmt::Display for TinaError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { source_name, line, column, message, help } = self;
        write!(f, "{source_name}:{line}:{column}: {message}")?;
        help.iter().try_for_each(|help| write!(f, "\n  help: {help}"))
    }
}

impl std::error::Error for TinaError {}

/// An error before lines are counted.
#[derive(Debug)]
pub(super) struct Finding {
    /// The byte where it is.
    at: usize,
    message: String,
    help: Option<String>,
}

impl Finding {
    pub(super) fn new(at: usize, message: impl Into<String>) -> Self {
        Self { at, message: message.into(), help: None }
    }

    pub(super) fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }

    /// The error in a text, whose part before it is UTF-8.
    pub(super) fn locate(self, source_name: &str, text: &[u8]) -> TinaError {
        let before = String::from_utf8_lossy(&text[..self.at.min(text.len())]);
        TinaError {
            source_name: source_name.to_owned(),
            line: 1 + before.matches('\n').count(),
            column: 1 + before.rsplit('\n').next().unwrap_or_default().chars().count(),
            message: self.message,
            help: self.help,
        }
    }
}

/// A text of the file as a message shows it: in backticks, cut, and without characters that a
/// terminal obeys.
pub(super) fn quoted(text: &str) -> String {
    const SHOWN: usize = 40;
    let obeyed = |c: char| {
        c.is_control()
            || matches!(c, '\u{200e}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    let shown = text
        .chars()
        .take(SHOWN)
        .map(|c| if obeyed(c) { c.escape_default().to_string() } else { c.to_string() });
    let more = if text.chars().nth(SHOWN).is_some() { "…" } else { "" };
    format!("`{}{more}`", shown.collect::<String>())
}
