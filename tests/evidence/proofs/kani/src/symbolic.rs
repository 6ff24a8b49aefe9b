//! Inputs come from symbols that a symbolic executor replaces; on their own they do nothing useful.
use core::hint::black_box;

/// Any 32 bits.
#[unsafe(no_mangle)]
#[inline(never)]
pub extern "C" fn proof_any32() -> u32 {
    black_box(0)
}

/// An assumption does not hold: this path is none.
#[unsafe(no_mangle)]
#[inline(never)]
pub extern "C" fn proof_reject() -> ! {
    loop {
        black_box(());
    }
}

/// Some input on this path satisfies a `cover!`, whose text is here.
#[unsafe(no_mangle)]
#[inline(never)]
pub extern "C" fn proof_covered(text: *const u8, length: usize) {
    black_box((text, length));
}

pub(crate) fn choose(bits: u32) -> u64 {
    let low = u64::from(proof_any32());
    match bits {
        33.. => low | u64::from(proof_any32()) << 32,
        32 => low,
        _ => low & ((1 << bits) - 1),
    }
}

pub(crate) const fn mark() -> usize {
    0
}

pub(crate) fn again(_mark: usize) {
    proof_reject()
}

/// Goes on only where `condition` holds.
pub fn assume(condition: bool) {
    if !condition {
        proof_reject()
    }
}

/// The function behind [`cover!`](crate::cover!).
pub fn covered(text: &'static str, condition: bool) {
    if condition {
        proof_covered(text.as_ptr(), text.len());
    }
}
