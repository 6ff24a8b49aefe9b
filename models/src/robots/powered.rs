//! Motors and the battery of a robot, as its file has them.

use cotama_core::units::Millis;

/// Two motors with their gears, one on each wheel. All numbers are those at the wheel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Motors {
    /// The voltage for which they are made, in mV.
    pub voltage_mv: u64,
    /// Speed of a wheel at that voltage without a load, in thousandths of rad/s.
    pub no_load_mrad_s: u64,
    /// The resistance of a winding, in mΩ.
    pub resistance_mohm: u64,
    /// The current that a motor never exceeds, in mA.
    pub limit_ma: u64,
    /// The force that holds the robot back while it rolls, in thousandths of its weight.
    pub rolling_permille: u64,
    /// The mass that they move, in g: that of the body.
    pub mass_g: u64,
    /// Time for which a wheel must be held before its motor counts as stalled.
    pub stall: Millis,
}

/// The battery from which motors and hardware are fed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Battery {
    /// The charge of the full battery, in mAh.
    pub capacity_mah: u64,
    /// The voltage without a load when it is full, in mV.
    pub full_mv: u64,
    /// The voltage without a load when it is empty, in mV; between both it falls evenly.
    pub empty_mv: u64,
    /// The voltage under load below which the robot switches itself off, in mV.
    pub cutoff_mv: u64,
    /// Internal resistance, in mΩ.
    pub resistance_mohm: u64,
    /// Cells in series.
    pub cells: u64,
}
