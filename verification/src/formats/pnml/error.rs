//! What is wrong with a PNML file, where, and what to do about it.

use crate::source::{Location, said};
use std::fmt;

/// How many errors of one file are kept; the rest are counted.
pub const MAX_DIAGNOSTICS: usize = 100;

/// One error of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Where.
    pub at: Location,
    /// What is wrong.
    pub message: String,
    /// What to do about it.
    pub help: Option<String>,
    /// Another part of the file that has to do with it: the first use of an id, the start of an
    /// element.
    pub related: Option<Location>,
}

/// All errors of one file that were found before reading had to stop: at least one, sorted by
/// place.
///
/// Its `Display` is plain text: a line `file:line:column: message` for each error, and lines of
/// help and of the related place where there are some.
///
/// ```
/// use cotama_verification::pnml;
/// let text = r#"<pnml xmlns="http://www.pnml.org/version-2009/grammar/pnml">
/// <net id="n" type="http://www.pnml.org/version-2009/grammar/ptnet"><page id="g">
///   <arc id="a" source="p" target="t"/>
/// </page></net></pnml>"#;
/// let errors = pnml::read("mine.pnml", text.as_bytes()).unwrap_err();
/// assert_eq!(errors.diagnostics()[0].at.line, 3);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PnmlErrors {
    source_name: String,
    text: String,
    diagnostics: Vec<Diagnostic>,
    omitted: usize,
}

impl PnmlErrors {
    pub(super) fn new(source_name: &str, text: String, findings: Findings) -> Self {
        let Findings { mut list, omitted } = findings;
        list.sort_by_key(|finding| (finding.span.start, finding.span.end));
        let spans = list.iter().flat_map(|finding| [Some(finding.span), finding.related]).flatten();
        let mut locations = locate(&text, &spans.collect::<Vec<_>>()).into_iter();
        let diagnostics = list.into_iter().map(|finding| {
            let at = locations.next().unwrap_or_default();
            let related = finding.related.and_then(|_| locations.next());
            Diagnostic { at, message: finding.message, help: finding.help, related }
        });
        let diagnostics = diagnostics.collect();
        Self { source_name: source_name.to_owned(), text, diagnostics, omitted }
    }

    /// The name of the file, as the caller gave it.
    pub fn source_name(&self) -> &str {
        &self.source_name
    }

    /// The text of the file without its byte order mark, decoded as far as it could be.
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
}

impl fmt::Display for PnmlErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let file = &self.source_name;
        for (index, diagnostic) in self.diagnostics.iter().enumerate() {
            let separator = if index == 0 { "" } else { "\n" };
            let Diagnostic { at, message, help, .. } = diagnostic;
            f.write_str(separator)?;
            said(f, file, (at.line, at.column), message, help.as_deref())?;
            if let Some(Location { line, column, .. }) = diagnostic.related {
                write!(f, "\n  see: {file}:{line}:{column}")?;
            }
        }
        if self.omitted > 0 {
            write!(f, "\n{file}: {} further errors", self.omitted)?;
        }
        Ok(())
    }
}

impl std::error::Error for PnmlErrors {}

/// The locations of spans, in the same order, in one pass over the text.
fn locate(text: &str, spans: &[Span]) -> Vec<Location> {
    let mut order: Vec<usize> = (0..spans.len()).collect();
    order.sort_by_key(|&index| spans[index].start);
    let mut locations = vec![Location::default(); spans.len()];
    let (mut line, mut column, mut done) = (1, 1, 0);
    for index in order {
        let start = boundary(text, spans[index].start);
        let passed = &text[done..start];
        let newlines = passed.bytes().filter(|&byte| byte == b'\n').count();
        if let Some(newline) = passed.rfind('\n') {
            column = 1 + passed[newline + 1..].chars().count();
        } else {
            column += passed.chars().count();
        }
        line += newlines;
        done = start;
        let end = boundary(text, spans[index].end).max(start);
        locations[index] = Location { line, column, span: start..end };
    }
    locations
}

/// The last character boundary at or before `offset`.
fn boundary(text: &str, offset: usize) -> usize {
    let mut offset = offset.min(text.len());
    while !text.is_char_boundary(offset) {
        offset -= 1;
    }
    offset
}

/// A part of the text, in bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Span {
    pub(super) start: usize,
    pub(super) end: usize,
}

/// A value and where it stands.
#[derive(Clone, Debug)]
pub(super) struct Spanned<T> {
    pub(super) value: T,
    pub(super) span: Span,
}

/// An error before lines are counted.
#[derive(Debug)]
pub(super) struct Finding {
    span: Span,
    message: String,
    help: Option<String>,
    related: Option<Span>,
}

impl Finding {
    pub(super) fn new(span: Span, message: impl Into<String>) -> Self {
        Self { span, message: message.into(), help: None, related: None }
    }

    pub(super) fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }

    pub(super) fn related(self, related: Span) -> Self {
        Self { related: Some(related), ..self }
    }
}

/// The first errors in the order they were found, and how many more there are.
#[derive(Debug, Default)]
pub(super) struct Findings {
    list: Vec<Finding>,
    omitted: usize,
}

impl Findings {
    pub(super) fn push(&mut self, finding: Finding) {
        if self.list.len() < MAX_DIAGNOSTICS {
            self.list.push(finding);
        } else {
            self.omitted += 1;
        }
    }

    /// The value of a result; its error is kept.
    pub(super) fn keep<T>(&mut self, result: Result<T, Finding>) -> Option<T> {
        result.map_err(|finding| self.push(finding)).ok()
    }

    pub(super) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }
}

impl From<Finding> for Findings {
    fn from(finding: Finding) -> Self {
        Self { list: vec![finding], omitted: 0 }
    }
}
