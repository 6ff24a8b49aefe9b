//! A robot in the plane that is told nothing: it knows its pose by localisation or odometry, and
//! what is wrong by flags that observers make of its signals (Durand et al., TAROS 2010, Sections
//! III.B, IV.B, VI.A).
//!
//! A [`Bench`] is made once for the runs of a mission: the map as its sonars see it, and a survey
//! of its course by a sound robot, from which thresholds follow. [`Senses`] are those of one run.
//! The robot's file says what modules compute ([`Role`]), what flags watch ([`Watch`]), and what
//! failures harm ([`Harm`]).
//!
//! | signal | by |
//! | --- | --- |
//! | ranges of 16 sonars | [`Ring`](cotama_devices::Ring) |
//! | scans, pictures, turns, as the robot's file has them | [`Laser`], [`Camera`], [`Gyro`] |
//! | pose in the map | [`Localiser`], by scans or sonars; by marks a Kalman filter |
//! | pose by encoders | [`Odometry`](cotama_plane::Odometry) |
//! | speeds, currents, stall, bumpers, voltage | packets of the micro-controller |
//! | level of the link, heartbeat of the operator | [`Link`](cotama_devices::Link) |
//! | images | time stamps alone |
//!
//! [`Laser`]: cotama_devices::Laser
//! [`Camera`]: cotama_devices::Camera
//! [`Gyro`]: cotama_devices::Gyro
//! [`Localiser`]: cotama_localisation::Localiser
#![cfg_attr(test, allow(clippy::pedantic, clippy::unwrap_used))]
#![allow(clippy::cast_precision_loss)] // times and lengths of a mission are below 2^53
#![allow(clippy::cast_sign_loss)] // lengths along a path are at least 0

mod around;
mod base;
mod bench;
mod devices;
mod gyro;
mod lasers;
mod marks;
mod modules;
mod observing;
mod senses;
mod sonars;
mod watching;

pub use bench::{Bench, NoBench};
pub use cotama_devices::SettingsError;
pub use cotama_models::robots::{Harm, Harmed, Role, Watch};
pub use senses::{Senses, Uses};
