//! Observers that make flags of a robot's signals, each at a promised rate of false alarms.
//!
//! An observer is told the time and a signal, and answers with a [`Flag`]: clear, raised, or that
//! the signal is missing. A rate goes in ([`FalseAlarms`]) and a threshold comes out: each observer
//! states what is assumed of a sound robot, and how the threshold follows. A test measures its rate
//! beside the promised one. The observers are those of COTAMA (Durand, Godary-Dejean, Lapierre,
//! Passama, Crestani, TAROS 2010), which names them and leaves their algorithms open.
//!
//! | observer | signal | assumed of a sound robot |
//! | --- | --- | --- |
//! | [`Age`] | when data were taken | each datum is lost with the chance q |
//! | [`Deadlines`] | ends of jobs | each deadline is missed with the chance q |
//! | [`Interval`] | a value | a normal error about a value that is inside |
//! | [`FarSonars`] | ranges, way | the tail of ways at the largest range, surveyed |
//! | [`Apart`] | odometry, localisation | errors of odometry grow as √way; covariances |
//! | [`Turns`] | gyro, encoders | errors of odometry; bias and noise |
//! | [`Lasting`] | a condition | the tail of times for which it holds |
//! | [`Spread`] | covariance | worked out of k independent particles |
//! | [`Backward`] | place on the path | the tail of times behind |
//! | [`Progress`] | place on the path | the tail of waits |
//! | [`Convergence`] | place on the path | the distance falls as exp(-t/τ) |
//! | [`Coherence`] | speeds | ramps to the speeds that are told |
//! | [`WheelObserver`] | wheels and motors | one of ten models; breaks with the chance ρ |
//! | [`LinkLevel`] | level of the link | normal errors about a line |
//! | [`Bumper`] | contact, way, room | the tail of unseen contacts; braking |
//! | [`Battery`] | voltage, current | half of the readings are below the level |
//! | [`Stall`] | bits of the motors | each bit is set with the chance q |
//!
//! Sections are those of TAROS 2010; other sources stand at each type.
//!
//! | observer | threshold | source |
//! | --- | --- | --- |
//! | [`Age`] | an age of L + J + kT, with (1 - q)qᵏ ≤ p | IV.B.3; runs |
//! | [`Deadlines`], [`Stall`] | k in a row, with (1 - q)qᵏ ≤ p | VI.A.1, IV.B.3; runs |
//! | [`Interval`] | the ends, z(p) σ further out | IV.B.3 |
//! | [`FarSonars`] | u + m ln(n b / λ) metres | VI.A.3; Pickands 1975 |
//! | [`Backward`], [`Progress`] | u + m ln(b / λ) seconds | VI.A.2; Pickands 1975 |
//! | [`Apart`] | χ²₃(p) of Mahalanobis | VI.A.2; Siegwart et al., 5.2.4 |
//! | [`Spread`] | σ² χ²ₖ₋₁(p/3) / (k - 1) | IV.B.3; variance of a sample |
//! | [`Lasting`] | u + m ln(b / λ) seconds | IV.B.3; Pickands 1975 |
//! | [`Turns`] | z(p/2) √(β² W² + σ² T W + d² s + t² φ) | IV.B.3; sum of normal errors |
//! | [`Convergence`] | z(p/2) σ √(1 + ρ²), with ρ = exp(-T/τ) | IV.B.3 |
//! | [`Coherence`] | χ²₂(p) of mean errors | IV.B.3 |
//! | [`WheelObserver`] | odds of any fault ρ / p, k in a row | IV.B.3; Pollak 1985 |
//! | [`LinkLevel`] | z(p) σ / √n; z(p) of a forecast | IV.B.3; Montgomery et al., 2.4.2 |
//! | [`Bumper`] | as for `Backward`; v t + v²/2a + z(p) σ | IV.B.3 |
//! | [`Battery`] | k in a row, with 1/2ᵏ⁺¹ ≤ p | IV.B.3; He et al. 2011 |
//!
//! Here λ is the promised rate and p = 1 - exp(-λT) the chance that it leaves to a decision of each
//! period or window T; z(p) and χ²ₙ(p) are exceeded with the chance p ([`normal_quantile`],
//! [`chi_square_quantile`]). A [`Tail`] of u, b and m says how long spells last in which a sound
//! signal looks like a broken one; a [`Survey`] makes it of a run.
//!
//! Flags of the shipped delivery robot, and what raises them: *sonar far*, `FarSonars`; *pose
//! growth* and *pose jump*, `Apart` over 5 s and over a period; *spread*; *backward*; *no
//! progress*; *no convergence*; *value outside*, `Interval`; *link poor*, `LinkLevel`; *free
//! ahead*, `Bumper`; *stall*; *battery low*; *sonar silent*, *no frame*, *old frame*, *link down*,
//! *packet silence* and *robot silent*, `Age`; *MCL late*, *module late* and *module silent*,
//! `Deadlines`; *wheel residual*, *wheel gain* and *wheel peak*, `WheelObserver` and its modes.
//!
//! [`round`] runs observers over the [`Signals`] of a period; their flags say of modules and data
//! that they are suspect or lost; the [`StatusVector`] takes along all that need them, and tells
//! each change once.
//!
//! *What is promised* is the rate of one observer whose assumptions hold. The tail of a survey
//! holds in its surroundings. Errors that are alike at both ends of a window make fewer alarms of
//! [`Apart`]; errors that last for many periods make more of [`LinkLevel`] and [`Battery`].
//!
//! *Memory.* The crate has no heap. *Speed.* All observers of a robot, among them 60 of ports,
//! modules and values, and a bank of ten filters: 3.2 µs a period, 2.5 µs of it for the bank
//! (`benches/observers.rs`, median of 11 rounds on a shared core, an AMD EPYC as a program
//! sees it).
//!
//! # Example
//!
//! ```
//! use cotama_core::units::Millis;
//! use cotama_devices::Sensed;
//! use cotama_observers::{
//!     Blame, Item, Items, MODES, Mode, Needs, Side, Signals, Status, StatusVector, Watch,
//!     WheelObserver, WheelRates, WheelSettings, Wheels, round,
//! };
//! // Odometry needs the encoders, navigation odometry.
//! let [encoders, motors, odometry, navigation] = [0, 1, 2, 3].map(|it| Item::new(it).unwrap());
//! let needs = [(odometry, encoders), (navigation, odometry), (navigation, motors)];
//! let mut vector = StatusVector::new(Needs::of(needs));
//!
//! // A false alarm in 100 hours. While it is open which fault it is, both are suspect.
//! let rates = WheelRates::rare(0.01).unwrap();
//! let mut wheels = WheelObserver::new(WheelSettings::pioneer(), rates).unwrap();
//! let flags = |is_meant: fn(&Mode) -> bool| {
//!     let all = MODES.iter().enumerate().filter(|it| is_meant(it.1));
//!     all.fold(0, |bits, it| bits | 1 << it.0)
//! };
//! let blame = |flags, item, raised| Blame { flags, item, raised, missing: Status::Suspect };
//! let blames = [
//!     blame(1, encoders, Status::Suspect),
//!     blame(1, motors, Status::Suspect),
//!     blame(flags(|it| matches!(it, Mode::EncoderDead(_))), encoders, Status::Lost),
//!     blame(flags(|it| matches!(it, Mode::MotorWeak(_))), motors, Status::Lost),
//! ];
//! let mut watches = [Watch { observer: &mut wheels, blames: &blames }];
//!
//! // At 0.3 m/s the left encoder reads 0 from the third second on.
//! let mut events = vec![];
//! for period in 0..40 {
//!     let now = Millis(period * 100);
//!     let left = if period < 30 { 3.08 } else { 0.0 };
//!     let value = Wheels {
//!         dt: 0.1,
//!         commanded: [3.08; 2],
//!         encoder: [left, 3.08],
//!         current: [0.19; 2],
//!         gyro: Some(0.0),
//!     };
//!     let signals = Signals { wheels: Some(Sensed { taken: now, value }), ..Signals::default() };
//!     events.extend(round(&mut watches, now, &signals, &mut vector).map(|it| (period, it.lost)));
//! }
//! assert_eq!(events, [(33, Items::from_iter([encoders, odometry, navigation]))]);
//! assert_eq!(vector.status(motors), Status::Suspect);
//! ```
#![cfg_attr(not(test), no_std)]
#![cfg_attr(test, allow(clippy::pedantic, clippy::unwrap_used))]
#![allow(clippy::cast_precision_loss)] // times and counts need no more than 53 bits

mod body;
mod flag;
mod lasting;
mod link;
#[cfg(test)]
mod measured;
mod newest;
mod outliers;
mod path;
mod pose;
mod promise;
mod quantile;
mod round;
mod runaway;
mod signals;
mod sonars;
mod spell;
mod status;
mod timing;
mod turn;
mod wheels;

pub use body::{Battery, Braking, Bumper, Contact, Stall, Supply};
pub use flag::Flag;
pub use lasting::{Lasting, LastingSurvey};
pub use link::{LinkLevel, MAX_LEVELS};
pub use outliers::{Frozen, Jumps, Outliers};
pub use path::{Backward, Coherence, Convergence, Motion, OnPath, Progress};
pub use pose::{Apart, OdometryErrors, Poses, Spread};
pub use promise::{FalseAlarms, in_a_row};
pub use quantile::{chi_square_above, chi_square_quantile, normal_above, normal_quantile};
pub use round::{Blame, Watch, round};
pub use runaway::Runaway;
pub use signals::{Module, Observer, Port, Report, Signals, Value};
pub use sonars::{FarSonars, SonarSurvey};
pub use spell::{Survey, Tail};
pub use status::{Item, Items, MAX_ITEMS, Needs, Status, StatusEvent, StatusVector};
pub use timing::{Age, Deadlines, Interval, Job};
pub use turn::{Turn, Turns};
pub use wheels::{
    Bank, Diagnosis, MODES, Mode, Side, WheelObserver, WheelRates, WheelSettings, Wheels,
};
