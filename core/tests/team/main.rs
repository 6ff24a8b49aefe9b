//! Who does what: answers against all answers, and what proves them.
#![allow(missing_docs, clippy::pedantic, clippy::unwrap_used)]

mod assignment;
#[path = "../common/draw.rs"]
#[allow(unreachable_pub)] // the tests across the crates read it too
mod draw;
mod effort;
#[path = "../common/effort.rs"]
#[allow(unreachable_pub)] // as above
mod efforts;
mod joint;
mod tables;
#[allow(unreachable_pub)] // benchmarks read it too
mod teams;
mod thesis;
