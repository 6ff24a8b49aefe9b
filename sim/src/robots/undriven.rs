//! Missions that no supervisors drive.

use crate::setup::SetupError;
use cotama_core::monitor::MonitorError;
use cotama_core::system::SystemError;
use cotama_plane::NoCourse;

/// Why a mission is not driven by the supervisors of a robot's file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Undriven {
    /// The mission names no robot.
    Plain,
    /// The supervisors are too large to be played.
    TooLarge(SystemError),
    /// The limits cannot be watched.
    Unwatchable(MonitorError),
    /// The robot cannot drive over the floor.
    NoCourse(NoCourse),
    /// The devices of the robot cannot be made.
    NoSenses(String),
    /// The options are those of another mission.
    Foreign(SetupError),
}

impl std::fmt::Display for Undriven {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Plain => f.write_str("the mission names no robot that has a file"),
            Self::TooLarge(why) => write!(f, "the robot's supervisors cannot be played: {why}"),
            Self::NoCourse(why) => write!(f, "the robot cannot drive in the plane: {why}"),
            Self::NoSenses(why) => write!(f, "the robot cannot sense: {why}"),
            Self::Foreign(why) => why.fmt(f),
            Self::Unwatchable(why) => write!(f, "the limits cannot be watched: {why}"),
        }
    }
}

impl std::error::Error for Undriven {}
