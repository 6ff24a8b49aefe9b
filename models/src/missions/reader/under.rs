//! Reading the incidents of a mission whose robot has a file of its own.

use super::entry::Names;
use super::fields::{Fields, Reported};
use super::moments::on_the_path;
use crate::missions::diagnostic::{Diagnostic, Spanned};
use crate::missions::known::{AT_LEAST_ZERO, DOOR_STATES, INCIDENTS};
use crate::robots::{Answer, Incident, IncidentKind, Mode, Moment, Robot};
use cotama_core::units::{Millimetres, Millis};

/// The place of the local supervisor in which the robot waits for the operator.
const WAITS: &str = "Waits";
/// Answers that are no sub-objective.
const OTHERS: [(&str, Answer); 2] = [("done", Answer::Done), ("give_up", Answer::GivesUp)];

/// Whether an event is one that the supervisors of a robot deal with.
pub(super) fn is_incident(fields: &Fields<'_>) -> bool {
    let has = |key| fields.has(key);
    has("mode") || has("answers") || has("during") || fields.says("kind", &INCIDENTS)
}

/// Reads an incident.
pub(super) fn incident(
    mut fields: Fields<'_>,
    robot: &Robot,
    names: &Names<'_>,
) -> Option<Incident> {
    let kind = fields.choice("kind", "event", &["failure", "repair", "operator", "door"]);
    let when = moment(&mut fields, robot, ["x_mm", "t_ms", "during", "after_ms"]);
    let kind = match kind {
        Some("failure") => failure(&mut fields, robot).map(|failure| {
            let keys = ["until_x_mm", "until_t_ms", "until_during", "until_after_ms"];
            let until = moment(&mut fields, robot, keys);
            until.ok().map(|until| IncidentKind::Failure { failure, until })
        }),
        Some("door") => Some(door(&mut fields, names)),
        Some("repair") => failure(&mut fields, robot).map(|it| Some(IncidentKind::Repair(it))),
        Some(_) => Some(operator(&mut fields, robot)),
        None => {
            fields.abandon();
            return None;
        }
    };
    if let Ok(Some(Moment::Place(x))) = when {
        on_the_path(&fields, "x_mm", Some(x), names);
    }
    if let Ok(None) = when {
        let message = "nothing says when this happens";
        let it = Diagnostic::new(fields.whole(), message, "when?");
        fields.report(it.help("add `x_mm`, `t_ms` or `during`"));
    }
    if let (Ok(Some(Moment::During(..) | Moment::Waiting(_) | Moment::At(_))), Some(Some(it))) =
        (&when, &kind)
        && !matches!(it, IncidentKind::Failure { .. } | IncidentKind::Door { .. })
    {
        let it = Diagnostic::new(fields.whole(), "this happens at a place", "not by place");
        fields.report(it.help("write `x_mm`"));
    }
    fields.finish();
    Some(Incident { when: when.ok()??, kind: kind?? })
}

/// Reads which door opens or closes.
fn door(fields: &mut Fields<'_>, names: &Names<'_>) -> Option<IncidentKind> {
    let door = fields.text("door");
    let becomes = fields.choice("becomes", "state of a door", &DOOR_STATES);
    let Some(doors) = names.doors else {
        let message = "a door is one of a floor, and the mission names none";
        let it = Diagnostic::new(fields.whole(), message, "without a floor");
        fields.report(it.help("leave this event out, or name a `floor` in the mission"));
        return None;
    };
    let door = fields.index_of(&door?, "door of the floor", doors.iter().map(String::as_str))?;
    Some(IncidentKind::Door { door, is_open: becomes? == "open" })
}

/// Reads which failure.
fn failure(fields: &mut Fields<'_>, robot: &Robot) -> Option<usize> {
    let mode = fields.text("mode")?;
    fields.index_of(&mode, "failure of the robot", robot.failures.iter().map(|it| it.id.as_str()))
}

fn moment(
    fields: &mut Fields<'_>,
    robot: &Robot,
    [x, t, during, after]: [&'static str; 4],
) -> Result<Option<Moment>, Reported> {
    let place = fields.optional_integer(x, AT_LEAST_ZERO)?.map(Millimetres);
    let time = fields.optional_integer(t, AT_LEAST_ZERO)?.map(Millis);
    let state = fields.optional_text(during)?;
    let wait = if state.is_some() { fields.optional_integer(after, AT_LEAST_ZERO)? } else { None };
    let wait = Millis(wait.unwrap_or(0));
    let said = [place.is_some(), time.is_some(), state.is_some()];
    if said.into_iter().filter(|it| *it).count() > 1 {
        let message = format!("one of `{x}`, `{t}` and `{during}` says when, not several");
        let it = Diagnostic::new(fields.whole(), message, "said twice");
        fields.report(it.help("leave out all but one"));
        return Err(Reported);
    }
    let Some(state) = state else {
        return Ok(place.map(Moment::Place).or(time.map(Moment::At)));
    };
    let names = robot.sub_objectives.iter().map(|it| it.name.as_str()).chain([WAITS]);
    let at = fields.index_of(&state, "sub-objective", names).ok_or(Reported)?;
    let waits = at == robot.sub_objectives.len();
    Ok(Some(if waits { Moment::Waiting(wait) } else { Moment::During(at, wait) }))
}

fn operator(fields: &mut Fields<'_>, robot: &Robot) -> Option<IncidentKind> {
    let delay = fields.integer("delay_ms", AT_LEAST_ZERO).map(Millis);
    let found = fields.texts("answers")?;
    let answers =
        found.iter().map(|name| answer(fields, name, robot)).collect::<Option<Vec<_>>>()?;
    let ends = matches!(answers.last(), Some(Answer::Done | Answer::GivesUp));
    let early = answers.iter().rev().skip(1).any(|it| !matches!(it, Answer::Chooses(_)));
    if !ends || early || answers.first() == Some(&Answer::Done) {
        let message = "answers begin with what the operator chooses, and end with `done` or \
                       `give_up`";
        let it = Diagnostic::new(fields.span_of("answers"), message, "not so");
        fields.report(it.help("for example: answers = [\"Manual\", \"done\"]"));
        return None;
    }
    Some(IncidentKind::Operator { answers, delay: delay? })
}

fn answer(fields: &Fields<'_>, name: &Spanned<String>, robot: &Robot) -> Option<Answer> {
    let his: Vec<usize> = (0..robot.sub_objectives.len())
        .filter(|it| robot.sub_objectives.get(*it).is_some_and(|it| it.mode == Mode::Operator))
        .collect();
    let names = his.iter().filter_map(|it| robot.sub_objectives.get(*it));
    let names = names.map(|it| it.name.as_str()).chain(OTHERS.iter().map(|it| it.0));
    let names: Vec<_> = names.collect();
    let at = fields.index_of(name, "answer", names.into_iter())?;
    let other = at.checked_sub(his.len()).and_then(|it| OTHERS.get(it)).map(|it| it.1);
    other.or_else(|| his.get(at).map(|it| Answer::Chooses(*it)))
}
