//! The caller's memory: one element for each activity, and each remembered node; that of each
//! candidate is an [`Item`].

use super::item::Item;
use super::level::Level;
use super::rows::Rows;

/// Working memory for one activity. Give [`Exact::new`](super::Exact::new) one for each activity of
/// the problem.
#[derive(Clone, Copy, Debug)]
pub struct Stage<const A: usize> {
    /// The first of its items, and their number.
    pub(super) first: u32,
    pub(super) count: u16,
    /// The item (from `first`) of the best plan so far.
    pub(super) best: u16,
    /// One level of the search: a list of its own.
    pub(super) level: Level<A>,
}

impl<const A: usize> Stage<A> {
    /// Unused memory.
    pub const EMPTY: Self = Self { first: 0, count: 0, best: 0, level: Level::EMPTY };

    #[inline]
    pub(super) const fn range(&self) -> core::ops::Range<usize> {
        self.first as usize..self.first.wrapping_add(self.count as u32) as usize
    }

    #[inline]
    pub(super) fn items<'i>(&self, items: &'i [Item<A>]) -> &'i [Item<A>] {
        debug_assert!(self.range().end <= items.len(), "the items of an activity are loaded");
        items.get(self.range()).unwrap_or(&[])
    }

    #[inline]
    pub(super) fn item<'i>(&self, items: &'i [Item<A>], index: u16) -> &'i Item<A> {
        debug_assert!(index < self.count, "an item of the activity");
        items.get(self.first.wrapping_add(index.into()) as usize).unwrap_or(Item::NONE)
    }
}

/// Working memory for one node of the search that need not be searched twice. Optional: see
/// [`Exact::with_memory`](super::Exact::with_memory).
#[derive(Clone, Copy, Debug)]
pub struct Seen<const A: usize> {
    /// The room in each row, or the most that 32 bits hold.
    room: [u32; A],
    quality: u32,
    /// The dive that saw it.
    dive: u32,
    /// The value of the node in the upper 48 bits, its depth in the lower 16.
    place: u64,
}

/// Bits of a node's depth: there are no more activities.
const DEPTH: u32 = u16::BITS;

impl<const A: usize> Seen<A> {
    /// Unused memory.
    pub const EMPTY: Self = Self { room: [0; A], quality: 0, dive: 0, place: 0 };

    /// The node of a dive at this depth, with this value and room, neither of them negative.
    pub(super) fn new(dive: u32, depth: usize, value: i64, room: &Rows<A>) -> Self {
        debug_assert!(room.none_negative(), "a node that is noted is within the limits");
        debug_assert!(value.cast_unsigned().leading_zeros() >= DEPTH, "a value fits its bits");
        debug_assert!(depth < 1 << DEPTH, "a depth fits its bits");
        let kept = |room: i64| room.cast_unsigned().min(u32::MAX.into()) as u32;
        Self {
            room: room.axes.map(kept),
            quality: kept(room.quality),
            dive,
            place: value.cast_unsigned() << DEPTH | depth as u64,
        }
    }

    /// Returns a hash of the node for its slot; nodes that differ in room only share it.
    pub(super) const fn mixed(&self) -> u64 {
        // A multiplicative hash (Knuth, The Art of Computer Programming 3, section 6.4), twice.
        let mixed = self.place.wrapping_mul(0x9E37_79B9_7F4A_7C15);
        (mixed ^ mixed >> 32).wrapping_mul(0x94D0_49BB_1331_11EB)
    }

    /// Whether this node is at least as good as the other: in the same place, with as much room.
    pub(super) fn covers(&self, other: &Self) -> bool {
        let rooms = self.room.iter().zip(&other.room);
        self.dive == other.dive
            && self.place == other.place
            && self.quality >= other.quality
            && rooms.fold(true, |all, (mine, theirs)| all && mine >= theirs)
    }
}
