//! Indicators of a robot at a moment.

use core::f64::consts::{PI, TAU};
use cotama_floor::{Field, Point, Pose, Vector};
use std::fmt::Write;

/// The columns, in the order of table 4.1 of Rohrmueller 2011.
pub const COLUMNS: [&str; 10] = [
    "map_uncertainty",
    "pose_uncertainty",
    "map_information",
    "path_length",
    "waypoints",
    "angle_variance",
    "angle_sum",
    "voronoi_waypoints",
    "speed",
    "heading_variance",
];

/// Samples from which a variance is taken; the thesis does not say how many.
pub const WINDOW: usize = 10;

/// The indicators of a moment, in the order of [`COLUMNS`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample(pub [f64; 10]);

/// Writes samples as CSV, for `cotama risk discretise`.
pub fn to_csv(samples: &[Sample]) -> String {
    let mut text = COLUMNS.join(",") + "\n";
    for Sample(values) in samples {
        for (at, value) in values.iter().enumerate() {
            let comma = if at > 0 { "," } else { "" };
            let _ = write!(text, "{comma}{value:.6}");
        }
        text.push('\n');
    }
    text
}

/// Indicators of a planned path as a robot at a pose sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OfPath {
    /// Length, in metres.
    pub(crate) length: f64,
    /// Waypoints per metre of the straight line to the goal.
    pub(crate) waypoints: f64,
    /// Angle between heading and next waypoint (eq. 4.15).
    pub(crate) angle: f64,
    /// Sum of the angles between consecutive legs, from the heading on (eq. 4.16).
    pub(crate) angle_sum: f64,
    /// Number of waypoints around which there is nowhere more room.
    pub(crate) voronoi: f64,
}

impl OfPath {
    /// The corners of a path that begins where the robot is.
    pub(crate) fn new(points: &[Point], pose: &Pose, room: &Field) -> Self {
        let mut heading = pose.rotation.angle();
        let mut angles = points.windows(2).map(|ends| {
            let way = ends[1] - ends[0];
            let next = libm::atan2(way.y, way.x);
            let angle = between(next, heading);
            heading = next;
            angle
        });
        let angle = angles.next().unwrap_or(0.0);
        let angle_sum = angle + angles.sum::<f64>();
        let straight = points.first().zip(points.last()).map_or(0.0, |it| (it.1 - it.0).norm());
        let later = points.get(1..).unwrap_or_default();
        let is_clear = |at: &&Point| {
            let here = room.at(**at);
            let around = (0..8).map(|it| {
                let (sin, cos) = libm::sincos(f64::from(it) * TAU / 8.0);
                room.at(**at + Vector::new(cos, sin) * 0.3)
            });
            around.into_iter().all(|it| it <= here + 0.1)
        };
        Self {
            length: points.windows(2).map(|ends| (ends[1] - ends[0]).norm()).sum(),
            waypoints: later.len() as f64 / straight.max(0.5),
            angle,
            angle_sum,
            voronoi: later.iter().filter(is_clear).count() as f64,
        }
    }
}

/// The angle between two directions, from 0 to π.
pub(crate) fn between(a: f64, b: f64) -> f64 {
    let off = (a - b).rem_euclid(TAU);
    if off > PI { TAU - off } else { off }
}

/// The variance of numbers.
pub(crate) fn variance(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let count = values.clone().count().max(1) as f64;
    let mean = values.clone().sum::<f64>() / count;
    values.map(|it| (it - mean) * (it - mean)).sum::<f64>() / count
}
