//! Statistics of a probability after many runs.
//!
//! All of it assumes that runs are independent and drawn alike; which strategies draw so,
//! [`Strategy::estimates`](super::strategy::Strategy::estimates) says.

mod anytime;
mod beta;
mod interval;
mod pairs;
mod promise;
mod sequential;

pub use anytime::anytime;
pub use beta::{incomplete_beta, quantile};
pub use interval::{Interval, clopper_pearson, mean_interval, okamoto_runs};
pub use pairs::{Difference, mcnemar, paired_difference};
pub use promise::Promise;
pub use sequential::{Decision, Sprt, SprtError};
