//! Errors of Tina files: cause, position and remedy.

use cotama_property::source::{Location, said};
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
    /// The cause of the error.
    pub message: String,
    /// The remedy, in words.
    pub help: Option<String>,
}

impl fmt::Display for TinaError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { source_name, line, column, message, help } = self;
        said(f, source_name, (*line, *column), message, help.as_deref())
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
        let Location { line, column, .. } = Location::of(&before, before.len()..before.len());
        TinaError {
            source_name: source_name.to_owned(),
            line,
            column,
            message: self.message,
            help: self.help,
        }
    }
}
