//! Why a mission cannot be the subject of a campaign.

use cotama_sim::robots::{Undriven, Unmonitored};
use cotama_sim::run::NoPlan;
use cotama_sim::setup::SetupError;
use std::fmt;

/// Why a mission cannot be the subject of a campaign.
#[derive(Clone, Debug, PartialEq)]
pub enum Unready {
    /// The mission cannot be set up.
    Setup(SetupError),
    /// The supervisors of the robot's file cannot be played.
    Undriven(Undriven),
    /// The mission has no plan, even if nothing fails: the reason, and the same in words.
    NoPlan(NoPlan, String),
    /// A requirement is no property that can be watched: its text, and why.
    Property(String, Unmonitored),
    /// A requirement is about supervisors, and the mission has none: its text.
    Plain(String),
    /// A requirement is about teams, and the subject is none: its text.
    NoTeam(String),
}

impl fmt::Display for Unready {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Setup(error) => error.fmt(f),
            Self::Undriven(error) => error.fmt(f),
            Self::NoPlan(_, why) => write!(
                f,
                "there is no plan even if nothing fails: {why}\n  help: `cotama plan MISSION` says \
                 what weighs most, and what would help"
            ),
            Self::Property(text, why) => write!(f, "`{}`: {why}", text.escape_debug()),
            Self::NoTeam(text) => {
                write!(f, "`{}` is about teams, and the mission is none", text.escape_debug())
            }
            Self::Plain(text) => write!(
                f,
                "`{}` is about supervisors, and the mission has none",
                text.escape_debug()
            ),
        }
    }
}

impl std::error::Error for Unready {}
