//! The figures of a robot's body: its largest speed, and the power that it takes.

use cotama_core::hardware::Equipment;
use cotama_core::units::{MillimetresPerSecond, Milliwatts};
use cotama_models::cotama::{Configuration, Modules};
use cotama_models::missions::{Mission, MotionPower, embedded};
use std::sync::LazyLock;

/// The figures of a body.
#[derive(Debug)]
pub(crate) struct Chassis {
    pub(crate) speed_max: MillimetresPerSecond,
    motion: MotionPower,
    /// The power of the modules of each configuration.
    hardware: Vec<(Configuration, Milliwatts)>,
}

/// The body of the robot that the shipped supervisors drive.
pub(crate) static DELIVERY: LazyLock<Chassis> = LazyLock::new(|| {
    let it = embedded::mission("delivery").expect("it is shipped");
    Chassis::of(&Mission::parse(it.name, it.text).expect("a test reads it"))
});

impl Chassis {
    /// Returns the body of a mission's robot.
    pub(crate) fn of(mission: &Mission) -> Self {
        let units = |modules: Modules| {
            let kinds = mission.hardware.iter().enumerate();
            let used = |name: &str| modules.iter().any(|it| it.name() == name);
            let used = kinds.filter(|it| used(&it.1.name));
            used.fold(Equipment::NONE, |all, (kind, _)| all.with(kind, 1).unwrap_or(all))
        };
        let power = |it: &Configuration| (*it, mission.power_of(units(it.facts().required)));
        Self {
            speed_max: mission.robot.speed_max,
            motion: mission.motion_power,
            hardware: Configuration::ALL.iter().map(power).collect(),
        }
    }

    /// Returns the power in a configuration at a speed.
    pub(crate) fn power(
        &self,
        configuration: Option<Configuration>,
        speed: MillimetresPerSecond,
    ) -> Milliwatts {
        let of = self.hardware.iter().find(|it| Some(it.0) == configuration);
        Milliwatts(self.motion.at(speed).0.saturating_add(of.map_or(0, |it| it.1.0)))
    }
}
