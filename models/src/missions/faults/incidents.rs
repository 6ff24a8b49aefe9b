//! Incidents of a run that only supervisors can deal with: failures that observers have to find,
//! and answers of the operator to requests of the robot.

use crate::cotama::{Configuration, FailureMode, Module, local, recovering};
use cotama_core::units::{Millimetres, Millis};

/// Something that happens once to a supervised mission.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Incident {
    /// When; of what is no failure, by place.
    pub when: Moment,
    /// The kind of the incident.
    pub kind: IncidentKind,
}

/// When something happens to a supervised mission. Moments are sorted by their kind, in this order,
/// and then by their number.
///
/// ```
/// use cotama_core::units::{Millimetres, Millis};
/// use cotama_models::cotama::local::State;
/// use cotama_models::missions::faults::Moment;
/// let asked = Moment::During(State::HandOver, Millis(500));
/// assert_eq!(asked.to_string(), "0.500 s after HandOver is first reached");
/// assert_eq!(Moment::Place(Millimetres(5_000)).to_string(), "at 5.0 m");
/// assert_eq!(Moment::At(Millis(20_000)).to_string(), "at 20.000 s");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Moment {
    /// The farthest place that the robot has reached along the path.
    Place(Millimetres),
    /// So long after the start.
    At(Millis),
    /// So long after the local supervisor has come to a place for the first time.
    During(local::State, Millis),
    /// So long after a transition of the supervisors has fired for the first time.
    Fired(Act, Millis),
}

/// A transition of the supervisors. Those of the global one are its mission's, and are not named.
///
/// ```
/// use cotama_models::missions::faults::Act;
/// let revoked = Act::named("permit.revoked").unwrap();
/// assert_eq!((revoked.net, revoked.transition), ("permit", "revoked"));
/// assert!(Act::all().any(|it| it == revoked));
/// assert_eq!(Act::named("gs.g1"), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Act {
    /// The net.
    pub net: &'static str,
    /// Name of the transition.
    pub transition: &'static str,
}

impl Act {
    /// All, in the order of the nets.
    pub fn all() -> impl Iterator<Item = Self> + Clone {
        let of_supervisors = |net: &str| !["gs", "faults", "operator"].contains(&net);
        let components = recovering::SYSTEM.components.iter();
        components.filter(move |it| of_supervisors(it.name)).flat_map(|it| {
            let transitions = it.net.transitions.iter();
            transitions.map(|transition| Self { net: it.name, transition: transition.name })
        })
    }

    /// The one of this name, as `permit.revoked`.
    pub fn named(name: &str) -> Option<Self> {
        let (net, transition) = name.split_once('.')?;
        Self::all().find(|it| it.net == net && it.transition == transition)
    }
}

impl std::fmt::Display for Act {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}.{}", self.net, self.transition)
    }
}

impl Moment {
    /// The places of the local supervisor that a moment can name, with their names.
    pub const STATES: [(&'static str, local::State); 5] = [
        ("Planning", local::State::Planning),
        ("Following", local::State::Following),
        ("HandOver", local::State::HandOver),
        ("Teleprogrammed", local::State::Teleprogrammed),
        ("Teleoperated", local::State::Teleoperated),
    ];

    /// The name of a place of the local supervisor; none for those at rest.
    pub fn state_name(state: local::State) -> Option<&'static str> {
        Self::STATES.iter().find(|it| it.1 == state).map(|it| it.0)
    }

    /// Returns the sort key of a moment.
    pub fn key(self) -> (u8, u64) {
        match self {
            Self::Place(x) => (0, x.0),
            Self::At(time) => (1, time.0),
            Self::During(state, after) => (2 + state as u8, after.0),
            Self::Fired(_, after) => (u8::MAX, after.0),
        }
    }
}

impl std::fmt::Display for Moment {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let seconds = |it: Millis| format!("{}.{:03} s", it.0 / 1_000, it.0 % 1_000);
        match *self {
            Self::Place(x) => write!(f, "at {}.{} m", x.0 / 1_000, x.0 / 100 % 10),
            Self::At(time) => write!(f, "at {}", seconds(time)),
            Self::During(state, after) => {
                let name = Self::state_name(state).unwrap_or("rest");
                write!(f, "{} after {name} is first reached", seconds(after))
            }
            Self::Fired(act, after) => write!(f, "{} after {act} first fires", seconds(after)),
        }
    }
}

/// The kind of an incident.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum IncidentKind {
    /// Something fails; what that does to the signals is the business of who simulates it.
    Failure {
        /// The failure mode.
        mode: FailureMode,
        /// Which module, if it is a failure of one module, whichever it is; of avoidance if none.
        part: Option<Module>,
        /// When it ends, if not by itself or by a [`Repair`](Self::Repair).
        until: Option<Moment>,
    },
    /// The failure ends, if it is under way. Whether the module is used again is for the
    /// supervisors to say.
    Repair(FailureMode),
    /// The operator answers the next request of the robot from there on.
    Operator {
        /// The answers, one after the other: see [`Answer`].
        answers: Vec<Answer>,
        /// The time before each of them.
        delay: Millis,
    },
}

/// An answer of the operator (Durand et al., TAROS 2010, Section V.C.2). Asked, he drives or edits
/// the path or gives up; driving, he reaches the goal, or goes over to editing, or gives up;
/// editing, he gives way-points or a path, or gives up.
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

    /// Returns the name in mission files.
    pub const fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }

    /// Returns the answers that can follow this one; none when the robot goes on, or stops, with
    /// it.
    pub const fn next(self) -> &'static [Self] {
        match self {
            Self::Teleoperate => &[Self::Goal, Self::Teleprogram, Self::GiveUp],
            Self::Teleprogram => &[Self::Waypoints, Self::Path, Self::GiveUp],
            Self::Waypoints | Self::Path | Self::Goal | Self::GiveUp => &[],
        }
    }

    /// The answers that can come first.
    pub const FIRST: &[Self] = &[Self::Teleoperate, Self::Teleprogram, Self::GiveUp];

    pub(crate) const fn needs(self) -> Option<Configuration> {
        match self {
            Self::Teleoperate => Some(Configuration::TeleoperationDegraded),
            Self::Teleprogram => Some(Configuration::Teleprogramming),
            _ => None,
        }
    }
}
