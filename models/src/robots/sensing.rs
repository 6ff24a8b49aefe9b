//! Devices by which a robot senses in the plane, as its file has them: `[[body.laser]]`,
//! `[body.camera]`, `[body.gyro]`, and whether it has a ring of sonars.
//!
//! A device names the hardware that it is. What a module reads follows from what it stands on: one
//! that localises and needs the hardware of a laser localises by it.

use super::{Robot, members, sound::with_needs};
use cotama_core::units::{Millimetres, Millis};

/// The most laser scanners of a robot.
pub const MAX_LASERS: usize = 4;

/// The devices of a robot.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Sensing {
    /// Whether it has no ring of sonars; else it has that of a Pioneer 3-DX.
    pub no_sonars: bool,
    /// Laser scanners, at most [`MAX_LASERS`].
    pub lasers: Vec<LaserScanner>,
    /// A camera that finds QR marks.
    pub camera: Option<MarkCamera>,
    /// A gyro.
    pub gyro: Option<Gyro>,
}

/// The place of a device on the robot: x ahead, y to the left.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mount {
    /// How far ahead, in mm.
    pub x_mm: i32,
    /// How far to the left, in mm.
    pub y_mm: i32,
    /// The way that it looks, in degrees to the left of straight ahead.
    pub heading_deg: i32,
}

/// A laser scanner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LaserScanner {
    /// The number of its hardware.
    pub hardware: usize,
    /// The place.
    pub mount: Mount,
    /// The angle from its first ray to the last, in degrees.
    pub view_deg: u16,
    /// The rays of a scan.
    pub rays: u16,
    /// The nearest and the furthest thing that it sees.
    pub range: [Millimetres; 2],
    /// The deviation of a range.
    pub noise: Millimetres,
    /// The time between two scans, and from a scan to its arrival.
    pub times: [Millis; 2],
}

/// A camera that finds QR marks; how large a mark must be in the picture is that of a Kinect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MarkCamera {
    /// The number of its hardware.
    pub hardware: usize,
    /// The place.
    pub mount: Mount,
    /// The angle from one side of the picture to the other, in degrees.
    pub view_deg: u16,
    /// The speed above which pictures are blurred, in mm/s.
    pub sharp_mm_s: u64,
    /// The time between two pictures, and from a picture to its arrival.
    pub times: [Millis; 2],
}

/// A gyro: the turn of the robot, with a bias that is drawn for each run, and noise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Gyro {
    /// The number of its hardware.
    pub hardware: usize,
    /// The deviation of its bias, in millionths of rad/s.
    pub bias_urad_s: u64,
    /// The deviation of a reading, in millionths of rad/s.
    pub noise_urad_s: u64,
}

impl Robot {
    /// Returns the hardware that modules stand on, a bit each: their own, and that of all modules
    /// that they need or may use.
    ///
    /// ```
    /// use cotama_models::robots::Robot;
    /// let robot = Robot::shipped("transport").unwrap();
    /// let of = |name: &str| robot.modules.iter().position(|it| it.name == name).unwrap();
    /// let hardware = |it: usize| robot.hardware[it].name.as_str();
    /// let under = robot.hardware_under(1 << of("marker"));
    /// let names: Vec<_> = (0..64).filter(|it| under >> it & 1 == 1).map(hardware).collect();
    /// assert_eq!(names, ["drives", "camera", "computer"]);
    /// ```
    pub fn hardware_under(&self, modules: u64) -> u64 {
        let mut all = with_needs(self, modules);
        loop {
            let used = members(all).filter_map(|it| self.modules.get(it));
            let more = with_needs(self, used.fold(all, |all, it| all | it.one_of));
            if more == all {
                break;
            }
            all = more;
        }
        let modules = members(all).filter_map(|it| self.modules.get(it));
        modules.fold(0, |all, it| all | it.needs.hardware)
    }
}
