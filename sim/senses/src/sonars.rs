//! The ring of sonars.

use cotama_core::units::Millis;
use cotama_devices::{RingSettings, Sensed};

/// The largest range of a sonar, in metres: also what it reads where it hears nothing.
pub(crate) const RANGE_M: f64 = 5.0;
/// A range that is no longer than this is short, in metres.
pub(crate) const SHORT_M: f64 = 0.35;

/// The ring of a Pioneer, all sonars in each period, as where they are simulated (Durand et al.,
/// TAROS 2010, Section IV).
pub(crate) fn ring() -> RingSettings {
    RingSettings::pioneer().all_at_once(Millis(100))
}

/// A range that is short reads as the largest one, and every other one as nothing.
pub(crate) fn short(it: Sensed<f64>) -> Sensed<f64> {
    Sensed { value: if it.value <= SHORT_M { RANGE_M } else { 0.0 }, ..it }
}
