//! Conditions of a refusal.

use cotama_models::missions::MissionErrors;

/// The text that a file of such bytes is taken for.
pub(super) fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Checks that a place is one of the text, or right behind its end: line and column in characters
/// (some readers count bytes), from 1.
#[track_caller]
pub(super) fn is_place(text: &str, line: usize, column: usize) {
    // XML ends lines with a carriage return alone, too; the others with line feeds.
    let lines = text.split(['\n', '\r']).count();
    assert!((1..=lines + 1).contains(&line), "line {line} of {lines}");
    let longest = text.split('\n').map(str::len).max().unwrap_or(0);
    assert!((1..=longest + 2).contains(&column), "column {column} of at most {longest}");
}

/// Checks that a span of bytes is one of the text.
#[track_caller]
pub(super) fn is_span(text: &str, span: std::ops::Range<usize>) {
    assert!(text.get(span.clone()).is_some(), "{span:?} of {} bytes", text.len());
}

/// Checks the errors of a reader of mission files, or of their kin.
#[track_caller]
pub(super) fn errors(text: &str, errors: &MissionErrors) {
    assert!(!errors.diagnostics().is_empty());
    for diagnostic in errors.diagnostics() {
        is_span(text, diagnostic.span.clone());
        let position = errors.position(diagnostic);
        is_place(text, position.line, position.column);
        assert!(!diagnostic.message.is_empty());
    }
    assert!(errors.to_string().starts_with("file:"));
}
