//! Algorithms of a robot that finds its way, on what it knows.
//!
//! Types here are in the roles of COTAMA's modules (Durand et al., TAROS 2010, Table I): each a
//! small deterministic type. They are told believed poses and readings, never the truth, and count
//! their [`Work`], which an executive turns into execution time. Equations of SMZ and of DVZ could
//! not be read; published methods stand in their roles, under their own names.
//!
//! | role | algorithm | source | inputs | output | work |
//! | --- | --- | --- | --- | --- | --- |
//! | PPL | [`Roadmap`] | Bohlin, Kavraki 2000 | charted floor, ends | path | rooms, nodes |
//! | SIM | [`Expected`] | rays in the map | charted floor, pose | ranges of sonars | rays |
//! | UST | [`LocalMap`] | points that fade | readings, odometry | points around | points |
//! | GUI, CTR | [`Guidance`], [`Law`] | Soetanto et al. 2003 | path, pose | speeds | 1 |
//! | SMZ | [`DynamicWindow`] | Fox et al. 1997 | points, speeds, target | [`Choice`] | motions |
//! | DVZ | [`Histogram`] | Ulrich, Borenstein 1998 | points, speeds, target | [`Choice`] | points |
//! | operator | [`Operator`] | a model of ours | [`Image`]s | speeds | 1 |
//! | recovery | [`Retreat`] | straight back | points, odometry | speeds, [`Progress`] | points |
//!
//! Both avoidances rest on [`Braking`]: a motion is admissible if the robot can stop after it.
#![cfg_attr(test, allow(clippy::pedantic, clippy::unwrap_used))]
#![allow(clippy::cast_precision_loss)] // times and numbers of points need no more than 53 bits
#![allow(clippy::cast_sign_loss)] // what becomes a number was made at least 0 before

mod braking;
mod expected;
mod guidance;
mod histogram;
mod local_map;
mod operator;
mod patience;
mod retreat;
mod roadmap;
mod window;
mod work;

pub use braking::{Braking, Limits, MAX_PERIODS};
pub use expected::Expected;
pub use guidance::{Errors, Gains, Guidance, Law, Steer};
pub use histogram::{Histogram, SECTORS, Thresholds};
pub use local_map::{LocalMap, MAX_POINTS, Obstacle};
pub use operator::{Habits, Image, MAX_DELAY, Operator};
pub use patience::Patience;
pub use retreat::{Progress, Retreat};
pub use roadmap::{MAX_SAMPLES, NoWay, Roadmap, SPARE_M, Sampling};
pub use window::{CLEAR_M, Choice, DynamicWindow, Weights};
pub use work::Work;
