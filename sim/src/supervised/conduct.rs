//! The conduct of supervisors in a run, failure by failure.

use cotama_core::units::{Millimetres, Millis};
use cotama_models::cotama::{Cause, Class, Diagnosis, FailureMode, Flags, Judged, local};

/// A transition of a supervisor that fired.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fired {
    /// Time of the firing.
    pub at: Millis,
    /// The net, as `ls`.
    pub net: &'static str,
    /// The transition, as `l5`.
    pub transition: String,
    /// The cause: 0, or the number of a failure in `conduct` of a run, from 1.
    pub cause: Cause,
}

/// The conduct on a failure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Conduct {
    /// The failure mode.
    pub mode: FailureMode,
    /// Time of the failure.
    pub injected: Millis,
    /// Position of the robot then.
    pub x: Millimetres,
    /// State of the local supervisor then.
    pub during: local::State,
    /// When its flags were raised, and what they were taken for.
    pub detected: Option<(Millis, Diagnosis)>,
    /// The flags, with those of other failures that were seen in the same period.
    pub flags: Flags,
    /// How it was judged when it was detected.
    pub judged: Option<Judged>,
    /// When the contextual supervisor had decided, and what.
    pub decided: Option<(Millis, Class)>,
    /// When a supervisor first acted on it.
    pub answered: Option<Millis>,
    /// For how long, in all, the robot moved while its configuration required a module that this
    /// failure breaks.
    pub exposed: Millis,
}
