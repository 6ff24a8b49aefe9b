//! Going back to a run of the original net, where that is possible.

use std::fmt;

/// The most firings of a lifted run.
pub(super) const MAX_LENGTH: usize = 1 << 24;

/// Why a run was not lifted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LiftError {
    /// The sequence is no run of the reduced net, or these are not the nets of this trail.
    NotARun,
    /// The run would have more than [`Trail::MAX_LENGTH`](super::Trail::MAX_LENGTH) firings.
    TooLong,
}

impl fmt::Display for LiftError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotARun => f.write_str("this is no run of the reduced net"),
            Self::TooLong => {
                write!(f, "the run of the original net has more than {MAX_LENGTH} firings")
            }
        }
    }
}

impl std::error::Error for LiftError {}
