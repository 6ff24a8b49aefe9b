//! Bayesian networks of a robot's runs: learned, asked, and used to choose with a known risk
//! (Rohrmueller, dissertation, TU Munich 2011, chapter 4).
//!
//! Runs are a table of discrete values ([`Data`], [`discretise`]). A structure is learned by
//! [`exact`] search, which proves that none scores higher, or by [`k2`], [`hill`] and [`chain`],
//! which do not; [`Counts`] give it its probabilities. A [`Network`], learned or read, is asked for
//! [posteriors](Network::infer), for [what tells of what](Network::open_path), and for how strongly
//! two variables [hang together](coherence()). A [`Model`] of trials that may fail chooses a way by
//! a mean or a quantile of its cost.
//!
//! ```
//! use cotama_risk::{Constraints, Counts, Families, Limits, Network, Score, exact};
//!
//! let (asia, _) = Network::from_bif(cotama_risk::EMBEDDED[1].2).unwrap();
//! let data = asia.sample(2_000, 1).unwrap();
//! let mut families = Families::new(&data, Score::Bic);
//! let none = Constraints::none(8).unwrap();
//! let best = exact(&mut families, &none, Limits::default()).unwrap();
//! let net = Counts::new(&data, &best.dag, None).unwrap().network("learned", 1.0).unwrap();
//! let (lung, seen) = (net.variable("lung").unwrap(), net.state("xray", "yes").unwrap());
//! assert!(net.infer(lung, &[seen]).unwrap().posterior[1] > 0.3);
//! ```

#![allow(clippy::cast_precision_loss)] // counts of rows and states are far below 2^53

mod bif;
mod choose;
mod coherence;
mod csv;
mod dag;
mod data;
mod discretise;
mod embedded;
mod fixed;
mod infer;
mod learn;
mod network;
mod parameters;
mod picture;
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
pub use data::{Data, MAX_ROWS, MAX_STATES, MAX_VARIABLES, Variable};
pub use discretise::{Cuts, MAX_BINS, Rule, discretise};
pub use embedded::{EMBEDDED, TWO_WAYS};
pub use fixed::Fixed;
pub use infer::{NoAnswer, Plan, Posterior, Scratch};
pub use learn::{
    ArcCounts, Chain, Constraints, Exact, Families, Limits, Score, TooMuch, Wish, bootstrap, chain,
    exact, hill, k2, memory, upper_bound,
};
pub use network::{MAX_CELLS, Network, Node};
pub use parameters::Counts;
pub use quantile::{Convention, quantile};
pub use separation::OpenPath;
pub use wrong::Wrong;
