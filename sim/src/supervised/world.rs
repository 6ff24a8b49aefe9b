//! One supervised mission, period after period.
//!
//! In each period, in this order: what is to fail fails; the robot goes on; observers raise their flags, which are diagnosed;
//! the supervisors take one round and are then told *one* thing, the oldest failure first, else what the mission or the
//! operator has to say. So a run is a run of the system that was checked: [`Told`] is its alphabet, and the list of what was
//! told, a round each, is all that is needed to check that it is one.

use super::effect::{Motion, effect, observable};
use super::operator::{Answer, Operator, View};
use super::plan::Planning;
use super::robot::Robot;
use super::{Conduct, Fired, Injection, Run, Script, When};
use crate::trace::Outcome;
use cotama_core::net::PlaceId;
use cotama_core::system::{Happening, Offered};
use cotama_core::units::{Millimetres, MillimetresPerSecond, Millis};
use cotama_models::cotama::{
    Cause, Configuration, DecisionalLevel, FailureMode, Health, Modules, Report, Told, faults, global, local,
};
use cotama_models::mission::{Does, Mission};
use std::collections::VecDeque;

/// The period of the control loop, of rounds, and of the steps of the robot (stated: below 0.1 s a loop).
pub const PERIOD: Millis = Millis(100);
/// How long planning a path takes: assumed.
pub const PLANNING: Millis = Millis(2_000);
/// A run ends after this time, whatever it does.
pub const LONGEST: Millis = Millis(3_600_000);

/// A failure under way.
#[derive(Clone, Copy, Debug)]
struct Failure {
    mode: FailureMode,
    /// For how long its observer has been able to see it.
    seen: Millis,
    flagged: bool,
}

/// A mission under way.
pub(super) struct World<'m> {
    mission: &'m Mission,
    script: Script,
    level: DecisionalLevel,
    now: Millis,
    robot: Robot,
    operator: Operator,
    /// What is broken, known or not.
    broken: Health,
    /// What is diagnosed.
    known: Health,
    failures: Vec<Failure>,
    /// What the supervisors are still to be told.
    untold: VecDeque<(Told, Cause)>,
    planning: Planning<'m>,
    /// Since when the local supervisor, and the global one, are where they are.
    local_since: (local::Place, Millis),
    global_since: (PlaceId, Millis),
    conduct: Vec<Conduct>,
    run: Run,
    exposed: Millis,
}
