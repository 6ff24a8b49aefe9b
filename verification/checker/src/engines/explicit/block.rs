//! Lists of markings that threads pass to each other.

/// Bytes of a block.
const BLOCK: usize = 1 << 12;

/// Some markings of one level.
#[derive(Debug)]
pub(super) struct Block<const S: usize> {
    pub(super) markings: Vec<[u64; S]>,
    /// For each the transition by which it was first met.
    pub(super) via: Vec<u32>,
}

impl<const S: usize> Block<S> {
    /// How many markings a block has room for.
    pub(super) const ROOM: usize =
        if BLOCK / size_of::<[u64; S]>() < 16 { 16 } else { BLOCK / size_of::<[u64; S]>() };

    /// An empty one, if the system has memory for it.
    pub(super) fn new() -> Option<Self> {
        let (mut markings, mut via) = (Vec::new(), Vec::new());
        markings.try_reserve_exact(Self::ROOM).ok()?;
        via.try_reserve_exact(Self::ROOM).ok()?;
        Some(Self { markings, via })
    }

    pub(super) fn push(&mut self, marking: &[u64; S], via: u32) {
        self.markings.push(*marking);
        self.via.push(via);
    }

    pub(super) fn bytes(&self) -> usize {
        self.markings.capacity() * size_of::<[u64; S]>() + self.via.capacity() * size_of::<u32>()
    }
}
