//! The ids of the failure modes that are known of the robot.

/// A failure mode of the FMECA (failure modes, effects and criticality analysis) of the delivery robot: its position in
/// [`FailureMode::IDS`].
///
/// ```
/// use cotama_models::cotama::failure_modes::FailureMode;
/// let slow = FailureMode::from_id("RT1").unwrap(); // a module misses its deadline again and again
/// assert_eq!(slow.id(), "RT1");
/// assert_eq!(FailureMode::from_id("RT9"), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FailureMode(u8);

impl FailureMode {
    /// All ids, by component: sonars, odometry, bumpers, camera, motors, wheels, emergency button, batteries,
    /// micro-controller, timing, software, localisation, planning, avoidance, people, communication, operator.
    pub const IDS: [&'static str; 40] = [
        "SON1", "SON2", "SON3", "SON4", "ODO1", "ODO2", "ODO3", "ODO4", "BMP1", "BMP2", "CAM1", "CAM2",
        "MOT1", "MOT2", "MOT3", "MOT4", "WHL1", "EST1", "BAT1", "BAT2", "BAT3", "PWR1", "P3D1", "P3D2",
        "P3D3", "RT1", "RT2", "RT3", "SW1", "SW2", "SW3", "LOC1", "LOC2", "LOC3", "PPL1", "COL1", "HUM1",
        "COM1", "COM2", "OPR1",
    ];

    /// The failure mode of this id.
    pub fn from_id(id: &str) -> Option<Self> {
        Self::IDS.iter().zip(0..).find(|(known, _)| **known == id).map(|(_, index)| Self(index))
    }

    /// Its id.
    pub fn id(self) -> &'static str {
        Self::IDS.get(usize::from(self.0)).copied().unwrap_or_default()
    }
}
