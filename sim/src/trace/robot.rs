//! The file of a robot in what is stored.

use cotama_models::missions::MissionErrors;
use cotama_models::robots::RobotFile;
use serde::{Deserialize, Serialize};

/// The file of a robot.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RobotText {
    /// The name of the file.
    pub source: String,
    /// The whole text of the file.
    pub text: String,
}

impl RobotText {
    /// Returns the text of a robot's file.
    pub fn of(file: &RobotFile) -> Self {
        Self { source: file.source().into(), text: file.text().into() }
    }

    /// Reads the file.
    ///
    /// # Errors
    /// All errors of its text.
    pub fn file(&self) -> Result<RobotFile, MissionErrors> {
        RobotFile::parse(&self.source, &self.text)
    }
}
