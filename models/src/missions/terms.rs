//! Terms that missions and robots share: power of motion, harmless speeds, criteria of plans.

use cotama_core::units::{Millijoules, MillimetresPerSecond, Milliwatts};

/// The largest whole speed at which the kinetic energy m v² / 2 is strictly below `energy`; zero if
/// there is none.
///
/// ```
/// use cotama_core::units::{Millijoules, MillimetresPerSecond};
/// # use cotama_models::missions::harmless_speed;
/// // 25 kg, 4 J: below 565.7 mm/s
/// assert_eq!(harmless_speed(25_000, Millijoules(4_000)), MillimetresPerSecond(565));
/// ```
pub const fn harmless_speed(mass_g: u64, energy: Millijoules) -> MillimetresPerSecond {
    // In these units, m v² / 2 < E is m_g * v² < 2,000,000 * E_mJ.
    let bound = energy.0.saturating_mul(2_000_000);
    match bound.saturating_sub(1).checked_div(mass_g) {
        Some(square) => MillimetresPerSecond(square.isqrt()),
        None => MillimetresPerSecond::ZERO,
    }
}

/// The power of motion at speed v (mm/s): c0 + c1 v / 1000 + c2 v² / 1,000,000 mW, rounded half up.
///
/// ```
/// use cotama_core::units::{MillimetresPerSecond, Milliwatts};
/// use cotama_models::missions::MotionPower;
/// let power = MotionPower { c0: 4_890, c1: 3_930, c2: 8_466 };
/// assert_eq!(power.at(MillimetresPerSecond(0)), Milliwatts(4_890));
/// assert_eq!(power.at(MillimetresPerSecond(410)), Milliwatts(7_924));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MotionPower {
    /// The constant coefficient, in mW.
    pub c0: u64,
    /// The linear coefficient, in mW for each m/s.
    pub c1: u64,
    /// The square coefficient, in mW for each (m/s)².
    pub c2: u64,
}

impl MotionPower {
    /// The power at a speed; the largest power when it does not fit.
    pub const fn at(&self, speed: MillimetresPerSecond) -> Milliwatts {
        let v = speed.0 as u128;
        let linear = (self.c1 as u128 * v).saturating_mul(1000);
        let square = (self.c2 as u128).saturating_mul(v * v);
        let micro = (self.c0 as u128 * 1_000_000).saturating_add(linear).saturating_add(square);
        let power = micro.saturating_add(500_000) / 1_000_000;
        if power > u64::MAX as u128 { Milliwatts(u64::MAX) } else { Milliwatts(power as u64) }
    }
}

/// The criterion by which plans are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlannedFor {
    /// The rule of the paper: the highest plan that it finds within the limits.
    Paper,
    /// The most quality.
    Quality,
    /// The least energy.
    MinEnergy,
}
