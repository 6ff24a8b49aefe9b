//! Bayesian networks of a robot's runs: learned, asked, and used to choose with a known risk
//! (Rohrmueller, dissertation, TU Munich 2011, chapter 4).

#![allow(clippy::cast_precision_loss)] // counts of rows and states are far below 2^53

mod bif;
mod choose;
mod coherence;
mod csv;
mod dag;
mod data;
mod discretise;
mod dot;
mod infer;
mod learn;
mod network;
mod parameters;
mod quantile;
mod rows;
mod separation;
mod wrong;

pub use choose::{
    Estimate, Knows, Measure, Memory, Model, Names, Rule as ChoiceRule, Seen, expected_reward,
    optimal_reward,
};
pub use coherence::{Coherence, coherence};
pub use csv::Cells;
pub use dag::{Dag, MAX_LEARNED, dags};
pub use data::{Data, MAX_STATES, MAX_VARIABLES, Variable};
pub use discretise::{Cuts, MAX_BINS, Rule, discretise};
pub use infer::{NoAnswer, Plan, Posterior, Scratch};
pub use learn::{
    Chain, Constraints, Exact, Families, Limits, Score, TooMuch, Wish, chain, exact, hill, k2,
    memory, upper_bound,
};
pub use network::{MAX_CELLS, Network, Node};
pub use parameters::Counts;
pub use quantile::{Convention, quantile};
pub use separation::OpenPath;
pub use wrong::Wrong;
