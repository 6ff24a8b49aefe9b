//! Tokens of a place, or any number of them.

use cotama_core::net::PlaceId;
use cotama_property::Marking;
use std::fmt;

/// How many tokens: a number below 2^64 - 1, or ω, which says that there can be more than any
/// number. ω is the greatest.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Tokens(u64);

impl Tokens {
    /// More than any number.
    pub const OMEGA: Self = Self(u64::MAX);

    /// So many tokens; 2^64 - 1 is [`OMEGA`](Self::OMEGA).
    pub const fn new(tokens: u64) -> Self {
        Self(tokens)
    }

    /// The number; `None` for ω.
    pub const fn finite(self) -> Option<u64> {
        if self.0 == u64::MAX { None } else { Some(self.0) }
    }

    /// Whether it is ω.
    pub const fn is_omega(self) -> bool {
        self.0 == u64::MAX
    }

    /// So many more, or fewer; ω stays ω. `None` below zero and from 2^64 - 1 on.
    pub fn changed(self, by: i64) -> Option<Self> {
        if self.is_omega() {
            Some(self)
        } else {
            self.0.checked_add_signed(by).map(Self).filter(|it| !it.is_omega())
        }
    }
}

impl From<u32> for Tokens {
    fn from(tokens: u32) -> Self {
        Self(u64::from(tokens))
    }
}

impl fmt::Display for Tokens {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.finite() {
            Some(tokens) => tokens.fmt(f),
            None => f.write_str("ω"),
        }
    }
}

impl fmt::Debug for Tokens {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// A marking with ω, of which formulas are asked: ω reads as 2^64 - 1, which no constant of a
/// formula with 64 bits reaches.
pub(super) struct OmegaMarking<'m>(pub(super) &'m [Tokens]);

impl Marking for OmegaMarking<'_> {
    fn tokens(&self, place: PlaceId) -> u64 {
        self.0.get(place.0 as usize).map_or(0, |it| it.0)
    }
}

/// Whether a marking has nowhere more tokens than another.
pub(super) fn at_most(one: &[Tokens], other: &[Tokens]) -> bool {
    one.iter().zip(other).all(|(one, other)| one <= other)
}

/// A bit for each marked place modulo 64: a marking is at most another one only if its bits are
/// among those of the other.
pub(super) fn support(marking: &[Tokens]) -> u64 {
    let marked = marking.iter().enumerate().filter(|(_, it)| it.0 > 0);
    marked.fold(0, |bits, (place, _)| bits | 1 << (place % 64))
}
