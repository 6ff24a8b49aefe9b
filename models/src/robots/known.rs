//! Numbers and words that a robot's file may have: for the reader, and for the schema of the file.

use super::{Motion, Try};
use std::ops::RangeInclusive;

/// Value of `format` in files of robots.
pub const FORMAT: &str = "cotama-robot/1";
/// Times in ms, up to an hour.
pub const TIMES: RangeInclusive<i64> = 1..=3_600_000;
/// Times in µs, up to a minute.
pub const COSTS: RangeInclusive<i64> = 1..=60_000_000;
/// Speeds in mm/s, up to 10 m/s.
pub const SPEEDS: RangeInclusive<i64> = 0..=10_000;
/// Power in mW, up to 10 kW.
pub const POWERS: RangeInclusive<i64> = 0..=10_000_000;
/// Units of hardware.
pub const UNITS: RangeInclusive<i64> = 1..=255;
/// Ranks of configurations.
pub const RANKS: RangeInclusive<i64> = 0..=255;
/// How often a module is started anew.
pub const RESTARTS: RangeInclusive<i64> = 1..=9;
/// How often a setting alone is the answer.
pub const SETTINGS: RangeInclusive<i64> = 1..=9;
/// How often the operator is asked first.
pub const ASKS: RangeInclusive<i64> = 1..=9;
/// When flags are masked: with what is told of the failure, or on the operator's order.
pub const MASKS: [&str; 2] = ["told", "order"];
/// Names of the rule for parts that an observer alone watches, while it sees nothing.
pub const UNWATCHED: [&str; 2] = ["kept", "lost"];
/// Reactions that are tried one after the other, by their keys.
pub const TRIES: [(&str, Try); 3] =
    [("restart", Try::Restart), ("set", Try::Set), ("ask", Try::Ask)];
/// Values of parameters of modules.
pub const VALUES: RangeInclusive<i64> = 0..=1_000_000_000;
/// How long a setting outlasts its failure, in ms.
pub const HOLDS: RangeInclusive<i64> = 0..=3_600_000;
/// The most parameters of a module.
pub const MAX_PARAMETERS: usize = 16;
/// Modes of autonomy.
pub const MODES: [&str; 2] = ["autonomous", "operator"];
/// Severities.
pub const SEVERITIES: [&str; 4] = ["weak", "medium", "hard", "fatal"];
/// Persistences of failures.
pub const PERSISTENCES: [&str; 3] = ["permanent", "intermittent", "transient"];

/// Masses in g, accelerations in mm/s², energies in mJ.
pub const POSITIVE: RangeInclusive<i64> = 1..=1_000_000_000;
/// Coefficients of the power of motion.
pub const COEFFICIENTS: RangeInclusive<i64> = 0..=1_000_000_000;
/// Speeds that a body can have, in mm/s.
pub const BODY_SPEEDS: RangeInclusive<i64> = 1..=10_000;
/// Periods of a control loop in ms.
pub const PERIODS: RangeInclusive<i64> = 10..=1_000;
/// Radii of bodies in mm.
pub const RADII: RangeInclusive<i64> = 1..=10_000;
/// Radii of wheels in µm.
pub const WHEELS: RangeInclusive<i64> = 1_000..=2_000_000;
/// Distances between wheels in mm.
pub const AXLES: RangeInclusive<i64> = 10..=10_000;
/// Speeds of turning in thousandths of rad/s, and how fast they change.
pub const TURNS: RangeInclusive<i64> = 1..=20_000;
/// Counts of an encoder.
pub const COUNTS: RangeInclusive<i64> = 1..=10_000_000;
/// Errors of wheels in millionths.
pub const ERRORS: RangeInclusive<i64> = -100_000..=100_000;
/// Voltages of motors and batteries in mV.
pub const VOLTAGES: RangeInclusive<i64> = 1_000..=1_000_000;
/// Resistances in mΩ.
pub const RESISTANCES: RangeInclusive<i64> = 1..=1_000_000;
/// Currents of motors in mA.
pub const CURRENTS: RangeInclusive<i64> = 1..=1_000_000;
/// Speeds of wheels without a load, in thousandths of rad/s.
pub const NO_LOADS: RangeInclusive<i64> = 100..=1_000_000;
/// Forces of rolling in thousandths of a weight.
pub const ROLLINGS: RangeInclusive<i64> = 0..=1_000;
/// Charges of batteries in mAh.
pub const CHARGES: RangeInclusive<i64> = 1..=10_000_000;
/// Cells in series.
pub const CELLS: RangeInclusive<i64> = 1..=1_000;
/// Thousandths of the commanded speed that are left.
pub const SLOWED: RangeInclusive<i64> = 1..=999;
/// Rings of sonars: that of a Pioneer 3-DX, or none.
pub const SONARS: [&str; 2] = ["pioneer", "none"];
/// Places of devices on a robot, in mm.
pub const MOUNTS: RangeInclusive<i64> = -10_000..=10_000;
/// Ways that devices look, in degrees.
pub const HEADINGS: RangeInclusive<i64> = -180..=180;
/// Fields of view in degrees.
pub const VIEWS: RangeInclusive<i64> = 1..=360;
/// Rays of a scan.
pub const RAYS: RangeInclusive<i64> = 8..=4_096;
/// Ranges of lasers in mm.
pub const RANGES: RangeInclusive<i64> = 100..=200_000;
/// Least ranges, and deviations of ranges, in mm.
pub const LEASTS: RangeInclusive<i64> = 0..=10_000;
/// Times between readings in ms.
pub const RATES: RangeInclusive<i64> = 10..=1_000;
/// Times from a reading to its arrival in ms.
pub const LATENCIES: RangeInclusive<i64> = 0..=1_000;
/// Speeds at which pictures are sharp, in mm/s.
pub const SHARP: RangeInclusive<i64> = 1..=10_000;
/// Deviations of a gyro in millionths of rad/s.
pub const NOISES: RangeInclusive<i64> = 0..=1_000_000;
/// Sonars that a failure harms; of lasers and of two sides, the first ones.
pub const HARM_UNITS: RangeInclusive<i64> = 0..=15;
/// Parts that a harm takes, in thousandths.
pub const HARMED: RangeInclusive<i64> = 1..=1_000;
/// Time that comes to jobs, in thousandths of what they take.
pub const LENGTHENED: RangeInclusive<i64> = 1..=60_000;
/// Effects of failures on motion, with their names.
pub const MOTIONS: [(&str, Motion); 5] = [
    ("blocked", Motion::Blocked),
    ("runaway", Motion::Runaway),
    ("dead", Motion::Dead),
    ("silent", Motion::Silent),
    ("mindless", Motion::Mindless),
];
