//! People on the floor of a mission.

use super::way::Leg;
use cotama_core::units::{MillimetresPerSecond, Millis};

/// The people of a mission.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct People {
    /// How many walk between places that a seed draws.
    pub drawn: usize,
    /// The people who walk as the mission says.
    pub walkers: Vec<Walker>,
}

/// A person who walks from place to place, and from the last one to the first again.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Walker {
    /// The name, which also names the random numbers.
    pub id: String,
    /// The way to each place from the one before; to the first one from the last. Who has one place
    /// alone stands there.
    pub ways: Vec<Leg>,
    /// The speed; drawn for each walk where nothing is said.
    pub speed: Option<MillimetresPerSecond>,
    /// The time in each place; drawn where nothing is said.
    pub stays: Option<Millis>,
    /// The time of the first walk; until then the person stands in the first place.
    pub from: Millis,
    /// Whether the person goes out of the way of a robot, and otherwise waits before it.
    pub gives_way: bool,
}
