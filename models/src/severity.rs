//! Severity of a failure, receiver of its event, duration.

/// Severity (stated, Durand et al., TAROS 2010, Section III.A). It depends on the autonomy mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// The sub-objective goes on nearly as before.
    Weak,
    /// The sub-objective goes on after an adaptation.
    Medium,
    /// The sub-objective does not go on without help.
    Hard,
    /// The mission cannot go on.
    Fatal,
}

impl Severity {
    /// All severities, from the weakest on.
    pub const ALL: [Self; 4] = [Self::Weak, Self::Medium, Self::Hard, Self::Fatal];

    /// Returns the class (stated, Sections III.C and V.B): weak and medium go to the adapter, hard
    /// to the local, fatal to the global supervisor.
    pub const fn class(self) -> Class {
        match self {
            Self::Weak | Self::Medium => Class::Adapter,
            Self::Hard => Class::Local,
            Self::Fatal => Class::Global,
        }
    }

    /// Returns the name in the FMECA.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Weak => "weak",
            Self::Medium => "medium",
            Self::Hard => "hard",
            Self::Fatal => "fatal",
        }
    }
}

/// Strength of a decision; the order is that of strength.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Class {
    /// Acknowledged and recorded.
    Record,
    /// The sub-objective goes on in another way.
    Adapter,
    /// The operator is asked.
    Local,
    /// The mission ends safely.
    Global,
}

impl Class {
    /// All classes, from the weakest on.
    pub const ALL: [Self; 4] = [Self::Record, Self::Adapter, Self::Local, Self::Global];

    /// Returns the class of an output of a contextual supervisor, the net that decides: all but
    /// two outputs go to an adapter.
    pub fn of_output(output: &str) -> Self {
        match output {
            "global_event" => Self::Global,
            "local_event" => Self::Local,
            _ => Self::Adapter,
        }
    }

    /// The stronger of two.
    #[must_use]
    pub const fn worse(self, other: Self) -> Self {
        if self as u8 >= other as u8 { self } else { other }
    }

    /// Returns the name in the FMECA: the supervisor that receives the event.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Record => "record",
            Self::Adapter => "adapter",
            Self::Local => "local",
            Self::Global => "global",
        }
    }
}

/// Duration of a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Persistence {
    /// Until repaired.
    Permanent,
    /// The failure passes.
    Transient,
    /// The failure comes and goes.
    Intermittent,
}

impl Persistence {
    /// Returns the name in the FMECA.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Permanent => "permanent",
            Self::Transient => "transient",
            Self::Intermittent => "intermittent",
        }
    }
}
