//! Errors of PNML files: cause, position and remedy.

use cotama_property::source::{Location, said};
use std::collections::HashMap;
use std::fmt;

/// How many errors of one file are kept; the rest are counted.
pub const MAX_DIAGNOSTICS: usize = 100;

/// One error of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Diagnostic {
    /// Position of the error.
    pub at: Location,
    /// The cause of the error.
    pub message: String,
    /// The remedy, in words.
    pub help: Option<String>,
    /// Another part of the file that has to do with it: the first use of an id, the start of an
    /// element.
    pub related: Option<Location>,
    /// How often the file has an error of this cause; the place is that of the first.
    pub times: usize,
    /// The lines of the next few of them.
    pub also: Vec<usize>,
}

impl Diagnostic {
    /// Says how many more there are of this cause, and in which lines the first of them are.
    fn more(&self) -> Option<String> {
        let more = self.times.checked_sub(1).filter(|&it| it > 0)?;
        let mut lines = self.also.clone();
        lines.dedup();
        let noun = if lines.len() == 1 { "line" } else { "lines" };
        let shown: Vec<_> = lines.iter().map(usize::to_string).collect();
        let rest = if more > self.also.len() { ", ..." } else { "" };
        let places = if more == 1 { "place" } else { "places" };
        Some(format!("the same at {more} further {places}: {noun} {}{rest}", shown.join(", ")))
    }
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
        let Findings { mut list, omitted, .. } = findings;
        list.sort_by_key(|finding| (finding.span.start, finding.span.end));
        let spans = list.iter().flat_map(|finding| {
            let alike = finding.alike.iter().flat_map(|it| it.first.iter().copied().map(Some));
            [Some(finding.span), finding.related].into_iter().chain(alike)
        });
        let mut locations = locate(&text, &spans.flatten().collect::<Vec<_>>()).into_iter();
        let diagnostics = list.into_iter().map(|finding| {
            let at = locations.next().unwrap_or_default();
            let related = finding.related.and_then(|_| locations.next());
            let alike = finding.alike.unwrap_or_default();
            let also = alike.first.iter().filter_map(|_| Some(locations.next()?.line)).collect();
            let (message, help, times) = (finding.message, finding.help, 1 + alike.more);
            Diagnostic { at, message, help, related, times, also }
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
            if let Some(more) = diagnostic.more() {
                write!(f, "\n  {more}")?;
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
    /// The others of the same cause.
    alike: Option<Box<Alike>>,
}

/// How many more errors there are of one cause, and where the first of them are.
#[derive(Debug, Default)]
struct Alike {
    more: usize,
    first: Vec<Span>,
}

/// Different errors of one cause that are shown, and places that are named of the others.
const OF_ONE_CAUSE: usize = 3;
const PLACES: usize = 5;

impl Finding {
    pub(super) fn new(span: Span, message: impl Into<String>) -> Self {
        Self { span, message: message.into(), help: None, related: None, alike: None }
    }

    /// The message without what is quoted in it.
    fn cause(&self) -> String {
        self.message.split('`').step_by(2).collect::<Vec<_>>().join("`")
    }

    pub(super) fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }

    pub(super) fn related(self, related: Span) -> Self {
        Self { related: Some(related), ..self }
    }
}

/// The first errors in the order they were found, those of one cause together, and how many more
/// there are.
#[derive(Debug, Default)]
pub(super) struct Findings {
    list: Vec<Finding>,
    /// For each cause where in the list its errors are.
    causes: HashMap<String, Vec<usize>>,
    omitted: usize,
}

impl Findings {
    pub(super) fn push(&mut self, finding: Finding) {
        let Self { list, causes, omitted } = self;
        let known = causes.get(&finding.cause()).map_or(&[][..], |it| it);
        let same = known.iter().copied().find(|&at| list[at].message == finding.message);
        let last = known.last().copied().filter(|_| known.len() >= OF_ONE_CAUSE);
        if let Some(before) = same.or(last).and_then(|at| list.get_mut(at)) {
            let alike = before.alike.get_or_insert_default();
            alike.more += 1;
            if alike.first.len() < PLACES {
                alike.first.push(finding.span);
            }
        } else if list.len() < MAX_DIAGNOSTICS {
            causes.entry(finding.cause()).or_default().push(list.len());
            list.push(finding);
        } else {
            *omitted += 1;
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
        let mut findings = Self::default();
        findings.push(finding);
        findings
    }
}
