//! What happens during a run that only supervisors can deal with: failures that observers have to
//! find, and what the operator answers when the robot asks.

use crate::cotama::{Configuration, FailureMode};
use cotama_core::units::{Millimetres, Millis};

/// Something that happens once, at a place, to a supervised mission.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Incident {
    /// Where, by the path.
    pub x: Millimetres,
    /// What.
    pub kind: IncidentKind,
}

/// What happens.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum IncidentKind {
    /// Something fails; what that does to the signals is the business of who simulates it.
    Failure(FailureMode),
    /// It ends, if it is under way. Whether the module is used again is for the supervisors to say.
    Repair(FailureMode),
    /// The operator answers the next request of the robot from there on.
    Operator {
        /// The answers, one after the other: see [`Answer`].
        answers: Vec<Answer>,
        /// The time before each of them.
        delay: Millis,
    },
}

/// What the operator can do (Durand et al., TAROS 2010, Fig. 3). Asked, he drives or edits the path
/// or gives up; driving, he reaches the goal, or goes over to editing, or gives up; editing, he
/// gives way-points or a path, or gives up.
///
/// ```
/// use cotama_models::missions::faults::Answer;
/// assert_eq!(Answer::FIRST.iter().map(|it| it.name()).collect::<Vec<_>>(), [
///     "teleoperate", "teleprogram", "give_up",
/// ]);
/// assert_eq!(Answer::Teleprogram.next(), [Answer::Waypoints, Answer::Path, Answer::GiveUp]);
/// assert!(Answer::Goal.next().is_empty()); // the robot goes on
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Answer {
    /// He drives.
    Teleoperate,
    /// He edits way-points or a path.
    Teleprogram,
    /// He gives way-points: a path is planned again.
    Waypoints,
    /// He gives a path: it is followed.
    Path,
    /// He has driven the robot to the goal.
    Goal,
    /// He gives up.
    GiveUp,
}

impl Answer {
    /// The names in mission files, in the order of the enum.
    pub const NAMES: [&str; 6] =
        ["teleoperate", "teleprogram", "waypoints", "path", "goal", "give_up"];

    pub(crate) const ALL: [Self; 6] = [
        Self::Teleoperate,
        Self::Teleprogram,
        Self::Waypoints,
        Self::Path,
        Self::Goal,
        Self::GiveUp,
    ];

    /// Its name in mission files.
    pub const fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }

    /// What can follow it; nothing when the robot goes on, or stops, with it.
    pub const fn next(self) -> &'static [Self] {
        match self {
            Self::Teleoperate => &[Self::Goal, Self::Teleprogram, Self::GiveUp],
            Self::Teleprogram => &[Self::Waypoints, Self::Path, Self::GiveUp],
            Self::Waypoints | Self::Path | Self::Goal | Self::GiveUp => &[],
        }
    }

    /// What can come first.
    pub const FIRST: &[Self] = &[Self::Teleoperate, Self::Teleprogram, Self::GiveUp];

    pub(crate) const fn needs(self) -> Option<Configuration> {
        match self {
            Self::Teleoperate => Some(Configuration::TeleoperationDegraded),
            Self::Teleprogram => Some(Configuration::Teleprogramming),
            _ => None,
        }
    }
}
