//! Reading hardware and the options of tasks.

use super::entry::{Entry, ids};
use super::fields::{Fields, Reported};
use super::form::Form;
use super::path::task;
use crate::missions::definition::{Hardware, Standing, Task, Tio};
use crate::missions::diagnostic::{Diagnostic, Spanned};
use crate::missions::known::{AT_LEAST_ZERO, NEEDED_UNITS, POSITIVE, QUALITIES, SPEEDS, UNITS};
use cotama_core::hardware::{Equipment, MAX_KINDS};
use cotama_core::units::{MillimetresPerSecond, Millis, Milliwatts};

/// Returns the entries that could be read.
pub(super) fn items<T>(entries: &[Entry<T>]) -> impl Iterator<Item = &T> {
    entries.iter().filter_map(|entry| entry.item.as_ref())
}

pub(super) fn hardware(fields: Fields<'_>, form: Form) -> Option<Vec<Entry<Hardware>>> {
    let mut kinds = Vec::new();
    for (index, (name, table)) in fields.named_tables()?.into_iter().enumerate() {
        let item = table.and_then(|mut table| {
            if index == MAX_KINDS {
                let message = format!("more than {MAX_KINDS} kinds of hardware");
                let help = "put kinds that are always switched together into one";
                table
                    .report(Diagnostic::new(name.span.clone(), message, "one too many").help(help));
            }
            let units = table.integer("units", UNITS);
            let power = table.integer("power_mw", AT_LEAST_ZERO).map(Milliwatts);
            let own = form.numbers(&mut table);
            table.finish();
            Some(Hardware { name: name.value.clone(), units: units?, power: power?, own })
        });
        kinds.push(Entry { id: name.value, item });
    }
    Some(kinds)
}

pub(super) fn tio(mut fields: Fields<'_>, hardware: &[Entry<Hardware>], form: Form) -> Entry<Tio> {
    let supervised = form.supervised;
    let id = fields.id("id");
    let task = fields.text("task").and_then(|name| task(&fields, &name));
    let needs = if supervised && !fields.has("needs") {
        Some(Equipment::NONE)
    } else {
        needs(&mut fields, hardware)
    };
    if let (true, Some(task @ (Task::Move | Task::Turn | Task::Detect | Task::Localise))) =
        (supervised, task)
    {
        let message = format!("`{}` is done by the configurations of the robot", task.name());
        let it = Diagnostic::new(fields.span_of("task"), message, "not here");
        fields.report(it.help(
            "leave the option out; `RCV`, `DLV`, `WAI` and tasks of your own can stand here",
        ));
    }
    let speed_max = fields.optional_integer("speed_max_mm_s", SPEEDS);
    let quality_per_dm = fields.optional_integer("quality_per_dm", QUALITIES);
    let quality = fields.optional_integer("quality", QUALITIES);
    let standing = own_standing(&mut fields, task, form);
    if form.axed {
        let _ = fields.optional_text("software");
    }
    let own = form.numbers(&mut fields);
    fields.finish();
    let Some(Spanned { value: id, span }) = id else { return Entry::unreadable() };
    let complete = || {
        Some(Tio {
            id: id.clone(),
            span,
            task: task?,
            needs: needs?,
            speed_max: speed_max.ok()?.map(MillimetresPerSecond),
            quality_per_dm: quality_per_dm.ok()?.unwrap_or(0),
            quality: quality.ok()?.unwrap_or(0),
            standing: standing.ok()?,
            own: own.clone(),
        })
    };
    Entry { item: complete(), id }
}

/// Reads time and power of an option that gives them itself: one that receives, delivers, waits, or
/// does a task of the user's own.
fn own_standing(
    fields: &mut Fields<'_>,
    task: Option<Task>,
    form: Form,
) -> Result<Option<Standing>, Reported> {
    if form.axed && fields.has("stand_ms") {
        let duration = fields.integer("stand_ms", POSITIVE).map(Millis);
        let power = fields.integer("stand_mw", AT_LEAST_ZERO).map(Milliwatts);
        let (duration, power) = duration.zip(power).ok_or(Reported)?;
        return Ok(Some(Standing { duration, power }));
    }
    if !matches!(task, Some(Task::Receive | Task::Deliver | Task::Wait | Task::Own(_))) {
        return Ok(None);
    }
    let duration = fields.integer("duration_ms", POSITIVE).map(Millis);
    let power = fields.integer("power_mw", AT_LEAST_ZERO).map(Milliwatts);
    let (duration, power) = duration.zip(power).ok_or(Reported)?;
    Ok(Some(Standing { duration, power }))
}

fn needs(fields: &mut Fields<'_>, hardware: &[Entry<Hardware>]) -> Option<Equipment> {
    let entries = fields.table("needs")?.named_integers::<u8>(&NEEDED_UNITS)?;
    let mut needs = Some(Equipment::NONE);
    for (name, count) in entries {
        let index = fields.index_of(&name, "hardware", ids(hardware));
        let kind = index.and_then(|index| hardware.get(index)?.item.as_ref());
        if let Some(kind) = kind.filter(|kind| count > kind.units) {
            let message =
                format!("needs {count} of `{}`, but the robot has only {}", kind.name, kind.units);
            let help = format!("write {} or less, or give the robot more units", kind.units);
            fields.report(Diagnostic::new(name.span, message, "more than there are").help(help));
        }
        needs = needs.zip(index).and_then(|(needs, index)| needs.with(index, count));
    }
    needs
}

/// Reads `[fixed]`, needed by the options that do not travel, and completes these options.
pub(super) fn standing(root: &mut Fields<'_>, tios: &mut [Entry<Tio>]) {
    let has = |task| items(tios).any(|tio| tio.task == task && tio.standing.is_none());
    let (turns, detects) = (has(Task::Turn), has(Task::Detect));
    let table = if turns || detects {
        root.table("fixed")
    } else {
        root.optional_table("fixed").ok().flatten()
    };
    let Some(mut fixed) = table else { return };
    if turns || fixed.has("turn_ms") || fixed.has("turn_power_mw") {
        let duration = fixed.integer("turn_ms", POSITIVE).map(Millis);
        let power = fixed.integer("turn_power_mw", AT_LEAST_ZERO).map(Milliwatts);
        let standing = duration.zip(power).map(|(duration, power)| Standing { duration, power });
        for tio in tios
            .iter_mut()
            .filter_map(|entry| entry.item.as_mut())
            .filter(|tio| tio.task == Task::Turn && tio.standing.is_none())
        {
            tio.standing = standing;
        }
    }
    if detects || fixed.has("detect_ms") || fixed.has("detect_power_mw") {
        let duration = fixed.integer("detect_ms", POSITIVE).map(Millis);
        let powers =
            fixed.table("detect_power_mw").and_then(|table| table.named_integers(&AT_LEAST_ZERO));
        for (name, power) in powers.as_deref().unwrap_or_default() {
            let other = |entry: &Entry<Tio>| {
                entry.item.as_ref().is_some_and(|tio| tio.task != Task::Detect)
            };
            let ids = tios.iter().filter(|entry| !other(entry)).map(|entry| entry.id.as_str());
            fixed.index_of(name, "detecting option", ids);
            let standing =
                duration.map(|duration| Standing { duration, power: Milliwatts(*power) });
            for tio in tios
                .iter_mut()
                .filter_map(|entry| entry.item.as_mut())
                .filter(|tio| tio.id == name.value)
            {
                tio.standing = standing;
            }
        }
        let without = |tio: &&Tio| tio.task == Task::Detect && tio.standing.is_none();
        for tio in items(tios).filter(|_| powers.is_some() && duration.is_some()).filter(without) {
            let message = format!("the option `{}` has no detection power", tio.id);
            let help = format!("add `{}` to `detect_power_mw` in [fixed]", tio.id);
            fixed.report(
                Diagnostic::new(tio.span.clone(), message, "not in `detect_power_mw`").help(help),
            );
        }
    }
    fixed.finish();
}
