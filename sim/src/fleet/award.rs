//! The award of a task to a coalition.

use cotama_core::team::RobotSet;

/// An award: which task, and of which round.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct AwardId {
    pub(super) task: usize,
    pub(super) round: u32,
}

/// The award of a task to a coalition.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Award {
    pub(super) id: AwardId,
    pub(super) plan: usize,
    /// The robot of each role.
    pub(super) robots: Vec<usize>,
    /// Largest cost of each role, in ms: beyond it the robot gives the task back.
    pub(super) pledges_ms: Vec<u64>,
    pub(super) members: RobotSet,
}
