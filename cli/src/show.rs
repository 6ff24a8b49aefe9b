//! `cotama show`: the file of a mission, a team, a robot or a floor.

use crate::args::ShowArgs;
use crate::exit::{Exit, Failure};
use crate::mission;
use crate::output::Screen;
use crate::team::Chosen;
use cotama_core::text;
use cotama_models::robots;

/// Prints the file of a mission, a team, a robot or a floor; what a terminal would obey in its
/// strings and comments is escaped.
pub(crate) fn show(args: &ShowArgs) -> Result<Exit, Failure> {
    let (args, with_axes) = (&args.mission, args.axes);
    if with_axes {
        let mission = mission::load(&args.mission, None)?;
        let text = mission.upgraded().map_err(|why| {
            Failure::new(format!("--axes: {} is not written anew: {why}", mission.source()))
        })?;
        Screen::raw(text::toml(&text).to_string().as_bytes())?;
        return Ok(Exit::Success);
    }
    let robot = robots::embedded(&args.mission).map(|it| it.text);
    let robot = robot.or_else(|| cotama_axes::embedded(&args.mission).map(|it| it.text));
    let floor = || cotama_floor::embedded::named(&args.mission).map(|it| it.text);
    // A team has the name of the floor that is drawn for it.
    let text = match (robot, Chosen::of(&args.mission)?) {
        (Some(text), _) => text.to_owned(),
        (None, Some(team)) => team.text(),
        (None, None) => match floor() {
            Some(text) => text.to_owned(),
            None => mission::load(&args.mission, None)?.text().to_owned(),
        },
    };
    Screen::raw(text::toml(&text).to_string().as_bytes())?;
    Ok(Exit::Success)
}
