//! Ports between modules: data, events, requests, parameters (Durand et al., TAROS 2010, Section
//! II.B: a module has ports for each).

use crate::cotama::label::Label;
use crate::cotama::members::members;

members! {
    /// A kind of data that modules hand to each other in mailboxes.
    Datum,
    /// Kinds of data.
    Data(u32) {
        /// Raw sonar values.
        SonarValues = "sonar values",
        /// Ranges, ready for the algorithms.
        Ranges = "ranges",
        /// Encoder ticks.
        Ticks = "ticks",
        /// Bumpers, battery voltage, stall, emergency button.
        RobotState = "robot state",
        /// The command to the motors.
        MotorCommand = "motor command",
        /// The pose by the particle filter.
        MclPose = "MCL pose",
        /// The pose by the encoders.
        OdometricPose = "odometric pose",
        /// The selected pose.
        Pose = "pose",
        /// A path to follow.
        Path = "path",
        /// Wanted speed and turn rate.
        Course = "course",
        /// Level, noise and heartbeat of the link to the operator.
        LinkState = "link state",
        /// A camera frame.
        Image = "image",
        /// When jobs started and ended.
        JobTimes = "job times",
        /// Flags of the observers.
        Flags = "flags",
        /// The module status vector.
        StatusVector = "status vector",
    }
}

members! {
    /// An event that a module sends to the decisional level.
    ModuleEvent,
    /// Events to the decisional level.
    ModuleEvents(u8) {
        /// The status vector or the set of faults changed.
        StatusChanged = "status changed",
        /// Too many deadlines missed in a row.
        RealTimeFault = "real-time fault",
        /// A path is planned.
        PathReady = "path ready",
        /// No path was found.
        PlannerFailed = "planner failed",
        /// The end of the path is reached.
        GoalReached = "goal reached",
        /// The operator answered or asked for something.
        Operator = "operator",
    }
}

/// A request that every module takes (stated: three types, and that requests also set ports).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Request {
    /// Run.
    Activate,
    /// Pause.
    Stop,
    /// End.
    Kill,
    /// Set the data and event ports: no type of its own in the paper.
    Configure,
}

/// A setting that a request carries to a module.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Parameter {
    /// Name of the port, unique in its module.
    pub name: &'static str,
    /// The unit of the three numbers; empty for a count.
    pub unit: &'static str,
    /// The least value.
    pub low: u32,
    /// The largest value.
    pub high: u32,
    /// The value to start with, in the range.
    pub initial: u32,
    /// How well the initial value is known. Ranges are assumed.
    pub label: Label,
}
