//! Reasons why a search for runs ends early.

use super::automaton::TooLarge;
use crate::explicit::Limit;

/// No transition: after a deadlock the marking lasts.
pub(super) const NONE: u32 = u32::MAX;

/// Why something is not known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stop {
    Limit(Limit),
    TooLarge,
}

impl From<Limit> for Stop {
    fn from(limit: Limit) -> Self {
        Self::Limit(limit)
    }
}

impl From<TooLarge> for Stop {
    fn from(_: TooLarge) -> Self {
        Self::TooLarge
    }
}
