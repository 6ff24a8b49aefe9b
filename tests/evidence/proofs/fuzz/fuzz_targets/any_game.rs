//! A random net or system, and events and times for it, all from bytes: the player beside the plain
//! game of the textbook.
#![no_main]

#[path = "../../../../stories/players/by_the_book/mod.rs"]
#[allow(dead_code, unused_imports, reason = "the stories use more of it")]
mod by_the_book;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    by_the_book::plays(bytes);
});
