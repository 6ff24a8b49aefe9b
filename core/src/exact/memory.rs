//! The caller's memory: one element for each candidate, each activity, each remembered node.

use super::level::Level;
use super::rows::Rows;

/// Working memory for one candidate. Give [`Exact::new`](super::Exact::new) one for each candidate
/// of the problem.
#[derive(Clone, Copy, Debug)]
pub struct Item<const A: usize> {
    /// Cost above the cheapest of the activity.
    pub(super) cost: [u32; A],
    /// Quality below the best of the activity, where an objective before fixed the quality.
    pub(super) deficit: u32,
    /// Value above the least of the activity.
    pub(super) value: u32,
    /// The loss in 48 bits, and the position among the candidates as written in 16.
    lost: u64,
}

/// Bits of a loss that are not kept; a loss is rounded down, so that no plan is excluded.
const GRAIN: u32 = 4;
/// Bits of an item's position among the candidates as written.
const CHOICE: u32 = u16::BITS;

impl<const A: usize> Item<A> {
    /// Unused memory.
    pub const EMPTY: Self = Self { cost: [0; A], deficit: 0, value: 0, lost: 0 };
    pub(super) const NONE: &'static Self = &Self::EMPTY;

    pub(super) const fn new(cost: [u32; A], deficit: u32, value: u32, choice: u16) -> Self {
        Self { cost, deficit, value, lost: choice as u64 }
    }

    #[inline]
    pub(super) fn rows(&self) -> Rows<A> {
        Rows { axes: self.cost.map(i64::from), quality: i64::from(self.deficit) }
    }

    /// The value at these prices, with `fraction` fraction bits.
    #[inline]
    pub(super) fn reduced(&self, multiplier: &Rows<A>, fraction: u32) -> i64 {
        i64::from(self.value).wrapping_shl(fraction).wrapping_sub(multiplier.dot(&self.rows()))
    }

    /// What is lost at the current prices against the best of the activity. A loss of 2^52 or more,
    /// which no plan within any allowance has, is kept as the largest below.
    #[inline]
    pub(super) const fn loss(&self) -> i64 {
        ((self.lost >> CHOICE) << GRAIN).cast_signed()
    }

    /// Sets the loss, which is not negative.
    pub(super) fn lose(&mut self, loss: i64) {
        let kept = (loss.cast_unsigned() >> GRAIN).min(u64::MAX >> CHOICE);
        self.lost = kept << CHOICE | u64::from(self.choice());
    }

    /// Position among the candidates as written.
    #[inline]
    pub(super) const fn choice(&self) -> u16 {
        self.lost as u16
    }
}

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
        items.get(self.range()).unwrap_or(&[])
    }

    #[inline]
    pub(super) fn item<'i>(&self, items: &'i [Item<A>], index: u16) -> &'i Item<A> {
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
    /// Its value in 48 bits, and its depth in 16.
    place: u64,
}

/// Bits of a node's depth: there are no more activities.
const DEPTH: u32 = u16::BITS;

impl<const A: usize> Seen<A> {
    /// Unused memory.
    pub const EMPTY: Self = Self { room: [0; A], quality: 0, dive: 0, place: 0 };

    /// The node of a dive at this depth, with this value and room, neither of them negative.
    pub(super) fn new(dive: u32, depth: usize, value: i64, room: &Rows<A>) -> Self {
        let kept = |room: i64| room.cast_unsigned().min(u32::MAX.into()) as u32;
        Self {
            room: room.axes.map(kept),
            quality: kept(room.quality),
            dive,
            place: value.cast_unsigned() << DEPTH | depth as u64,
        }
    }

    /// Where a node may be noted: a number that looks random, the same for nodes that differ in
    /// room only.
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
