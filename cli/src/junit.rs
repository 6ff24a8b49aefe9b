//! Answers as test cases, in the XML of JUnit that build servers read.

use cotama_core::text::marked;
use std::fmt::Write;

/// A test suite.
#[derive(Debug)]
pub(crate) struct Suite {
    /// Name of the subject: a model, a mission.
    pub(crate) name: String,
    pub(crate) cases: Vec<Case>,
}

/// A test case.
#[derive(Debug)]
pub(crate) struct Case {
    pub(crate) name: String,
    /// How long it took, where that was measured.
    pub(crate) seconds: Option<f64>,
    pub(crate) end: End,
}

/// How a test case ended.
#[derive(Debug)]
pub(crate) enum End {
    Passed,
    /// The failure, and more about it.
    Failed(String, String),
    /// Why the answer is not known, and more about it.
    Unknown(String, String),
}

impl Suite {
    /// A document with this suite alone.
    pub(crate) fn text(&self) -> String {
        let count = |it: fn(&End) -> bool| self.cases.iter().filter(|case| it(&case.end)).count();
        let failures = count(|it| matches!(it, End::Failed(..)));
        let errors = count(|it| matches!(it, End::Unknown(..)));
        let time = |seconds: Option<f64>| {
            seconds.map_or_else(String::new, |it| format!(" time=\"{it:.3}\""))
        };
        let all = self.cases.iter().filter_map(|it| it.seconds).reduce(|sum, it| sum + it);
        let name = escaped(&self.name);
        let mut text = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n");
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "  <testsuite name=\"{name}\" tests=\"{}\" failures=\"{failures}\" \
             errors=\"{errors}\" skipped=\"0\"{}>",
            self.cases.len(),
            time(all)
        );
        for case in &self.cases {
            let _ = write!(
                text,
                "    <testcase classname=\"{name}\" name=\"{}\"{}",
                escaped(&case.name),
                time(case.seconds)
            );
            let (element, message, more) = match &case.end {
                End::Passed => {
                    text.push_str("/>\n");
                    continue;
                }
                End::Failed(message, more) => ("failure", message, more),
                End::Unknown(message, more) => ("error", message, more),
            };
            let _ = writeln!(
                text,
                ">\n      <{element} message=\"{}\">{}</{element}>\n    </testcase>",
                escaped(message),
                escaped(more)
            );
        }
        text.push_str("  </testsuite>\n</testsuites>\n");
        text
    }
}

/// Returns the text as XML 1.0 takes it, in one line. A character that is obeyed or hidden where a
/// text is shown becomes its code, as `\u{1b}`; so does one that XML cannot hold.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for (letter, hidden) in marked(text) {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\n' => escaped.push_str("&#10;"),
            '\u{fffe}' | '\u{ffff}' => escaped.extend(letter.escape_unicode()),
            other if hidden => escaped.extend(other.escape_unicode()),
            other => escaped.push(other),
        }
    }
    escaped
}
