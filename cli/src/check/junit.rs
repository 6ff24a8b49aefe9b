//! Verdicts as test cases, in the XML of JUnit that build servers read.

use crate::answers::check::{CheckAnswer, ResultRow, VerdictName};
use std::fmt::Write;

/// One test suite, the model, with a test case for each property: one that is false is a failure,
/// one that is not known an error.
pub(super) fn text(answer: &CheckAnswer) -> String {
    let count = |verdict| answer.results.iter().filter(|it| it.verdict == verdict).count();
    let (failures, errors) = (count(VerdictName::False), count(VerdictName::Unknown));
    let seconds: f64 = answer.results.iter().map(|it| it.seconds).sum();
    let model = escaped(&answer.model);
    let mut text = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n");
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "  <testsuite name=\"{model}\" tests=\"{}\" failures=\"{failures}\" errors=\"{errors}\" \
         skipped=\"0\" time=\"{seconds:.3}\">",
        answer.results.len()
    );
    for row in &answer.results {
        let _ = write!(
            text,
            "    <testcase classname=\"{model}\" name=\"{}\" time=\"{:.3}\"",
            escaped(&row.name),
            row.seconds
        );
        let (element, message) = match row.verdict {
            VerdictName::True => {
                text.push_str("/>\n");
                continue;
            }
            VerdictName::False => ("failure", row.cause.as_deref().unwrap_or("it is false")),
            VerdictName::Unknown => ("error", row.reason.as_deref().unwrap_or("it is not known")),
        };
        let _ = writeln!(
            text,
            ">\n      <{element} message=\"{}\">{}</{element}>\n    </testcase>",
            escaped(message),
            escaped(&steps(row).join("\n"))
        );
    }
    text.push_str("  </testsuite>\n</testsuites>\n");
    text
}

/// The property and the run that shows it, a line each.
pub(super) fn steps(row: &ResultRow) -> Vec<String> {
    let run = row.trace.iter().flatten().map(|it| match &it.event {
        Some(event) => format!("{} on {event}", it.transition),
        None => it.transition.clone(),
    });
    std::iter::once(row.property.clone()).chain(run).collect()
}

/// Text as XML 1.0 takes it: other control characters cannot be written there.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\n' => escaped.push_str("&#10;"),
            '\0'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => escaped.push('\u{fffd}'),
            other => escaped.push(other),
        }
    }
    escaped
}
