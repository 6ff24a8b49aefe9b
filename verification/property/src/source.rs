//! The common parts of all readers' errors: places in a text, and excerpts of the file.

use cotama_core::text::marked;
use std::fmt::{self, Write as _};
use std::ops::Range;

/// A part of a file, for people and for programs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Location {
    /// The line of its start, from 1.
    pub line: usize,
    /// The column of its start in characters, from 1.
    pub column: usize,
    /// Position in the text that was read, in bytes; both ends lie between characters.
    pub span: Range<usize>,
}

impl Location {
    /// The place of a span that lies between characters of a text.
    pub fn of(text: &str, span: Range<usize>) -> Self {
        let before = text.get(..span.start).unwrap_or(text);
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        Self {
            line: 1 + before.bytes().filter(|&byte| byte == b'\n').count(),
            column: 1 + before[line_start..].chars().count(),
            span,
        }
    }
}

/// Writes an error in plain text: `file:line:column: message`, and a line of help where there is
/// some.
///
/// # Errors
/// Errors of the formatter.
pub fn said(
    f: &mut fmt::Formatter<'_>,
    file: &str,
    (line, column): (usize, usize),
    message: &str,
    help: Option<&str>,
) -> fmt::Result {
    write!(f, "{file}:{line}:{column}: {message}")?;
    help.map_or(Ok(()), |help| write!(f, "\n  help: {help}"))
}

/// A text of the file as a message shows it: in backticks, cut, and without characters that a
/// terminal obeys.
pub fn quoted(text: &str) -> String {
    const SHOWN: usize = 40;
    let mut shown = String::from("`");
    for (c, hidden) in marked(text).take(SHOWN) {
        if hidden {
            let _ = write!(shown, "{}", c.escape_default()); // writing to a String cannot fail
        } else {
            shown.push(c);
        }
    }
    shown.push_str(if text.chars().nth(SHOWN).is_some() { "…`" } else { "`" });
    shown
}
