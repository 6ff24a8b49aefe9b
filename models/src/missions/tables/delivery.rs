//! The activities of the mission `delivery`, printed from its file.

use cotama_core::hardware::Equipment;
#[allow(unused_imports)] // a mission may stand nowhere
use cotama_models::missions::tables::rows::{activity, stand, travel, units};
use cotama_models::missions::tables::{Activity, Alternative};

/// The inclusive limits, in ms and mJ.
pub const LIMITS: [u64; 2] = [900_000, 7_200_000];
/// The axes in their order of treatment.
pub const ORDER: [usize; 2] = [0, 1];
/// All the hardware of the robot.
pub const AVAILABLE: Equipment = units(0x1111);

/// The activities.
#[rustfmt::skip]
pub static ACTIVITIES: [Activity<'static>; 4] = [
    activity(0, 40_000, &ALTERNATIVES_0),
    activity(40_000, 40_000, &ALTERNATIVES_1),
    activity(40_000, 80_000, &ALTERNATIVES_0),
    activity(80_000, 80_000, &ALTERNATIVES_1),
];

/// The names of the alternatives of each activity.
#[rustfmt::skip]
pub static LABELS: [&[&str]; 4] = [
    &LABELS_0,
    &LABELS_1,
    &LABELS_0,
    &LABELS_2,
];

#[rustfmt::skip]
static ALTERNATIVES_0: [Alternative; 4] = [
    travel(300, 7_720, 0x1, 4),
    travel(300, 7_720, 0x10, 3),
    travel(300, 7_720, 0x100, 2),
    travel(150, 6_000, 0x1000, 1),
];

#[rustfmt::skip]
static ALTERNATIVES_1: [Alternative; 1] = [
    stand(30_000, 4_600, 0x0, 0),
];

#[rustfmt::skip]
static LABELS_0: [&str; 4] = [
    "PF.OPT", "PF.DVZ", "PF.ODO", "PF.DEG",
];

#[rustfmt::skip]
static LABELS_1: [&str; 1] = [
    "hand-in",
];

#[rustfmt::skip]
static LABELS_2: [&str; 1] = [
    "hand-over",
];
