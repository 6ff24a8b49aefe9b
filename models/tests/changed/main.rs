//! Changed inputs: files with a few words, numbers or lines changed, and drawn situations, teams
//! and failures. All that is said, computed and planned then is in `tests/golden/changed_*.txt` as
//! counts and digests; `UPDATE_GOLDEN=1 cargo test -p cotama-models --test changed` writes them.
#![cfg(feature = "std")]

mod capabilities;
mod decided;
#[path = "../../../core/tests/common/draw.rs"]
#[allow(unreachable_pub)] // core's tests read it too
mod draw;
#[path = "../../../core/tests/common/effort.rs"]
#[allow(unreachable_pub)] // as above
mod efforts;
mod files;
mod health;
mod limits;
mod nets;

use draw::Draw;

/// A number below this one.
fn below(draw: &mut Draw, end: usize) -> usize {
    draw.between(0, end as u64 - 1) as usize
}

/// One of these.
fn pick<'a, T>(draw: &mut Draw, from: &'a [T]) -> &'a T {
    &from[below(draw, from.len())]
}

/// True in so many of a hundred cases.
fn chance(draw: &mut Draw, percent: u64) -> bool {
    draw.between(1, 100) <= percent
}
