//! Why a system cannot be made one net.

use super::MOST_TRANSITIONS;
use cotama_core::net::NetError;
use cotama_core::system::SystemError;
use cotama_property::PropertyError;
use std::fmt;

/// Why a system cannot be made one net.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FlatError {
    /// The system does not fit together.
    Defect(SystemError),
    /// The absence of tokens in a place without a bound decides whether an event is ignored.
    Unbounded {
        /// The place, as `net.place`.
        place: String,
    },
    /// The net would have more than [`MOST_TRANSITIONS`] transitions.
    TooMany,
    /// Conditions under which events are ignored are too many to compare; of interleavings alone.
    TooMuch,
    /// A net of a system whose rounds are asked for is not sound.
    Net {
        /// Name of the net in the system.
        net: String,
        /// The defect of the net.
        defect: NetError,
    },
    /// Rounds have no time, and this transition has an interval.
    Interval {
        /// The transition, as `net.transition`.
        transition: String,
    },
    /// A transition changes a place and not its declared complement, or the other way round.
    Complement {
        /// The place, as `net.place`.
        place: String,
        /// The transition, as `net.transition`.
        transition: String,
    },
    /// So many transitions of a net as [`SETTLE`](cotama_core::player::SETTLE) fire at once by
    /// themselves, one after another.
    Endless {
        /// The net.
        net: String,
    },
    /// The condition of an observer is not a formula about one marking that compares sums of
    /// tokens.
    Condition {
        /// The observer.
        observer: String,
    },
    /// The condition of an observer cannot be read.
    Text {
        /// The observer.
        observer: String,
        /// The error in the condition.
        error: Box<PropertyError>,
    },
}

impl fmt::Display for FlatError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Defect(defect) => write!(f, "the system does not fit together: {defect}"),
            Self::Unbounded { place } => {
                write!(
                    f,
                    "the absence of tokens in {place} decides whether an event is ignored: \
                     give the place a bound"
                )
            }
            Self::TooMany => {
                write!(f, "as one net it has more than {MOST_TRANSITIONS} transitions")
            }
            Self::TooMuch => write!(
                f,
                "events are ignored in too many ways: check the rounds, which tell fewer apart"
            ),
            Self::Net { net, defect } => write!(f, "the net {net} is not sound: {defect:?}"),
            Self::Interval { transition } => {
                write!(
                    f,
                    "rounds have no time, and {transition} has an interval: check the interleavings"
                )
            }
            Self::Complement { place, transition } => {
                write!(
                    f,
                    "{transition} changes {place} and does not change its complement to match"
                )
            }
            Self::Endless { net } => {
                write!(
                    f,
                    "the net {net} does not settle: \
                     its transitions without event fire again and again"
                )
            }
            Self::Text { observer, error } => write!(f, "the observer {observer}: {error}"),
            Self::Condition { observer } => {
                write!(
                    f,
                    "{observer} can only look at one marking, \
                     and compare sums of tokens of bounded places"
                )
            }
        }
    }
}

impl std::error::Error for FlatError {}
