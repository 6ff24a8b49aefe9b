//! A number for each limited sum: every axis, and the quality where an objective before has fixed
//! it.
//!
//! Amounts and prices are so small that no sum here overflows: see [`load`](super::load). Sums
//! wrap, which then is the same, because the compiler cannot see it.

/// One number for each axis and one for the quality.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Rows<const A: usize> {
    pub(super) axes: [i64; A],
    pub(super) quality: i64,
}

impl<const A: usize> Rows<A> {
    pub(super) const ZERO: Self = Self { axes: [0; A], quality: 0 };
    /// How many rows there are.
    pub(super) const COUNT: usize = A + 1;

    /// The number of row `row`: an axis, then the quality.
    pub(super) fn get(&self, row: usize) -> i64 {
        self.axes.get(row).copied().unwrap_or(self.quality)
    }

    pub(super) fn set(&mut self, row: usize, value: i64) {
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
        self.zip(other, i64::wrapping_add)
    }

    #[inline]
    pub(super) fn minus(&self, other: &Self) -> Self {
        self.zip(other, i64::wrapping_sub)
    }

    #[inline]
    pub(super) fn dot(&self, other: &Self) -> i64 {
        let axes = self.axes.iter().zip(&other.axes);
        axes.fold(self.quality.wrapping_mul(other.quality), |sum, (&a, &b)| {
            sum.wrapping_add(a.wrapping_mul(b))
        })
    }

    #[inline]
    pub(super) fn none_negative(&self) -> bool {
        self.axes.iter().all(|&a| a >= 0) && self.quality >= 0
    }
}
