//! Packed equipment is what a list of numbers would be.

use super::*;
use cotama_units::proofs::few;

/// Any units of three kinds: the first, one inside, and the last.
fn three_kinds() -> Equipment {
    [0, 7, MAX_KINDS - 1].into_iter().fold(Equipment::NONE, |it, kind| {
        let Some(more) = it.with(kind, few::<3>()) else { unreachable!() };
        more
    })
}

/// Equipment covers a need exactly when it has enough of every kind, for three kinds at once.
#[kani::proof]
#[kani::unwind(17)]
pub fn covering_is_comparing_every_kind() {
    let (have, need) = (three_kinds(), three_kinds());
    let each = [0, 7, MAX_KINDS - 1].into_iter().all(|kind| have.of(kind) >= need.of(kind));
    assert!(have.covers(need) == each);
    kani::cover!(have.covers(need) && have != need, "more than enough");
    kani::cover!(have.of(7) > need.of(7) && !have.covers(need), "enough of one kind only");
}

/// Equipment covers a need exactly when it has enough of every kind, for all sixteen kinds.
#[kani::proof]
#[kani::unwind(17)]
pub fn covering_is_comparing_all_kinds() {
    let (have, need): (u64, u64) = (kani::any(), kani::any());
    let (Some(have), Some(need)) =
        (Equipment::from_bits(have & !GUARDS), Equipment::from_bits(need & !GUARDS))
    else {
        unreachable!()
    };
    let mut each = true;
    for kind in 0..MAX_KINDS {
        each &= have.of(kind) >= need.of(kind);
    }
    assert!(have.covers(need) == each);
    kani::cover!(have.covers(need), "enough");
    kani::cover!(!have.covers(need), "not enough");
}

/// A set covers the union of two options exactly when it covers both of them.
#[kani::proof]
#[kani::unwind(17)]
pub fn a_union_is_the_least_that_covers_both() {
    let two_kinds = || {
        let one = Equipment::NONE.with(3, few::<3>());
        let Some(both) = one.and_then(|it| it.with(4, few::<3>())) else { unreachable!() };
        both
    };
    let (a, b, any) = (two_kinds(), two_kinds(), two_kinds());
    assert!(any.covers(a.union(b)) == (any.covers(a) && any.covers(b)));
    kani::cover!(any == a.union(b) && any != a && any != b, "the least");
}

/// Lost units are those of one kind, at most those that are there; what does not exist is refused.
#[kani::proof]
#[kani::unwind(17)]
pub fn losing_units_touches_no_other_kind() {
    let (before, kind, count) = (three_kinds(), usize::from(few::<5>()), few::<4>());
    let after = before.without(kind, count);
    for other in 0..MAX_KINDS {
        let lost = if other == kind { count } else { 0 };
        assert!(after.of(other) == before.of(other).saturating_sub(lost));
    }
    let added = before.with(kind, count);
    assert!(added.is_some() == (kind < MAX_KINDS && count <= MAX_UNITS));
    assert!(added.is_none_or(|it| it.of(kind) == count && it.to_bits() & GUARDS == 0));
    kani::cover!(kind == 7 && before.of(7) < count, "more than there is");
    kani::cover!(kind >= MAX_KINDS, "no such kind");
}
