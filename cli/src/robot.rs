//! Robots from the command line: by name or from a file.

use crate::exit::Failure;
use crate::input;
use crate::kind::{self, Kind as FileKind};
use crate::names::quoted;
use cotama_models::robots::{self, Robot, RobotFile};
use cotama_verification::formats::json;
use std::fs;
use std::path::Path;

/// The robot of a name, or of a file that begins as one.
pub(crate) fn robot(name: &str) -> Result<Option<Robot>, Failure> {
    if let Some(it) = robots::embedded(name) {
        return Ok(Some(Robot::parse(it.name, it.text)?));
    }
    if !kind::is(name, FileKind::Robot) {
        return Ok(None);
    }
    let text = kind::text(name, "a robot's file", input::MISSION_BYTES, &[FileKind::Robot])?;
    Ok(Some(robot_file(name, &text)?.robot().clone()))
}

/// The robot of this text; nets that it names stand beside the file.
pub(crate) fn robot_file(path: &str, text: &str) -> Result<RobotFile, Failure> {
    let folder = Path::new(path).parent();
    let own = &mut |name: &str| {
        let net = folder.map_or_else(|| name.into(), |it| it.join(name));
        let refused = |why: std::io::Error| format!("{}: {why}", quoted(name));
        if fs::metadata(&net).map_err(refused)?.len() > json::MAX_BYTES as u64 {
            return Err(format!("{} is too large for a net", quoted(name)));
        }
        let text = fs::read_to_string(&net).map_err(refused)?;
        json::read(&text).map_err(|why| format!("{}: {why}", quoted(name)))
    };
    Ok(RobotFile::parse_with(input::name(path), text, own)?)
}
