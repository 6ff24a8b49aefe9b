//! Events and outputs of the delivery robot's decisional level, by number: enums that mirror those
//! of `cotama-models`, which is checked while compiling.

use crate::error::{Done, cotama_error};
use crate::firings::cotama_text;
use crate::memory::Pieces;
use cotama_models::cotama::{Configuration, FailureMode, Flag, Module, Word, operator};

/// Whether an enum for C has the members of one of Rust's, with their numbers.
macro_rules! mirrors {
    ($c:ident = $rust:ident: $($member:ident)*) => {
        const _: () = {
            let mut members = 0;
            $(
                assert!($c::$member as u32 == $rust::$member as u32);
                members += 1;
            )*
            assert!(members == $rust::ALL.len());
        };
    };
}

/// The observation of an observer: flag `n` is bit `n` of a set of flags.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum cotama_flag {
    /// O-SEN: a sonar at its largest range for long while the robot moves.
    SonarFar = 0,
    /// O-SEN: no fresh range.
    SonarSilent = 1,
    /// O-SEN: a sonar at one short range while the robot moves.
    SonarNear = 2,
    /// O-SEN: many readings rejected.
    SonarOutliers = 3,
    /// O-SEN: the sonars see free space where the bumper is closed.
    FreeAhead = 4,
    /// O-SEN: no camera frame.
    NoFrame = 5,
    /// O-COM or O-SEN: camera frames come late.
    OldFrame = 6,
    /// O-SEN, O-LOC or O-PF, for any module: a value out of its interval.
    ValueOutside = 7,
    /// O-EFF: the filter's residual says that wheel and encoder disagree.
    WheelResidual = 8,
    /// O-EFF: a residual that went back to normal.
    WheelPeak = 9,
    /// O-EFF: a wheel does not follow its command.
    WheelDisobeys = 10,
    /// O-EFF: the estimated gain of an actuator is low.
    WheelGain = 11,
    /// O-EFF or P3D: speed above the limit, or against the command.
    Runaway = 12,
    /// O-LOC: odometric and MCL pose are far apart.
    PoseDistance = 13,
    /// O-LOC: odometric and MCL pose move apart quickly.
    PoseGrowth = 14,
    /// O-LOC: odometric and MCL pose moved apart for a moment.
    PosePeak = 15,
    /// O-LOC: odometric and MCL pose move apart slowly, always the same way.
    SlowDrift = 16,
    /// O-LOC: a pose jumped.
    PoseJump = 17,
    /// O-LOC: the particles are spread wide.
    Spread = 18,
    /// O-PF: backward for too long.
    Backward = 19,
    /// O-PF: the path error does not converge.
    NoConvergence = 20,
    /// O-PF: hardly any progress.
    NoProgress = 21,
    /// O-COM: no link, no heartbeat.
    LinkDown = 22,
    /// O-COM: level or noise out of its interval.
    LinkPoor = 23,
    /// P3D: a bumper is closed.
    Bumper = 24,
    /// P3D: the motors stall.
    Stall = 25,
    /// P3D: the emergency button.
    EmergencyStop = 26,
    /// P3D: low voltage.
    BatteryLow = 27,
    /// P3D: critical voltage.
    BatteryCritical = 28,
    /// P3D: no packet from the robot.
    PacketSilence = 29,
    /// P3D: many checksum errors.
    PacketErrors = 30,
    /// P3D: the packet sequence starts anew.
    SequenceRestart = 31,
    /// SCH: MCL missed several deadlines in a row.
    MclLate = 32,
    /// SCH: one job was late, inside its extra time.
    OneLate = 33,
    /// SCH: another module missed several deadlines in a row.
    ModuleLate = 34,
    /// SCH: a module completes nothing any more.
    ModuleSilent = 35,
    /// PPL: the planner failed or timed out.
    PlanFailed = 36,
    /// The contextual supervisor's timer: the operator does not answer.
    OperatorSilent = 37,
    /// On the operator's side: no heartbeat from the robot.
    RobotSilent = 38,
}
mirrors! { cotama_flag = Flag:
    SonarFar SonarSilent SonarNear SonarOutliers FreeAhead NoFrame OldFrame ValueOutside
    WheelResidual WheelPeak WheelDisobeys WheelGain Runaway PoseDistance PoseGrowth PosePeak
    SlowDrift PoseJump Spread Backward NoConvergence NoProgress LinkDown LinkPoor Bumper Stall
    EmergencyStop BatteryLow BatteryCritical PacketSilence PacketErrors SequenceRestart MclLate
    OneLate ModuleLate ModuleSilent PlanFailed OperatorSilent RobotSilent
}

/// A module of the executive level: module `n` is bit `n` of a set of modules.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum cotama_module {
    /// Scheduler, and observer of real-time faults.
    Sch = 0,
    /// Global observation module: collects flags, diagnoses, keeps the status vector.
    Gom = 1,
    /// Link to the robot's micro-controller.
    P3d = 2,
    /// Hardware in the loop: makes the sonar values.
    Sim = 3,
    /// Sonar values made usable.
    Ust = 4,
    /// Monte Carlo localisation.
    Mcl = 5,
    /// Odometric pose.
    Odo = 6,
    /// Navigation: selection of the pose, control law.
    Nav = 7,
    /// The asymptotic control law with saturation of the actuators.
    Ctr = 8,
    /// Path planning.
    Ppl = 9,
    /// Guidance: path following alone.
    Gui = 10,
    /// Safe manoeuvring zone: avoidance and guidance in one.
    Smz = 11,
    /// Deformable virtual zone: reactive avoidance.
    Dvz = 12,
    /// The wireless link to the operator.
    Lan = 13,
    /// Camera stream for the operator.
    Cam = 14,
    /// Observer of sensor data.
    OSen = 15,
    /// Observer of motors and wheels.
    OEff = 16,
    /// Observer of the link to the operator.
    OCom = 17,
    /// Observer of localisation.
    OLoc = 18,
    /// Observer of path following.
    OPf = 19,
}
mirrors! { cotama_module = Module:
    Sch Gom P3d Sim Ust Mcl Odo Nav Ctr Ppl Gui Smz Dvz Lan Cam OSen OEff OCom OLoc OPf
}

/// All modules, as a set.
pub const COTAMA_MODULES_ALL: u32 = 0xfffff;
const _: () = assert!(COTAMA_MODULES_ALL == cotama_models::cotama::Modules::ALL.bits());

/// A set of modules that serves one sub-objective.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum cotama_configuration {
    /// Path planning.
    Planning = 0,
    /// Path following, optimal.
    FollowingOptimal = 1,
    /// The same with fewer particles.
    FollowingReduced = 2,
    /// Path following by odometry, with avoidance.
    FollowingOdometric = 3,
    /// Path following without avoidance and localisation, slower.
    FollowingDegraded = 4,
    /// Path following with the other avoidance.
    FollowingDvz = 5,
    /// The robot stands; the operator edits way-points or a path.
    Teleprogramming = 6,
    /// Teleoperation with avoidance.
    TeleoperationFull = 7,
    /// Teleoperation without.
    TeleoperationDegraded = 8,
    /// Stop, alarm, warning.
    Security = 9,
}
mirrors! { cotama_configuration = Configuration:
    Planning FollowingOptimal FollowingReduced FollowingOdometric FollowingDegraded FollowingDvz
    Teleprogramming TeleoperationFull TeleoperationDegraded Security
}

/// A word of the mission, of the planner of paths, or of the operator.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum cotama_word {
    /// Nobody says anything.
    Nothing = 0,
    /// A mission is given.
    MissionReceived = 1,
    /// The object is on board.
    ObjectReceived = 2,
    /// The object was handed over.
    ObjectDelivered = 3,
    /// A path is planned.
    PathReady = 4,
    /// The operator wants to edit way-points or a path.
    Teleprogram = 5,
    /// The operator wants to drive.
    Teleoperate = 6,
    /// The operator gives way-points.
    Waypoints = 7,
    /// The operator gives a path.
    NewPath = 8,
    /// The operator has driven to the goal.
    Arrived = 9,
    /// The operator gives up.
    GivesUp = 10,
}

/// The word of a number.
pub(crate) fn word_of(number: u32) -> Result<Option<Word>, cotama_error> {
    use operator::Event;
    Ok(Some(match number {
        0 => return Ok(None),
        1 => Word::MissionReceived,
        2 => Word::ObjectReceived,
        3 => Word::ObjectDelivered,
        4 => Word::PathReady,
        5 => Word::Operator(Event::teleprogram),
        6 => Word::Operator(Event::teleoperate),
        7 => Word::Operator(Event::waypoints),
        8 => Word::Operator(Event::new_path),
        9 => Word::Operator(Event::arrived),
        10 => Word::Operator(Event::gives_up),
        _ => return Err(cotama_error::BadNumber),
    }))
}

/// The configuration of a number; none for `COTAMA_NONE` and for all that stand for nothing.
pub(crate) fn configuration_of(number: u32) -> Option<Configuration> {
    Configuration::ALL.get(number as usize).copied()
}

/// Puts a name where C wants it.
///
/// # Safety
/// The pointer is null or points to memory for a text.
unsafe fn tell(name: Option<&'static str>, to: *mut cotama_text) -> Done {
    // SAFETY: the caller promises the same.
    let to = unsafe { Pieces::new().out(to) }?;
    to.put(name.ok_or(cotama_error::BadNumber)?.into());
    Ok(())
}

/// The name of a `cotama_flag` in print.
///
/// # Safety
/// The pointer is null or points to memory for a text.
// SAFETY: no other function of the program has this name; so for all below.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_flag_name(flag: u32, name: *mut cotama_text) -> cotama_error {
    // SAFETY: the caller promises the same.
    unsafe { tell(Flag::ALL.get(flag as usize).map(|it| it.name()), name) }.into()
}

/// The name of a `cotama_module` in print.
///
/// # Safety
/// The pointer is null or points to memory for a text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_module_name(module: u32, name: *mut cotama_text) -> cotama_error {
    // SAFETY: the caller promises the same.
    unsafe { tell(Module::ALL.get(module as usize).map(|it| it.name()), name) }.into()
}

/// The name of a `cotama_configuration` in print.
///
/// # Safety
/// The pointer is null or points to memory for a text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_configuration_name(
    configuration: u32,
    name: *mut cotama_text,
) -> cotama_error {
    // SAFETY: the caller promises the same.
    unsafe { tell(configuration_of(configuration).map(Configuration::name), name) }.into()
}

/// The name of a row of the FMECA, such as SON1: mode `n` is bit `n` of the modes of a finding.
///
/// # Safety
/// The pointer is null or points to memory for a text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_failure_mode_name(
    mode: u32,
    name: *mut cotama_text,
) -> cotama_error {
    // SAFETY: the caller promises the same.
    unsafe { tell(FailureMode::ALL.get(mode as usize).map(|it| it.name()), name) }.into()
}
