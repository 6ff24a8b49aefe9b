//! The contents of a row of the FMECA: the rule that firmware needs, and the words.

use super::adjustment::Adjustment;
use super::flags::Flags;
use crate::cotama::decisions::{Class, Report, Severity};
use crate::cotama::label::Label;
use crate::cotama::modules::{Modules, Resources};
use crate::severity::Persistence;

/// How a failure mode shows (inferred from its detection and its effect): it is possible while the
/// flags raised are all of `always` and some of `sometimes`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Signature {
    /// Flags that it always raises; none when nothing of the architecture sees it.
    pub always: Flags,
    /// Flags that it may raise too: effects that depend on the place, and detections of which one
    /// is enough.
    pub sometimes: Flags,
    /// The modules that have to be available for the failure to happen, or to matter.
    pub present: Modules,
    /// The modules that have to be unavailable for the failure to happen.
    pub absent: Modules,
}

/// The facts of a failure mode that a reaction needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rule {
    /// Modules that are faulty with it.
    pub faulty: Modules,
    /// Whether it is a fault of one module, whichever it is.
    pub one_module: bool,
    /// Resources that are lost with it.
    pub lost: Resources,
    /// Severity while the robot drives itself.
    pub autonomous: Severity,
    /// Severity while the operator drives.
    pub operator: Severity,
    /// The class of its event while the robot drives itself.
    pub class: Class,
    /// How long it stays.
    pub persistence: Persistence,
    /// How long its detection takes, in milliseconds.
    pub latency_ms: u32,
    /// The flags that show the failure.
    pub signature: Signature,
    /// The report to the contextual supervisor; none for what is recorded only. A report means in
    /// each mode what [`decide`](crate::cotama::decide) says. Hard faults without a report of their
    /// own ask for judgement: [`Report::Ambiguous`] (inferred).
    pub report: Option<Report>,
    /// The adjustment of an adapter, if the reaction is a setting.
    pub adjustment: Option<Adjustment>,
}

/// The words of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Description {
    /// The function that suffers.
    pub function: &'static str,
    /// The component that fails.
    pub component: &'static str,
    /// The failure.
    pub failure: &'static str,
    /// The cause.
    pub cause: &'static str,
    /// The effect.
    pub effect: &'static str,
    /// Modules lost, in words.
    pub modules: &'static str,
    /// The observer that sees it, in words.
    pub observer: &'static str,
    /// The detection.
    pub detection: &'static str,
    /// Why nothing of the architecture sees it, where nothing does.
    pub silent: Option<&'static str>,
    /// The reaction, in words.
    pub reaction: &'static str,
    /// Why nothing is changed on a failure that is detected: it is recorded, and the robot goes on.
    pub tolerated: Option<&'static str>,
    /// Mean time between failures, in thousandths of an hour.
    pub mtbf_mh: u32,
    /// How well the rate is known; stated: by a data sheet.
    pub rate_label: Label,
    /// Source of the rate.
    pub rate: &'static str,
    /// How the fault is injected in simulation.
    pub injection: &'static str,
}
