//! Robot missions as data: from a mission file to the alternatives of each activity.
//!
//! A *mission* (Lambert et al., J. Intell. Robot. Syst. 110, 2024, DOI 10.1007/s10846-024-02058-7)
//! is a sequence of *objectives* along a path. Cut at the borders of the *zones* that constrain it,
//! it becomes a sequence of *activities*; each can be done by several *implementation
//! alternatives*, products of the *task implementation options* (TIOs) of its tasks.
//! [`Mission::parse`](missions::Mission::parse) reads all of this from a `panorama-mission/1` file
//! and reports every error at once; what it returns is complete, so that nothing after it can fail
//! on the mission's account.
//!
//! The crate has more rooms. [`nets`] are ready supervisors, checked while compiling, and families
//! of nets. `robots` (feature `std`) reads a robot from a file and makes its supervisors and their
//! requirements; [`level`] is what they need at work, from flags to requests. `fmeca` (feature
//! `std`) reads an analysis of failures from a file, and says how critical each row is.
//!
//! `margins` (feature `std`) learns from past runs how much to hold back for what remains.
//!
//! [`team`] is what robots can do together: capabilities, tasks, bids, errors.
//!
//! Without the feature `std` only [`level`], [`team`], the tables of missions
//! ([`missions::tables`]) and the ready [`nets`] remain, without heap, for firmware.
//!
//! ```
//! # #[cfg(feature = "std")] {
//! use cotama_models::missions::{Mission, embedded};
//! let patrol = embedded::mission("patrol").unwrap();
//! let mission = Mission::parse(patrol.name, patrol.text).unwrap();
//! let scenario = mission.scenario();
//! assert_eq!(scenario.activities.len(), 17);
//! assert_eq!(scenario.activities[0].labels[13], "M5 L2");
//! assert_eq!(scenario.combinations(), Some(768_288_795_144_192));
//! # }
//! ```
#![cfg_attr(not(feature = "std"), no_std)]
#![cfg_attr(kani, allow(clippy::pedantic))]

// Printed tables name this crate, wherever they are compiled; two of them are compiled here.
extern crate self as cotama_models;

#[cfg(feature = "std")]
pub mod fmeca;
#[cfg(feature = "std")]
mod json;
pub mod level;
#[cfg(feature = "std")]
pub mod margins;
pub mod missions;
pub mod nets;
#[cfg(feature = "std")]
pub mod reading;
#[cfg(feature = "std")]
pub mod robots;
pub mod severity;
pub mod team;
#[cfg(feature = "std")]
pub mod toml_text;

#[cfg(feature = "std")]
mod names;
