//! A system as a net that acts in rounds: it does what a player does, and COTAMA's decisional level
//! keeps its properties in it.
#![allow(clippy::type_complexity, clippy::needless_for_each)]
#![allow(missing_docs)]

mod ace;
mod asked;
mod conformance;
mod delivery;
#[allow(unreachable_pub, reason = "the file is public where it is a crate's")]
mod drawn;
mod liveness;
mod logs;
mod mutants;
mod mutations;
#[allow(nonstandard_style, reason = "names are those of a robot's file")]
mod printed_robot;
mod reconstruction;
mod recorded;
mod responses;
mod robots;
mod shared;
mod steps;
