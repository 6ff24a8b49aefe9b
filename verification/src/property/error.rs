//! What is wrong with a property, where, and what to do about it.

use crate::pnml::Location;
use std::fmt::{self, Write as _};
use std::ops::Range;

/// A property that cannot be read.
///
/// Its `Display` is plain text: `source:line:column: message`, and a line of help where there is
/// some.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PropertyError {
    /// The name of the file; `property` for a text.
    pub source_name: String,
    /// Where; the span is that of the text or the file, without its byte order mark.
    pub at: Location,
    /// What is wrong.
    pub message: String,
    /// What to do about it.
    pub help: Option<String>,
}

impl fmt::Display for PropertyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}: {}", self.source_name, self.at.line, self.at.column, self.message)?;
        self.help.as_ref().map_or(Ok(()), |help| write!(f, "\n  help: {help}"))
    }
}

impl std::error::Error for PropertyError {}

/// An error before lines are counted.
#[derive(Debug)]
pub(super) struct Fault {
    span: Range<usize>,
    message: String,
    help: Option<String>,
}

impl Fault {
    pub(super) fn new(span: Range<usize>, message: impl Into<String>) -> Self {
        Self { span, message: message.into(), help: None }
    }

    pub(super) fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }

    /// The error with its place in the text. The span lies between characters of the text.
    pub(super) fn located(self, source_name: &str, text: &str) -> PropertyError {
        let before = text.get(..self.span.start).unwrap_or(text);
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let at = Location {
            line: 1 + before.bytes().filter(|&byte| byte == b'\n').count(),
            column: 1 + before[line_start..].chars().count(),
            span: self.span,
        };
        PropertyError {
            source_name: source_name.to_owned(),
            at,
            message: self.message,
            help: self.help,
        }
    }
}

/// A text as a message shows it: in backticks, cut, and without characters that a terminal obeys.
pub(super) fn quoted(text: &str) -> String {
    const SHOWN: usize = 40;
    let obeyed = |c: char| {
        c.is_control()
            || matches!(c, '\u{200e}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    let mut shown = String::from("`");
    for c in text.chars().take(SHOWN) {
        if obeyed(c) {
            let _ = write!(shown, "{}", c.escape_default()); // writing to a String cannot fail
        } else {
            shown.push(c);
        }
    }
    shown.push_str(if text.chars().nth(SHOWN).is_some() { "…`" } else { "`" });
    shown
}
