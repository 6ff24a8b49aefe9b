//! `cotama play`: a page in which a model is played.

use crate::answers::model::PlayAnswer;
use crate::args::PlayArgs;
use crate::exit::{Exit, Failure};
use crate::model::{self, Found};
use crate::names::quoted;
use crate::output::{self, Screen};
use crate::render::style::NAME;
use crate::render::visible;
use crate::simulate::not_played;
use cotama_playground::Subject;
use std::path::{Path, PathBuf};

/// Writes the page.
pub(crate) fn play(args: &PlayArgs, screen: &Screen) -> Result<Exit, Failure> {
    let name = &args.model.model;
    let path = args.output.clone().unwrap_or_else(|| beside(name));
    output::place(&path)?;
    let found = model::find(name)?;
    let robot = match &found {
        Found::Owned(it) => it.robot.clone(),
        _ => None,
    };
    let robot = robot.as_ref().map(|(robot, steps)| (robot, steps.as_slice()));
    let subject = Subject { command: name, robot };
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
