//! Recordings of runs for other tools: MCAP for Foxglove, Lichtblick and PlotJuggler, TUM poses
//! for evo, comma-separated values for all others; indicators of a run for `cotama risk`.
//!
//! Each is a pure function of a [`Trace`](cotama_sim::trace::Trace): the same trace gives the same
//! bytes, with the times of the run and no clock of a machine. Records of MCAP are written by hand
//! ([the format](https://mcap.dev/spec) has eleven that matter here), as a package for them brings
//! 34 others, none of which is used elsewhere.
//!
//! *Sensors.* A trace holds no readings: the flags of its failures are told. Scans and sonars are
//! those that a Hokuyo URG-04LX and the ring of a Pioneer 3-DX without faults read at the recorded
//! poses on the floor as it is.
#![cfg_attr(test, allow(clippy::pedantic, clippy::unwrap_used))]
#![allow(clippy::cast_precision_loss)] // amounts of a run and numbers of cells are below 2^53
#![allow(clippy::cast_sign_loss, clippy::cast_possible_truncation)] // sizes of a floor in cells

mod cdr;
mod container;
mod csv;
mod ground;
mod indicators;
mod log;
mod mcap;
mod messages;
mod schema;
mod sensors;
mod tum;

pub use csv::{COLUMNS, csv};
pub use indicators::{MAX_MOMENTS, indicators};
pub use mcap::{MAX_SCANS, mcap};
pub use tum::{Tum, tum};

use cotama_floor::{Pose, metres};
use cotama_sim::trace;
use std::fmt;

/// Why there is no recording of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoRecording {
    /// The robot was a point on its path, and had no poses.
    Line,
    /// The floor of the trace cannot be read.
    Floor(String),
    /// The sensors cannot be made.
    Sensors(String),
}

impl fmt::Display for NoRecording {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line => f.write_str("the run has no poses: the robot was a point on its path"),
            Self::Sensors(why) => write!(f, "the sensors cannot be made: {why}"),
            Self::Floor(why) => write!(f, "the floor of the trace cannot be read: {why}"),
        }
    }
}

impl std::error::Error for NoRecording {}

/// Returns where the robot was, in metres and radians.
fn true_pose(it: &trace::Pose) -> Pose {
    pose(it.at_mm, it.heading_mrad)
}

/// Returns the pose that odometry told, in metres and radians.
fn told(it: &trace::Pose) -> Pose {
    pose(it.odometry_mm, it.odometry_mrad)
}

fn pose(at_mm: [i32; 2], heading_mrad: i32) -> Pose {
    Pose::new(metres(at_mm).coords, f64::from(heading_mrad) / 1_000.0)
}
