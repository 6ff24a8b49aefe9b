//! Bids, and the objects of tasks.

use cotama_models::team::CapabilitySet;
use cotama_models::team::scenario::Spot;

/// The offer of a bidder for a role.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Offer {
    /// The task.
    pub(super) task: usize,
    /// The plan of it.
    pub(super) plan: usize,
    /// The role of that.
    pub(super) role: usize,
    /// Cost, in ms.
    pub(super) cost_ms: u32,
}

/// A coalition that a broker bids.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Share {
    /// The task.
    pub(super) task: usize,
    /// The plan of it.
    pub(super) plan: usize,
    /// The robot of each role, and what it costs there, in ms.
    pub(super) robots: Vec<(usize, u32)>,
    /// Cost of the task, in parts.
    pub(super) cost: u64,
}

/// The object of a task.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Object {
    pub(super) at: Whereabouts,
    /// The capabilities that cannot take it as it stands.
    pub(super) hidden: CapabilitySet,
}

/// The location of an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Whereabouts {
    Lies(Spot),
    Held(usize),
    Delivered,
}
