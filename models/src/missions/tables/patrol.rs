//! The activities of the mission `patrol`, printed from its file.

use cotama_core::hardware::Equipment;
#[allow(unused_imports)] // a mission may stand nowhere
use cotama_models::missions::tables::rows::{activity, stand, travel, units};
use cotama_models::missions::tables::{Activity, Alternative};

/// The inclusive limits, in ms and mJ.
pub const LIMITS: [u64; 2] = [600_000, 8_640_000];
/// The axes in their order of treatment.
pub const ORDER: [usize; 2] = [0, 1];
/// All the hardware of the robot.
pub const AVAILABLE: Equipment = units(0x1121);

/// The activities.
#[rustfmt::skip]
pub static ACTIVITIES: [Activity<'static>; 17] = [
    activity(0, 31_000, &ALTERNATIVES_0),
    activity(31_000, 34_000, &ALTERNATIVES_1),
    activity(34_000, 37_000, &ALTERNATIVES_2),
    activity(37_000, 37_000, &ALTERNATIVES_3),
    activity(37_000, 37_000, &ALTERNATIVES_4),
    activity(37_000, 37_000, &ALTERNATIVES_3),
    activity(37_000, 41_000, &ALTERNATIVES_1),
    activity(41_000, 63_500, &ALTERNATIVES_0),
    activity(63_500, 91_500, &ALTERNATIVES_5),
    activity(91_500, 93_500, &ALTERNATIVES_6),
    activity(93_500, 93_500, &ALTERNATIVES_3),
    activity(93_500, 93_500, &ALTERNATIVES_4),
    activity(93_500, 93_500, &ALTERNATIVES_3),
    activity(93_500, 123_500, &ALTERNATIVES_5),
    activity(123_500, 146_000, &ALTERNATIVES_0),
    activity(146_000, 156_000, &ALTERNATIVES_1),
    activity(156_000, 187_000, &ALTERNATIVES_0),
];

/// The names of the alternatives of each activity.
#[rustfmt::skip]
pub static LABELS: [&[&str]; 17] = [
    &LABELS_0,
    &LABELS_1,
    &LABELS_2,
    &LABELS_3,
    &LABELS_4,
    &LABELS_3,
    &LABELS_1,
    &LABELS_0,
    &LABELS_0,
    &LABELS_2,
    &LABELS_3,
    &LABELS_4,
    &LABELS_3,
    &LABELS_0,
    &LABELS_0,
    &LABELS_1,
    &LABELS_0,
];

#[rustfmt::skip]
static ALTERNATIVES_0: [Alternative; 21] = [
    travel(410, 9_224, 0x1001, 1),
    travel(410, 13_824, 0x1101, 10),
    travel(410, 13_624, 0x1021, 7),
    travel(410, 9_224, 0x1001, 1),
    travel(410, 13_824, 0x1101, 10),
    travel(410, 13_624, 0x1021, 7),
    travel(410, 10_124, 0x1010, 1),
    travel(410, 14_724, 0x1110, 10),
    travel(410, 12_324, 0x1020, 7),
    travel(410, 12_324, 0x1020, 2),
    travel(410, 16_924, 0x1120, 11),
    travel(410, 12_324, 0x1020, 8),
    travel(410, 13_624, 0x1021, 3),
    travel(410, 18_224, 0x1121, 12),
    travel(410, 13_624, 0x1021, 9),
    travel(410, 13_624, 0x1021, 3),
    travel(410, 18_224, 0x1121, 12),
    travel(410, 13_624, 0x1021, 9),
    travel(410, 12_324, 0x1020, 2),
    travel(410, 16_924, 0x1120, 11),
    travel(410, 12_324, 0x1020, 8),
];

#[rustfmt::skip]
static ALTERNATIVES_1: [Alternative; 12] = [
    travel(330, 8_409, 0x1001, 1),
    travel(330, 13_009, 0x1101, 10),
    travel(330, 12_809, 0x1021, 7),
    travel(330, 8_409, 0x1001, 1),
    travel(330, 13_009, 0x1101, 10),
    travel(330, 12_809, 0x1021, 7),
    travel(330, 12_809, 0x1021, 3),
    travel(330, 17_409, 0x1121, 12),
    travel(330, 12_809, 0x1021, 9),
    travel(330, 12_809, 0x1021, 3),
    travel(330, 17_409, 0x1121, 12),
    travel(330, 12_809, 0x1021, 9),
];

#[rustfmt::skip]
static ALTERNATIVES_2: [Alternative; 4] = [
    travel(330, 13_009, 0x1101, 10),
    travel(330, 13_009, 0x1101, 10),
    travel(330, 17_409, 0x1121, 12),
    travel(330, 17_409, 0x1121, 12),
];

#[rustfmt::skip]
static ALTERNATIVES_3: [Alternative; 3] = [
    stand(8_000, 7_500, 0x1000, 0),
    stand(8_000, 12_100, 0x1100, 30),
    stand(8_000, 11_900, 0x1020, 20),
];

#[rustfmt::skip]
static ALTERNATIVES_4: [Alternative; 2] = [
    stand(14_000, 9_490, 0x100, 10),
    stand(14_000, 11_100, 0x1100, 20),
];

#[rustfmt::skip]
static ALTERNATIVES_5: [Alternative; 21] = [
    travel(560, 11_046, 0x1001, 1),
    travel(410, 13_824, 0x1101, 10),
    travel(560, 15_446, 0x1021, 7),
    travel(560, 11_046, 0x1001, 1),
    travel(410, 13_824, 0x1101, 10),
    travel(560, 15_446, 0x1021, 7),
    travel(560, 11_946, 0x1010, 1),
    travel(410, 14_724, 0x1110, 10),
    travel(560, 14_146, 0x1020, 7),
    travel(560, 14_146, 0x1020, 2),
    travel(410, 16_924, 0x1120, 11),
    travel(560, 14_146, 0x1020, 8),
    travel(560, 15_446, 0x1021, 3),
    travel(410, 18_224, 0x1121, 12),
    travel(560, 15_446, 0x1021, 9),
    travel(560, 15_446, 0x1021, 3),
    travel(410, 18_224, 0x1121, 12),
    travel(560, 15_446, 0x1021, 9),
    travel(560, 14_146, 0x1020, 2),
    travel(410, 16_924, 0x1120, 11),
    travel(560, 14_146, 0x1020, 8),
];

#[rustfmt::skip]
static ALTERNATIVES_6: [Alternative; 4] = [
    travel(410, 13_824, 0x1101, 10),
    travel(410, 13_824, 0x1101, 10),
    travel(410, 18_224, 0x1121, 12),
    travel(410, 18_224, 0x1121, 12),
];

#[rustfmt::skip]
static LABELS_0: [&str; 21] = [
    "M1 L1", "M1 L2", "M1 L3", "M2 L1", "M2 L2", "M2 L3", "M3 L1", "M3 L2", "M3 L3", "M4 L1",
    "M4 L2", "M4 L3", "M5 L1", "M5 L2", "M5 L3", "M6 L1", "M6 L2", "M6 L3", "M7 L1", "M7 L2",
    "M7 L3",
];

#[rustfmt::skip]
static LABELS_1: [&str; 12] = [
    "M1 L1", "M1 L2", "M1 L3", "M2 L1", "M2 L2", "M2 L3", "M5 L1", "M5 L2", "M5 L3", "M6 L1",
    "M6 L2", "M6 L3",
];

#[rustfmt::skip]
static LABELS_2: [&str; 4] = [
    "M1 L2", "M2 L2", "M5 L2", "M6 L2",
];

#[rustfmt::skip]
static LABELS_3: [&str; 3] = [
    "T1 L1", "T1 L2", "T1 L3",
];

#[rustfmt::skip]
static LABELS_4: [&str; 2] = [
    "D1", "D2",
];
