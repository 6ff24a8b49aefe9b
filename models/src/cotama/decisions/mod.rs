//! Decisions as functions: what the contextual supervisor decides on a report, and the two rules
//! behind it, by severity and by what is left available.

mod report;
mod severity;
mod situation;

pub use crate::severity::{Class, Severity};
pub use report::{Decision, Report, Reports, decide, lost_after};
pub use severity::{by_availability, by_rules, by_severity, is_settled, judge, severity};
pub use situation::{Loss, Losses, Situation};
