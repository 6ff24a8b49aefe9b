//! `cotama play`: a page in which a model is played.

use crate::answers::model::PlayAnswer;
use crate::args::PlayArgs;
use crate::exit::{Exit, Failure};
use crate::input;
use crate::model::{self, Found};
use crate::names::quoted;
use crate::output::{self, Screen};
use crate::render::style::NAME;
use crate::render::visible;
use crate::simulate::not_played;
use crate::team::{Chosen, too_large};
use cotama_playground::Subject;
use std::path::{Path, PathBuf};

mod outing;
mod team;

/// Writes the page.
pub(crate) fn play(args: &PlayArgs, screen: &Screen) -> Result<Exit, Failure> {
    let name = &args.model;
    let path = args.output.clone().unwrap_or_else(|| beside(name));
    output::place(&path)?;
    let (mut outing, mut command, mut note) = (None, name.clone(), String::new());
    let found = if let Some(team) = Chosen::of(name)? {
        let scenario = team.scenario();
        let of = team::protocol(&scenario).ok_or_else(|| {
            Failure::of(input::name(name), too_large(&scenario))
                .help("the simulator runs it: `cotama run`, `cotama campaign`")
        })?;
        note = of.note;
        if of.is_part {
            command.clear();
        }
        Found::from(of.protocol)
    } else if let Some(it) = outing::of(name, args.mission.as_deref(), screen)? {
        (outing, command) = (it.outing, it.mission);
        it.found
    } else {
        model::find(name)?
    };
    let robot = match &found {
        Found::Owned(it) => it.robot.clone(),
        _ => None,
    };
    let robot = robot.as_ref().map(|(robot, steps)| (robot, steps.as_slice()));
    let subject = Subject { command: &command, robot, outing: outing.as_ref(), note: &note };
    let page = model::with_found(name, found, |it, _| cotama_playground::write(&subject, it))?;
    let page = page.map_err(|why| not_played(&why))?;
    output::file(&path, page.as_bytes())?;
    let file = path.display().to_string();
    if args.json.json {
        Screen::json(&PlayAnswer { schema: "cotama/play/1", file, bytes: page.len() as u64 })?;
    } else {
        let file = visible(&quoted(&file));
        screen.print(&format!("written: {NAME}{file}{NAME:#}\n\nnext: open it in a browser\n"))?;
    }
    Ok(Exit::Success)
}

/// A page in this folder, named as the model: `philosophers-5.html` of `philosophers:5`.
fn beside(name: &str) -> PathBuf {
    let stem = Path::new(name).file_stem().map(|it| it.to_string_lossy().into_owned());
    let stem = stem.filter(|it| !matches!(it.as_str(), "" | "-")).unwrap_or_else(|| "play".into());
    PathBuf::from(format!("{}.html", stem.replace(':', "-")))
}

#[cfg(test)]
mod tests {
    use super::beside;

    #[test]
    fn a_page_is_named_as_its_model() {
        let names = ["door", "philosophers:5", "nets/lamp.json", "-", "..", "a b.toml"];
        let pages =
            ["door.html", "philosophers-5.html", "lamp.html", "play.html", "play.html", "a b.html"];
        assert_eq!(names.map(|it| beside(it).display().to_string()), pages);
    }
}
