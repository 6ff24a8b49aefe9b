//! Missions from the command line: by name or from a file, with limits and hardware changed.

use crate::args::{AllocatorName, Lost, Objective, Planning};
use crate::exit::Failure;
use crate::input;
use crate::kind::{self, Kind};
use crate::names::{is_name, near};
use cotama_core::hardware::Equipment;
use cotama_models::missions::{Definition, Mission, PlannedFor, embedded};
use cotama_sim::options::{Aim, Planner};
use serde::Deserialize;
use std::path::Path;
use toml::Spanned;

/// A mission and where it is from.
#[derive(Debug)]
pub(crate) struct Loaded {
    /// The name of an embedded mission, or the path of a file.
    pub(crate) source: String,
    /// The text of the mission file, with the limits of the command line.
    pub(crate) text: String,
    pub(crate) mission: Mission,
}

/// The mission of this name, or of the file at this path.
pub(crate) fn load(name: &str) -> Result<Loaded, Failure> {
    let text = match embedded::mission(name) {
        Some(known) => known.text.to_owned(),
        None if is_name(name) && !Path::new(name).exists() => {
            return Err(kind::model_for_mission(name).unwrap_or_else(|| unknown(name)));
        }
        None => kind::text(name, "a mission file", input::MISSION_BYTES, &[Kind::Mission])?,
    };
    let source = if name == "-" { "standard input" } else { name };
    let mission = Mission::parse(source, &text)?;
    Ok(Loaded { source: source.into(), text, mission })
}

/// The mission for a plan or a run, with the limits of the command line.
pub(crate) fn load_for(name: &str, planning: &Planning) -> Result<Loaded, Failure> {
    let loaded = load(name)?;
    let wanted = [planning.duration_limit, planning.energy_limit];
    if wanted == [None, None] {
        return Ok(loaded);
    }
    let text = with_limits(&loaded.text, wanted).ok_or_else(|| {
        Failure::new(format!("{name}: its limits cannot be changed from the command line"))
    })?;
    let mission = Mission::parse(&loaded.source, &text)?;
    Ok(Loaded { text, mission, ..loaded })
}

/// What a plan is chosen for: what is wanted, else what the mission file says, else quality. The
/// allocator of PANORAMA has a rule and no objective, so who wants it wants the paper's.
pub(crate) fn objective(
    wanted: Option<Objective>,
    allocator: Option<AllocatorName>,
    mission: &Mission,
) -> Objective {
    let own = || match mission.planned_for? {
        PlannedFor::Paper => Some(Objective::Paper),
        PlannedFor::Quality => Some(Objective::Quality),
        PlannedFor::MinEnergy => Some(Objective::MinEnergy),
    };
    let rule = (allocator == Some(AllocatorName::Panorama)).then_some(Objective::Paper);
    wanted.or(rule).or_else(own).unwrap_or(Objective::Quality)
}

/// Who plans in a run, for this objective.
pub(crate) fn planner(
    objective: Objective,
    allocator: Option<AllocatorName>,
    steps: u64,
) -> Planner {
    match (objective, allocator) {
        (Objective::Paper, Some(AllocatorName::Exact)) => Planner::PanoramaThenExact { steps },
        (Objective::Paper, _) | (_, Some(AllocatorName::Panorama)) => Planner::Panorama,
        (Objective::MinEnergy, _) => Planner::Exact { aim: Aim::MinEnergy, steps },
        (Objective::Quality | Objective::Front, _) => Planner::Exact { aim: Aim::Quality, steps },
    }
}

fn unknown(name: &str) -> Failure {
    let names: Vec<_> = embedded::embedded().iter().map(|mission| mission.name).collect();
    let guess = near(name, names.iter().copied())
        .map_or_else(String::new, |known| format!("; did you mean `{known}`?"));
    Failure::new(format!("there is no mission `{name}`, and no file of this name{guess}")).help(
        format!(
            "missions that come with the program: {}; or give the path of a mission file",
            names.join(", ")
        ),
    )
}

/// The text of a mission file with other limits and nothing else changed.
fn with_limits(text: &str, wanted: [Option<u64>; 2]) -> Option<String> {
    #[derive(Deserialize)]
    struct File {
        limits: Limits,
    }
    #[derive(Deserialize)]
    struct Limits {
        duration_ms: Spanned<i64>,
        energy_mj: Spanned<i64>,
    }
    let Limits { duration_ms, energy_mj } = toml::from_str::<File>(text).ok()?.limits;
    let mut edits: Vec<_> =
        [duration_ms.span(), energy_mj.span()].into_iter().zip(wanted).collect();
    // The later one first, so that the place of the other stays right.
    edits.sort_by_key(|(span, _)| std::cmp::Reverse(span.start));
    let mut text = text.to_owned();
    for (span, wanted) in edits {
        text.get(span.clone())?;
        if let Some(wanted) = wanted {
            text.replace_range(span, &wanted.to_string());
        }
    }
    Some(text)
}

/// Hardware that was lost from the start: kinds with their units.
pub(crate) fn lost(mission: &Definition, lost: &[Lost]) -> Result<Vec<(usize, u8)>, Failure> {
    lost.iter().map(|one| find_lost(mission, one)).collect()
}

fn find_lost(mission: &Definition, lost: &Lost) -> Result<(usize, u8), Failure> {
    let names = || {
        mission
            .hardware
            .iter()
            .map(|it| format!("{} ({})", it.name, it.units))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let found = mission.hardware.iter().enumerate().find(|(_, it)| it.name == lost.kind);
    let Some((kind, hardware)) = found else {
        return Err(Failure::new(format!("--lost {}: the robot has no such hardware", lost.kind))
            .help(format!("it has: {}", names())));
    };
    let units = lost.units.unwrap_or(hardware.units);
    if units > hardware.units {
        let message =
            format!("--lost {}:{units}: the robot has only {}", lost.kind, hardware.units);
        return Err(Failure::new(message).help(format!("it has: {}", names())));
    }
    Ok((kind, units))
}

/// The hardware of a mission that is left.
pub(crate) fn available(mission: &Definition, lost: &[(usize, u8)]) -> Equipment {
    lost.iter().fold(mission.available(), |units, &(kind, count)| units.without(kind, count))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_changed_in_their_place_and_nothing_else() {
        let patrol = embedded::mission("patrol").unwrap().text;
        let changed = with_limits(patrol, [Some(1), Some(2)]).unwrap();
        let expected = patrol.replacen("duration_ms = 600000", "duration_ms = 1", 1).replacen(
            "= 8640000",
            "= 2",
            1,
        );
        assert_eq!(changed, expected);
        let inline = "limits = { energy_mj = 0x10, duration_ms = 1_0 } # 1_0";
        let changed = with_limits(inline, [Some(77), None]).unwrap();
        assert_eq!(changed, "limits = { energy_mj = 0x10, duration_ms = 77 } # 1_0");
    }
}
