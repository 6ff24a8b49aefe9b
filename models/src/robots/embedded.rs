//! The robots that come with the program.

use super::Robot;

/// A robot file that comes with the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EmbeddedRobot {
    /// Name of the robot.
    pub name: &'static str,
    /// Description in one line.
    pub description: &'static str,
    /// The text of the file.
    pub text: &'static str,
}

/// All robots that come with the program.
pub const EMBEDDED: [EmbeddedRobot; 3] = [
    EmbeddedRobot {
        name: "p3dx-delivery",
        description: "Pioneer 3-DX of Durand et al. 2010: 8 configurations, 46 failures",
        text: include_str!("../../robots/p3dx-delivery.toml"),
    },
    EmbeddedRobot {
        name: "p3dx-patrol",
        description: "Pioneer 3-DX of Lambert et al. 2024: two lasers, Kinect, sonars",
        text: include_str!("../../robots/p3dx-patrol.toml"),
    },
    EmbeddedRobot {
        name: "transport",
        description: "indoor transport robot with safety scanner, lidar and lift; from no paper",
        text: include_str!("../../robots/transport.toml"),
    },
];

/// The measurements that come with the program, by the names of their robots.
const MEASURED: [EmbeddedRobot; 1] = [EmbeddedRobot {
    name: "p3dx-delivery",
    description: "detections by signals on the delivery",
    text: include_str!("../../robots/p3dx-delivery.measured.toml"),
}];

/// The file of this name.
///
/// ```
/// use cotama_models::robots::{Robot, embedded};
/// let transport = embedded("transport").unwrap();
/// let robot = Robot::parse(transport.name, transport.text).unwrap();
/// assert_eq!((robot.modules.len(), robot.sub_objectives.len()), (12, 5));
/// let delivery = Robot::shipped("p3dx-delivery").unwrap();
/// assert_eq!((delivery.configurations.len(), delivery.failures.len()), (8, 47));
/// assert_eq!(embedded("nope"), None);
/// ```
pub fn embedded(name: &str) -> Option<EmbeddedRobot> {
    EMBEDDED.into_iter().find(|it| it.name == name)
}

/// The measured detections of a robot that comes with the program, as
/// [`Measurement::parse`](super::Measurement::parse) reads them; `None` where they were not
/// measured. The first line of the file says by which command they were.
pub fn embedded_measurement(name: &str) -> Option<EmbeddedRobot> {
    MEASURED.into_iter().find(|it| it.name == name)
}

impl Robot {
    /// Reads the robot of this name that comes with the program.
    pub fn shipped(name: &str) -> Option<Self> {
        let it = embedded(name)?;
        Self::parse(it.name, it.text).ok()
    }
}
