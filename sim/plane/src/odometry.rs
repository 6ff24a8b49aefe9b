//! The pose that a robot works out from its encoders.

use crate::drivetrain::Drivetrain;
use crate::vehicle::arc;
use cotama_floor::Pose;

/// Dead reckoning: the arc between two readings of the encoders (Siegwart, Nourbakhsh, Scaramuzza,
/// Introduction to Autonomous Mobile Robots, 2nd ed., Section 5.2.4), with the wheels as the robot
/// knows them.
#[derive(Clone, Debug, PartialEq)]
pub struct Odometry {
    pose: Pose,
    counts: [i64; 2],
}

impl Odometry {
    /// A robot that knows where it is, with its encoders at 0.
    pub const fn new(pose: Pose) -> Self {
        Self { pose, counts: [0; 2] }
    }

    /// Returns the pose.
    pub const fn pose(&self) -> &Pose {
        &self.pose
    }

    /// Begins anew at a pose.
    pub const fn begin(&mut self, pose: Pose) {
        self.pose = pose;
    }

    /// Reads the encoders.
    #[allow(clippy::cast_precision_loss)] // counts between two readings are few
    pub fn read(&mut self, drivetrain: &Drivetrain, counts: [i64; 2]) {
        let turn = core::f64::consts::TAU / drivetrain.counts * drivetrain.wheel;
        let [left, right] =
            [0, 1].map(|side: usize| (counts[side] - self.counts[side]) as f64 * turn);
        self.counts = counts;
        self.pose *= arc(f64::midpoint(left, right), (right - left) / drivetrain.axle);
    }
}
