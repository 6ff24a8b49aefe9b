//! The answer of an observer.

/// The answer of an observer in one period.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flag {
    /// The signal is as a sound thing gives it.
    Clear,
    /// The signal is not there, so nothing is said about the thing.
    Missing,
    /// The signal is so as a sound thing gives it no more often than was promised.
    Raised,
}

impl Flag {
    pub(crate) const fn raised_if(is_bad: bool) -> Self {
        if is_bad { Self::Raised } else { Self::Clear }
    }
}
