//! The result of checking a certificate.

use super::Certificate;
use std::fmt::{self, Display};

/// The verified statement of a certificate.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Verified {
    /// The name of the net, and its size.
    pub net: String,
    /// The question, written out.
    pub question: String,
    /// Truth of the claim.
    pub verdict: bool,
    /// Kind of the evidence, in words.
    pub evidence: String,
}

impl Verified {
    pub(super) fn of(shown: &Certificate) -> Self {
        Self {
            net: shown.net.to_string(),
            question: shown.question.to_string(),
            verdict: shown.verdict,
            evidence: shown.evidence.to_string(),
        }
    }
}

impl fmt::Display for Verified {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "net {}: {} is {}\n  by {}", self.net, self.question, self.verdict, self.evidence)
    }
}

/// Why a certificate shows nothing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VerifyError {
    /// Position in the certificate.
    pub at: String,
    /// The cause of the refusal.
    pub message: String,
}

impl fmt::Display for VerifyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.at, self.message)
    }
}

impl std::error::Error for VerifyError {}

pub(super) type Checked<T> = Result<T, VerifyError>;

pub(super) fn error(message: impl Display) -> VerifyError {
    VerifyError { at: String::new(), message: message.to_string() }
}

pub(super) fn ensure(holds: bool, message: impl Display) -> Checked<()> {
    if holds { Ok(()) } else { Err(error(message)) }
}

/// Puts the part of the certificate in front of where an error is.
pub(super) fn at(part: impl Display) -> impl FnOnce(VerifyError) -> VerifyError {
    move |it| VerifyError { at: format!("{part}{}", it.at), ..it }
}

/// Checks each of a list; where an error is starts with its number.
pub(super) fn each<T, U>(
    list: impl IntoIterator<Item = T>,
    mut check: impl FnMut(T) -> Checked<U>,
) -> Checked<Vec<U>> {
    list.into_iter()
        .enumerate()
        .map(|(n, it)| check(it).map_err(at(format_args!("[{n}]"))))
        .collect()
}
