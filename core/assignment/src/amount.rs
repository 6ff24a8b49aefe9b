//! The two widths in which an assignment is computed.

use super::cost::Cost;

/// The integers in which prices and paths are computed: [`i32`], or [`i64`] for every table.
///
/// Half the width takes about half the time, and has an answer for costs to 134,217,727 whose
/// prices stay below that; that they do not is said, never computed wrongly.
pub trait Amount: Copy + Ord + core::fmt::Debug + sealed::Arithmetic {}

impl Amount for i32 {}
impl Amount for i64 {}

pub(super) mod sealed {
    use super::Cost;

    /// Amounts are twice what they stand for, and a column that somebody has counts one more: so of
    /// columns that are equally near the least is a free one.
    pub trait Arithmetic: Sized {
        /// The amount 0.
        const ZERO: Self;
        /// One half.
        const HALF: Self;
        /// No path, and further than any path.
        const FAR: Self;
        /// Nearer than any path, of columns that are done; and less near than any column.
        const DONE: Self;
        /// The largest price and path, twice; a sum of four of these is nearer than `FAR`.
        const ROOM: Self;
        /// Twice the cost, which is missing if it is stored below `least`.
        fn twice(entry: Option<Cost>, least: i32) -> Option<Self>;
        /// Twice what a cost is stored as: the cheaper, the more.
        fn twice_stored(stored: i32) -> Self;
        /// How far something is that is so near, and how near what is so far.
        fn away(self) -> Self;
        /// The sum.
        fn plus(self, other: Self) -> Self;
        /// The difference.
        fn minus(self, other: Self) -> Self;
        /// Without the half.
        fn whole(self) -> Self;
        /// Half of it.
        fn halved(self) -> i64;
        /// Whether costs up to this one can be computed with.
        fn room_for(most: u32) -> bool;
    }

    macro_rules! arithmetic {
        ($kind:ty) => {
            impl Arithmetic for $kind {
                const ZERO: Self = 0;
                const HALF: Self = 1;
                const FAR: Self = Self::MAX;
                const DONE: Self = Self::MIN;
                const ROOM: Self = 1 << (Self::BITS - 4);
                #[inline]
                fn twice(entry: Option<Cost>, least: i32) -> Option<Self> {
                    let stored = Cost::upside_down(entry);
                    let cost = Cost::number(stored) as Self;
                    (stored >= least).then_some(cost.wrapping_add(cost))
                }
                #[inline]
                fn twice_stored(stored: i32) -> Self {
                    (stored as Self).wrapping_add(stored as Self)
                }
                #[inline]
                fn away(self) -> Self {
                    let nothing = Self::twice_stored(Cost::number(0));
                    match self {
                        Self::DONE => Self::FAR,
                        Self::FAR => Self::DONE,
                        it => nothing.wrapping_sub(it),
                    }
                }
                #[inline]
                fn plus(self, other: Self) -> Self {
                    self.wrapping_add(other)
                }
                #[inline]
                fn minus(self, other: Self) -> Self {
                    self.wrapping_sub(other)
                }
                #[inline]
                fn whole(self) -> Self {
                    self & !1
                }
                #[inline]
                fn halved(self) -> i64 {
                    (self >> 1) as i64
                }
                fn room_for(most: u32) -> bool {
                    i64::from(most) * 2 < i64::from(Self::ROOM)
                }
            }
        };
    }
    arithmetic!(i32);
    arithmetic!(i64);
}
