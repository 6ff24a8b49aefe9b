//! The static library that C programs link: what `cotama-c` exports, and what to do on a panic.
//!
//! A project with nets of its own has a crate like this one beside its nets; see the module
//! `supervisor` of `cotama-c`.
#![no_std]

use core::panic::PanicInfo;
pub use cotama_c::*;

// SAFETY: the C library defines it with this type, and it may be called at any time.
#[cfg(all(not(target_os = "none"), not(feature = "panic-free")))]
unsafe extern "C" {
    /// Ends the program, as C's library has it.
    safe fn abort() -> !;
}

/// A panic is a mistake of ours. On a chip it stands still, and the hardware watchdog, which nobody
/// feeds any more, starts it anew; elsewhere the program is aborted.
#[cfg(not(feature = "panic-free"))]
#[panic_handler]
fn stop(_: &PanicInfo<'_>) -> ! {
    #[cfg(not(target_os = "none"))]
    abort();
    #[cfg(target_os = "none")]
    loop {
        core::hint::spin_loop();
    }
}

/// The compiler's own functions come with tables for unwinding, which name this function; nothing
/// here unwinds, so nobody calls it.
// SAFETY: no C library has a function of this name, and a program holds one library of Rust's.
#[cfg(not(target_os = "none"))]
#[unsafe(no_mangle)]
extern "C" fn rust_eh_personality() {}

// SAFETY: nothing defines it, so no program that could call it is ever linked.
#[cfg(feature = "panic-free")]
unsafe extern "C" {
    /// Is defined nowhere.
    safe fn a_panic_can_be_reached() -> !;
}

#[cfg(feature = "panic-free")]
#[panic_handler]
fn stop(_: &PanicInfo<'_>) -> ! {
    a_panic_can_be_reached()
}

/// Can panic.
// SAFETY: no other function of the program has this name.
#[cfg(feature = "canary")]
#[unsafe(no_mangle)]
pub extern "C" fn cotama_canary(index: usize) -> u8 {
    b"canary"[index]
}
