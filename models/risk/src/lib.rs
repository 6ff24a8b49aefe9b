//! Bayesian networks of a robot's runs: learned, asked, and used to choose with a known risk
//! (Rohrmueller, dissertation, TU Munich 2011, chapter 4).

#![allow(clippy::cast_precision_loss)] // counts of rows and states are far below 2^53

mod bif;
mod coherence;
mod csv;
mod data;
mod discretise;
mod infer;
mod network;
mod quantile;
mod rows;
mod separation;
mod wrong;

pub use coherence::{Coherence, coherence};
pub use csv::Cells;
pub use data::{Data, MAX_STATES, MAX_VARIABLES, Variable};
pub use discretise::{Cuts, MAX_BINS, Rule, discretise};
pub use infer::{NoAnswer, Plan, Posterior, Scratch};
pub use network::{MAX_CELLS, Network, Node};
pub use quantile::{Convention, quantile};
pub use separation::OpenPath;
pub use wrong::Wrong;
