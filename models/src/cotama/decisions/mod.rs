//! Decisions as functions: what the contextual supervisor decides on a report, and the two rules
//! behind it, by severity and by what is left available.

mod report;
mod severity;
mod situation;

pub use report::{Class, Decision, Report, Reports, decide, lost_after};
pub use severity::{Severity, by_availability, by_rules, by_severity, is_settled, judge, severity};
pub use situation::{Loss, Losses, Situation};
