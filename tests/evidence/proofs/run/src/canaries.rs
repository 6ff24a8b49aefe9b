//! Harnesses that must fail: an engine that does not see them fail is blind.

/// One pair of bytes in 65,536 is found.
#[kani::proof]
#[kani::should_panic]
pub(crate) fn canary_one_case() {
    let (a, b): (u8, u8) = (kani::any(), kani::any());
    assert!(a != 0xBE || b != 0xEF);
}

/// An equation without solutions is refuted among wide inputs too.
#[kani::proof]
#[kani::should_panic]
pub(crate) fn canary_wide() {
    let it: u64 = kani::any();
    assert!(it & 1 == 0);
}

/// A harness that rejects every case shows nothing.
#[kani::proof]
#[kani::should_panic]
pub(crate) fn canary_vacuous() {
    let it: u8 = kani::any();
    kani::assume(it > 7);
    kani::assume(it < 7);
}

/// A case that never comes up is missed.
#[kani::proof]
#[kani::should_panic]
pub(crate) fn canary_uncovered() {
    let it = kani::any_where(|it: &u8| *it < 7);
    kani::cover!(it == 7, "seven");
}
