//! Every operation of the executor, for every model that ships, and every other public function of
//! core and of models that a target may call, linked against a panic that cannot be linked.
//!
//! The panic handler calls a function that exists nowhere. A root that links can therefore not
//! panic, in the code that this compiler made of it, whatever its arguments: markings, clocks and
//! stored bytes included. Overflow checks are on. There is no global allocator, so nothing here
//! needs a heap. A canary must not link. Of an `open` function the compiler cannot see that it does
//! not panic; it is listed so that none is forgotten.
#![no_std]
#![deny(missing_docs)]

#[cfg(feature = "canary-heap")]
extern crate alloc;

mod allocation;
mod canaries;
mod codes;
mod decider;
mod declared;
mod executive;
mod inference;
mod level;
mod models;
mod on_time;
mod readers;
mod systems;
mod tables;
mod team;
mod team_models;
mod units;

use core::panic::PanicInfo;

unsafe extern "C" {
    /// Is defined nowhere.
    safe fn a_panic_can_be_reached() -> !;
}

#[panic_handler]
fn stop(_: &PanicInfo<'_>) -> ! {
    a_panic_can_be_reached()
}
