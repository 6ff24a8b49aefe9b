//! Errors of files as people know them from compilers: the line, the place under it, and what to
//! do. What a terminal would obey is visible in each part before the parts are put together, with
//! the codes of styles.

use crate::exit::Failure;
use crate::file_errors::{FileError, FileErrors, Mark};
use crate::render::fold::folded;
use crate::render::style::{BAD, HEADING, terminal};
use crate::render::visible;
use annotate_snippets::{Annotation, AnnotationKind, Group, Level, Renderer, Snippet};
use cotama_core::text::marked;
use std::fmt::Write as _;
use std::ops::Range;

/// The most bytes of a file around a place; a file can be one line.
const WINDOW: usize = 16 << 10;

/// A failure in words, with the codes of styles.
pub(crate) fn failure(failure: &Failure, width: usize) -> String {
    match failure {
        Failure::Message { file, message, help } => {
            let file = file.as_ref().map_or_else(String::new, |it| format!("{}: ", visible(it)));
            let mut said = format!(
                "{BAD}error{BAD:#}{HEADING}: {file}{}{HEADING:#}",
                visible(message.trim_end())
            );
            if let Some(help) = help {
                let help = visible(help);
                let _ = write!(said, "\n |\n = {HEADING}help{HEADING:#}: {help}");
            }
            terminal(&folded(&said, width))
        }
        Failure::Text(errors) => text(errors, &Renderer::styled().term_width(width)),
    }
}

fn text(errors: &FileErrors, renderer: &Renderer) -> String {
    let mut said = String::new();
    for error in &errors.errors {
        let mut group = group(errors, error);
        if let Some(more) = error.more() {
            group = group.element(Level::NOTE.message(visible(&more)));
        }
        if let Some(help) = &error.help {
            group = group.element(Level::HELP.message(visible(help)));
        }
        said += &renderer.render(&[group]);
        said += "\n\n";
    }
    let count = errors.errors.iter().map(|it| it.times).sum::<usize>() + errors.omitted;
    let s = if count == 1 { "" } else { "s" };
    let shown = if errors.omitted > 0 {
        format!(", the first {} are shown", errors.errors.len())
    } else {
        String::new()
    };
    let title = format!("{}: {count} error{s}{shown}", visible(&errors.source));
    said += &renderer.render(&[Group::with_title(Level::ERROR.primary_title(title))]);
    said
}

/// The error with its place, and the place that has to do with it, as far as their lines are short
/// enough.
fn group<'e>(errors: &'e FileErrors, error: &'e FileError) -> Group<'e> {
    let Mark { line, column, .. } = error.at;
    let title = Level::ERROR.primary_title(visible(&error.message));
    let source = visible(&errors.source);
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
        let title = format!("{source}:{line}:{column}: {}", visible(&error.message));
        return Group::with_title(Level::ERROR.primary_title(title));
    };
    let group = title.element(snippet(errors, window, line, error, None));
    match related {
        None => group,
        Some(Mark { line, column, .. }) => {
            group.element(Level::NOTE.message(format!("see {source}:{line}:{column}")))
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
    let lines = Lines::new(text);
    // A place ends with the line in which it begins.
    let span = |mark: &Mark| {
        let start = mark.span.start - window.start;
        let line = text[start..].find('\n').map_or(text.len(), |end| start + end);
        lines.at(start)..lines.at((mark.span.end - window.start).min(line).max(start))
    };
    let label = error.label.as_deref().map(visible);
    let own = AnnotationKind::Primary.span(span(&error.at)).label(label);
    let other = related.map(|mark| AnnotationKind::Context.span(span(mark)).label("see here"));
    Snippet::source(lines.text.clone())
        .line_start(first)
        .path(visible(&errors.source))
        .annotation(own)
        .annotations(other)
}

/// Lines of a file in which what a terminal would obey is visible.
struct Lines {
    text: String,
    /// Ends in the file of characters that are others here, and by how many bytes all has moved by
    /// then.
    moved: Vec<(usize, isize)>,
}

impl Lines {
    fn new(original: &str) -> Self {
        let (mut text, mut moved, mut at) = (String::new(), Vec::new(), 0_usize);
        for (c, hidden) in marked(original) {
            at += c.len_utf8();
            if hidden && !matches!(c, '\n' | '\r' | '\t') {
                // In one character, so that columns stay.
                text.push(match u32::from(c) {
                    code @ ..0x20 => char::from_u32(0x2400 + code).unwrap_or(c),
                    0x7f => '\u{2421}',
                    _ => char::REPLACEMENT_CHARACTER,
                });
                moved.push((at, text.len().cast_signed() - at.cast_signed()));
            } else {
                text.push(c);
            }
        }
        Self { text, moved }
    }

    /// Returns the new position of a place of the file.
    fn at(&self, place: usize) -> usize {
        let before = self.moved.partition_point(|it| it.0 <= place);
        let by = before.checked_sub(1).map_or(0, |it| self.moved[it].1);
        place.saturating_add_signed(by)
    }
}

#[cfg(test)]
mod tests {
    use super::Lines;

    #[test]
    fn places_move_with_what_became_visible() {
        let text = "a\u{202e}b\tc\u{9b}\u{1b}d\u{e0041}e";
        let lines = Lines::new(text);
        assert_eq!(lines.text, "a\u{fffd}b\tc\u{fffd}\u{241b}d\u{fffd}e");
        for letter in ["a", "b", "c", "d", "e"] {
            assert_eq!(Some(lines.at(text.find(letter).unwrap())), lines.text.find(letter));
        }
    }
}
