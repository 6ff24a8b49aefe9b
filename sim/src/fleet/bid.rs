//! Bids, and the objects of tasks.

use cotama_models::team::scenario::Spot;
use cotama_models::team::{CapabilitySet, Probability, by_reliability};
use std::cmp::Ordering;

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
    /// Probability that no action fails, as the bidder takes it to be.
    pub(super) success: Probability,
    /// What the cost were if the bidder knew how often its skills fail; nobody in the team does.
    pub(super) known_ms: u32,
}

/// A robot in a role.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Member {
    pub(super) robot: usize,
    /// Cost, in ms.
    pub(super) cost_ms: u32,
    /// Probability that no action fails.
    pub(super) success: Probability,
}

/// A coalition that a broker bids.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Share {
    /// The task.
    pub(super) task: usize,
    /// The plan of it.
    pub(super) plan: usize,
    /// The robot of each role.
    pub(super) robots: Vec<Member>,
    /// Cost of the task, in parts.
    pub(super) cost: u64,
}

impl Share {
    /// Whether it is to be preferred to another one of the same cost (4.5.4): `Greater` where its
    /// least reliable member is more reliable.
    pub(super) fn is_more_reliable(&self, other: &Self) -> Ordering {
        let of = |it: &Self| it.robots.iter().map(|it| it.success).collect::<Vec<_>>();
        by_reliability(&mut of(self), &mut of(other))
    }
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
