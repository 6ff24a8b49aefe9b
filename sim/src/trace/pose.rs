//! Poses of a run in the plane.

use serde::{Deserialize, Serialize};

/// Pose of the robot in the plane, in mm from the left lower corner of the floor; headings are
/// thousandths of a radian, counter-clockwise from the x axis.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Pose {
    /// When, in µs.
    pub t_us: u64,
    /// Position, in mm.
    pub x_mm: u64,
    /// The place.
    pub at_mm: [i32; 2],
    /// The heading.
    pub heading_mrad: i32,
    /// The place that its encoders tell.
    pub odometry_mm: [i32; 2],
    /// The heading that its encoders tell.
    pub odometry_mrad: i32,
    /// The place and the heading at which it believes to be, where it works them out itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub believed: Option<([i32; 2], i32)>,
    /// Voltage under load and current of its battery, in mV and mA, where its file has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub battery_mv_ma: Option<[u32; 2]>,
    /// The people around it, and things that are on no map.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub people_mm: Vec<[i32; 2]>,
}

/// Whether there are no people, which traces need not say.
#[allow(clippy::trivially_copy_pass_by_ref)] // as serde asks
pub(super) const fn is_none(people: &usize) -> bool {
    *people == 0
}
