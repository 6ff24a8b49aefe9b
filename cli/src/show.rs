//! `cotama show`: the file of a mission or a team.

use crate::args::MissionArg;
use crate::exit::{Exit, Failure};
use crate::mission;
use crate::output::Screen;
use crate::team::Chosen;
use cotama_core::text;

/// Prints the file of a mission or a team; what a terminal would obey in its strings and comments
/// is escaped.
pub(crate) fn show(args: &MissionArg) -> Result<Exit, Failure> {
    let text = match Chosen::of(&args.mission)? {
        Some(team) => team.text(),
        None => mission::load(&args.mission)?.text().to_owned(),
    };
    Screen::raw(text::toml(&text).to_string().as_bytes())?;
    Ok(Exit::Success)
}
