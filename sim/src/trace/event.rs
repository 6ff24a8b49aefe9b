//! Events of a run that no supervisor decides on.

use serde::{Deserialize, Serialize};

/// Something happened to the robot.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Event {
    /// When it was over, in µs.
    pub t_us: u64,
    /// Position, in mm.
    pub x_mm: u64,
    /// The event.
    pub event: Occurrence,
    /// The name of the random event that it comes from; none for those with a given place.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub random: Option<String>,
    /// The time that it took, in µs.
    pub lost_us: u64,
}

/// An event of the robot.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Occurrence {
    /// Something stood in the way.
    Obstacle {
        /// The time lost.
        delay_ms: u64,
    },
    /// Hardware failed.
    Fault {
        /// Name of the hardware.
        hardware: String,
        /// The units that were lost: no more than there were.
        units_lost: u8,
        /// The units that still work.
        units_left: u8,
    },
    /// Hardware works again.
    Repair {
        /// Name of the hardware.
        hardware: String,
        /// The units that came back: no more than were missing.
        units_back: u8,
        /// The units that work now.
        units_left: u8,
    },
    /// A door was closed, and the robot goes another way.
    Detour {
        /// Name of the door.
        door: String,
        /// The additional path.
        extra_mm: u64,
    },
    /// The position was wrong.
    Odometry {
        /// The additional path.
        extra_mm: u64,
    },
}
