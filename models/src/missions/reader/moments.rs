//! Reading when a failure begins and ends: at a place of the path, at a time, at a place of the
//! local supervisor, or when a transition of the supervisors fires.

use super::entry::Names;
use super::fields::{Fields, Reported};
use crate::missions::diagnostic::Diagnostic;
use crate::missions::faults::{Act, Moment};
use crate::missions::known::AT_LEAST_ZERO;
use cotama_core::units::{Millimetres, Millis};

/// The keys of a moment: a place, a time, a place of the local supervisor, a transition of the
/// supervisors, and how long after one of the last two.
type Keys = [&'static str; 5];

const START: Keys = ["x_mm", "t_ms", "during", "fired", "after_ms"];
const END: Keys = ["until_x_mm", "until_t_ms", "until_during", "until_fired", "until_after_ms"];

/// When a failure begins, where it is not by place alone.
pub(super) fn start(fields: &mut Fields<'_>) -> Option<Moment> {
    moment(fields, START).ok()?
}

/// When a failure ends, if it is said.
pub(super) fn end(fields: &mut Fields<'_>, names: &Names<'_>) -> Result<Option<Moment>, Reported> {
    let end = moment(fields, END)?;
    if let Some(Moment::Place(x)) = end {
        on_the_path(fields, END[0], Some(x), names);
    }
    Ok(end)
}

/// The moment that one of the keys says; an error when two do.
fn moment(
    fields: &mut Fields<'_>,
    [x, t, during, fired, after]: Keys,
) -> Result<Option<Moment>, Reported> {
    let place = fields.optional_integer(x, AT_LEAST_ZERO).map(|it| it.map(Millimetres));
    let time = fields.optional_integer(t, AT_LEAST_ZERO).map(|it| it.map(Millis));
    let state = fields.optional_text(during);
    let act = fields.optional_text(fired);
    let wait = fields.optional_integer(after, AT_LEAST_ZERO).map(|it| it.map(Millis));
    let (place, time, state, act, wait) = (place?, time?, state?, act?, wait?);
    let said = [place.is_some(), time.is_some(), state.is_some(), act.is_some()];
    if said.into_iter().filter(|it| *it).count() > 1 {
        let message =
            format!("one of `{x}`, `{t}`, `{during}` and `{fired}` says when, not several");
        let key = if time.is_some() {
            t
        } else if state.is_some() {
            during
        } else {
            fired
        };
        let help = "leave out all but one";
        fields.report(Diagnostic::new(fields.span_of(key), message, "said twice").help(help));
        return Err(Reported);
    }
    if let (None, None, Some(_)) = (&state, &act, wait) {
        let message = format!("`{after}` is counted from what the supervisors do");
        let help = format!("add `{during}` or `{fired}`, or write `{t}`");
        fields.report(Diagnostic::new(fields.span_of(after), message, "since when?").help(help));
        return Err(Reported);
    }
    let wait = wait.unwrap_or(Millis(0));
    if let Some(name) = act {
        let names: Vec<_> = Act::all().map(|it| it.to_string()).collect();
        let names = names.iter().map(String::as_str);
        fields.index_of(&name, "transition of the supervisors", names).ok_or(Reported)?;
        return Ok(Act::named(&name.value).map(|act| Moment::Fired(act, wait)));
    }
    let Some(state) = state else {
        return Ok(place.map(Moment::Place).or(time.map(Moment::At)));
    };
    let names = Moment::STATES.iter().map(|it| it.0);
    let at = fields.index_of(&state, "place of the local supervisor", names).ok_or(Reported)?;
    Ok(Some(Moment::During(Moment::STATES[at].1, wait)))
}

/// Reports a place of the key that is behind the end of the path.
pub(super) fn on_the_path(
    fields: &Fields<'_>,
    key: &'static str,
    x: Option<Millimetres>,
    names: &Names<'_>,
) {
    if let (Some(x), Some(end)) = (x, names.path_length)
        && x > end
    {
        let message = format!("the event at {x} lies behind the end of the path, {end}");
        let help = format!("place it between 0 and {}", end.0);
        fields.report(Diagnostic::new(fields.span_of(key), message, "not on the path").help(help));
    }
}
