//! Tools of measurements: marks at which an emulator counts, and the depth of the stack.

use core::hint::black_box;
use core::ptr::addr_of;

/// The emulator looks for this function by its name, and counts the instructions between two calls.
// SAFETY: `no_mangle` counts as unsafe because two equal names would meet at link time: no other
// function is called so.
#[unsafe(no_mangle)]
#[inline(never)]
pub extern "C" fn icount_mark() {
    black_box(());
}

unsafe extern "C" {
    /// The top of the stack and its end, by cortex-m-rt.
    static _stack_start: u32;
    static _stack_end: u32;
}

/// The deepest use of the stack so far, in bytes: what was painted at the start and is still so was
/// not used.
pub fn stack_used() -> usize {
    let (top, end) = (addr_of!(_stack_start), addr_of!(_stack_end));
    let mut word = end;
    // SAFETY: the words from the end to the top are RAM that belongs to the stack.
    while word < top && unsafe { word.read_volatile() } == cortex_m_rt::STACK_PAINT_VALUE {
        word = word.wrapping_add(1);
    }
    top as usize - word as usize
}
