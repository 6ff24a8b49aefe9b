//! Errors at places of a file, whoever found them.

use cotama_models::missions::{MissionErrors, Position};
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
    /// What is wrong.
    pub(crate) message: String,
    pub(crate) at: Mark,
    /// A few words to write under the place.
    pub(crate) label: Option<String>,
    /// What to do about it.
    pub(crate) help: Option<String>,
    /// Another place that has to do with it.
    pub(crate) related: Option<Mark>,
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
        let errors = vec![FileError { message, at, label: None, help: None, related: None }];
        Self { source: source.to_owned(), text, errors, omitted: 0 }
    }

    /// The same with what to do about the first.
    pub(crate) fn help(mut self, words: impl Into<String>) -> Self {
        if let Some(first) = self.errors.first_mut() {
            first.help = Some(words.into());
        }
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
        let whole = text.split('\n').nth(line.saturating_sub(1)).unwrap_or_default();
        let bytes = whole.chars().take(column.saturating_sub(1)).map(char::len_utf8).sum::<usize>();
        let mut errors = Self::at(source, text, line, bytes + 1, message);
        errors.errors[0].help = help;
        errors
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
            message: it.message.clone(),
            at: mark(&it.at),
            label: None,
            help: it.help.clone(),
            related: it.related.as_ref().map(mark),
        };
        Self {
            source: errors.source_name().to_owned(),
            text: errors.text().to_owned(),
            errors: errors.diagnostics().iter().map(one).collect(),
            omitted: errors.omitted(),
        }
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
