//! The answer for a supervised run: from each failure to the reaction. Failures are counted from 1,
//! in the order of `failures`.

#[cfg(test)]
use schemars::JsonSchema;
use serde::Serialize;

/// The actions of the supervisors.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct Supervised {
    /// The story in numbered points.
    pub(crate) points: Vec<Point>,
    /// The transitions that fired.
    pub(crate) fired: Vec<Fired>,
    /// Failures with their consequences, in the order of their happening.
    pub(crate) failures: Vec<Failure>,
    /// Which configuration ran from when on.
    pub(crate) configurations: Vec<Configured>,
    /// Events that the supervisors accepted, one a round.
    pub(crate) told: Vec<Told>,
}

/// A point of the story: the start, a failure, or what the operator does before the robot goes on
/// alone.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct Point {
    /// From 1.
    pub(crate) number: usize,
    pub(crate) t_ms: u64,
    pub(crate) x_mm: u64,
    /// Event, in words.
    pub(crate) text: String,
    /// Finding of the observers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) found: Option<String>,
    /// Decision, with its reason.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) decided: Option<String>,
    /// Reaction of the robot.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) done: Option<String>,
    /// How far up the reaction went: `parameter`, `set`, `activity`, `objective`, `mission`.
    pub(crate) ladder: Vec<&'static str>,
}

/// A transition that fired.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct Fired {
    pub(crate) t_ms: u64,
    /// `gs`, `ls`, `pf`, `to`, `permit`, `gom` or `cs`.
    pub(crate) net: String,
    pub(crate) transition: String,
    /// The place that is marked after it.
    pub(crate) place: String,
    /// The number of the failure that it goes back to; none for the mission and the operator.
    pub(crate) cause: Option<u16>,
}

/// A failure and its consequences. Times are since the start.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct Failure {
    /// The row of the FMECA.
    pub(crate) mode: String,
    pub(crate) t_ms: u64,
    pub(crate) x_mm: u64,
    /// The place of the local supervisor when it happened.
    pub(crate) during: String,
    /// When its flags were raised; none if nobody noticed it.
    pub(crate) detected_ms: Option<u64>,
    /// The flags.
    pub(crate) flags: Vec<String>,
    /// `unique`, `ambiguous` or `unexplained`.
    pub(crate) diagnosis: Option<&'static str>,
    /// The rows of the FMECA that explain the flags.
    pub(crate) candidates: Vec<String>,
    /// The report to the contextual supervisor.
    pub(crate) report: Option<String>,
    /// `weak`, `medium`, `hard` or `fatal`.
    pub(crate) severity: Option<&'static str>,
    /// The class by severity.
    pub(crate) by_severity: Option<&'static str>,
    /// The class by what is still available.
    pub(crate) by_availability: Option<&'static str>,
    pub(crate) decided_ms: Option<u64>,
    /// `record`, `adapter`, `local` or `global`.
    pub(crate) decision: Option<&'static str>,
    /// The event that the contextual supervisor sent.
    pub(crate) event: Option<String>,
    /// Transition.
    pub(crate) transition: Option<String>,
    /// When a supervisor first acted on it.
    pub(crate) answered_ms: Option<u64>,
    /// For how long, in all, the robot moved without a module that its configuration required and
    /// that this failure breaks.
    pub(crate) exposed_ms: u64,
}

/// A configuration.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct Configured {
    pub(crate) t_ms: u64,
    /// Configuration; none when none runs.
    pub(crate) configuration: Option<String>,
    /// The autonomy mode.
    pub(crate) mode: &'static str,
}

/// Something that the supervisors were told.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct Told {
    /// The number of the round after which, from 1.
    pub(crate) round: u64,
    /// The net and its event, as `operator.teleoperate`.
    pub(crate) event: String,
}
