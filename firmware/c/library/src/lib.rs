//! The static library that C programs link: what `cotama-c` exports, and what to do on a panic.
//!
//! A project with nets of its own has a crate like this one beside its nets; see the module
//! `supervisor` of `cotama-c`.
#![no_std]

use core::panic::PanicInfo;
pub use cotama_c::*;

#[cfg(not(target_os = "none"))]
unsafe extern "C" {
    /// Ends the program, as C's library has it.
    safe fn abort() -> !;
}

/// A panic is a mistake of ours. On a chip it stands still, and the hardware watchdog, which nobody
/// feeds any more, starts it anew; elsewhere the program is aborted.
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
