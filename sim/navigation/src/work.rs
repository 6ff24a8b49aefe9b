//! Work that an algorithm did, so that an executive can turn it into execution time.

/// Counts of what was done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Steps of the algorithm itself: points held against a place, edges looked at.
    pub operations: u64,
    /// Questions asked of a map: rays, and room around a point.
    pub rays: u64,
    /// Nodes that a search opened, or motions that were held against each other.
    pub nodes: u64,
}

impl core::ops::AddAssign for Work {
    fn add_assign(&mut self, other: Self) {
        self.operations += other.operations;
        self.rays += other.rays;
        self.nodes += other.nodes;
    }
}
