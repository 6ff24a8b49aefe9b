//! Laws speak of what the player does: their verdicts against an explorer that calls the player
//! itself, and the programs that once were judged wrongly.
#![cfg(feature = "alloc")]

mod against_the_player;
mod by_the_player;
#[path = "../../../tests/common/draw.rs"]
#[allow(unreachable_pub)] // the tests across the crates read it too
mod draw;
mod limits;
mod missing;
mod programs;
mod random;
mod systems;
