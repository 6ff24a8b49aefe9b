//! Sorting and sifting without panics: the library's sort may say that an order is none.

/// Elements with their positions, as `enumerate` does, which counts with a check that can panic.
pub(crate) fn numbered<I: IntoIterator>(elements: I) -> impl Iterator<Item = (usize, I::Item)> {
    (0..usize::MAX).zip(elements)
}

/// Sorts by a key in rising order, in place and not stably.
pub(crate) fn sort_by_key<T, K: Ord>(list: &mut [T], key: impl Fn(&T) -> K) {
    let before = |list: &[T], a: usize, b: usize| match (list.get(a), list.get(b)) {
        (Some(a), Some(b)) => key(a) < key(b),
        _ => false,
    };
    let swap = |list: &mut [T], a: usize, b: usize| {
        debug_assert!(a != b && a.max(b) < list.len(), "two places of the list");
        if let Ok([a, b]) = list.get_disjoint_mut([a, b]) {
            core::mem::swap(a, b);
        }
    };
    sort_list(list, before, swap);
    debug_assert!(list.is_sorted_by_key(&key), "rising keys");
}

/// Sorts by what says which of two elements comes before the other, and by what swaps two: in place
/// and not stably, by a heap (Williams 1964).
pub(crate) fn sort_list<T>(
    list: &mut [T],
    before: impl Fn(&[T], usize, usize) -> bool,
    swap: impl Fn(&mut [T], usize, usize),
) {
    let count = list.len();
    for top in (0..count / 2).rev() {
        sift(list, top, count, &before, &swap);
    }
    for end in (1..count).rev() {
        swap(list, 0, end);
        sift(list, 0, end, &before, &swap);
    }
    debug_assert!((1..count).all(|at| !before(list, at, at - 1)), "a sorted list");
}

/// Moves the elements that none kept before them dominates to the front, in their order, and
/// returns those. Each is compared with the last `most` that are kept, the nearest first.
pub(crate) fn keep_undominated<T: Copy>(
    list: &mut [T],
    most: usize,
    dominates: impl Fn(&T, &T) -> bool,
) -> &[T] {
    let mut kept = 0usize;
    for next in 0..list.len() {
        let Some((before, rest)) = list.split_at_mut_checked(next) else { break };
        let (Some(before), Some(&mut new)) = (before.get_mut(..kept), rest.first_mut()) else {
            break;
        };
        if before.iter().rev().take(most).any(|other| dominates(other, &new)) {
            continue;
        }
        debug_assert!(kept <= next, "no element that is still to be looked at is overwritten");
        if let Some(place) = list.get_mut(kept) {
            *place = new;
            kept = kept.wrapping_add(1);
        }
    }
    list.get(..kept).unwrap_or(&[])
}

/// Lets the element at `top` sink below the later ones, among those before `end`.
fn sift<T>(
    list: &mut [T],
    mut top: usize,
    end: usize,
    before: &impl Fn(&[T], usize, usize) -> bool,
    swap: &impl Fn(&mut [T], usize, usize),
) {
    loop {
        let left = top.wrapping_mul(2).wrapping_add(1);
        let right = left.wrapping_add(1);
        let later = |a: usize, b: usize| b < end && before(list, a, b);
        let child = if later(left, right) { right } else { left };
        if !later(top, child) {
            return;
        }
        swap(list, top, child);
        top = child;
    }
}

#[cfg(test)]
mod tests {
    use super::sort_by_key;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_sorted_list_equals_that_of_the_library(
            mut list in prop::collection::vec(0u16..50, 0..40)
        ) {
            let mut expected = list.clone();
            expected.sort_unstable_by_key(|n| core::cmp::Reverse(*n));
            sort_by_key(&mut list, |n| core::cmp::Reverse(*n));
            prop_assert_eq!(list, expected);
        }
    }
}
