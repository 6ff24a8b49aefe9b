//! Errors of properties: cause, position and remedy.

use crate::source::{Location, said};
use std::fmt;
use std::ops::Range;

/// A property that cannot be read.
///
/// Its `Display` is plain text: `source:line:column: message`, and a line of help where there is
/// some.
///
/// ```
/// use cotama_models::nets::door;
/// use cotama_verification::{property, pt::Pt};
/// let error = property::parse("AG !(Opn & obstacle)", &Pt::from(&door::NET)).unwrap_err();
/// assert_eq!((error.at.line, error.at.column), (1, 6));
/// assert_eq!(error.help.as_deref(), Some("did you mean `Open`?"));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PropertyError {
    /// The name of the file; `property` for a text.
    pub source_name: String,
    /// Position of the error; the span is that of the text or the file, without its byte order
    /// mark.
    pub at: Location,
    /// The cause of the error.
    pub message: String,
    /// The remedy, in words.
    pub help: Option<String>,
}

impl fmt::Display for PropertyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { source_name, at, message, help } = self;
        said(f, source_name, (at.line, at.column), message, help.as_deref())
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

    /// Returns the byte at which it begins.
    pub(super) fn start(&self) -> usize {
        self.span.start
    }

    /// Whether these words are in what it says.
    pub(super) fn says(&self, words: &str) -> bool {
        self.message.contains(words) || self.help.as_ref().is_some_and(|it| it.contains(words))
    }

    /// The error with its place in the text. The span lies between characters of the text.
    pub(super) fn located(self, source_name: &str, text: &str) -> PropertyError {
        PropertyError {
            source_name: source_name.to_owned(),
            at: Location::of(text, self.span),
            message: self.message,
            help: self.help,
        }
    }
}
