//! The stack of a call, by painting.

use core::ptr::{read_volatile, write_volatile};

/// So much of the stack is looked at.
const DEPTH: usize = 24 * 1024;
const PAINT: u32 = 0x5AA5_C33C;

/// How deep the stack goes below its caller in a call, in bytes.
#[inline(never)]
pub fn depth(act: impl FnOnce()) -> usize {
    let here = 0_u32;
    let top = (&raw const here as usize - 256) & !3;
    let paint = |at: usize| (top - at) as *mut u32;
    // SAFETY: this is the unused part of the stack, of which the linker leaves far more; nothing
    // else runs.
    (4..DEPTH).step_by(4).for_each(|at| unsafe { write_volatile(paint(at), PAINT) });
    act();
    // SAFETY: as above.
    let used = (4..DEPTH).step_by(4).rev().find(|at| unsafe { read_volatile(paint(*at)) } != PAINT);
    used.map_or(0, |it| it + 256)
}
