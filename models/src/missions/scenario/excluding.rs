//! Constraints of zones that exclude combinations of options, and what they leave.

use super::{Combination, Constraint, Part, PlannedActivity};
use crate::missions::definition::{Definition, Task, Zone};
use crate::missions::diagnostic::Diagnostic;
use cotama_core::hardware::Equipment;

/// The constraints that exclude a combination, in the order of the file.
pub(super) fn excluding(
    definition: &Definition,
    zones: &[(usize, &Zone)],
    combination: &Combination,
) -> Vec<(usize, Constraint)> {
    let moving = definition.tios.get(combination.lead).filter(|tio| tio.task == Task::Move);
    let uses = moving.map_or(Equipment::NONE, |tio| tio.needs);
    let mut by = Vec::new();
    for &(index, zone) in zones {
        let hardware = zone.require_hardware.as_ref().map(|required| required.value);
        if hardware.is_some_and(|required| uses.of(required.hardware) < required.units) {
            by.push((index, Constraint::Hardware));
        }
        let tio = zone.require_tio.as_ref().map(|required| required.value);
        if tio.is_some_and(|required| !combination.tios.contains(&required)) {
            by.push((index, Constraint::Tio));
        }
    }
    by
}

/// Returns the demand of a constraint, in words.
pub(super) fn demand(definition: &Definition, zone: usize, constraint: Constraint) -> String {
    let Some(zone) = definition.zones.get(zone) else { return String::new() };
    match (constraint, &zone.require_hardware, &zone.require_tio) {
        (Constraint::Hardware, Some(required), _) => {
            let name =
                definition.hardware.get(required.value.hardware).map_or("", |it| it.name.as_str());
            let count = required.value.units;
            format!("zone `{}` requires the moving option to use {count} of `{name}`", zone.id)
        }
        (Constraint::Tio, _, Some(required)) => {
            let id = definition.tios.get(required.value).map_or("", |it| it.id.as_str());
            format!("zone `{}` requires the option `{id}`", zone.id)
        }
        _ => String::new(),
    }
}

pub(super) fn place_of(activity: &PlannedActivity, part: &Part<'_>) -> String {
    let (id, objective) = (&activity.id, &part.task_objective.id);
    format!(
        "the activity {id} (objective `{objective}`, {} to {})",
        activity.x_start, activity.x_end
    )
}

pub(super) fn too_expensive(
    activity: &PlannedActivity,
    part: &Part<'_>,
    label: &str,
) -> Diagnostic {
    let place = place_of(activity, part);
    let message = format!("{place}, done with `{label}`, costs more than {} ms or mJ", u32::MAX);
    let help =
        "split the objective, or give it a higher speed or less power; quality has the same limit";
    Diagnostic::new(part.task_objective.span.clone(), message, "too large").help(help)
}

/// Says which constraint excluded the last alternative, and what each left.
pub(super) fn emptied(
    definition: &Definition,
    activity: &PlannedActivity,
    part: &Part<'_>,
) -> Diagnostic {
    let mut constraints: Vec<_> =
        activity.dropped.iter().flat_map(|dropped| dropped.by.clone()).collect();
    constraints.sort_unstable();
    constraints.dedup();
    let mut story = vec![format!("of {} combinations", activity.dropped.len())];
    let mut last = part.task_objective.span.clone();
    for count in 1..=constraints.len() {
        let applied = &constraints[..count];
        let excluded = |by: &[(usize, Constraint)]| by.iter().any(|one| applied.contains(one));
        let left = activity.dropped.iter().filter(|dropped| !excluded(&dropped.by)).count();
        let (zone, constraint) = constraints[count - 1];
        story.push(format!("{left} are left when {}", demand(definition, zone, constraint)));
        if left == 0 {
            let zone = &definition.zones[zone];
            last = match constraint {
                Constraint::Hardware => {
                    zone.require_hardware.as_ref().map(|required| required.span.clone())
                }
                Constraint::Tio => zone.require_tio.as_ref().map(|required| required.span.clone()),
            }
            .unwrap_or(zone.span.clone());
            break;
        }
    }
    let by_axes: Vec<_> = activity.dropped.iter().filter(|it| it.by.is_empty()).collect();
    if let Some(first) = by_axes.first() {
        story.push(format!(
            "{} are excluded by axes, `{}`: {}",
            by_axes.len(),
            first.label,
            first.reason
        ));
    }
    let message = format!("{} is left without alternatives", place_of(activity, part));
    Diagnostic::new(last, message, "excludes the last of them").help(story.join(", "))
}
