//! The program as its users meet it: every test runs the binary.
//!
//! Golden files are written again by `UPDATE_GOLDEN=1 cargo test -p cotama`.
#![allow(clippy::unwrap_used)]

mod allocate;
mod assign;
mod bad_input;
mod book;
mod broken_pnml;
mod campaign;
mod certificates;
mod check;
mod common;
mod conform;
mod errors;
mod estimate;
mod export;
mod file_schemas;
mod fmeca;
mod help;
mod hints;
mod mistakes;
mod models;
mod new;
mod own_fmeca;
mod plan;
mod questions;
mod reference;
mod replay;
mod run;
mod schemas;
mod screens;
mod simulate;
mod statespace;
mod team;
