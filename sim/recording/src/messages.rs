//! Messages of ROS 2 Humble, each as it is sent.

use crate::cdr::Cdr;
use crate::ground::Raster;
use cotama_devices::Laser;
use cotama_floor::{Point, Pose, Vector};

pub(crate) const TEXT: &str = "std_msgs/msg/String";
pub(crate) const NUMBER: &str = "std_msgs/msg/Float64";
pub(crate) const TRANSFORMS: &str = "tf2_msgs/msg/TFMessage";
pub(crate) const POSE: &str = "geometry_msgs/msg/PoseWithCovarianceStamped";
pub(crate) const PATH: &str = "nav_msgs/msg/Path";
pub(crate) const MAP: &str = "nav_msgs/msg/OccupancyGrid";
pub(crate) const SCAN: &str = "sensor_msgs/msg/LaserScan";
pub(crate) const RANGE: &str = "sensor_msgs/msg/Range";
pub(crate) const MARKERS: &str = "visualization_msgs/msg/MarkerArray";
pub(crate) const BATTERY: &str = "sensor_msgs/msg/BatteryState";
pub(crate) const DIAGNOSTICS: &str = "diagnostic_msgs/msg/DiagnosticArray";
pub(crate) const LOG: &str = "rcl_interfaces/msg/Log";

/// All kinds of messages.
#[cfg(test)]
pub(crate) const KINDS: [&str; 12] =
    [TEXT, NUMBER, TRANSFORMS, POSE, PATH, MAP, SCAN, RANGE, MARKERS, BATTERY, DIAGNOSTICS, LOG];

/// A message and its type.
#[derive(Debug)]
pub(crate) struct Message {
    pub(crate) kind: &'static str,
    pub(crate) data: Vec<u8>,
}

/// Writes a message.
fn message(kind: &'static str, write: impl FnOnce(&mut Cdr)) -> Message {
    let mut cdr = Cdr::new();
    write(&mut cdr);
    Message { kind, data: cdr.into_bytes() }
}

/// Writes a time of the run, in µs.
fn stamp(cdr: &mut Cdr, t_us: u64) {
    cdr.i32(i32::try_from(t_us / 1_000_000).unwrap_or(i32::MAX));
    cdr.u32(u32::try_from(t_us % 1_000_000 * 1_000).unwrap_or_default());
}

fn header(cdr: &mut Cdr, t_us: u64, frame: &str) {
    stamp(cdr, t_us);
    cdr.text(frame);
}

/// Returns the quaternion of a heading: its z and w, as x and y are 0.
pub(crate) fn quaternion(pose: &Pose) -> [f64; 2] {
    let angle = libm::atan2(pose.rotation.im, pose.rotation.re);
    let (sin, cos) = libm::sincos(angle / 2.0);
    [sin, cos]
}

/// Writes a position and a heading: as a pose and as a transform.
fn placed(cdr: &mut Cdr, pose: &Pose) {
    let at = pose.translation;
    let [z, w] = quaternion(pose);
    cdr.f64s([at.x, at.y, 0.0, 0.0, 0.0, z, w]);
}

pub(crate) fn text(it: &str) -> Message {
    message(TEXT, |cdr| cdr.text(it))
}

pub(crate) fn number(it: f64) -> Message {
    message(NUMBER, |cdr| cdr.f64(it))
}

/// Returns frames, each with the one that it is in and its pose there.
pub(crate) fn transforms(t_us: u64, frames: &[(&str, &str, Pose)]) -> Message {
    message(TRANSFORMS, |cdr| {
        cdr.count(frames.len());
        for (parent, child, pose) in frames {
            header(cdr, t_us, parent);
            cdr.text(child);
            placed(cdr, pose);
        }
    })
}

/// Returns a pose without a covariance, which is 0: unknown.
pub(crate) fn pose(t_us: u64, frame: &str, pose: &Pose) -> Message {
    message(POSE, |cdr| {
        header(cdr, t_us, frame);
        placed(cdr, pose);
        cdr.f64s([0.0; 36]);
    })
}

/// Returns a path through points; each heading is that to the next point.
pub(crate) fn path(t_us: u64, frame: &str, points: &[Point]) -> Message {
    message(PATH, |cdr| {
        header(cdr, t_us, frame);
        cdr.count(points.len());
        let mut heading = 0.0;
        for (number, at) in points.iter().enumerate() {
            if let Some(way) = points.get(number + 1).map(|it| it - at) {
                heading = libm::atan2(way.y, way.x);
            }
            header(cdr, t_us, frame);
            placed(cdr, &Pose::new(at.coords, heading));
        }
    })
}

pub(crate) fn map(t_us: u64, frame: &str, raster: &Raster) -> Message {
    message(MAP, |cdr| {
        header(cdr, t_us, frame);
        stamp(cdr, t_us);
        cdr.f32(raster.cell_m);
        cdr.count(raster.width);
        cdr.count(raster.height);
        placed(cdr, &Pose::translation(raster.least.x, raster.least.y));
        cdr.bytes(&raster.cells);
    })
}

/// Returns a scan, all of whose ranges are of one moment. Infinity: nothing was seen.
pub(crate) fn scan(
    t_us: u64,
    frame: &str,
    laser: &Laser,
    range_m: [f64; 2],
    all: &[f64],
) -> Message {
    message(SCAN, |cdr| {
        header(cdr, t_us, frame);
        let (first, last) = (laser.angle(0), laser.angle(all.len().saturating_sub(1)));
        let gaps = all.len().saturating_sub(1).max(1) as f64;
        let between = (last - first) / gaps;
        [first, last, between, 0.0, 0.0].into_iter().for_each(|it| cdr.f32(it));
        range_m.into_iter().for_each(|it| cdr.f32(it));
        cdr.count(all.len());
        all.iter().for_each(|it| cdr.f32(*it));
        cdr.count(0);
    })
}

/// Cones of sonars, and what they read.
#[derive(Debug)]
pub(crate) struct Cone {
    pub(crate) mount: Pose,
    /// The angle from side to side.
    pub(crate) view_rad: f64,
    pub(crate) least_m: f64,
    pub(crate) most_m: f64,
    pub(crate) range_m: f64,
}

pub(crate) fn range(t_us: u64, frame: &str, cone: &Cone) -> Message {
    const ULTRASOUND: u8 = 0;
    message(RANGE, |cdr| {
        header(cdr, t_us, frame);
        cdr.u8(ULTRASOUND);
        let Cone { view_rad, least_m, most_m, range_m, .. } = *cone;
        [view_rad, least_m, most_m, range_m].into_iter().for_each(|it| cdr.f32(it));
    })
}

/// Returns the cones as triangles of one marker.
pub(crate) fn cones(t_us: u64, frame: &str, cones: &[Cone]) -> Message {
    const TRIANGLE_LIST: i32 = 11;
    const ADD: i32 = 0;
    message(MARKERS, |cdr| {
        cdr.count(1);
        header(cdr, t_us, frame);
        cdr.text("sonars");
        [0, TRIANGLE_LIST, ADD].into_iter().for_each(|it| cdr.i32(it));
        placed(cdr, &Pose::identity());
        cdr.f64s([1.0; 3]);
        [0.1, 0.5, 0.9, 0.25].into_iter().for_each(|it| cdr.f32(it));
        // For ever, until the next one; it moves with its frame.
        cdr.i32(0);
        cdr.u32(0);
        cdr.u8(1);
        cdr.count(cones.len() * 3);
        for cone in cones {
            let corner = |side: f64| {
                let (sin, cos) = libm::sincos(side * cone.view_rad / 2.0);
                cone.mount * Point::from(Vector::new(cos, sin) * cone.range_m)
            };
            let apex = cone.mount * Point::origin();
            for it in [apex, corner(-1.0), corner(1.0)] {
                cdr.f64s([it.x, it.y, 0.0]);
            }
        }
        // Neither colours of corners, nor a texture with its image, nor places on it, nor a text,
        // nor a mesh with its file and materials.
        cdr.count(0);
        cdr.text("");
        header(cdr, t_us, frame);
        cdr.text("");
        cdr.count(0);
        cdr.count(0);
        cdr.text("");
        cdr.text("");
        cdr.text("");
        cdr.count(0);
        cdr.u8(0);
    })
}

/// Returns the state of a battery that is so full, from 0 to 1, with its voltage and the current
/// that it gives, in mV and mA. All that is not known is no number.
pub(crate) fn battery(t_us: u64, frame: &str, part: f64, known: Option<[u32; 2]>) -> Message {
    const DISCHARGING: u8 = 2;
    const UNKNOWN: u8 = 0;
    const NO: f64 = f64::NAN;
    message(BATTERY, |cdr| {
        header(cdr, t_us, frame);
        let [voltage, current] = match known {
            Some([mv, ma]) => [f64::from(mv) / 1_000.0, -f64::from(ma) / 1_000.0], // below 0: given
            None => [f64::NAN; 2],
        };
        // Voltage, temperature, current, charge, capacity, capacity by design.
        [voltage, NO, current, NO, NO, NO].into_iter().for_each(|it| cdr.f32(it));
        cdr.f32(part);
        [DISCHARGING, UNKNOWN, UNKNOWN].into_iter().for_each(|it| cdr.u8(it));
        cdr.u8(1); // present
        cdr.count(0);
        cdr.count(0);
        cdr.text("");
        cdr.text("");
    })
}

/// How bad a status is.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Level {
    Warn = 1,
    Error = 2,
}

pub(crate) fn diagnostics(
    t_us: u64,
    level: Level,
    [name, text]: [&str; 2],
    values: &[(&str, String)],
) -> Message {
    message(DIAGNOSTICS, |cdr| {
        header(cdr, t_us, "");
        cdr.count(1);
        cdr.u8(level as u8);
        [name, text, ""].into_iter().for_each(|it| cdr.text(it));
        cdr.count(values.len());
        for (key, value) in values {
            cdr.text(key);
            cdr.text(value);
        }
    })
}

/// How much a line of the log matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Weight {
    Info = 20,
    Warn = 30,
    Error = 40,
}

pub(crate) fn log(t_us: u64, weight: Weight, text: &str) -> Message {
    message(LOG, |cdr| {
        stamp(cdr, t_us);
        cdr.u8(weight as u8);
        ["cotama", text, "", ""].into_iter().for_each(|it| cdr.text(it));
        cdr.u32(0);
    })
}
