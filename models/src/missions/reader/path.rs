//! Reading what lies along the path: zones and objectives.

use super::entry::{Entry, ids};
use super::fields::{Fields, Reported};
use super::form::Form;
use super::ground::{Ground, Span, parts, without_floor};
use super::supervision;
use crate::missions::definition::{
    Does, Hardware, HardwareRequirement, Objective, Task, Tio, Zone,
};
use crate::missions::diagnostic::{Diagnostic, Spanned};
use crate::missions::known::{AT_LEAST_ZERO, SPEEDS, UNITS};
use crate::names::unknown;
use cotama_core::units::{Millimetres, MillimetresPerSecond};
use std::ops::Range;

/// Reads a zone; on a floor it may be as many as the path has parts in it.
pub(super) fn zone(
    mut fields: Fields<'_>,
    path_length: Option<Millimetres>,
    (ground, form): (Option<&Ground<'_>>, Form),
    hardware: &[Entry<Hardware>],
    tios: &[Entry<Tio>],
) -> Vec<Entry<Zone>> {
    let id = fields.id("id");
    let spans = if let Some(ground) = ground.filter(|_| !fields.has("x_start_mm")) {
        let of = fields.optional_text("on_floor");
        let name = of.ok().flatten().or_else(|| id.clone());
        name.map(|it| ground.spans(&fields, &it))
    } else {
        if ground.is_none() && form.supervised {
            without_floor(&mut fields, &["on_floor"]);
        }
        span(&mut fields, path_length).map(|it| vec![it])
    };
    let speed_max = fields.optional_integer("speed_max_mm_s", SPEEDS);
    let require_hardware = required_hardware(&mut fields, hardware);
    let require_tio = fields.optional_text("require_tio").and_then(|name| match name {
        None => Ok(None),
        Some(name) => {
            let value = fields.index_of(&name, "option", ids(tios)).ok_or(Reported)?;
            Ok(Some(Spanned { value, span: name.span }))
        }
    });
    let blind = if form.axed { blind(&mut fields, hardware) } else { Some(Vec::new()) };
    let own = form.numbers(&mut fields);
    fields.finish();
    let Some(Spanned { value: id, span }) = id else { return vec![Entry::unreadable()] };
    let complete = || {
        Some(Zone {
            id: id.clone(),
            span,
            x_start: Millimetres::ZERO,
            x_end: Millimetres::ZERO,
            speed_max: speed_max.ok()?.map(MillimetresPerSecond),
            require_hardware: require_hardware.ok()?,
            require_tio: require_tio.ok()?,
            blind: blind.clone()?,
            own: own.clone(),
        })
    };
    match complete().zip(spans) {
        Some((zone, spans)) if !spans.is_empty() => parts(&zone, spans),
        _ => vec![Entry { id, item: None }],
    }
}

/// Reads the kinds of hardware that see no obstacles in a zone.
fn blind(fields: &mut Fields<'_>, hardware: &[Entry<Hardware>]) -> Option<Vec<usize>> {
    let names = fields.optional_texts("blind").ok()?;
    names.iter().map(|it| fields.index_of(it, "hardware", ids(hardware))).collect()
}

/// Reads the stretch of the path that a zone is.
fn span(fields: &mut Fields<'_>, path_length: Option<Millimetres>) -> Option<Span> {
    let x_start = fields.integer("x_start_mm", AT_LEAST_ZERO).map(Millimetres);
    let x_end = fields.integer("x_end_mm", AT_LEAST_ZERO).map(Millimetres);
    if let (Some(start), Some(end)) = (x_start, x_end)
        && start >= end
    {
        let message = format!("the zone is empty: it starts at {start} and ends at {end}");
        let help = "let it end behind its start";
        fields.report(
            Diagnostic::new(fields.span_of("x_end_mm"), message, "not behind the start").help(help),
        );
    }
    if let (Some(end), Some(length)) = (x_end, path_length)
        && end > length
    {
        let message = format!("the zone ends at {end}, behind the end of the path, {length}");
        let help = format!("let it end at {} or before", length.0);
        fields.report(
            Diagnostic::new(fields.span_of("x_end_mm"), message, "not on the path").help(help),
        );
    }
    Some([x_start?, x_end?])
}

fn required_hardware(
    fields: &mut Fields<'_>,
    hardware: &[Entry<Hardware>],
) -> Result<Option<Spanned<HardwareRequirement>>, Reported> {
    // Without a hardware, a number of units is an unknown key.
    let Some(name) = fields.optional_text("require_hardware")? else { return Ok(None) };
    let units = fields.optional_integer("require_units", UNITS);
    let hardware = fields.index_of(&name, "hardware", ids(hardware)).ok_or(Reported)?;
    let value = HardwareRequirement { hardware, units: units?.unwrap_or(1) };
    Ok(Some(Spanned { value, span: name.span }))
}

pub(super) fn objective(
    mut fields: Fields<'_>,
    ground: Option<&mut Ground<'_>>,
    tios: &[Entry<Tio>],
    supervised: bool,
) -> Entry<Objective> {
    let id = fields.id("id");
    let does = supervision::does(&mut fields, supervised);
    let doing = does.as_ref().map(|does| does.as_ref().map(|does| does.value));
    let way = if let Some(ground) = ground {
        ground.leg(&mut fields)
    } else {
        if supervised {
            without_floor(&mut fields, &["to"]);
        }
        let x_start = fields.integer("x_start_mm", AT_LEAST_ZERO).map(Millimetres);
        let x_end = fields.integer("x_end_mm", AT_LEAST_ZERO).map(Millimetres);
        x_start.zip(x_end)
    };
    let by_does = supervised && !fields.has("tasks");
    let known = by_does.then(|| match (&doing, way) {
        (Ok(Some(does)), Some(way)) => {
            let tasks = vec![does.task()];
            has_options(&fields, "does", &tasks, tios);
            suit_what_it_does(&fields, &tasks, way, *does).then_some(tasks)
        }
        _ => None,
    });
    let named = if by_does { None } else { fields.texts("tasks") };
    let tasks = known.flatten().or(named.and_then(|names| {
        let found = tasks(&fields, &names, tios)?;
        let suit = match (way?, doing) {
            (way, Ok(None)) => suit_the_way(&fields, &found, way),
            (way, Ok(Some(does))) => suit_what_it_does(&fields, &found, way, does),
            (_, Err(Reported)) => false,
        };
        suit.then_some(found)
    }));
    fields.finish();
    let Some(Spanned { value: id, span }) = id else { return Entry::unreadable() };
    let complete = || {
        let (x_start, x_end) = way?;
        Some(Objective { id: id.clone(), span, x_start, x_end, tasks: tasks?, does: does.ok()? })
    };
    Entry { item: complete(), id }
}

/// The task of this name; reports it if there is none.
pub(super) fn task(fields: &Fields<'_>, name: &Spanned<String>) -> Option<Task> {
    let task = Task::from_name(&name.value);
    if task.is_none() {
        let (message, mut help) = unknown("task", &name.value, Task::NAMES.into_iter());
        if help.starts_with("known") {
            help += "; or one of your own, in capitals";
        }
        fields.report(Diagnostic::new(name.span.clone(), message, "not known").help(help));
    }
    task
}

fn tasks(fields: &Fields<'_>, names: &[Spanned<String>], tios: &[Entry<Tio>]) -> Option<Vec<Task>> {
    let found: Vec<_> = names.iter().map(|name| task(fields, name)).collect();
    let found: Vec<Task> = found.into_iter().collect::<Option<_>>()?;
    for (place, (task, name)) in found.iter().zip(names).enumerate() {
        if found.iter().position(|other| other == task) != Some(place) {
            let message = format!("the task `{}` is named twice", task.name());
            fields
                .report(Diagnostic::new(name.span.clone(), message, "again").help("leave it out"));
        }
        without_option(fields, *task, name.span.clone(), tios);
    }
    Some(found)
}

/// Reports tasks that no option implements, at a key.
fn has_options(fields: &Fields<'_>, key: &str, tasks: &[Task], tios: &[Entry<Tio>]) {
    tasks.iter().for_each(|it| without_option(fields, *it, fields.span_of(key), tios));
}

/// Reports a task that no option implements.
fn without_option(fields: &Fields<'_>, task: Task, at: Range<usize>, tios: &[Entry<Tio>]) {
    // Options that could not be read may be of this task.
    let implements = |tio: &Entry<Tio>| tio.item.as_ref().is_none_or(|tio| tio.task == task);
    if !tios.iter().any(implements) {
        let message = format!("no option implements the task `{}`", task.name());
        let help = format!("add a [[tio]] with task = \"{}\"", task.name());
        fields.report(Diagnostic::new(at, message, "without an option").help(help));
    }
}

/// The tasks that decide how long an objective takes.
fn leads(tasks: &[Task]) -> Vec<Task> {
    tasks.iter().copied().filter(|task| task.leads()).collect()
}

/// Whether the tasks of an objective are right for one that travels, or stands; reports it if not.
fn suit_the_way(
    fields: &Fields<'_>,
    tasks: &[Task],
    (x_start, x_end): (Millimetres, Millimetres),
) -> bool {
    let wrong = match (x_start < x_end, &leads(tasks)[..]) {
        (true, [Task::Move]) => return true,
        (false, [lead]) if *lead != Task::Move => return true,
        (true, _) => "an objective that travels needs `MOV`, and no other task but `LOC`",
        (false, _) => {
            "an objective that stays at one place needs one of `TUR`, `DET`, `RCV`, `DLV`, `WAI`, \
             and not `MOV`"
        }
    };
    let help = "change its tasks, or its `x_start_mm` and `x_end_mm`";
    fields.report(Diagnostic::new(fields.span_of("tasks"), wrong, "these tasks").help(help));
    false
}

/// Whether the way and the tasks of a supervised objective are right for what it does; reports it
/// if not.
fn suit_what_it_does(
    fields: &Fields<'_>,
    tasks: &[Task],
    (x_start, x_end): (Millimetres, Millimetres),
    does: Does,
) -> bool {
    let drives = does == Does::Drive;
    if drives != (x_start < x_end) {
        let (message, label) = if !drives {
            let message = format!(
                "this objective goes from {x_start} to {x_end}, but only one that drives travels"
            );
            (message, "not where it starts")
        } else if x_start == x_end {
            (
                format!("this drive leads nowhere: it starts and ends at {x_start}"),
                "not behind the start",
            )
        } else {
            (format!("this drive leads back, from {x_start} to {x_end}"), "not behind the start")
        };
        let (key, help) = match (drives, fields.has("x_end_mm")) {
            (true, true) => ("x_end_mm", "let it end behind its start"),
            (false, true) => ("x_end_mm", "let it end where it starts"),
            (true, false) => ("to", "say `to`, another place of the floor"),
            (false, false) => ("to", "leave `to` out"),
        };
        fields.report(Diagnostic::new(fields.span_of(key), message, label).help(help));
        return false;
    }
    let task = does.task();
    let task = task.name();
    if leads(tasks) != [does.task()] {
        let message = format!(
            "an objective that does `{}` needs `{task}`, and no other task but `LOC`",
            does.name()
        );
        let help = format!("write tasks = [\"{task}\"], or change what it does");
        fields.report(Diagnostic::new(fields.span_of("tasks"), message, "these tasks").help(help));
        return false;
    }
    true
}

/// Objectives must follow each other from the start of the path to its end.
pub(super) fn one_after_the_other(
    root: &Fields<'_>,
    path_length: Option<Millimetres>,
    objectives: &[Entry<Objective>],
) {
    let mut at = Some(Millimetres::ZERO);
    for objective in objectives {
        let Some(it) = &objective.item else {
            at = None;
            continue;
        };
        let wrong = if it.x_end < it.x_start {
            Some(format!(
                "the objective `{}` ends at {}, before its start at {}",
                it.id, it.x_end, it.x_start
            ))
        } else {
            let at = at.filter(|at| *at != it.x_start);
            at.map(|at| match it.x_start.checked_sub(at) {
                Some(gap) => {
                    format!(
                        "a gap of {gap} before the objective `{}`: it must start at {at}",
                        it.id
                    )
                }
                None => {
                    format!(
                        "the objective `{}` starts at {}, but the robot is at {at}",
                        it.id, it.x_start
                    )
                }
            })
        };
        if let Some(message) = wrong {
            let help =
                "objectives follow each other along the path, each from where the one before ends";
            root.report(
                Diagnostic::new(it.span.clone(), message, "not where the robot is").help(help),
            );
        }
        at = Some(it.x_end);
    }
    if let (Some(length), Some(at), Some(last)) =
        (path_length, at, objectives.last().and_then(|last| last.item.as_ref()))
        && at != length
    {
        let message = format!("the last objective ends at {at}, but the path at {length}");
        let help = "let it end with the path, or change `path_length_mm`";
        root.report(
            Diagnostic::new(last.span.clone(), message, "not the end of the path").help(help),
        );
    }
}
