//! Checks of a supervised mission as a whole, so that its supervisor cannot be asked for the
//! impossible, and so that no objective blocks.

use super::definition::{Definition, Does, Objective};
use super::diagnostic::Diagnostic;
use super::mission_net::{self, Fault, MAX_OBJECTIVES, RESERVED, global_supervisor};
use super::scenario::{PlannedActivity, Scenario};
use crate::cotama::{Configuration, Module, SubObjective};
use cotama_core::net::owned::OwnedNet;

/// The most objectives of a supervised mission.
pub const MAX_SUPERVISED_OBJECTIVES: usize = MAX_OBJECTIVES;

/// The supervisor of a supervised mission, made and checked; none for a plain one.
///
/// # Errors
/// Every rule that the mission breaks.
pub(super) fn supervisor(
    definition: &Definition,
    scenario: &Scenario,
) -> Result<Option<OwnedNet>, Vec<Diagnostic>> {
    let objectives = &definition.objectives;
    if definition.supervision.is_none() {
        let by_robot = definition.under.is_some();
        let errors = if by_robot { object(objectives) } else { Vec::new() };
        return if errors.is_empty() { Ok(None) } else { Err(errors) };
    }
    if let Some(one_too_many) = objectives.get(MAX_OBJECTIVES) {
        let message = format!("a supervised mission has at most {MAX_OBJECTIVES} objectives");
        let help = "leave some out, or make two missions";
        return Err(vec![
            Diagnostic::new(one_too_many.span.clone(), message, "one too many").help(help),
        ]);
    }
    let mut errors = names(objectives);
    errors.extend(object(objectives));
    errors.extend(last(objectives));
    errors.extend(could_block(definition, scenario));
    if !errors.is_empty() {
        return Err(errors);
    }
    let at = |objective: Option<&Objective>, message: String| {
        let span = objective.map_or(0..0, |it| it.span.clone());
        Diagnostic::new(span, message, "its supervisor")
            .help("this is an error of the program: report it")
    };
    let net = global_supervisor(objectives)
        .map_err(|error| vec![at(objectives.first(), error.to_string())])?;
    mission_net::check(&net.view().net(), objectives).map_err(|faults| {
        let place = |fault: &Fault| match fault {
            Fault::Unreached(place) | Fault::Deadlock(place) | Fault::Blocks { at: place, .. } => {
                Some(place.clone())
            }
            _ => None,
        };
        let objective =
            |fault: &Fault| place(fault).and_then(|id| objectives.iter().find(|it| it.id == id));
        faults
            .iter()
            .map(|fault| at(objective(fault).or(objectives.first()), fault.to_string()))
            .collect::<Vec<_>>()
    })?;
    Ok(Some(net))
}

fn what(objective: &Objective) -> Option<Does> {
    objective.does.as_ref().map(|does| does.value)
}

/// An error at what an objective does.
fn wrong(objective: &Objective, message: String, label: &str, help: &str) -> Diagnostic {
    let span = objective.does.as_ref().map_or(&objective.span, |does| &does.span);
    Diagnostic::new(span.clone(), message, label).help(help)
}

/// Objectives are places of the supervisor, and it has places of its own.
fn names(objectives: &[Objective]) -> Vec<Diagnostic> {
    let taken = objectives.iter().filter(|it| RESERVED.contains(&it.id.as_str()));
    let error = |it: &Objective| {
        let message = format!("the supervisor of every mission has a place `{}` of its own", it.id);
        Diagnostic::new(it.span.clone(), message, "taken").help("rename the objective")
    };
    taken.map(error).collect()
}

/// One object at most, received before it is delivered, and delivered in the end.
fn object(objectives: &[Objective]) -> Vec<Diagnostic> {
    let mut errors = Vec::new();
    let mut on_board: Option<&Objective> = None;
    for it in objectives {
        match (what(it), on_board) {
            (Some(Does::Receive), Some(since)) => {
                let message = format!(
                    "`{}` receives an object, but the one of `{}` is still on board",
                    it.id, since.id
                );
                errors.push(wrong(it, message, "a second object", "deliver the first one before"));
            }
            (Some(Does::Receive), None) => on_board = Some(it),
            (Some(Does::Deliver), None) => {
                let message = format!("`{}` delivers, but no object is on board there", it.id);
                errors.push(wrong(it, message, "nothing to deliver", "receive an object before"));
            }
            (Some(Does::Deliver), Some(_)) => on_board = None,
            _ => {}
        }
    }
    if let Some(since) = on_board {
        let message = format!("the object of `{}` is never delivered", since.id);
        errors.push(wrong(
            since,
            message,
            "still on board at the end",
            "add an objective that delivers it",
        ));
    }
    errors
}

/// A mission does not end with waiting.
fn last(objectives: &[Objective]) -> Option<Diagnostic> {
    let last = objectives.last().filter(|it| what(it) == Some(Does::Wait))?;
    let message = format!("the mission ends with `{}`, which waits for nothing", last.id);
    Some(wrong(last, message, "nothing follows", "leave it out"))
}

fn of(scenario: &Scenario, objective: usize) -> impl Iterator<Item = &PlannedActivity> {
    scenario.activities.iter().filter(move |activity| activity.objective == objective)
}

/// Whether no way to drive does without this module: when it is lost, stopping is all that is left.
fn is_vital(module: Module) -> bool {
    let drives = |it: &Configuration| {
        let facts = it.facts();
        facts.sub_objective == SubObjective::Following
            || *it == Configuration::TeleoperationDegraded
    };
    Configuration::ALL.iter().filter(|it| drives(it)).all(|it| it.facts().required.has(module))
}

/// An objective that one lost module would leave without any configuration, and the operator
/// without the means to drive; modules that every way to drive needs are not counted: without them
/// the robot stops, as it should.
fn could_block(definition: &Definition, scenario: &Scenario) -> Vec<Diagnostic> {
    let has = |module: Module| definition.hardware.iter().any(|it| it.name == module.name());
    let teleoperation = Configuration::TeleoperationDegraded.facts().required;
    let operator = teleoperation.iter().all(has);
    let rescued =
        |name: &str| operator && !Module::named(name).is_some_and(|it| teleoperation.has(it));
    let vital = |name: &str| Module::named(name).is_some_and(is_vital);
    let mut errors = Vec::new();
    for (index, objective) in definition.objectives.iter().enumerate() {
        let drives = what(objective) == Some(Does::Drive);
        let blocking = |activity: &PlannedActivity| {
            let needed = |kind: usize| activity.alternatives.iter().all(|it| it.needs.of(kind) > 0);
            let kinds = definition.hardware.iter().enumerate().filter(|(kind, _)| needed(*kind));
            let names = kinds.map(|(_, module)| module.name.as_str());
            names.filter(|name| !(vital(name) || drives && rescued(name))).collect::<Vec<_>>()
        };
        let mut places = of(scenario, index).map(|activity| (activity, blocking(activity)));
        let Some((activity, modules)) = places.find(|(_, modules)| !modules.is_empty()) else {
            continue;
        };
        let (id, at, without) = (&objective.id, activity.x_start, modules.join(" or "));
        let options = activity.labels.join(", ");
        let left = if drives { ", and no teleoperation without CAM and LAN" } else { "" };
        let message = format!(
            "`{id}` could block at {at}: without {without} none of its options is left \
             ({options}){left}"
        );
        let help = format!("add an option that does not need {without}");
        let help = if drives { format!("{help}, or the modules CAM and LAN") } else { help };
        errors.push(Diagnostic::new(objective.span.clone(), message, "could block").help(help));
    }
    errors
}
