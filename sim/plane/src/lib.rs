//! Robots that drive over a floor: two wheels, contact, odometry, a path that is followed.
//!
//! A [`Course`] is what the runs of a mission share: the floor, the path over it and the wheels of
//! its robot. A [`Rover`] is the robot of one run. It knows its pose: localisation is perfect here.
//!
//! ```
//! use cotama_core::units::{Millimetres, MillimetresPerSecond, Millis};
//! use cotama_models::missions::{Mission, embedded};
//! use cotama_plane::{Course, Rover};
//! let shift = embedded::mission("shift").unwrap();
//! let mission = Mission::parse(shift.name, shift.text).unwrap();
//! let course = Course::of(&mission, 0).unwrap();
//! let mut rover = Rover::new(&course, 0);
//! for _ in 0..100 {
//!     rover.go(MillimetresPerSecond(500), Millimetres(3_000), Millis(100));
//! }
//! assert_eq!(rover.x(), Millimetres(3_000)); // it stands there
//! assert!(!rover.touches());
//! ```
#![allow(clippy::cast_precision_loss)] // lengths and times of a mission are below 2^53

mod active;
mod battery;
pub mod corridors;
mod course;
mod detours;
mod doors;
mod drive;
mod drivetrain;
mod fault;
mod follower;
mod motors;
mod odometry;
mod people;
mod rover;
mod track;
mod vehicle;

pub use battery::Battery;
pub use cotama_devices::Disc;
pub use cotama_floor::Pose;
pub use course::{Course, NoCourse};
pub use drive::{BatterySignals, MotorSignals, Signals};
pub use drivetrain::Drivetrain;
pub use fault::{Defect, DriveFault, Side, Slip};
pub use follower::Follower;
pub use motors::Motors;
pub use odometry::Odometry;
pub use rover::{Met, Rover};
pub use track::{Corner, Near, Track};
pub use vehicle::{Command, Effect, Step, Vehicle, arc};
