//! The robot of a mission that has a file of its own.

use crate::robots::RobotFile;

/// The format of missions of a robot that has a file of its own.
pub const FORMAT_2: &str = "panorama-mission/2";

/// The format of missions whose speeds and limits follow from axes.
pub const FORMAT_3: &str = "panorama-mission/3";

/// Whether a text is of the third format, as far as its format can be read.
pub(super) fn is_axed(text: &str) -> bool {
    let file = text.parse::<toml::Table>();
    let format = file.as_ref().ok().and_then(|it| it.get("format")?.as_str());
    format == Some(FORMAT_3)
}

/// Returns the keys of a text of the second format, or of the third one that names a robot; `None`
/// of another one, as far as its format can be read.
pub(super) fn of_robot(text: &str) -> Option<toml::Table> {
    let file: toml::Table = text.parse().ok()?;
    let is_of_robot = match file.get("format")?.as_str()? {
        FORMAT_2 => true,
        FORMAT_3 => file.get("robot").is_some_and(toml::Value::is_str),
        _ => false,
    };
    is_of_robot.then_some(file)
}

/// A robot from a file whose supervisors decide while a mission runs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Under {
    /// The robot.
    pub file: RobotFile,
    /// The configuration that each kind of hardware stands for, where the options of moving are
    /// those of the robot; empty where the mission has its own.
    pub configurations: Vec<usize>,
    /// The module that each further kind of hardware stands for, with its kind: the options of the
    /// mission that it serves need it.
    pub modules: Vec<(usize, usize)>,
}
