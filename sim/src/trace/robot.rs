//! The file of a robot in what is stored.

use cotama_formats::json;
use cotama_models::missions::MissionErrors;
use cotama_models::robots::{RobotFile, embedded};
use cotama_models::team::scenario::Scenario;
use serde::{Deserialize, Serialize};

/// The file of a robot.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RobotText {
    /// The name of the file.
    pub source: String,
    /// The whole text of the file.
    pub text: String,
    /// The local supervisor, as JSON, where the file names a net of its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub local: Option<String>,
}

impl RobotText {
    /// Returns the text of a robot's file.
    pub fn of(file: &RobotFile) -> Self {
        let local = file.robot().local.as_ref().map(|it| json::write(&it.view().net()));
        Self { source: file.source().into(), text: file.text().into(), local }
    }

    /// Returns the texts of the robots of a team that are not shipped, each once.
    pub fn of_team(team: &Scenario) -> Vec<Self> {
        let mut files: Vec<&RobotFile> = Vec::new();
        for file in team.robots.iter().map(|it| &it.file) {
            if !files.contains(&file) {
                files.push(file);
            }
        }
        let is_shipped =
            |it: &RobotFile| embedded(it.source()).is_some_and(|own| own.text == it.text());
        files.into_iter().filter(|it| !is_shipped(it)).map(Self::of).collect()
    }

    /// Reads the file.
    ///
    /// # Errors
    /// All errors of its text.
    pub fn file(&self) -> Result<RobotFile, MissionErrors> {
        RobotFile::parse_with(&self.source, &self.text, &mut |_| {
            let text = self.local.as_deref().ok_or("the trace does not hold this net")?;
            json::read(text).map_err(|it| it.to_string())
        })
    }
}
