//! Observers.
#![cfg_attr(not(test), no_std)]
#![cfg_attr(test, allow(clippy::pedantic, clippy::unwrap_used))]
#![allow(clippy::cast_precision_loss)] // times and counts need no more than 53 bits

mod body;
mod flag;
mod link;
#[cfg(test)]
mod measured;
mod newest;
mod path;
mod pose;
mod promise;
mod quantile;
mod round;
mod signals;
mod sonars;
mod spell;
mod status;
mod timing;

pub use body::{Battery, Braking, Bumper, Contact, Stall, Supply};
pub use flag::Flag;
pub use link::{LinkLevel, MAX_LEVELS};
pub use path::{Backward, Coherence, Convergence, Motion, OnPath, Progress};
pub use pose::{Apart, OdometryErrors, Poses, Spread};
pub use promise::{FalseAlarms, in_a_row};
pub use quantile::{chi_square_above, chi_square_quantile, normal_above, normal_quantile};
pub use round::{Blame, Watch, round};
pub use signals::{Module, Observer, Port, Report, Signals, Value};
pub use sonars::{FarSonars, SonarSurvey};
pub use spell::{Survey, Tail};
pub use status::{Item, Items, MAX_ITEMS, Needs, Status, StatusEvent, StatusVector};
pub use timing::{Age, Deadlines, Interval, Job};
mod wheels;
pub use wheels::{
    Bank, Diagnosis, MODES, Mode, Side, WheelObserver, WheelRates, WheelSettings, Wheels,
};
