//! Sets of numbers, a bit each.

/// The members of a set, from the lowest bit on.
pub(super) fn bits(set: u64) -> impl Iterator<Item = usize> {
    let mut left = set;
    core::iter::from_fn(move || {
        let lowest = left.trailing_zeros();
        left &= left.checked_sub(1)?;
        Some(lowest as usize)
    })
}

/// The set of these; who is no bit of it is left out.
pub(super) fn set_of(all: impl Iterator<Item = usize>) -> u64 {
    all.fold(0, |set, it| set | 1_u64.checked_shl(it as u32).unwrap_or(0))
}

/// The same of losses.
pub(super) fn losses_of(all: impl Iterator<Item = usize>) -> u32 {
    all.fold(0, |set, it| set | 1_u32.checked_shl(it as u32).unwrap_or(0))
}
