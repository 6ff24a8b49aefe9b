//! Monte Carlo localisation: where a robot is on a floor that it knows, by its odometry and ranges.
//!
//! A [`Localiser`] holds particles, poses that the robot may have. Each
//! [`update`](Localiser::update) moves them as the odometry tells, weighs them by how likely the
//! ranges are there, and draws them anew by their weights. A [`Chart`] is a floor prepared for a
//! [`Sensor`] and for [`Parameters`], once for all robots that share them. Names, defaults and
//! behaviour are those of Nav2's AMCL, whose [`nav2_params.yaml`](Parameters::parse) is read as it
//! is; the differences are below. Lengths are metres, angles radians, poses those of the robot on
//! the floor.
//!
//! ```
//! use cotama_core::units::Millis;
//! use cotama_devices::{Laser, LaserSettings, Scene, Streams};
//! use cotama_floor::{Pose, Version, embedded};
//! use cotama_localisation::{Chart, Localiser, Parameters, Sensor};
//!
//! let office = embedded::OFFICE.floor().unwrap();
//! let real = office.surface(Version::Real, &[]).unwrap();
//! let known = office.surface(Version::Charted, &[]).unwrap();
//! let settings = LaserSettings::sick_lms200();
//! let sensor =
//!     Sensor::laser(&settings.mount, settings.view_rad, settings.rays, settings.range_m).unwrap();
//! let text = "amcl:\n  ros__parameters:\n    max_beams: 90\n";
//! let (parameters, _) = Parameters::parse("nav2_params.yaml", text).unwrap();
//! let chart = Chart::new(&known, 0.05, &sensor, &parameters).unwrap();
//!
//! // Down the corridor with wheels that slip: 4 m, of which the odometry tells 4.4 m.
//! let streams = Streams::new(7);
//! let mut laser = Laser::new(&settings, &streams, "laser").unwrap();
//! let mut localiser = Localiser::new(&chart, &streams, "robot");
//! let pose = |ahead: f64| Pose::new([11.0 + ahead, 10.0].into(), 0.0);
//! localiser.start_at(&pose(0.0), &nalgebra::Matrix3::from_diagonal_element(0.01)).unwrap();
//! for step in 0..=20 {
//!     let (now, ahead) = (Millis(200 * step), 0.2 * step as f64);
//!     laser.sense(now, &pose(ahead), &Scene::of(&real, &[]));
//!     let scan = laser.latest(Millis(now.0 + 100)).unwrap();
//!     localiser.update(&Pose::translation(1.1 * ahead, 0.0), scan.value);
//! }
//! let found = localiser.pose_at(&Pose::translation(4.4, 0.0));
//! assert!((found.translation.x - 15.0).abs() < 0.1, "{found}");
//! ```
//!
//! # An update
//!
//! - *Motion* (Thrun, Burgard, Fox, Probabilistic Robotics, 2005, table 5.6): a turn, a way, a
//!   turn, with variances `alpha1` r² + `alpha2` d², `alpha3` d² + `alpha4` (r₁² + r₂²), and as the
//!   first. Errors are those of [`Stream::error`](cotama_streams::Stream::error), at most 3.465
//!   deviations.
//! - *Likelihood field* (table 6.3): with d the distance from the end of a beam to the nearest
//!   thing that the sensor notices, p = `z_hit` exp(-d² / 2 `sigma_hit`²) + `z_rand` / range.
//! - *Beam model* (table 6.1): p = `z_hit` exp(-(z - z*)² / 2 `sigma_hit`²), and `z_short` λ exp(-λ
//!   z) if z < z*, and `z_max` at the range of the sensor, else `z_rand` / range; z* is the range
//!   from the robot's pose, of 128 directions at the centre of each cell.
//! - *Weights*: `likelihood_field` and `beam` give a particle 1 + Σ p³ over its beams, as AMCL
//!   does, which says little at a time and forgives much. `likelihood_field_prob` gives Π p, as the
//!   book does: several times as exact for a robot that knows where it is, and the one that follows
//!   a robot with few sonars; but overly sure of itself where a robot may be anywhere.
//! - *Sonars* are beams with a cone of a few rays: the field takes the likeliest end point on the
//!   arc, the beam model expects the shortest ray.
//! - *Estimate*: mean and covariance of the heaviest cluster of bins ([`Estimate`]), of the
//!   weighted particles before they are drawn anew.
//! - *Drawing anew*: their number by KLD-sampling (Fox, IJRR 22(12), 2003), in bins of 0.5 m, 0.5 m
//!   and 10°; which ones with low variance (table 4.4), so that each is drawn ⌊n w⌋ or ⌈n w⌉ times;
//!   with `recovery_alpha_fast` and `recovery_alpha_slow` a part 1 - short / long of them anywhere
//!   (table 8.3).
//!
//! # Differences to Nav2
//!
//! - Never more than `max_beams` beams are looked at, evenly from the first to the last.
//! - Particles are drawn with low variance, where Nav2 draws each alone.
//! - One occupied bin needs `min_particles`, where Nav2 takes `max_particles`.
//! - The mean likelihood is Σ w p, where Nav2 divides it by the number of particles once more; and
//!   short- and long-term means go on after particles are drawn anywhere, where Nav2 begins anew,
//!   so that a robot that is lost draws them in one update only.
//! - Beams are not skipped (`do_beamskip` is refused), and robots do not move aside.
//!
//! # Determinism and speed
//!
//! Random numbers come from streams named after the robot. Positions are in single precision from
//! the left lower corner of the floor; sums, products and square roots alone, and functions of
//! `libm`: the same bytes on every machine. All memory is taken when a localiser is made.
//!
//! Times of an update of 500 particles in the office, all of it, on one of two shared cores (an AMD
//! EPYC of 2.6 GHz, without its wide vectors): medians of 21 rounds of `benches/updates.rs`, by the
//! time on the processor.
//!
//! | model | beams | ms |
//! | --- | --- | --- |
//! | `likelihood_field` | 60 | 0.060 |
//! | `likelihood_field` | 240 | 0.115 |
//! | `beam` | 60 | 0.300 |
//! | `likelihood_field`, sonars | 16 of 5 rays | 0.098 |
#![cfg_attr(test, allow(clippy::pedantic, clippy::unwrap_used))]
#![allow(clippy::cast_precision_loss)] // cells and particles need no more than 24 bits
#![allow(clippy::cast_sign_loss)] // what becomes a number was made at least 0 before

mod angle;
mod chart;
mod estimate;
mod histogram;
mod localiser;
mod motion;
mod parameters;
mod particles;
mod resampling;
mod sensor;

pub use chart::{Chart, ChartError, MAX_CAST_CELLS, MAX_FIELD_CELLS};
pub use estimate::Estimate;
pub use localiser::{Localiser, StartError};
pub use parameters::{KEYS_WITHOUT_MEANING, MAX_TEXT, Model, Parameters, ParametersError};
pub use sensor::{MAX_BEAMS, MAX_CONE_RAYS, Sensor, SensorError};
