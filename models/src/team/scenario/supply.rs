//! Batteries of a team's robots: what is left, what a role needs, and the way home.

use super::worker::hardware_power;
use super::{Outlook, Place, RobotSpec, RoleSpec, Scenario, Spot};
use cotama_core::units::MillimetresPerSecond;

/// The battery of a robot that drives home to be charged. Its size is that of the robot's file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Supply {
    /// The charge at the start of a run, in thousandths of the full battery.
    pub charge_permille: u16,
    /// The charge that a robot keeps back for what it did not foresee, in thousandths.
    pub reserve_permille: u16,
    /// The place where it is charged.
    pub home: Place,
    /// Power of the charger, in W.
    pub charger_w: u32,
}

impl Supply {
    /// Returns the power of the charger, in mW.
    pub fn charger_mw(&self) -> u64 {
        u64::from(self.charger_w) * 1_000
    }
}

impl RobotSpec {
    /// Returns the energy of the full battery by the robot's file, in mJ: its charge at the mean of
    /// the voltages of a full and of an empty one; 0 where the file has none.
    ///
    /// ```
    /// let robot = &cotama_models::team::scenario::service().unwrap().robots[0];
    /// assert_eq!(robot.full_mj(), 937_008_000); // 21.6 Ah at 12.05 V
    /// ```
    pub fn full_mj(&self) -> u64 {
        let battery = self.file.robot().body.as_ref().and_then(|it| it.battery);
        battery.map_or(0, |it| {
            let voltage = it.full_mv.saturating_add(it.empty_mv) / 2;
            it.capacity_mah.saturating_mul(voltage).saturating_mul(36) / 10
        })
    }

    /// Returns the energy of a drive over a way at a pace in mm/s, in mJ.
    pub fn drive_mj(&self, way_mm: u64, pace: u64) -> u64 {
        let motion = self.power_mw(pace).saturating_add(hardware_power(self.file.robot()));
        energy(motion, self.drive_ms(way_mm, pace))
    }

    /// Returns the energy of standing for so long, in mJ.
    pub fn stand_mj(&self, time_ms: u64) -> u64 {
        energy(self.power_mw(0), time_ms)
    }

    /// Returns the power of the motion at a speed in mm/s, in mW.
    pub fn power_mw(&self, pace: u64) -> u64 {
        let body = self.file.robot().body.as_ref();
        body.map_or(0, |it| it.motion_power.at(MillimetresPerSecond(pace)).0)
    }
}

fn energy(power_mw: u64, time_ms: u64) -> u64 {
    power_mw.saturating_mul(time_ms) / 1_000
}

impl Scenario {
    /// Returns the energy that a robot needs for a role, from there home, and keeps back, in mJ;
    /// 0 for a robot without a [`Supply`], `None` where no way leads.
    pub fn needs_mj(&self, role: &RoleSpec, outlook: &Outlook<'_>) -> Option<u64> {
        let Some(supply) = &outlook.robot.supply else { return Some(0) };
        let (robot, parts) = (outlook.robot, self.parts(role, outlook)?);
        let drives = parts.ways_mm.map(|it| robot.drive_mj(it, outlook.pace));
        let stands = parts.delays_ms.into_iter().chain([parts.take_ms, parts.give_ms]);
        let stands = stands.fold(parts.rounds_ms, u64::saturating_add);
        let home = self.home_mj(robot, outlook.ends[1], outlook.pace)?;
        let all = drives.into_iter().chain([robot.stand_mj(stands), home, reserve(robot, supply)]);
        Some(all.fold(0, u64::saturating_add))
    }

    /// Whether a robot has charge enough for a role at the start of a run.
    pub(super) fn is_charged_for(&self, role: &RoleSpec, outlook: &Outlook<'_>) -> bool {
        let Some(supply) = &outlook.robot.supply else { return true };
        let charge = outlook.robot.full_mj() / 1_000 * u64::from(supply.charge_permille);
        self.needs_mj(role, outlook).is_some_and(|it| it <= charge)
    }

    /// Returns the energy of the way home from a spot, in mJ; 0 for a robot without a [`Supply`],
    /// `None` where no way leads.
    pub fn home_mj(&self, robot: &RobotSpec, from: Spot, pace: u64) -> Option<u64> {
        let Some(supply) = &robot.supply else { return Some(0) };
        let way = self.floor.distance(from, Spot::at(supply.home))?;
        Some(if way == 0 { 0 } else { robot.drive_mj(way, pace) })
    }
}

/// Returns the energy that a robot keeps back, in mJ.
fn reserve(robot: &RobotSpec, supply: &Supply) -> u64 {
    robot.full_mj() / 1_000 * u64::from(supply.reserve_permille)
}
