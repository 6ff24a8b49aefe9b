//! Limits of a search, and the reasons why it ended before its end: the same for all engines.

use std::time::Instant;

/// How much a search may use. What else keeps a search in its bounds, and is the same for all
/// users, are constants of its engine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// The most markings, ω-markings or state classes. A level of the explicit search that does not
    /// fit as a whole is not counted at all.
    pub states: u64,
    /// The most bytes for these, tables and arcs, before they are taken.
    pub bytes: u64,
    /// When to stop.
    pub deadline: Option<Instant>,
}

impl Limits {
    /// Whether the time is over.
    #[inline]
    pub fn is_over(&self) -> bool {
        self.deadline.is_some_and(|it| Instant::now() >= it)
    }

    /// Looks at time and memory, at every 256th step.
    ///
    /// # Errors
    /// The limit that was reached.
    pub fn check(&self, step: u32, bytes: impl Fn() -> usize) -> Result<(), Limit> {
        if !step.is_multiple_of(256) {
            return Ok(());
        }
        if self.is_over() {
            return Err(Limit::Time);
        }
        if bytes() as u64 > self.bytes { Err(Limit::Bytes) } else { Ok(()) }
    }
}

impl Default for Limits {
    /// No limit on markings and time, 4 GiB.
    fn default() -> Self {
        Self { states: u64::MAX, bytes: 4 << 30, deadline: None }
    }
}

/// Why a search ended before its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// More markings than [`Limits::states`].
    States,
    /// More memory than [`Limits::bytes`].
    Bytes,
    /// [`Limits::deadline`] has passed.
    Time,
    /// A number is too large: a place with more than 4,294,967,295 tokens; what an engine computes
    /// of tokens and times, beyond 63 bits.
    Tokens,
    /// A marking that no longer fits in 128 words, as places hold more than it seemed. Nets of
    /// which no marking fits are searched too.
    Words,
    /// The net is unbounded: it has no end.
    Unbounded,
    /// The work that an engine does for one question is done.
    Work,
}

impl Limit {
    const ALL: [Self; 7] = [
        Self::States,
        Self::Bytes,
        Self::Time,
        Self::Tokens,
        Self::Words,
        Self::Unbounded,
        Self::Work,
    ];

    /// A number of its own, never 0.
    pub fn code(self) -> u8 {
        1 + self as u8
    }

    /// Returns the limit of a number that [`code`](Self::code) gave.
    pub fn of(code: u8) -> Option<Self> {
        Self::ALL.get(usize::from(code).checked_sub(1)?).copied()
    }
}
