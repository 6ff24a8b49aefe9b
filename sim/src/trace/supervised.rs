//! The records of a mission's supervisors in its trace (Durand et al., TAROS 2010): the chain from
//! a failure to a reaction.
//!
//! Failures have numbers from 1 in the order of their happening; `cause` and `failure` are such
//! numbers.

use cotama_models::severity::{Class, Severity};
use serde::{Deserialize, Serialize};

/// A transition of a supervisor fired.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Fired {
    /// When, in µs.
    pub t_us: u64,
    /// Position, in mm.
    pub x_mm: u64,
    /// The net, by its name in the system of supervisors, as `ls`.
    pub net: String,
    /// The transition.
    pub transition: String,
    /// The place of the net that is marked after it.
    pub place: String,
    /// The failure that it goes back to; none for what the mission or the operator caused.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cause: Option<u16>,
    /// The setting that is made, in words.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sets: Option<String>,
    /// The mask that is made now, or on the operator's order, in words.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub masks: Option<String>,
}

impl Fired {
    /// The line of the net's definition: the transition without the variant of a counter or a
    /// group, as `as2`.
    pub fn line(&self) -> &str {
        self.transition.split('.').next().unwrap_or_default()
    }
}

/// The supervisors were told something, and it was accepted.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Told {
    /// When, in µs.
    pub t_us: u64,
    /// Position, in mm.
    pub x_mm: u64,
    /// The number of the round after which, from 1.
    pub round: u64,
    /// The event: its net and name, as `operator.teleoperate`.
    pub event: String,
}

/// Something failed; nobody has noticed it yet.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Failure {
    /// When, in µs.
    pub t_us: u64,
    /// Position, in mm.
    pub x_mm: u64,
    /// Number of the failure.
    pub failure: u16,
    /// The row of the FMECA, as `SON1`.
    pub mode: String,
    /// The same in words, where the row is one of a robot's file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub what: Option<String>,
    /// The place of the local supervisor.
    pub during: String,
}

/// Flags were raised, and taken for something.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Diagnosis {
    /// When, in µs.
    pub t_us: u64,
    /// Position, in mm.
    pub x_mm: u64,
    /// The failures that raised them.
    pub failures: Vec<u16>,
    /// The flags.
    pub flags: Vec<String>,
    /// The rows of the FMECA that explain the flags: one is a unique diagnosis, several are an
    /// ambiguous one, none is an unexplained one.
    pub candidates: Vec<String>,
    /// The report to the contextual supervisor; none for what is recorded only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub report: Option<String>,
    /// How severe it is where the robot is.
    #[serde(with = "crate::named")]
    pub severity: Severity,
    /// The class by severity.
    #[serde(with = "crate::named")]
    pub by_severity: Class,
    /// The class by what is still available.
    #[serde(with = "crate::named")]
    pub by_availability: Class,
}

/// The contextual supervisor decided on a failure for the first time.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Decision {
    /// When, in µs.
    pub t_us: u64,
    /// Position, in mm.
    pub x_mm: u64,
    /// The failure.
    pub failure: u16,
    /// The receiver.
    #[serde(with = "crate::named")]
    pub decision: Class,
    /// The event that it sends; none when it records only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub event: Option<String>,
    /// The transition of the contextual supervisor.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub transition: Option<String>,
    /// The time since the failure, in ms.
    pub since_ms: u64,
}

/// The robot has moved while its configuration required a module that a failure breaks; written
/// when that is over.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Exposure {
    /// When it was over, in µs.
    pub t_us: u64,
    /// Position, in mm.
    pub x_mm: u64,
    /// The failure.
    pub failure: u16,
    /// For how long, in all since the failure, in ms.
    pub exposed_ms: u64,
}

/// The autonomy mode: the decider of the robot's motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Autonomy {
    /// The robot.
    Autonomous,
    /// Nobody yet: the robot stands and has asked.
    HandOver,
    /// The operator, by way-points; the robot stands.
    Teleprogrammed,
    /// The operator, by hand.
    Teleoperated,
}

impl Autonomy {
    /// All modes.
    pub const ALL: [Self; 4] =
        [Self::Autonomous, Self::HandOver, Self::Teleprogrammed, Self::Teleoperated];

    /// Returns the name in traces.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Autonomous => "autonomous",
            Self::HandOver => "hand-over",
            Self::Teleprogrammed => "teleprogrammed",
            Self::Teleoperated => "teleoperated",
        }
    }
}

/// The module status vector has changed (Durand et al., TAROS 2010, Section V.A.3): what is known
/// to be lost, and the modules that do not work without it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Status {
    /// When, in µs.
    pub t_us: u64,
    /// Position, in mm.
    pub x_mm: u64,
    /// The hardware and the modules that are known to be lost.
    pub lost: Vec<String>,
    /// The modules that need one of them, and do not work.
    pub without: Vec<String>,
}

/// Other modules run from now on.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Configured {
    /// When, in µs.
    pub t_us: u64,
    /// Position, in mm.
    pub x_mm: u64,
    /// The configuration, as `PF.OPT`; none when none runs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub configuration: Option<String>,
    /// The autonomy mode.
    #[serde(with = "crate::named")]
    pub mode: Autonomy,
}
