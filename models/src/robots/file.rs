//! A robot together with the text that says it.

use super::supervisors::ReadNet;
use super::{Robot, embedded};
use crate::missions::MissionErrors;
use std::sync::Arc;

/// A robot and its file: what a run under its supervisors has to keep to be made again.
///
/// ```
/// use cotama_models::robots::RobotFile;
/// let file = RobotFile::shipped("transport").unwrap();
/// assert_eq!((file.source(), file.robot().failures.len()), ("transport", 11));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RobotFile {
    source: String,
    text: Arc<str>,
    robot: Arc<Robot>,
}

impl RobotFile {
    /// Reads a robot's file. `source` is its name in messages.
    ///
    /// # Errors
    /// As [`Robot::parse`].
    pub fn parse(source: &str, text: &str) -> Result<Self, MissionErrors> {
        Ok(Self::of(source, text, Robot::parse(source, text)?))
    }

    /// The same of a robot that may name nets of its own; `own` reads them.
    ///
    /// # Errors
    /// As [`Robot::parse_with`].
    pub fn parse_with(
        source: &str,
        text: &str,
        own: &mut ReadNet<'_>,
    ) -> Result<Self, MissionErrors> {
        Ok(Self::of(source, text, Robot::parse_with(source, text, own)?))
    }

    fn of(source: &str, text: &str, robot: Robot) -> Self {
        Self { source: source.to_owned(), text: text.into(), robot: Arc::new(robot) }
    }

    /// Returns the robot of this name that comes with the program.
    pub fn shipped(name: &str) -> Option<Self> {
        let it = embedded(name)?;
        Self::parse(it.name, it.text).ok()
    }

    /// Returns the same robot under another name of its file.
    #[must_use]
    pub fn renamed(self, source: &str) -> Self {
        Self { source: source.to_owned(), ..self }
    }

    /// Returns the name of the file.
    pub fn source(&self) -> &str {
        &self.source
    }

    /// Returns the text of the file.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Returns the robot.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }
}
