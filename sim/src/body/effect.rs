//! The effects of failures on the robot at mission fidelity, and their latencies: assumed, after
//! the rows of the FMECA.

use cotama_core::units::Millis;
use cotama_models::cotama::{
    Configuration, FailureMode, Flag, Flags, Module, Modules, Situation, local,
};

pub use cotama_models::robots::Motion;

/// How long the micro-controller waits for a command (Pioneer 3-DX).
pub const FIRMWARE_WATCHDOG: Millis = Millis(2_000);

/// When a failure ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ends {
    /// Never.
    Never,
    /// After a time.
    After(Millis),
    /// When the operator has led the robot past it, or given another path.
    Helped,
}

/// The effect of a failure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effect {
    /// To motion.
    pub motion: Motion,
    /// When it ends.
    pub ends: Ends,
}

/// Returns the effect of a failure.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_models::cotama::FailureMode;
/// use cotama_sim::body::{Ends, Motion, effect};
/// let somebody = effect(FailureMode::Hum1);
/// assert_eq!((somebody.motion, somebody.ends), (Motion::Blocked, Ends::After(Millis(8_000))));
/// assert_eq!(effect(FailureMode::Pwr1).motion, Motion::Mindless);
/// ```
pub const fn effect(mode: FailureMode) -> Effect {
    use FailureMode as F;
    let motion = match mode {
        F::Mot1 | F::Mot3 | F::Bmp2 | F::Loc2 | F::Hum1 | F::Col1 | F::Loc3 => Motion::Blocked,
        F::Mot2 => Motion::Slowed(600),
        F::Whl1 => Motion::Slowed(500),
        F::Mot4 => Motion::Runaway,
        F::Est1 | F::Bat2 | F::Bat3 => Motion::Dead,
        F::P3d1 => Motion::Silent,
        F::Pwr1 | F::Sw3 => Motion::Mindless,
        _ => Motion::Free,
    };
    let ends = match mode {
        F::Hum1 => Ends::After(Millis(8_000)),
        F::Son4 | F::Odo3 | F::Cam2 | F::P3d2 | F::Com2 => Ends::After(Millis(10_000)),
        F::Rt2 => Ends::After(Millis(100)),
        F::Col1 => Ends::After(Millis(5_000)),
        F::Mot3 | F::Loc1 | F::Loc2 | F::Loc3 | F::Ppl1 | F::P3d3 | F::Bmp2 | F::Whl1 => {
            Ends::Helped
        }
        _ => Ends::Never,
    };
    Effect { motion, ends }
}

/// The flags that a failure raises while these modules observe: all that it always does, and of the
/// others those that this simulation has. Encoders that lose ticks are seen by the filter on the
/// wheels too, which tells them from a lost localisation (assumed).
pub(crate) fn raises(mode: FailureMode, observing: Modules) -> Flags {
    let always = mode.rule().signature.always;
    match mode {
        FailureMode::Odo2 if Flags::seen_by(observing).covers(always) => {
            always.with(Flag::WheelResidual)
        }
        _ => always,
    }
}

/// Whether the observer of a failure can see it now: what is not used is not observed.
pub(crate) fn observable(mode: FailureMode, situation: Situation, moving: bool) -> bool {
    use FailureMode as F;
    let running = situation.configuration();
    let uses = |module: Module| running.is_some_and(|it| it.facts().required.has(module));
    match mode {
        F::Son1 | F::Son3 | F::Odo1 | F::Odo2 | F::Odo3 | F::Odo4 | F::Mot2 => moving,
        F::Mot1 | F::Mot3 | F::Whl1 | F::Bmp1 | F::Bmp2 | F::Col1 => wants_to_move(running),
        F::Loc1 => uses(Module::Mcl),
        F::Loc2 | F::Hum1 => matches!(situation.local, local::State::Following),
        F::Loc3 => {
            matches!(running, Some(Configuration::FollowingDegraded)) && wants_to_move(running)
        }
        F::Ppl1 => matches!(situation.local, local::State::Planning),
        // The scheduler sees what arises from the modules at work, and the decider misses the
        // operator.
        F::Rt1 | F::Rt2 | F::Rt3 | F::Sw1 | F::Opr1 => false,
        F::Cam2 => matches!(situation.local, local::State::Teleoperated),
        _ => true,
    }
}

/// Whether a configuration moves the robot.
fn wants_to_move(running: Option<Configuration>) -> bool {
    running.is_some_and(|it| it.facts().speed.0 > 0)
}
