//! Assignments of robots: answers against all answers, and their proofs.
#![allow(missing_docs, clippy::pedantic, clippy::unwrap_used)]

mod assignment;
mod coalition;
#[path = "../../../tests/common/draw.rs"]
#[allow(unreachable_pub)] // the tests across the crates read it too
mod draw;
mod tables;
#[allow(unreachable_pub)] // benchmarks read it too
mod teams;
mod winners;
