//! What supervisors did in a run, and what became of each failure.

use cotama_core::units::{Millimetres, Millis};
use cotama_models::cotama::{Cause, Class, Diagnosis, FailureMode, Flags, Judged, local};

/// A transition of a supervisor that fired.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fired {
    /// When.
    pub at: Millis,
    /// The net, as `ls`.
    pub net: &'static str,
    /// The transition, as `l5`.
    pub transition: String,
    /// What it goes back to: 0, or the number of a failure in `conduct` of a run, from 1.
    pub cause: Cause,
}

/// What became of a failure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Conduct {
    /// What failed.
    pub mode: FailureMode,
    /// When.
    pub injected: Millis,
    /// Where the robot was then.
    pub x: Millimetres,
    /// Where the local supervisor was then.
    pub during: local::State,
    /// When its flags were raised, and what they were taken for.
    pub detected: Option<(Millis, Diagnosis)>,
    /// The flags, with those of other failures that were seen in the same period.
    pub flags: Flags,
    /// How it was judged when it was detected.
    pub judged: Option<Judged>,
    /// When the contextual supervisor had decided, and what.
    pub decided: Option<(Millis, Decided)>,
    /// When a supervisor first acted on it.
    pub answered: Option<Millis>,
    /// For how long, in all, the robot moved while its configuration required a module that this
    /// failure breaks.
    pub exposed: Millis,
}

/// What the contextual supervisor made of a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Decided {
    /// It is recorded.
    Record,
    /// An adapter changes parameters or modules.
    Adapter,
    /// The local supervisor asks the operator.
    Local,
    /// The global supervisor ends the mission.
    Global,
}

impl Decided {
    /// Its name: that of the class of the decision.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Record => Class::Record.name(),
            Self::Adapter => Class::Adapter.name(),
            Self::Local => Class::Local.name(),
            Self::Global => Class::Global.name(),
        }
    }
}

impl From<&str> for Decided {
    /// From the output of [`contextual`](cotama_models::cotama::contextual).
    fn from(output: &str) -> Self {
        match output {
            "global_event" => Self::Global,
            "local_event" => Self::Local,
            _ => Self::Adapter,
        }
    }
}
