//! The script of a run of a robot: what fails, and what the operator answers.

use cotama_core::units::{Millimetres, Millis};

/// Something that happens to a robot under way, once.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Incident {
    /// When; of what the operator answers by place.
    pub when: Moment,
    /// The kind of the incident.
    pub kind: IncidentKind,
}

/// When something happens. Moments are sorted by their kind, in this order, and then by their
/// number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Moment {
    /// The farthest place that the robot has reached along the path.
    Place(Millimetres),
    /// So long after the start.
    At(Millis),
    /// So long after a sub-objective, by its number, has started for the first time.
    During(usize, Millis),
    /// So long after the robot has waited for the operator for the first time.
    Waiting(Millis),
}

/// The kind of an incident.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum IncidentKind {
    /// Something fails.
    Failure {
        /// Number of the failure.
        failure: usize,
        /// When it ends, if not by itself or by a [`Repair`](Self::Repair).
        until: Option<Moment>,
    },
    /// The failure ends, if it is under way. What is lost stays lost.
    Repair(usize),
    /// A door of the floor of the mission opens or closes.
    Door {
        /// Number of the door.
        door: usize,
        /// Whether it opens.
        is_open: bool,
    },
    /// The operator answers the next request of the robot from there on.
    Operator {
        /// The answers, one after the other.
        answers: Vec<Answer>,
        /// The time before each of them.
        delay: Millis,
    },
}

/// An answer of the operator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Answer {
    /// He chooses one of his sub-objectives, by its number.
    Chooses(usize),
    /// He is done with it: the robot is at its goal, or goes on by itself. Where the robot moves he
    /// is done when it is at the goal.
    Done,
    /// He gives up: the mission ends.
    GivesUp,
}
