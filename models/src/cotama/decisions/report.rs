//! The decision of the contextual supervisor, as a function: the same as the net
//! [`contextual`](crate::cotama::contextual), for firmware that needs no net for it and for tests
//! over every case.

use super::situation::{Loss, Losses, Situation};
use crate::cotama::members::members;
use crate::cotama::supervisors::{local, path_following, teleoperation};
use crate::severity::Class;

members! {
    /// A report of the GOM or a module to the contextual supervisor.
    Report,
    /// Reports.
    Reports(u16) {
        /// Localisation misses its deadline again and again.
        Slow = "slow",
        /// Localisation is lost, by a unique diagnosis.
        Mcl = "mcl",
        /// The sonars are lost.
        Sonar = "sonar",
        /// The operator's avoidance is lost, which path following uses in place of its own.
        Avoidance = "avoidance",
        /// The avoidance of path following is lost.
        Smz = "smz",
        /// Several diagnoses are possible, or the robot cannot judge alone: localisation, for one,
        /// is ambiguous.
        Ambiguous = "ambiguous",
        /// The robot touched something.
        Collision = "collision",
        /// Any other failure that is hard where it happens.
        Hard = "hard",
        /// Any other failure that is weak or medium where it happens, and takes nothing that runs.
        Minor = "minor",
        /// No path was found.
        Planner = "planner",
        /// The camera is lost.
        Camera = "camera",
        /// The link to the operator is lost.
        Wifi = "wifi",
        /// Power, micro-controller or motors are lost.
        Vital = "vital",
        /// The operator gives up, or does not answer in time.
        Refusal = "refusal",
    }
}

/// The answer to a report: which event goes to which supervisor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Decision {
    /// No decision beyond the record.
    Record,
    /// `adapt_rt` to the adapter of path following: fewer particles.
    AdaptRt,
    /// `adapt_mcl` to it: odometry in place of localisation.
    AdaptMcl,
    /// `adapt_sonar` to it: no avoidance, slower.
    AdaptSonar,
    /// `adapt_bump` to it: slower.
    AdaptBump,
    /// `adapt_smz` to it: the other avoidance.
    AdaptSmz,
    /// `adapt_avoidance` to it: no avoidance, slower.
    AdaptAvoidance,
    /// `adapt_minor` to it: a setting of a module changes, which one the failure says.
    AdaptMinor,
    /// `adapt_sonar` to the adapter of teleoperation.
    AdaptSonarTeleoperation,
    /// `adapt_minor` to it.
    AdaptMinorTeleoperation,
    /// `local_event` to the local supervisor.
    Local,
    /// `global_event` to the global supervisor.
    Global,
}

impl Decision {
    /// How strong it is.
    pub const fn class(self) -> Class {
        match self {
            Self::Record => Class::Record,
            Self::AdaptRt
            | Self::AdaptMcl
            | Self::AdaptSonar
            | Self::AdaptBump
            | Self::AdaptSmz
            | Self::AdaptAvoidance
            | Self::AdaptMinor
            | Self::AdaptSonarTeleoperation
            | Self::AdaptMinorTeleoperation => Class::Adapter,
            Self::Local => Class::Local,
            Self::Global => Class::Global,
        }
    }
}

impl Report {
    /// The loss that it tells of; none for what may pass.
    pub const fn loss(self) -> Option<Loss> {
        match self {
            Self::Avoidance => Some(Loss::Avoidance),
            Self::Smz => Some(Loss::Smz),
            Self::Mcl => Some(Loss::Mcl),
            Self::Sonar => Some(Loss::Sonar),
            Self::Camera => Some(Loss::Camera),
            Self::Wifi => Some(Loss::Wifi),
            Self::Vital => Some(Loss::Vital),
            Self::Slow
            | Self::Ambiguous
            | Self::Collision
            | Self::Hard
            | Self::Minor
            | Self::Planner
            | Self::Refusal => None,
        }
    }
}

/// Returns the losses once a report was answered: with its own loss, and with localisation when it
/// is too slow with the fewest particles, so that the next drive starts without it (inferred).
#[must_use]
pub const fn lost_after(report: Report, situation: Situation) -> Losses {
    let lost = match report.loss() {
        Some(loss) => situation.lost.with(loss),
        None => situation.lost,
    };
    match (report, adaptation(report, situation)) {
        (Report::Slow, Some(Decision::AdaptMcl)) => lost.with(Loss::Mcl),
        _ => lost,
    }
}

/// The decision: the table of the reconstruction, cell by cell. Total, also where the places do not
/// fit together.
///
/// Severity decides first (stated, Durand et al., TAROS 2010, Section V.B); the cells are inferred
/// from it and from what is still available, see [`by_rules`](crate::cotama::by_rules). A question
/// that no operator can answer is a global event.
///
/// ```
/// use cotama_models::cotama::{Decision, Loss, Losses, Report, Situation, decide};
/// use cotama_models::cotama::{local, path_following};
/// let driving = Situation {
///     local: local::State::Following,
///     following: path_following::State::Optimal,
///     ..Situation::AT_REST
/// };
/// assert_eq!(decide(Report::Sonar, driving), Decision::AdaptSonar);
/// assert_eq!(decide(Report::Ambiguous, driving), Decision::Local);
/// let alone = Situation { lost: Losses::of(&[Loss::Wifi]), ..driving };
/// assert_eq!(decide(Report::Ambiguous, alone), Decision::Global);
/// ```
pub const fn decide(report: Report, situation: Situation) -> Decision {
    use local::State::{Following, HandOver, Planning, Teleoperated, Teleprogrammed};
    let degraded = matches!(situation.following, path_following::State::Degraded);
    let place = situation.local;
    let asks_operator = match report {
        Report::Ambiguous => matches!(place, Planning | Following),
        Report::Collision => matches!(place, Planning) || degraded,
        Report::Hard => matches!(place, Planning | Following | Teleoperated),
        Report::Planner => matches!(place, Planning),
        Report::Camera => matches!(place, Teleoperated),
        _ => false,
    };
    let ends = match report {
        Report::Vital => true,
        Report::Wifi | Report::Refusal => matches!(place, HandOver | Teleprogrammed | Teleoperated),
        _ => asks_operator && situation.lost.has(Loss::Wifi),
    };
    match adaptation(report, situation) {
        _ if ends => Decision::Global,
        _ if asks_operator => Decision::Local,
        Some(adapted) => adapted,
        None => Decision::Record,
    }
}

/// Returns the decision that the running adapter can take on a report (the transitions of
/// [`path_following`] and [`teleoperation`]).
pub(super) const fn adaptation(report: Report, situation: Situation) -> Option<Decision> {
    use path_following::State as Adapter;
    let (adapter, level) = (situation.following, situation.level);
    let following = matches!(situation.local, local::State::Following);
    let degraded = matches!(adapter, Adapter::Degraded);
    match (report, adapter) {
        (Report::Slow, Adapter::Optimal | Adapter::Reduced | Adapter::Reactive) if level >= 1 => {
            Some(Decision::AdaptRt)
        }
        (Report::Slow, Adapter::Reduced | Adapter::Reactive)
        | (Report::Mcl, Adapter::Optimal | Adapter::Reduced | Adapter::Reactive) => {
            Some(Decision::AdaptMcl)
        }
        (Report::Smz, _) if following && !degraded => Some(Decision::AdaptSmz),
        (Report::Sonar, _) if following && !degraded => Some(Decision::AdaptSonar),
        (Report::Sonar | Report::Avoidance, _)
            if matches!(situation.teleoperation, teleoperation::State::Full) =>
        {
            Some(Decision::AdaptSonarTeleoperation)
        }
        (Report::Avoidance, Adapter::Reactive) => Some(Decision::AdaptAvoidance),
        (Report::Collision, _) if following && !degraded => Some(Decision::AdaptBump),
        (Report::Minor, _) if following => Some(Decision::AdaptMinor),
        (Report::Minor, _) if matches!(situation.local, local::State::Teleoperated) => {
            Some(Decision::AdaptMinorTeleoperation)
        }
        _ => None,
    }
}
