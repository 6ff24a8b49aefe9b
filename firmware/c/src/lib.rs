//! Cotama from C: supervisors, the decisional level, allocation.
//!
//! `include/cotama.h` is made of this crate by cbindgen, `include/cotama_robot.h` of a robot's file
//! by the build script; the package `library` beside it is the static library that C links. A C
//! program that runs a supervisor, the decisional level and the allocator is `example.c`.
//!
//! - *Memory* is the caller's: a handle lies where the caller says, in a number of bytes that the
//!   header names. There is no heap, and nothing is kept anywhere else.
//! - *Errors* are numbers, and whoever gets one finds everything as it was. Null pointers,
//!   misaligned, short or overlapping memory, handles that were never started, and numbers out of
//!   range are refused. That an address points to memory of the length that the caller says cannot
//!   be checked.
//! - *Threads*: a handle is for one thread at a time, as its functions say; two handles know
//!   nothing of each other.
//!
//! This is the one crate of the project with unsafe code, and holds nothing else: each function
//! checks what it is given and calls the crate that does the work.
#![no_std]

pub mod allocation;
pub mod error;
pub mod failures;
pub mod firings;
pub mod level;
pub mod memory;
pub mod monitor;
pub mod names;
pub mod robot;
pub mod supervisor;
pub mod tables;
pub mod ticks;
pub mod told;
pub mod watchdog;

/// The version of this header, as numbers. Programs made with one minor version of 0 need a library
/// of that one.
pub const COTAMA_VERSION_MAJOR: u32 = 0;
/// See [`COTAMA_VERSION_MAJOR`].
pub const COTAMA_VERSION_MINOR: u32 = 1;
/// See [`COTAMA_VERSION_MAJOR`].
pub const COTAMA_VERSION_PATCH: u32 = 0;

const _: () = {
    assert!(is(env!("CARGO_PKG_VERSION_MAJOR"), COTAMA_VERSION_MAJOR));
    assert!(is(env!("CARGO_PKG_VERSION_MINOR"), COTAMA_VERSION_MINOR));
    assert!(is(env!("CARGO_PKG_VERSION_PATCH"), COTAMA_VERSION_PATCH));
};

/// Whether these digits are this number.
const fn is(digits: &str, number: u32) -> bool {
    let (mut read, mut at) = (0, 0);
    while at < digits.len() {
        read = 10 * read + (digits.as_bytes()[at] - b'0') as u32;
        at += 1;
    }
    read == number
}

/// The version of the library: the major number times 65,536, and the minor one times 256, and the
/// patch.
// SAFETY: no other function of the program has this name.
#[unsafe(no_mangle)]
pub extern "C" fn cotama_version() -> u32 {
    COTAMA_VERSION_MAJOR << 16 | COTAMA_VERSION_MINOR << 8 | COTAMA_VERSION_PATCH
}
