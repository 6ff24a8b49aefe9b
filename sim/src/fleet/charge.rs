//! The battery of a robot of a team, and its errands.

use super::driver::Driver;
use cotama_models::team::scenario::RobotSpec;
use std::cell::Cell;

/// Energy of a robot's battery.
#[derive(Clone, Debug)]
pub(super) struct Charge {
    pub(super) full_mj: u64,
    /// The charge at the start, with all that came from chargers, in mJ.
    pub(super) gained_mj: u64,
    /// Since when it is charged, and by which power in mW.
    pub(super) charger: Option<(u64, u64)>,
    /// Something was not bid for since it last looked, as its charge is short.
    pub(super) declined: Cell<bool>,
}

impl Charge {
    pub(super) fn of(spec: &RobotSpec) -> Option<Self> {
        let supply = spec.supply.as_ref()?;
        let full_mj = spec.full_mj();
        let gained_mj = full_mj / 1_000 * u64::from(supply.charge_permille);
        Some(Self { full_mj, gained_mj, charger: None, declined: Cell::new(false) })
    }

    pub(super) fn left_mj(&self, now: u64, driver: &Driver) -> u64 {
        let came = self.charger.map_or(0, |(since, mw)| mw.saturating_mul(now - since) / 1_000);
        let left = self.gained_mj.saturating_add(came).saturating_sub(driver.energy_mj(now));
        left.min(self.full_mj)
    }
}

/// An errand of a robot that is free.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Errand {
    /// The robot drives home.
    Home,
    /// The robot is charged there.
    Charges,
}
