//! The numbers and words that mission files and files of faults can hold, as the reader checks them
//! and a schema for editors repeats them.

use super::terms::PlannedFor;
use cotama_core::hardware::MAX_UNITS;
use std::ops::RangeInclusive;

/// The largest length, duration, mass or power, in mm, ms, g or mW.
pub const MAX_QUANTITY: i64 = 1_000_000_000;
/// Quantities that cannot be zero.
pub const POSITIVE: RangeInclusive<i64> = 1..=MAX_QUANTITY;
/// Quantities that can be zero.
pub const AT_LEAST_ZERO: RangeInclusive<i64> = 0..=MAX_QUANTITY;
/// Speeds in mm/s: up to 100 m/s, so that no power passes 64 bits.
pub const SPEEDS: RangeInclusive<i64> = 1..=100_000;
/// Qualities of options, without a unit.
pub const QUALITIES: RangeInclusive<i64> = 0..=1_000_000;
/// Limits of energy in mJ: up to 1 GJ.
pub const ENERGIES: RangeInclusive<i64> = 1..=1_000_000_000_000;
/// A limit that no mission reaches, in ms or mJ: that of an axis without a constraint.
pub const NO_LIMIT: u64 = 1_000_000_000_000_000;
/// Units of one kind of hardware that there are, are lost or come back.
pub const UNITS: RangeInclusive<i64> = 1..=MAX_UNITS as i64;
/// Units of one kind of hardware that an option needs.
pub const NEEDED_UNITS: RangeInclusive<i64> = 0..=MAX_UNITS as i64;
/// Periods of the margin monitor in ms: up to an hour.
pub const PERIODS: RangeInclusive<i64> = 1..=3_600_000;
/// By how much real power differs from the modelled one, in parts per thousand.
pub const POWER_ERRORS: RangeInclusive<i64> = -999..=10_000;
/// How many random events are expected on a kilometre.
pub const PER_KM: RangeInclusive<i64> = 1..=1000;
/// Attributes of parts of a mission, which formulas of axes read.
pub const ATTRIBUTES: RangeInclusive<i64> = -1_000_000_000_000..=1_000_000_000_000;
/// How many characters the name of a mission has.
pub const NAME_LENGTHS: RangeInclusive<usize> = 1..=100;
/// How many characters an id has.
pub const ID_LENGTHS: RangeInclusive<usize> = 1..=crate::names::MAX_ID;
/// People who walk where a seed draws.
pub const PEOPLE: RangeInclusive<i64> = 0..=1_000;
/// Speeds of people in mm/s: up to that of a runner.
pub const WALKING_SPEEDS: RangeInclusive<i64> = 100..=10_000;
/// Room beyond the radius of a robot that its path keeps, in mm.
pub const CLEARANCE_MM: RangeInclusive<i64> = 0..=1_000;
/// The most people of whom a mission says where they walk.
pub const MAX_PERSONS: usize = 100;
/// The most places between which a person walks.
pub const MAX_WALKS: usize = 16;
/// The most entries of one list or table.
pub const MAX_ENTRIES: usize = 1000;

/// Keys that are documentation: texts, accepted in every table and not read.
pub const DOCUMENTATION: [&str; 2] = ["source", "power_source"];

/// The two formulas by which the program rounds, by key.
pub const ROUNDINGS: [(&str, &str); 2] = [
    ("duration", "ms = round_half_up(length_mm * 1000 / speed_mm_s)"),
    ("energy", "mJ = round_half_up(power_mW * duration_ms / 1000)"),
];

/// Names of the criteria by which plans can be chosen.
pub const OBJECTIVES: [(&str, PlannedFor); 3] = [
    ("paper", PlannedFor::Paper),
    ("quality", PlannedFor::Quality),
    ("min-energy", PlannedFor::MinEnergy),
];

/// Names of the allocators.
pub const ALLOCATORS: [&str; 2] = ["panorama", "exact"];
/// The steps of a search.
pub const SEARCHES: RangeInclusive<i64> = 1..=i64::MAX;
/// Range of counts and measures of a run.
pub const COUNTS: RangeInclusive<i64> = 0..=i64::MAX;

/// The kinds of events in every mission.
pub const EVENTS: [&str; 4] = ["obstacle", "fault", "repair", "odometry"];
/// The further kinds of events of supervised missions.
pub const INCIDENTS: [&str; 3] = ["failure", "operator", "door"];
/// The states of a door.
pub const DOOR_STATES: [&str; 2] = ["open", "closed"];
/// The kinds of random events.
pub const RANDOM_EVENTS: [&str; 2] = ["obstacle", "odometry"];
