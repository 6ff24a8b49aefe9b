//! Verdicts as test cases.

use crate::answers::check::{CheckAnswer, ResultRow, VerdictName};
use crate::junit::{Case, End, Suite};

/// One test suite, the model, with a test case for each property: one that is false is a failure,
/// one that is not known an error.
pub(super) fn text(answer: &CheckAnswer) -> String {
    let case = |row: &ResultRow| {
        let more = || steps(row).join("\n");
        let said =
            |words: &Option<String>, else_: &str| words.as_deref().unwrap_or(else_).to_owned();
        let end = match row.verdict {
            VerdictName::True => End::Passed,
            VerdictName::False => End::Failed(said(&row.cause, "it is false"), more()),
            VerdictName::Unknown => End::Unknown(said(&row.reason, "it is not known"), more()),
        };
        Case { name: row.name.clone(), seconds: Some(row.seconds), end }
    };
    let cases = answer.results.iter().map(case).collect();
    Suite { name: answer.model.clone(), cases }.text()
}

/// The property and the run that shows it, a line each.
pub(super) fn steps(row: &ResultRow) -> Vec<String> {
    let run = row.trace.iter().flatten().map(|it| match &it.event {
        Some(event) => format!("{} on {event}", it.transition),
        None => it.transition.clone(),
    });
    std::iter::once(row.property.clone()).chain(run).collect()
}
