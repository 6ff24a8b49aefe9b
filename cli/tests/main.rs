//! The program as its users meet it: every test runs the binary.
//!
//! Golden files are written again by `UPDATE_GOLDEN=1 cargo test -p cotama`.
#![allow(clippy::unwrap_used)]

mod allocate;
mod asked;
mod assign;
mod axes;
mod axes_run;
mod bad_input;
mod book;
mod broken_pnml;
mod campaign;
mod campaign_kept;
mod campaign_said;
mod certificates;
mod check;
mod common;
mod conform;
mod engines;
mod errors;
mod estimate;
mod export;
mod file_schemas;
mod floor;
mod fmeca;
mod fmeca_measured;
mod fmeca_page;
mod help;
mod hints;
mod hostile;
mod idle_options;
mod logs;
mod mistakes;
mod models;
mod new;
mod next;
mod one_cause;
mod own_fmeca;
mod own_supervisor;
mod places;
mod plan;
mod questions;
mod recording;
mod reference;
mod replay;
mod risk;
mod robots;
mod run;
mod sarif;
mod schemas;
mod screens;
mod simulate;
mod special;
mod statespace;
mod team;
mod texts;
