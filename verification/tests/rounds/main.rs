//! A system as a net that acts in rounds: it does what a player does, and COTAMA's decisional level
//! keeps its properties in it.
//!
//! `UPDATE_GOLDEN=1` writes the tables in `tests/golden/rounds` anew; that of mutants with
//! `--ignored`.
#![allow(clippy::type_complexity, clippy::needless_for_each)]
#![allow(missing_docs)]

mod ace;
mod asked;
mod breaks;
mod cells;
mod conformance;
mod corrections;
mod delivery;
mod delivery_mutants;
#[allow(unreachable_pub, reason = "the file is public where it is a crate's")]
mod drawn;
mod liveness;
mod logs;
mod mutants;
mod mutations;
#[allow(nonstandard_style, reason = "names are those of a robot's file")]
mod printed_robot;
mod reactions;
mod reconstruction;
mod recorded;
mod recovering;
mod responses;
mod robots;
mod shared;
mod steps;

/// Compares a table with the one that is kept.
fn golden(name: &str, text: &str) {
    cotama_golden::compare(std::path::Path::new("tests/golden/rounds").join(name), text);
}
