//! The screen of `cotama verify`.

use super::style::{BAD, GOOD};
use super::{visible, wrapped};
use crate::answers::check::VerifyAnswer;

/// Returns the statement of a certificate, or why it shows nothing.
pub(crate) fn screen(answer: &VerifyAnswer, width: usize) -> String {
    let said = |text: &Option<String>| visible(text.as_deref().unwrap_or_default());
    if answer.verified {
        let verdict = answer.verdict.unwrap_or_default();
        // A certificate of a tree answers several questions.
        let (about, has) = match &answer.tree {
            Some(tree) => (format!("tree {}", visible(tree)), ":"),
            None => (format!("net {}", said(&answer.net)), " is"),
        };
        let net = wrapped(&about, width, "  ");
        let claim = wrapped(&format!("{}{has} {verdict}", said(&answer.question)), width, "  ");
        let by = wrapped(&format!("by {}", said(&answer.evidence)), width, "  ");
        return format!("{GOOD}verified{GOOD:#}\n{net}{claim}{by}");
    }
    let why = wrapped(&format!("{}: {}", said(&answer.at), said(&answer.message)), width, "  ");
    format!("{BAD}refused{BAD:#}\n{why}")
}
