//! Errors at places of a file, whoever found them.

use cotama_models::missions::{MissionErrors, Position, told_with};
use cotama_verification::pnml::{Location, PnmlErrors};
use std::ops::Range;

/// Errors of one file: at least one, sorted by place.
#[derive(Debug)]
pub(crate) struct FileErrors {
    /// The name of the file.
    pub(crate) source: String,
    pub(crate) text: String,
    pub(crate) errors: Vec<FileError>,
    /// How many further ones are left out.
    pub(crate) omitted: usize,
}

/// One error.
#[derive(Debug)]
pub(crate) struct FileError {
    /// Cause of the error.
    pub(crate) message: String,
    pub(crate) at: Mark,
    /// A few words to write under the place.
    pub(crate) label: Option<String>,
    /// Remedy.
    pub(crate) help: Option<String>,
    /// Another place that has to do with it.
    pub(crate) related: Option<Mark>,
    /// How often the file has an error of this cause; the place is that of the first.
    pub(crate) times: usize,
    /// The lines of the next few of them, where the file has many.
    pub(crate) also: Vec<usize>,
}

impl FileError {
    /// One error at a place.
    pub(crate) fn new(message: String, at: Mark, help: Option<String>) -> Self {
        Self { message, at, label: None, help, related: None, times: 1, also: Vec::new() }
    }

    /// Says that there are more of this cause, and where.
    pub(crate) fn more(&self) -> Option<String> {
        let more = self.times.checked_sub(1).filter(|&it| it > 0)?;
        let mut lines = self.also.clone();
        lines.dedup();
        let word = if lines.len() == 1 { "line" } else { "lines" };
        let shown: Vec<_> = lines.iter().map(usize::to_string).collect();
        let rest = if more > self.also.len() { ", ..." } else { "" };
        let places = if more == 1 { "place" } else { "places" };
        Some(format!("the same at {more} further {places}: {word} {}{rest}", shown.join(", ")))
    }
}

/// A place in a text.
#[derive(Clone, Debug)]
pub(crate) struct Mark {
    /// From 1.
    pub(crate) line: usize,
    /// In characters, from 1.
    pub(crate) column: usize,
    /// In bytes; both ends lie between characters.
    pub(crate) span: Range<usize>,
}

impl FileErrors {
    /// One error at a line and a column in bytes, both from 1.
    pub(crate) fn at(
        source: &str,
        text: String,
        line: usize,
        column: usize,
        message: String,
    ) -> Self {
        let before: usize =
            text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
        let mut start = (before + column.saturating_sub(1)).min(text.len());
        while !text.is_char_boundary(start) {
            start -= 1;
        }
        let end = start + text[start..].chars().next().map_or(0, char::len_utf8);
        let Position { line, column } = Position::of(&text, start);
        let at = Mark { line, column, span: start..end };
        let errors = vec![FileError::new(message, at, None)];
        Self { source: source.to_owned(), text, errors, omitted: 0 }
    }

    /// The same with what to do about the first.
    pub(crate) fn help(mut self, words: impl Into<String>) -> Self {
        if let Some(first) = self.errors.first_mut() {
            first.help = Some(words.into());
        }
        self
    }

    /// The same with the errors of one cause, if they are many, as one.
    pub(crate) fn folded(mut self) -> Self {
        const ALSO: usize = 4;
        let said: Vec<_> =
            self.errors.iter().map(|it| (it.message.as_str(), it.help.as_deref())).collect();
        let told = told_with(&said);
        // An error can stand for several already.
        let mut also = vec![(0, Vec::new()); told.len()];
        for (at, (with, error)) in told.iter().zip(&self.errors).enumerate() {
            let (times, lines) = &mut also[*with];
            *times += error.times;
            lines.extend((*with != at).then_some(error.at.line));
            lines.extend(&error.also);
        }
        let mut all = told.into_iter().zip(also).enumerate();
        self.errors.retain_mut(|it| {
            let Some((at, (with, (times, mut lines)))) = all.next() else { return true };
            lines.sort_unstable();
            lines.truncate(ALSO);
            (it.times, it.also) = (times, lines);
            with == at
        });
        self
    }

    /// One error at a line and a column in characters, both from 1.
    pub(crate) fn at_character(
        source: &str,
        text: String,
        (line, column): (usize, usize),
        message: String,
        help: Option<String>,
    ) -> Self {
        Self::at_characters(source, text, std::iter::once(((line, column), message, help)))
    }

    /// Errors at lines and columns in characters, both from 1, each with its remedy.
    pub(crate) fn at_characters(
        source: &str,
        text: String,
        all: impl Iterator<Item = ((usize, usize), String, Option<String>)>,
    ) -> Self {
        let one = |((line, column), message, help): ((usize, usize), String, Option<String>)| {
            let start: usize =
                text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
            let rest = text.get(start..).unwrap_or_default();
            let before = rest.chars().take(column.saturating_sub(1)).take_while(|it| *it != '\n');
            let start = start + before.map(char::len_utf8).sum::<usize>();
            let end = start + text[start..].chars().next().map_or(0, char::len_utf8);
            FileError::new(message, Mark { line, column, span: start..end }, help)
        };
        let errors = all.map(one).collect();
        Self { source: source.to_owned(), text, errors, omitted: 0 }
    }
}

impl From<MissionErrors> for FileErrors {
    fn from(errors: MissionErrors) -> Self {
        let one = |it: &cotama_models::missions::Diagnostic| {
            let Position { line, column } = errors.position(it);
            FileError {
                message: it.message.clone(),
                at: Mark { line, column, span: it.span.clone() },
                label: Some(it.label.clone()),
                help: it.help.clone(),
                related: None,
                times: it.times,
                also: it.also.iter().map(|it| Position::of(errors.text(), it.start).line).collect(),
            }
        };
        Self {
            source: errors.source_name().to_owned(),
            text: errors.text().to_owned(),
            errors: errors.diagnostics().iter().map(one).collect(),
            omitted: errors.omitted(),
        }
    }
}

impl From<PnmlErrors> for FileErrors {
    fn from(errors: PnmlErrors) -> Self {
        let mark = |at: &Location| Mark { line: at.line, column: at.column, span: at.span.clone() };
        let one = |it: &cotama_verification::pnml::Diagnostic| FileError {
            related: it.related.as_ref().map(mark),
            times: it.times,
            also: it.also.clone(),
            ..FileError::new(it.message.clone(), mark(&it.at), it.help.clone())
        };
        Self {
            source: errors.source_name().to_owned(),
            text: errors.text().to_owned(),
            errors: errors.diagnostics().iter().map(one).collect(),
            omitted: errors.omitted(),
        }
        .folded()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_column_counts_letters_and_a_span_counts_bytes() {
        let text = "first\näö x".to_owned();
        let errors = FileErrors::at_character("a file", text, (2, 4), "wrong".to_owned(), None);
        let Mark { line, column, span } = errors.errors[0].at.clone();
        assert_eq!((line, column, span), (2, 4, 11..12));
    }
}
