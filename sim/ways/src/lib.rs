//! A short and a long way to one goal, both crossed by moving discs: trials are made on the plane,
//! a model is learned from them, and policies choose with a known risk (Rohrmueller, dissertation,
//! TU Munich 2011, section 4.5.2).
//!
//! A [`World`] makes each [`Trial`] when it is first asked for: bodies of `cotama_plane`, a laser
//! that sees 1.7 m, VFH+ of `cotama_navigation`. [`train`] learns from two runs on each way; a
//! [`run`] visits the 20 [`MAPS`] without and with knowledge of the discs, and tries each up to
//! three times. [`Results`] have the intervals of the campaigns' statistics.
//!
//! # Numbers that the thesis does not print
//! Figures 4.12 and 4.13 are drawings. Assumed are: a corridor of 2 m, a short way of 10 m, discs
//! evenly along each way with phases that are drawn, waypoints at the corners; 0.5 m/s² and 40°/s
//! (the latter a default of Player's driver), a path's length in thirds at 6 and 12 m, and 120 s as
//! the longest trial. Width and acceleration were chosen, out of a dozen pairs, by one printed
//! number: at 0.3 m/s and 3/1, 0.73 of the trials on the short way fail. All else comes of it.
//!
//! ```
//! use cotama_ways::{Condition, End, ObjectSpeed, Place, Series, Way, World};
//! let mut world = World::new(1, ObjectSpeed::Medium);
//! let place = Place { series: Series::Run(0), condition: Condition::Limited, map: 6, trial: 0 };
//! let short = world.trial(place, Way::Short);
//! assert_eq!(short, world.clone().trial(place, Way::Short)); // fixed by its place
//! assert!(short.end != End::Arrived || short.length_m > 9.0);
//! ```
#![cfg_attr(test, allow(clippy::pedantic, clippy::unwrap_used))]
#![allow(clippy::cast_precision_loss)] // numbers of trials and times are far below 2^53
#![allow(clippy::cast_sign_loss)] // what becomes a number is at least 0

mod learned;
mod maps;
mod picture;
mod policy;
mod report;
mod ring;
mod run;
mod trial;
mod world;

pub use learned::{LENGTHS_M, Learned, Row, TIMES_S, TRIALS, UTILITY, to_csv};
pub use maps::{MAPS, Map, Ratio};
pub use picture::{Track, to_svg};
pub use policy::{Condition, Policy, Rules};
pub use report::{AtRatio, CONFIDENCE, InCondition, Mean, Results, gain};
pub use ring::{CORRIDOR_M, Crossing, DISC_M, Ring, SIZE_M, Way};
pub use run::{Visit, run, train};
pub use trial::{End, MAX_S, ObjectSpeed, Trial, trial};
pub use world::{Place, Series, World};
