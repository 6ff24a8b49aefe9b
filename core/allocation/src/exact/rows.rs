//! A number for each limited sum: every axis, and the quality where an objective before has fixed
//! it.
//!
//! Amounts and prices are so small that no sum here overflows: see [`load`](super::load). Sums
//! wrap, which then is the same, because the compiler cannot see it; debug builds assert it.

/// One number for each axis and one for the quality.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Rows<const A: usize> {
    pub(super) axes: [i64; A],
    pub(super) quality: i64,
}

/// A sum that does not overflow.
#[inline]
pub(super) const fn sum(a: i64, b: i64) -> i64 {
    debug_assert!(a.checked_add(b).is_some(), "no sum of amounts or priced values overflows");
    a.wrapping_add(b)
}

/// A difference that does not overflow.
#[inline]
pub(super) const fn difference(a: i64, b: i64) -> i64 {
    debug_assert!(a.checked_sub(b).is_some(), "no difference of amounts or values overflows");
    a.wrapping_sub(b)
}

/// A product that does not overflow.
#[inline]
pub(super) const fn product(a: i64, b: i64) -> i64 {
    debug_assert!(a.checked_mul(b).is_some(), "no priced amount overflows");
    a.wrapping_mul(b)
}

impl<const A: usize> Rows<A> {
    pub(super) const ZERO: Self = Self { axes: [0; A], quality: 0 };
    /// How many rows there are.
    pub(super) const COUNT: usize = A + 1;

    /// The number of row `row`: an axis, then the quality.
    pub(super) fn get(&self, row: usize) -> i64 {
        debug_assert!(row < Self::COUNT, "a row");
        self.axes.get(row).copied().unwrap_or(self.quality)
    }

    pub(super) fn set(&mut self, row: usize, value: i64) {
        debug_assert!(row < Self::COUNT, "a row");
        match self.axes.get_mut(row) {
            Some(axis) => *axis = value,
            None => self.quality = value,
        }
    }

    /// Row by row `f(self, other)`.
    #[inline]
    pub(super) fn zip(&self, other: &Self, f: impl Fn(i64, i64) -> i64) -> Self {
        let mut result = *self;
        for (mine, &theirs) in result.axes.iter_mut().zip(&other.axes) {
            *mine = f(*mine, theirs);
        }
        result.quality = f(self.quality, other.quality);
        result
    }

    #[inline]
    pub(super) fn plus(&self, other: &Self) -> Self {
        self.zip(other, sum)
    }

    #[inline]
    pub(super) fn minus(&self, other: &Self) -> Self {
        self.zip(other, difference)
    }

    #[inline]
    pub(super) fn dot(&self, other: &Self) -> i64 {
        let axes = self.axes.iter().zip(&other.axes);
        axes.fold(product(self.quality, other.quality), |all, (&a, &b)| sum(all, product(a, b)))
    }

    #[inline]
    pub(super) fn none_negative(&self) -> bool {
        self.axes.iter().all(|&a| a >= 0) && self.quality >= 0
    }
}
