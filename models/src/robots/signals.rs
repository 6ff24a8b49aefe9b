//! Parts of a robot in the plane where nothing is told: the algorithms that its modules run, the
//! signals that its observers watch, and the harm that a failure does to a device.
//!
//! A robot's file names them in words; [`ROLES`], [`WATCHES`] and [`HARMS`] are these words.

/// The algorithm that a module runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Role {
    /// The pose by the counts of the encoders.
    Odometry,
    /// The pose in the map, by ranges.
    Localisation,
    /// Ranges made usable: a map of what is near.
    Ranges,
    /// A path over the floor.
    Planning,
    /// Speeds along a path.
    Guidance,
    /// Speeds that keep away from what is near.
    Avoidance,
    /// Images for the operator.
    Images,
    /// The link to the operator.
    Link,
}

/// The signal that a flag is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Watch {
    /// A sonar that reads its largest range for a long way (Durand et al., TAROS 2010, Section
    /// VI.A.3).
    LargestRange,
    /// A sonar that reads the same short range for a long way.
    ShortestRange,
    /// Ranges that do not come.
    NoRanges,
    /// Encoders that count other than the motors make the wheels turn.
    Encoders,
    /// Wheels that slip.
    Slip,
    /// A motor that turns its wheel not at all.
    NoTorque,
    /// A motor that turns its wheel more slowly than it is told.
    WeakTorque,
    /// Odometry apart from localisation, by more than both allow for.
    PoseApart,
    /// Odometry that leaves localisation further with each metre.
    PoseGrows,
    /// Odometry that leaves localisation at once.
    PosePeak,
    /// Localisation that jumps.
    PoseJumps,
    /// Localisation that is spread.
    PoseSpread,
    /// Motion backwards for too long (Section VI.A.2).
    Backward,
    /// A path from which the robot stays away.
    OffPath,
    /// A path along which it gets no further.
    NoProgress,
    /// A level of the link that is low.
    LinkLow,
    /// A link that is silent.
    LinkSilent,
    /// The bumpers.
    Bumper,
    /// The bumpers, where ranges see nothing.
    BumperAlone,
    /// The stall bit of the motors.
    Stall,
    /// The voltage of the battery, near to its end.
    VoltageLow,
    /// The voltage of the battery, at its end.
    VoltageCritical,
    /// Packets of the micro-controller that do not come.
    PacketSilence,
    /// Packets of the micro-controller that are lost now and then.
    PacketErrors,
    /// Packets that begin anew.
    PacketRestart,
    /// Images that do not come.
    NoImage,
    /// Images that are old.
    OldImage,
    /// Ranges of which many jump from reading to reading.
    RangeOutliers,
    /// Odometry that leaves localisation slowly, over a minute.
    PoseDrifts,
    /// Wheels that turn faster than they are told.
    Runaway,
    /// The emergency button, as the micro-controller tells it.
    EmergencyStop,
    /// A planner that finds no path.
    PlanFailed,
    /// A job of a module that was late, and the next one is not.
    JobLate,
    /// A module that localises and is late again and again.
    LocalisationLate,
    /// Another module that is late again and again.
    ModuleLate,
    /// A module that publishes nothing and is not late.
    ModuleSilent,
    /// A module that publishes values that are none.
    ValueOutside,
    /// Scans of a laser that do not come; of any where no number is said.
    LaserSilent(Option<u8>),
    /// A laser that sees nothing within its range.
    LaserBlind(Option<u8>),
    /// Scans of a laser that do not match the map where the robot believes to be.
    LaserApart(Option<u8>),
    /// QR marks that should be in the picture and are not.
    MarksMissing,
    /// A gyro whose readings do not come.
    GyroSilent,
    /// The turn by the gyro apart from that by the encoders.
    GyroApart,
}

/// The harm that a failure does to a device or a module.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Harm {
    /// A sonar reads its largest range.
    SonarFar,
    /// A sonar reads a short range.
    SonarNear,
    /// No sonar reads anything.
    SonarSilent,
    /// An encoder counts nothing.
    EncoderDead,
    /// An encoder loses a part of its counts.
    EncoderLossy,
    /// Both wheels slip for a part of their way.
    WheelSlips,
    /// No wheel turns, whatever its motor does.
    WheelsStall,
    /// A motor has less torque.
    MotorWeak,
    /// A motor has none.
    MotorDead,
    /// The bumpers are pressed.
    BumperClosed,
    /// The voltage of the battery is low.
    BatteryLow,
    /// The voltage of the battery is at its end.
    BatteryCritical,
    /// No packet of the micro-controller comes.
    PacketsSilent,
    /// Packets are lost.
    PacketsLossy,
    /// The micro-controller begins anew: its pose is zero.
    PacketsRestart,
    /// The camera gives no image.
    CameraSilent,
    /// The camera gives old images.
    CameraLate,
    /// The link is down.
    LinkDown,
    /// The link is weak.
    LinkWeak,
    /// Localisation is elsewhere.
    PoseLost,
    /// Something that is on no map stands in the way.
    MapWrong,
    /// Somebody stands in the way.
    PersonInWay,
    /// Something that no sonar sees stands in the way.
    ThingUnseen,
    /// Sonars read echoes from anywhere, now and then.
    SonarsNoisy,
    /// A wheel is smaller than its odometry knows.
    WheelsUnequal,
    /// The bumpers are never pressed.
    BumperDead,
    /// The motors run as fast as they can, whatever they are told.
    MotorRunaway,
    /// The emergency button is pressed: motors are off.
    EmergencyStop,
    /// The planner finds no path.
    PlanFails,
    /// All modules take longer.
    ComputerBusy,
    /// A module takes longer.
    ModuleSlow,
    /// A module is gone: it publishes nothing.
    ModuleCrashed,
    /// A module publishes values that are none.
    ModuleWrong,
    /// A laser gives no scan.
    LaserSilent,
    /// A laser sees nothing.
    LaserBlind,
    /// A laser reads too far, by as many mm as the thousandths of the harm.
    LaserBiased,
    /// No mark is found, though images come.
    MarksCovered,
    /// A gyro gives no reading.
    GyroDead,
    /// A gyro reads more and more: after ten seconds as many thousandths of rad/s as the harm has.
    GyroDrift,
}

impl Harm {
    /// Whether it harms a module of the robot, which the failure names.
    pub const fn is_of_module(self) -> bool {
        matches!(self, Self::ModuleSlow | Self::ModuleCrashed | Self::ModuleWrong)
    }

    /// Whether it lengthens the time of jobs: by any part, not by the whole at most.
    pub const fn lengthens(self) -> bool {
        matches!(self, Self::ModuleSlow | Self::ComputerBusy)
    }

    /// Whether it is one of a laser, which `unit` numbers.
    pub const fn is_of_laser(self) -> bool {
        matches!(self, Self::LaserSilent | Self::LaserBlind | Self::LaserBiased)
    }
}

/// A harm, and how much of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Harmed {
    /// The harm.
    pub harm: Harm,
    /// The sonar or the laser, from 0 on; the side, of which 0 is left, 1 is right; or the module.
    pub unit: u8,
    /// The part that is lost, in thousandths; of a reading that is wrong, how much, in thousandths
    /// of its unit; of jobs, the time that comes to them.
    pub permille: u16,
}

/// Algorithms of modules, by their words.
pub const ROLES: [(&str, Role); 8] = [
    ("odometry", Role::Odometry),
    ("localisation", Role::Localisation),
    ("ranges", Role::Ranges),
    ("planning", Role::Planning),
    ("guidance", Role::Guidance),
    ("avoidance", Role::Avoidance),
    ("images", Role::Images),
    ("link", Role::Link),
];

/// The word for a flag that is told in the plane too.
pub const TOLD: &str = "told";

/// Signals that flags are made of, by their words.
pub const WATCHES: [(&str, Watch); 55] = [
    ("largest range", Watch::LargestRange),
    ("shortest range", Watch::ShortestRange),
    ("no ranges", Watch::NoRanges),
    ("encoders", Watch::Encoders),
    ("slip", Watch::Slip),
    ("no torque", Watch::NoTorque),
    ("weak torque", Watch::WeakTorque),
    ("pose apart", Watch::PoseApart),
    ("pose grows", Watch::PoseGrows),
    ("pose peak", Watch::PosePeak),
    ("pose jumps", Watch::PoseJumps),
    ("pose spread", Watch::PoseSpread),
    ("backward", Watch::Backward),
    ("off path", Watch::OffPath),
    ("no progress", Watch::NoProgress),
    ("link low", Watch::LinkLow),
    ("link silent", Watch::LinkSilent),
    ("bumper", Watch::Bumper),
    ("bumper alone", Watch::BumperAlone),
    ("stall", Watch::Stall),
    ("voltage low", Watch::VoltageLow),
    ("voltage critical", Watch::VoltageCritical),
    ("packet silence", Watch::PacketSilence),
    ("packet errors", Watch::PacketErrors),
    ("packet restart", Watch::PacketRestart),
    ("no image", Watch::NoImage),
    ("old image", Watch::OldImage),
    ("range outliers", Watch::RangeOutliers),
    ("pose drifts", Watch::PoseDrifts),
    ("runaway", Watch::Runaway),
    ("emergency stop", Watch::EmergencyStop),
    ("plan failed", Watch::PlanFailed),
    ("job late", Watch::JobLate),
    ("localisation late", Watch::LocalisationLate),
    ("module late", Watch::ModuleLate),
    ("module silent", Watch::ModuleSilent),
    ("value outside", Watch::ValueOutside),
    ("laser silent", Watch::LaserSilent(None)),
    ("laser 0 silent", Watch::LaserSilent(Some(0))),
    ("laser 1 silent", Watch::LaserSilent(Some(1))),
    ("laser 2 silent", Watch::LaserSilent(Some(2))),
    ("laser 3 silent", Watch::LaserSilent(Some(3))),
    ("laser at its longest", Watch::LaserBlind(None)),
    ("laser 0 at its longest", Watch::LaserBlind(Some(0))),
    ("laser 1 at its longest", Watch::LaserBlind(Some(1))),
    ("laser 2 at its longest", Watch::LaserBlind(Some(2))),
    ("laser 3 at its longest", Watch::LaserBlind(Some(3))),
    ("laser apart", Watch::LaserApart(None)),
    ("laser 0 apart", Watch::LaserApart(Some(0))),
    ("laser 1 apart", Watch::LaserApart(Some(1))),
    ("laser 2 apart", Watch::LaserApart(Some(2))),
    ("laser 3 apart", Watch::LaserApart(Some(3))),
    ("marks missing", Watch::MarksMissing),
    ("gyro silent", Watch::GyroSilent),
    ("gyro apart", Watch::GyroApart),
];

/// Harms of failures, by their words.
pub const HARMS: [(&str, Harm); 39] = [
    ("sonar far", Harm::SonarFar),
    ("sonar near", Harm::SonarNear),
    ("sonars silent", Harm::SonarSilent),
    ("encoder dead", Harm::EncoderDead),
    ("encoder lossy", Harm::EncoderLossy),
    ("wheels slip", Harm::WheelSlips),
    ("wheels stall", Harm::WheelsStall),
    ("motor weak", Harm::MotorWeak),
    ("motor dead", Harm::MotorDead),
    ("bumper closed", Harm::BumperClosed),
    ("battery low", Harm::BatteryLow),
    ("battery critical", Harm::BatteryCritical),
    ("packets silent", Harm::PacketsSilent),
    ("packets lossy", Harm::PacketsLossy),
    ("packets restart", Harm::PacketsRestart),
    ("camera silent", Harm::CameraSilent),
    ("camera late", Harm::CameraLate),
    ("link down", Harm::LinkDown),
    ("link weak", Harm::LinkWeak),
    ("pose lost", Harm::PoseLost),
    ("map wrong", Harm::MapWrong),
    ("person in the way", Harm::PersonInWay),
    ("thing unseen", Harm::ThingUnseen),
    ("sonars noisy", Harm::SonarsNoisy),
    ("wheels unequal", Harm::WheelsUnequal),
    ("bumper dead", Harm::BumperDead),
    ("motor runaway", Harm::MotorRunaway),
    ("emergency stop", Harm::EmergencyStop),
    ("plan fails", Harm::PlanFails),
    ("computer busy", Harm::ComputerBusy),
    ("module slow", Harm::ModuleSlow),
    ("module crashed", Harm::ModuleCrashed),
    ("module wrong", Harm::ModuleWrong),
    ("laser silent", Harm::LaserSilent),
    ("laser blind", Harm::LaserBlind),
    ("laser biased", Harm::LaserBiased),
    ("marks covered", Harm::MarksCovered),
    ("gyro dead", Harm::GyroDead),
    ("gyro drift", Harm::GyroDrift),
];
