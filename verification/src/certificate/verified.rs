//! What comes out of checking a certificate.

use super::Certificate;
use std::fmt;

/// What a certificate shows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Verified {
    /// The name of the net, and its size.
    pub net: String,
    /// The question, written out.
    pub question: String,
    /// Whether it is so.
    pub verdict: bool,
    /// What the evidence is.
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
    /// Where in the certificate.
    pub at: String,
    /// What is wrong there.
    pub message: String,
}

impl fmt::Display for VerifyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.at, self.message)
    }
}

impl std::error::Error for VerifyError {}
