//! `cotama show`: the file of a mission.

use crate::args::MissionArg;
use crate::exit::{Exit, Failure};
use crate::mission;
use crate::output::Screen;

/// Prints the file of a mission as it is.
pub(crate) fn show(args: &MissionArg) -> Result<Exit, Failure> {
    let loaded = mission::load(&args.mission)?;
    Screen::raw(loaded.text.as_bytes())?;
    Ok(Exit::Success)
}
