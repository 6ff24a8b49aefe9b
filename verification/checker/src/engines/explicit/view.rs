//! The view of a packed marking.

use super::cache_padded::CachePadded;

/// The view of a marking: the transitions that it enables, and room to compute it in.
#[derive(Clone, Debug, Default)]
pub(super) struct View {
    /// A bit for each transition: those that are enabled.
    pub(super) enabled: CachePadded<u64>,
    /// Words of implied places.
    pub(super) computed: CachePadded<u64>,
    /// Tokens of all places.
    pub(super) sum: u64,
}

impl View {
    /// Whether no transition is enabled.
    pub(super) fn is_dead(&self) -> bool {
        self.enabled.iter().all(|&it| it == 0)
    }

    /// Enabled transitions in their order.
    pub(super) fn transitions(&self) -> impl Iterator<Item = u32> + '_ {
        self.enabled
            .iter()
            .enumerate()
            .flat_map(|(at, &bits)| Bits(bits).map(move |bit| 64 * at as u32 + bit))
    }
}

/// The positions of the set bits of a word.
#[derive(Clone, Debug)]
pub(super) struct Bits(pub(super) u64);

impl Iterator for Bits {
    type Item = u32;

    #[inline]
    fn next(&mut self) -> Option<u32> {
        let bit = self.0.trailing_zeros();
        self.0 &= self.0.wrapping_sub(1);
        (bit < u64::BITS).then_some(bit)
    }
}

/// Leaves the transitions that a row allows.
#[inline]
pub(super) fn and(enabled: &mut [u64], allowed: &[u64]) {
    enabled.iter_mut().zip(allowed).for_each(|(it, allowed)| *it &= allowed);
}

/// Adds so many times what a row adds.
#[inline]
pub(super) fn add(computed: &mut [u64], row: &[u64], times: u64) {
    let adds = computed.iter_mut().zip(row);
    adds.for_each(|(it, add)| *it = it.wrapping_add(add.wrapping_mul(times)));
}
