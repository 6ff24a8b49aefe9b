//! The schema of the devices by which a robot senses in the plane.

use super::super::parts::{choice, integer, table, tables, text, with};
use cotama_models::robots::known::{
    HEADINGS, LATENCIES, LEASTS, MOUNTS, NOISES, RANGES, RATES, RAYS, SHARP, SONARS, VIEWS,
};
use cotama_models::robots::sensing::MAX_LASERS;
use serde_json::Value;

/// The keys of devices in the table of the body.
pub(super) fn sensing() -> [(&'static str, Value); 4] {
    let sonars = choice(&SONARS, "its ring of sonars; `\"pioneer\"`");
    let lasers = tables(&laser(), 0, "laser scanners, numbered from 0 on");
    let lasers = with(lasers, "maxItems", MAX_LASERS.into());
    [("sonars", sonars), ("laser", lasers), ("camera", camera()), ("gyro", gyro())]
}

/// Place and times of a device.
fn placed() -> [(&'static str, Value); 5] {
    [
        ("x_mm", integer(&MOUNTS, "how far ahead on the robot, in mm; 0")),
        ("y_mm", integer(&MOUNTS, "how far to the left on the robot, in mm; 0")),
        ("heading_deg", integer(&HEADINGS, "the way that it looks, in degrees to the left; 0")),
        ("period_ms", integer(&RATES, "the time between two readings, in ms; 100")),
        ("latency_ms", integer(&LATENCIES, "the time from a reading to its arrival, in ms; 0")),
    ]
}

fn laser() -> Value {
    let needs = [
        ("hardware", text("the hardware that it is")),
        ("view_deg", integer(&VIEWS, "the angle from its first ray to the last, in degrees")),
        ("rays", integer(&RAYS, "the rays of a scan")),
        ("range_mm", integer(&RANGES, "nothing further away is seen, in mm")),
    ];
    let can = [
        ("least_mm", integer(&LEASTS, "nearer things read this, in mm; 0")),
        ("noise_mm", integer(&LEASTS, "the deviation of a range, in mm; 10")),
    ];
    table(&needs, &[&can[..], &placed()].concat(), "a laser scanner, for runs by signals")
}

fn camera() -> Value {
    let needs = [
        ("hardware", text("the hardware that it is")),
        ("view_deg", integer(&VIEWS, "the angle from side to side, in degrees")),
        ("sharp_mm_s", integer(&SHARP, "faster robots take blurred pictures, in mm/s")),
    ];
    table(&needs, &placed(), "a camera that finds QR marks, for runs by signals")
}

fn gyro() -> Value {
    let needs = [
        ("hardware", text("the hardware that it is")),
        ("bias_urad_s", integer(&NOISES, "the deviation of its bias, in millionths of rad/s")),
        ("noise_urad_s", integer(&NOISES, "the deviation of a reading, in millionths of rad/s")),
    ];
    table(&needs, &[], "a gyro, for runs by signals")
}
