//! The allocators against plain transcriptions of what they promise.

mod brute;
#[path = "../../../tests/common/draw.rs"]
#[allow(unreachable_pub)] // the tests across the crates read it too
mod draw;
mod exact;
mod front;
#[allow(unreachable_pub)] // as above
mod instances;
mod panorama;
#[allow(unreachable_pub)] // as above
mod solve;
