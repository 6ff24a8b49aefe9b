//! Errors of files as people know them from compilers: the line, the place under it, and what to
//! do.

use crate::exit::Failure;
use crate::file_errors::{FileError, FileErrors, Mark};
use crate::render::fold::folded;
use annotate_snippets::{Annotation, AnnotationKind, Group, Level, Renderer, Snippet};
use std::ops::Range;

/// The most bytes of a file around a place; a file can be one line.
const WINDOW: usize = 16 << 10;

/// A failure in words, with styles.
pub(crate) fn failure(failure: &Failure, width: usize) -> String {
    let renderer = Renderer::styled().term_width(width);
    match failure {
        Failure::Message { file, message, help } => {
            let message = match file {
                Some(file) => format!("{file}: {message}"),
                None => message.clone(),
            };
            let title = Level::ERROR.primary_title(message);
            let group = match help {
                Some(help) => title.element(Level::HELP.message(help.as_str())),
                None => Group::with_title(title),
            };
            folded(&renderer.render(&[group]), width)
        }
        Failure::Text(errors) => text(errors, &renderer),
    }
}

fn text(errors: &FileErrors, renderer: &Renderer) -> String {
    let mut said = String::new();
    for error in &errors.errors {
        let mut group = group(errors, error);
        if let Some(help) = &error.help {
            group = group.element(Level::HELP.message(help.as_str()));
        }
        said += &renderer.render(&[group]);
        said += "\n\n";
    }
    let count = errors.errors.len() + errors.omitted;
    let s = if count == 1 { "" } else { "s" };
    let shown = if errors.omitted > 0 {
        format!(", the first {} are shown", errors.errors.len())
    } else {
        String::new()
    };
    let title = format!("{}: {count} error{s}{shown}", errors.source);
    said += &renderer.render(&[Group::with_title(Level::ERROR.primary_title(title))]);
    said
}

/// The error with its place, and the place that has to do with it, as far as their lines are short
/// enough.
fn group<'e>(errors: &'e FileErrors, error: &'e FileError) -> Group<'e> {
    let Mark { line, column, .. } = error.at;
    let title = Level::ERROR.primary_title(error.message.as_str());
    let related = error.related.as_ref();
    if let Some(related) = related
        && let Some(window) = window(&errors.text, &[&error.at, related])
    {
        return title.element(snippet(
            errors,
            window,
            line.min(related.line),
            error,
            Some(related),
        ));
    }
    let Some(window) = window(&errors.text, &[&error.at]) else {
        let title = format!("{}:{line}:{column}: {}", errors.source, error.message);
        return Group::with_title(Level::ERROR.primary_title(title));
    };
    let group = title.element(snippet(errors, window, line, error, None));
    match related {
        None => group,
        Some(Mark { line, column, .. }) => {
            group.element(Level::NOTE.message(format!("see {}:{line}:{column}", errors.source)))
        }
    }
}

/// The lines in which these places begin, if they are short enough.
fn window(text: &str, marks: &[&Mark]) -> Option<Range<usize>> {
    let bytes = text.as_bytes();
    let starts = || marks.iter().map(|mark| mark.span.start);
    let (first, last) = (starts().min()?, starts().max()?);
    if last - first > WINDOW {
        return None;
    }
    let (back, ahead) = (first.saturating_sub(WINDOW), (last + WINDOW).min(bytes.len()));
    let newline = |&byte: &u8| byte == b'\n';
    let start = bytes[back..first].iter().rposition(newline).map(|at| back + at + 1);
    let end = bytes[last..ahead].iter().position(newline).map(|at| last + at);
    let start = start.or((back == 0).then_some(0))?;
    let end = end.or((ahead == bytes.len()).then_some(ahead))?;
    Some(start..end)
}

/// The lines of a window, the first of which has the number `first`, with what is marked in them.
fn snippet<'e>(
    errors: &'e FileErrors,
    window: Range<usize>,
    first: usize,
    error: &'e FileError,
    related: Option<&'e Mark>,
) -> Snippet<'e, Annotation<'e>> {
    let text = &errors.text[window.clone()];
    // A place ends with the line in which it begins.
    let span = |mark: &Mark| {
        let start = mark.span.start - window.start;
        let line = text[start..].find('\n').map_or(text.len(), |end| start + end);
        start..(mark.span.end - window.start).min(line).max(start)
    };
    let own = AnnotationKind::Primary.span(span(&error.at)).label(error.label.as_deref());
    let other = related.map(|mark| AnnotationKind::Context.span(span(mark)).label("see here"));
    Snippet::source(text)
        .line_start(first)
        .path(errors.source.as_str())
        .annotation(own)
        .annotations(other)
}
