//! Checks of a mission under supervisors as a whole, so that its global supervisor can be made of
//! its objectives, and asks nothing impossible.

use super::definition::{Definition, Does, Objective, Task};
use super::diagnostic::Diagnostic;
use crate::robots::supervisors::{MAX_STEPS, RESERVED, Step};

/// Returns the objectives as steps of the global supervisor.
pub(super) fn steps(objectives: &[Objective]) -> Vec<Step> {
    let step = |it: &Objective| Step { name: it.id.clone(), ends: ends(it) };
    objectives.iter().map(step).collect()
}

/// Returns the event that ends an objective for which the robot stands.
fn ends(objective: &Objective) -> Option<String> {
    let task = objective.tasks.iter().find(|it| it.leads()).copied().filter(|it| *it != Task::Move);
    Some(match task? {
        Task::Receive => "object_received".to_owned(),
        Task::Deliver => "object_delivered".to_owned(),
        Task::Wait => "wait_over".to_owned(),
        task => format!("{}_over", task.name().to_ascii_lowercase()),
    })
}

/// Checks the objectives of a mission under supervisors; those of a plain one may be anything.
///
/// # Errors
/// Every rule that the mission breaks.
pub(super) fn check(definition: &Definition) -> Result<(), Vec<Diagnostic>> {
    let objectives = &definition.objectives;
    if definition.under.is_none() {
        return Ok(());
    }
    if let Some(one_too_many) = objectives.get(MAX_STEPS) {
        let message = format!("a mission under supervisors has at most {MAX_STEPS} objectives");
        let it = Diagnostic::new(one_too_many.span.clone(), message, "one too many");
        return Err(vec![it.help("leave some out, or make two missions")]);
    }
    let mut errors = names(objectives);
    errors.extend(object(objectives));
    errors.extend(last(objectives));
    if errors.is_empty() { Ok(()) } else { Err(errors) }
}

fn does(objective: &Objective) -> Option<Does> {
    objective.does.as_ref().map(|does| does.value)
}

/// An error at what an objective does.
fn wrong(objective: &Objective, message: String, label: &str, help: &str) -> Diagnostic {
    let span = objective.does.as_ref().map_or(&objective.span, |does| &does.span);
    Diagnostic::new(span.clone(), message, label).help(help)
}

/// Objectives are places of the supervisor, and it has places of its own.
fn names(objectives: &[Objective]) -> Vec<Diagnostic> {
    let mut errors = Vec::new();
    let steps = steps(objectives);
    for (at, it) in objectives.iter().enumerate() {
        let place = steps.get(at).map_or_else(String::new, Step::place);
        let before = steps.iter().take(at).position(|it| it.place() == place);
        let message = if RESERVED.contains(&place.as_str()) {
            format!("the supervisor of every mission has a place `{place}` of its own")
        } else if let Some(before) = before.and_then(|it| objectives.get(it)) {
            format!("`{}` and `{}` are one place `{place}` of the supervisor", before.id, it.id)
        } else {
            continue;
        };
        let it = Diagnostic::new(it.span.clone(), message, "taken");
        errors.push(it.help("rename the objective"));
    }
    errors
}

/// One object at most, received before it is delivered, and delivered in the end.
fn object(objectives: &[Objective]) -> Vec<Diagnostic> {
    let mut errors = Vec::new();
    let mut on_board: Option<&Objective> = None;
    for it in objectives {
        match (does(it), on_board) {
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
    let last = objectives.last().filter(|it| does(it) == Some(Does::Wait))?;
    let message = format!("the mission ends with `{}`, which waits for nothing", last.id);
    Some(wrong(last, message, "nothing follows", "leave it out"))
}
