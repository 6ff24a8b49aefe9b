//! Devices of a robot in the plane, the signals that they read, and the people around.
//!
//! A device is told the time, the pose of the robot and the [`Scene`]: the floor as it really is,
//! with the people and robots on it, each a [`Disc`]. It takes a reading when one is due, and hands
//! out the newest one that has arrived, [`Sensed`] with the time when it was taken.
//!
//! | device | reads | takes into account |
//! | --- | --- | --- |
//! | [`Ring`] | a range of each sonar | cones, banks, incidence, cross talk; glass is seen |
//! | [`Laser`] | the ranges of a scan | field of view; looks through glass |
//! | [`Camera`] | QR marks: distance, bearing | field of view, walls, angle, size, speed |
//! | [`Gyro`] | the turn of the robot | a bias that is drawn |
//! | [`Link`] | the level of the best access point | distance, walls |
//!
//! Each has a rate, a latency and noise, and carries [`Faults`], which change its readings.
//! [`WrongMap`] is the fault of a map. [`People`] walk between places and give way to robots.
//!
//! *Determinism.* Random numbers come from [`Streams`] by the name of a device, of a sonar, of a
//! mark, of a person or of a fault: one more of them changes no reading of another. Functions that
//! IEEE 754 does not fix are those of `libm`. Memory is taken when a device is made, and none while
//! it senses.
//!
//! *Speed.* Robots that wander over the office, on one of two shared cores (a Xeon of 2.65 GHz as a
//! program sees it): medians of 11 rounds of `benches/devices.rs`, by its time on the processor.
//!
//! | robots | devices of each | times real time |
//! | --- | --- | --- |
//! | 1 | 180 laser rays up to 5.6 m, 10 Hz | 7,700 |
//! | 1 | 16 sonars of 5 rays, 10 Hz | 12,800 |
//! | 40, which see each other | 180 laser rays up to 5.6 m, 10 Hz | 150 |
//!
//! ```
//! use cotama_core::units::Millis;
//! use cotama_devices::{
//!     Disc, Fault, Laser, LaserSettings, Mode, Ring, RingSettings, Scene, Streams,
//! };
//! use cotama_floor::{Point, Pose, Version, embedded};
//!
//! // A robot 1 m before the glass of the lounge, in which a person stands.
//! let office = embedded::OFFICE.floor().unwrap();
//! let surface = office.surface(Version::Real, &[]).unwrap();
//! let people = [Disc { centre: Point::new(11.0, 6.25), radius: 0.25 }];
//! let pose = Pose::new(Point::new(11.0, 10.0).coords, -core::f64::consts::FRAC_PI_2);
//!
//! let streams = Streams::new(42);
//! let quiet = LaserSettings { noise_m: 0.0, ..LaserSettings::hokuyo_urg(181) };
//! let mut laser = Laser::new(&quiet, &streams, "laser").unwrap();
//! let quiet = RingSettings { noise_m: 0.0, cross_talk: 0.0, ..RingSettings::pioneer() };
//! let mut ring = Ring::new(&quiet, &streams, "sonar").unwrap();
//! // Sonar 4 hears nothing from the fourth second on.
//! let deaf = Fault::new(Mode::Stuck(5.0)).unwrap().from(Millis(4_000));
//! ring.set_faults(4, &[deaf], &streams, "sonar").unwrap();
//!
//! let mut read = |now: u64| {
//!     for now in (now..now + 500).step_by(20).map(Millis) {
//!         let scene = Scene::of(&surface, &people);
//!         laser.sense(now, &pose, &scene);
//!         ring.sense(now, &pose, &scene);
//!     }
//!     let sonar = ring.latest(Millis(now + 500)).unwrap()[4].unwrap();
//!     let ahead = laser.latest(Millis(now + 500)).unwrap().value[90];
//!     ((ahead * 1_000.0).round(), (sonar.value * 1_000.0).round())
//! };
//! // The laser sees the person, 3.75 m ahead, less 0.25 m; the sonar the glass, 166 mm before it,
//! // by the ray that is 2.5° aside.
//! assert_eq!(read(0), (3_500.0, 835.0));
//! assert_eq!(read(4_000), (3_500.0, 5_000.0));
//! ```
#![cfg_attr(test, allow(clippy::pedantic, clippy::unwrap_used))]
#![allow(clippy::cast_precision_loss)] // times and numbers of rays need no more than 53 bits
#![allow(clippy::cast_sign_loss)] // what becomes a number was made at least 0 before

mod camera;
mod fault;
mod faults;
mod gyro;
mod laser;
mod link;
mod people;
mod ring;
mod routes;
mod scene;
mod sensed;
mod settings;
mod wrong_map;

pub use camera::{Camera, CameraSettings, MAX_MARKS, QrMark, Sighting};
pub use cotama_streams::{Stream, Streams};
pub use fault::{Effect, Fault, Intermittent, Mode, Phase};
pub use faults::{Faults, MAX_FAULTS};
pub use gyro::{Gyro, GyroSettings};
pub use laser::{Laser, LaserSettings, MAX_RAYS};
pub use link::{Link, LinkSettings, MAX_ACCESS_POINTS};
pub use people::{Goes, Habits, MAX_PEOPLE, People, STEP, Walker};
pub use ring::{MAX_CONE_RAYS, MAX_SONARS, Ring, RingSettings};
pub use routes::{MAX_PLACES, Routes};
pub use scene::{Disc, Scene};
pub use sensed::{MAX_TIME, MAX_VALUES, Rate, Sensed};
pub use settings::{SettingsError, within};
pub use wrong_map::WrongMap;
