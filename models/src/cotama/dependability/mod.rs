//! Dependability: what can fail (FMECA), how it shows (flags), and what is concluded (diagnosis).

#[macro_use]
mod rows;

mod adjustment;
mod diagnosis;
mod flags;
mod fmeca;
mod rule;
mod table;

pub use crate::severity::Persistence;
pub use adjustment::{Adjusted, Adjustment, Adjustments};
pub use diagnosis::{
    Diagnosis, Probe, Probes, ambiguity_groups, are_confusable, confusable_pairs, diagnose,
    is_detectable, shared_flags, undetectable, unwatched,
};
pub use flags::{Flag, Flags};
pub use rule::{Description, Rule, Signature};
pub use table::{FailureMode, FailureModes, RULES, TEXTS};
