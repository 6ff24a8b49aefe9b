//! Margins learned from runs: their files, and tables of what activities took.

pub(crate) mod watch;

use crate::exit::Failure;
use crate::input;
use crate::kind::{self, Kind};
use crate::output::{self, Screen};
use crate::render::style::NAME;
use cotama_models::margins::{Calibration, Spent};
use cotama_models::missions::Mission;
use std::fmt::Write;
use std::path::Path;
use std::sync::Arc;

/// The columns of a table of runs: a row for each activity that a run came to.
pub(crate) const COLUMNS: [&str; 8] =
    ["mission", "run", "activity", "planned_ms", "used_ms", "planned_mj", "used_mj", "done"];

/// The most runs of a table.
pub(crate) const MOST_RUNS: u64 = 100_000;

/// Reads a file of margins.
pub(crate) fn load(name: &str) -> Result<Calibration, Failure> {
    let text = kind::text(name, "a file of margins", input::MISSION_BYTES, &[Kind::Margins])?;
    Ok(Calibration::parse(name, &text)?)
}

/// Returns the margins of a run: those that are named, else those that its mission names, from a
/// file beside it; `none` are none.
pub(crate) fn of_run(
    name: Option<&str>,
    mission: &Mission,
) -> Result<Option<Arc<Calibration>>, Failure> {
    let path = match (name, &mission.run.margins) {
        (Some("none"), _) | (None, None) => return Ok(None),
        (Some(name), _) => name.to_owned(),
        (None, Some(_)) if mission.plans_by_wishes() => {
            let message = format!("`ask` of `{}` says what its plans are for", mission.name);
            let help = "leave `margins` of `[run]` out, or `ask`";
            return Err(Failure::of(mission.source(), message).help(help));
        }
        (None, Some(name)) => {
            let folder = Path::new(mission.source()).parent();
            folder.map_or_else(|| name.clone(), |it| it.join(name).display().to_string())
        }
    };
    Ok(Some(Arc::new(load(&path)?)))
}

/// Whether margins are named, and not refused.
pub(crate) fn are_given(name: Option<&str>) -> bool {
    name.is_some_and(|it| it != "none")
}

/// A table of runs that grows.
pub(crate) struct Table(String);

impl Table {
    pub(crate) fn new() -> Self {
        Self(COLUMNS.join(",") + "\n")
    }

    /// Adds what a run of a mission took.
    pub(crate) fn add(&mut self, mission: &Mission, run: u64, spent: &[Spent]) {
        let ids = &mission.scenario().activities;
        for it in spent {
            let id = ids.get(it.activity).map_or("", |it| it.id.as_str());
            let ([planned_ms, planned_mj], [used_ms, used_mj]) = (it.planned, it.used);
            let done = if it.done { "yes" } else { "no" };
            // Writing into a string cannot fail.
            let _ = writeln!(
                self.0,
                "{},{run},{},{planned_ms},{used_ms},{planned_mj},{used_mj},{done}",
                quoted(&mission.name),
                quoted(id)
            );
        }
    }

    pub(crate) fn write(&self, path: &Path, screen: &Screen) -> Result<(), Failure> {
        output::file(path, self.0.as_bytes())?;
        screen.note(&format!("written: {NAME}{}{NAME:#}", path.display()));
        Ok(())
    }
}

fn quoted(cell: &str) -> String {
    let bare =
        !cell.is_empty() && cell.chars().all(|it| it.is_alphanumeric() || "-_. ".contains(it));
    if bare { cell.to_owned() } else { format!("\"{}\"", cell.replace('"', "\"\"")) }
}
