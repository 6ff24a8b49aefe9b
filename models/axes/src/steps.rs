//! A bound on the work, so that reaching it is an answer.

use crate::tree::Wrong;

/// So much work, unless something else is said: some seconds.
pub const STEPS: u64 = 200_000_000;

/// Work that is left: a step is a part of a formula, or a partial plan looked at.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Steps {
    left: u64,
    used: u64,
}

/// Cause that ends work without an answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Stop {
    /// A limit was reached.
    Limit,
    /// Arithmetic of a formula does not come out.
    Wrong(Wrong),
}

impl From<Wrong> for Stop {
    fn from(wrong: Wrong) -> Self {
        Self::Wrong(wrong)
    }
}

impl Default for Steps {
    fn default() -> Self {
        Self::new(STEPS)
    }
}

impl Steps {
    /// So many steps.
    pub const fn new(left: u64) -> Self {
        Self { left, used: 0 }
    }

    /// Number that were used.
    pub const fn used(&self) -> u64 {
        self.used
    }

    pub(crate) fn take(&mut self, steps: u64) -> Result<(), Stop> {
        self.left = self.left.checked_sub(steps).ok_or(Stop::Limit)?;
        self.used += steps;
        Ok(())
    }
}
