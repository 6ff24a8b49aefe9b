//! Upper bounds of differences of times.

use cotama_property::time::Interval;

/// `< v`, `<= v`, or no bound; the smaller one is the tighter one.
///
/// One integer: `2v` for `< v`, `2v + 1` for `<= v`. Every bound of a class lies between the
/// negated largest lower and the largest upper bound of an interval (a firing replaces bounds by
/// bounds of this kind, see [`super::domain`]), so with bounds up to [`Interval::LARGEST`] sums of
/// several of them never leave 64 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Bound(i64);

impl Bound {
    /// `<= 0`.
    pub(super) const ZERO: Self = Self(1);
    /// No bound.
    pub(super) const INFINITE: Self = Self(i64::MAX);
    /// Bound of sums below which the next sum fits as well.
    const LARGEST: i64 = 1 << 61;

    /// The bound of a clock from above.
    pub(super) fn upper(interval: Interval) -> Self {
        interval.upper.map_or(Self::INFINITE, |upper| {
            Self(2 * upper.cast_signed() + i64::from(!interval.upper_strict))
        })
    }

    /// The bound of the negated clock from above.
    pub(super) fn lower(interval: Interval) -> Self {
        Self(-2 * interval.lower.cast_signed() + i64::from(!interval.lower_strict))
    }

    /// The bound of a sum.
    #[inline]
    pub(super) fn plus(self, other: Self) -> Self {
        if self == Self::INFINITE || other == Self::INFINITE {
            Self::INFINITE
        } else {
            Self(self.0 + other.0 - ((self.0 | other.0) & 1))
        }
    }

    /// The bound of a sum that grows without end; `None` when it gets too large.
    pub(super) fn checked_plus(self, other: Self) -> Option<Self> {
        let sum = self.plus(other);
        (sum == Self::INFINITE || sum.0.abs() < Self::LARGEST).then_some(sum)
    }

    /// The bound of the negated difference that holds exactly where this one does not.
    pub(super) const fn beyond(self) -> Self {
        Self(1 - self.0)
    }

    /// The same with the value included.
    pub(super) fn closed(self) -> Self {
        Self(self.0 | 1)
    }

    /// Returns the bound, and whether it is strict; `None` without a bound.
    pub(super) fn value(self) -> Option<(i64, bool)> {
        (self != Self::INFINITE).then_some((self.0 >> 1, self.0 & 1 == 0))
    }

    /// As it is stored.
    #[inline]
    pub(super) const fn code(self) -> i64 {
        self.0
    }

    /// As it was stored.
    #[inline]
    pub(super) const fn from_code(code: i64) -> Self {
        Self(code)
    }
}
