//! Indicators of a robot at work: how sure it is of its map and its pose, how winding its path is,
//! how it drives (Rohrmueller, dissertation, TU Munich 2011, table 4.1).
//!
//! [`drive`] lets a robot localise itself, map, plan and avoid people on the way between the places
//! of a floor, and samples ten indicators twice a second. [`to_csv`] makes a table of them, for
//! `cotama risk discretise`, `learn` and `coherence`. [`follow`] does the same of a run that was
//! recorded. Two floors come with it, [`SIDEWALK`] and [`PLAZA`], like the two situations of the
//! thesis.
//!
//! # Readings
//! - Map uncertainty and information are those of the 10 m by 10 m around the robot, of cells that
//!   were seen (the thesis sums over a map that holds no others). The map has cells of 0.1 m.
//! - Information is divided by the number of these cells; the thesis does not say its divisor.
//! - Pose uncertainty is the entropy of a normal distribution with the covariance of the particles,
//!   averaged over the way to the goal.
//! - Variances are of the last [`WINDOW`] samples.
//! - Waypoints are those of the planned path, per metre of the straight line; those of maximum
//!   clearance have nowhere more room within 0.3 m, in place of nodes of a Voronoi graph.
//!
//! ```
//! use cotama_indicators::{COLUMNS, Options, SIDEWALK, drive_on, to_csv};
//! let floor = SIDEWALK.floor().unwrap();
//! let options = Options { seed: 1, people: 4, seconds: 10 };
//! let samples = drive_on(&floor, &options).unwrap();
//! assert_eq!(samples.len(), 20 - 10 + 1); // the first has the variance of ten samples
//! assert!(to_csv(&samples).starts_with(&COLUMNS.join(",")));
//! ```
#![cfg_attr(test, allow(clippy::pedantic, clippy::unwrap_used))]
#![allow(clippy::cast_precision_loss)] // numbers of cells and samples are far below 2^53
#![allow(clippy::cast_sign_loss)] // what becomes a number is at least 0

mod drive;
mod follow;
mod map;
mod no_drive;
mod sample;
mod watch;

pub use drive::{Options, drive};
pub use follow::{Moment, follow};
pub use map::{Around, CELL_M, MAX_CELLS, Map};
pub use no_drive::{MAX_PEOPLE, MAX_S, NoDrive};
pub use sample::{COLUMNS, Sample, WINDOW, to_csv};

use cotama_floor::embedded::Embedded;
use cotama_floor::{Floor, Point, Version, metres};

/// A sidewalk of 60 m between house fronts and a fence.
pub const SIDEWALK: Embedded = Embedded {
    name: "sidewalk.toml",
    description: "A sidewalk of 60 m between house fronts and a fence",
    text: include_str!("../floors/sidewalk.toml"),
};

/// A plaza of 40 m by 30 m.
pub const PLAZA: Embedded = Embedded {
    name: "plaza.toml",
    description: "A plaza with a fountain, benches, trees and kiosks",
    text: include_str!("../floors/plaza.toml"),
};

/// Drives between all places of a floor; uncharted furniture is there, and the robot knows nothing
/// of it.
///
/// # Errors
/// When the floor, its places or the options do not make a drive.
pub fn drive_on(floor: &Floor, options: &Options) -> Result<Vec<Sample>, NoDrive> {
    let doors = floor.doors_at_first();
    let surface = |it| floor.surface(it, &doors).map_err(|_| NoDrive::Large);
    let (real, charted) = (surface(Version::Real)?, surface(Version::Charted)?);
    let places: Vec<Point> = floor.places.iter().map(|it| metres(it.at)).collect();
    drive(&real, &charted, &places, options)
}
