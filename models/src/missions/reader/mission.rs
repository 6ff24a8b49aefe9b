//! Reading a mission file, section by section.

use super::entry::{Entry, Names, ids};
use super::faults;
use super::fields::{Fields, Reported};
use super::ground::Ground;
use super::path::{objective, one_after_the_other, task, zone};
use super::people;
use super::supervision;
use crate::missions::definition::{AXES, Definition, Hardware, Robot, Standing, Task, Tio, Zone};
use crate::missions::diagnostic::{Diagnostic, Spanned};
use crate::missions::faults::PowerError;
use crate::missions::known::{
    AT_LEAST_ZERO, ENERGIES, NAME_LENGTHS, NEEDED_UNITS, OBJECTIVES, POSITIVE, QUALITIES,
    ROUNDINGS, SPEEDS, UNITS,
};
use crate::missions::people::People;
use crate::missions::terms::{MotionPower, PlannedFor, harmless_speed};
use crate::missions::under::Under;
use crate::missions::way::Way;
use crate::names::quoted;
use crate::robots::{EMBEDDED, RobotFile};
use cotama_core::hardware::{Equipment, MAX_KINDS};
use cotama_core::units::{Millijoules, Millimetres, MillimetresPerSecond, Millis, Milliwatts};
use std::ops::Range;

/// Reads the whole file of a mission whose robot has a file of its own: body, hardware and options
/// of moving are those of the robot.
pub(in crate::missions) fn definition_of(
    mut root: Fields<'_>,
    robot: Option<&RobotFile>,
    way: Option<&Way>,
) -> Option<Definition> {
    let name = name(&mut root);
    let named = root.text("robot");
    if let (None, Some(named)) = (robot, &named) {
        let names: Vec<_> = EMBEDDED.iter().map(|it| it.name).collect();
        root.index_of(named, "robot", names.into_iter());
    }
    let of = robot.zip(named).and_then(|(file, named)| Under::of(file, named.span, root.sink()));
    let mut ground = Ground::of(&mut root, way);
    let said = match &ground {
        Some(_) => None,
        None => root.integer("path_length_mm", POSITIVE).map(Millimetres),
    };
    let limits = root.table("limits").and_then(limits);
    let planned_for = root.optional_table("plan").map(|plan| plan.and_then(planned_for));
    let Some(of) = of else {
        root.abandon();
        return None;
    };
    let entry = |it: &Hardware| Entry { id: it.name.clone(), item: Some(it.clone()) };
    let hardware: Vec<_> = of.hardware.iter().map(entry).collect();
    let mut tios: Vec<_> = all(root.tables("tio", false), |it| tio(it, &hardware, true));
    tios.extend(of.tios.into_iter().map(|it| Entry { id: it.id.clone(), item: Some(it) }));
    let objectives =
        all(root.tables("objective", true), |table| objective(table, ground.as_mut(), &tios, true));
    let path_length = said.or_else(|| ground.as_ref()?.length());
    let read = |table| zone(table, path_length, (ground.as_ref(), true), &hardware, &tios);
    let zones = all(root.tables("zone", false), read);
    one_after_the_other(&root, path_length, &objectives);
    let names = Names {
        path_length,
        zones: &zones,
        hardware: &hardware,
        robot: robot.map(RobotFile::robot),
        doors: ground.as_ref().map(Ground::doors),
    };
    let run = root.optional_table("run").ok().and_then(|run| faults::run(run, &names));
    let people = people::people(&mut root, ground.as_ref());
    unique(&root, "option", items(&tios).map(|it| (&it.id, &it.span)));
    unique(&root, "zone", items(&zones).map(|it| (&it.id, &it.span)));
    unique(&root, "objective", items(&objectives).map(|it| (&it.id, &it.span)));
    root.finish();
    let (limits, order) = limits?;
    let (zones, mut run) = (complete(zones)?, run?);
    in_all_parts(&zones, &mut run.faults.power_errors);
    Some(Definition {
        name: name?,
        path_length: path_length?,
        limits,
        order,
        planned_for: planned_for.ok()?,
        robot: of.body,
        hardware: of.hardware,
        motion_power: of.motion_power,
        tios: complete(tios)?,
        objectives: complete(objectives)?,
        zones,
        under: Some(of.under),
        way: way.filter(|_| ground.is_some()).cloned(),
        people: people?,
        run,
    })
}

/// Lets what is said of a zone be said of all parts of the path in it.
fn in_all_parts(zones: &[Zone], errors: &mut Vec<PowerError>) {
    for it in errors.clone() {
        let others = zones.iter().enumerate().skip(it.zone + 1);
        let same = |other: &&(usize, &Zone)| {
            zones.get(it.zone).is_some_and(|zone| zone.span == other.1.span)
        };
        let others = others.filter(|other| same(&other));
        errors.extend(others.map(|(zone, _)| PowerError { zone, ..it }));
    }
}

/// Reads the whole file.
pub(in crate::missions) fn definition(mut root: Fields<'_>) -> Option<Definition> {
    // All else that such a file says is another form of the same mistake.
    if supervision::refuse(&root) {
        return None;
    }
    let name = name(&mut root);
    let path_length = root.integer("path_length_mm", POSITIVE).map(Millimetres);
    let limits = root.table("limits").and_then(limits);
    if let Ok(Some(table)) = root.optional_table("rounding") {
        rounding(table);
    }
    let planned_for = root.optional_table("plan").map(|plan| plan.and_then(planned_for));
    let robot = root.table("robot").and_then(robot);
    let motion_power = root.table("motion_power").and_then(motion_power);
    let hardware =
        root.table("hardware").and_then(hardware).unwrap_or_else(|| vec![Entry::unreadable()]);
    let mut tios = all(root.tables("tio", true), |table| tio(table, &hardware, false));
    standing(&mut root, &mut tios);
    let read = |table| zone(table, path_length, (None, false), &hardware, &tios);
    let zones = all(root.tables("zone", false), read);
    let objectives =
        all(root.tables("objective", true), |table| objective(table, None, &tios, false));
    one_after_the_other(&root, path_length, &objectives);
    let names = Names { path_length, zones: &zones, hardware: &hardware, robot: None, doors: None };
    let run = root.optional_table("run").ok().and_then(|run| faults::run(run, &names));
    unique(&root, "option", items(&tios).map(|it| (&it.id, &it.span)));
    unique(&root, "zone", items(&zones).map(|it| (&it.id, &it.span)));
    unique(&root, "objective", items(&objectives).map(|it| (&it.id, &it.span)));
    root.finish();
    let (limits, order) = limits?;
    Some(Definition {
        name: name?,
        path_length: path_length?,
        limits,
        order,
        planned_for: planned_for.ok()?,
        robot: robot?,
        hardware: complete(hardware)?,
        motion_power: motion_power?,
        tios: complete(tios)?,
        objectives: complete(objectives)?,
        zones: complete(zones)?,
        under: None,
        way: None,
        people: People::default(),
        run: run?,
    })
}

/// Every entry of a list, or an unreadable one when the list itself was wrong, which is then
/// reported.
fn all<'t, T, I: IntoIterator<Item = Entry<T>>>(
    tables: Option<Vec<Fields<'t>>>,
    read: impl FnMut(Fields<'t>) -> I,
) -> Vec<Entry<T>> {
    let Some(tables) = tables else { return vec![Entry::unreadable()] };
    tables.into_iter().flat_map(read).collect()
}

fn items<T>(entries: &[Entry<T>]) -> impl Iterator<Item = &T> {
    entries.iter().filter_map(|entry| entry.item.as_ref())
}

fn complete<T>(entries: Vec<Entry<T>>) -> Option<Vec<T>> {
    entries.into_iter().map(|entry| entry.item).collect()
}

fn unique<'n>(
    root: &Fields<'_>,
    what: &str,
    ids: impl Iterator<Item = (&'n String, &'n Range<usize>)>,
) {
    let mut seen = std::collections::BTreeSet::new();
    for (id, span) in ids {
        if !seen.insert(id) {
            let message = format!("the {what} `{id}` is defined twice");
            root.report(Diagnostic::new(span.clone(), message, "again").help("rename one of them"));
        }
    }
}

fn name(root: &mut Fields<'_>) -> Option<String> {
    let name = root.text("name")?;
    if !NAME_LENGTHS.contains(&name.value.chars().count())
        || name.value.chars().any(char::is_control)
    {
        let message = format!("{} is not a name for a mission", quoted(&name.value));
        let help = "use 1 to 100 characters on one line";
        root.report(Diagnostic::new(name.span, message, "not a name").help(help));
        return None;
    }
    Some(name.value)
}

fn limits(mut limits: Fields<'_>) -> Option<([u64; 2], [usize; 2])> {
    let duration = limits.integer("duration_ms", POSITIVE);
    let energy = limits.integer("energy_mj", ENERGIES);
    let order = limits.texts("order").and_then(|names| {
        let axes: Vec<_> =
            names.iter().map(|name| limits.index_of(name, "axis", AXES.iter().copied())).collect();
        let axes = axes.into_iter().collect::<Option<Vec<_>>>()?;
        match axes[..] {
            [0, 1] => Some([0, 1]),
            [1, 0] => Some([1, 0]),
            _ => {
                let message = "`order` must name each axis once";
                let help = "write [\"duration\", \"energy\"] or [\"energy\", \"duration\"]";
                limits.report(
                    Diagnostic::new(limits.span_of("order"), message, "each once").help(help),
                );
                None
            }
        }
    });
    limits.finish();
    Some(([duration?, energy?], order?))
}

fn rounding(mut rounding: Fields<'_>) {
    for (key, known) in ROUNDINGS {
        if let Ok(Some(found)) = rounding.optional_text(key)
            && found.value != known
        {
            let message = format!("unknown rounding of the {key}");
            let help = format!("only \"{known}\" is known; write that, or leave the key out");
            rounding.report(Diagnostic::new(found.span, message, "not known").help(help));
        }
    }
    rounding.finish();
}

/// Reads the criterion by which plans are chosen.
fn planned_for(mut plan: Fields<'_>) -> Option<PlannedFor> {
    let name = plan.text("objective");
    let known = OBJECTIVES.map(|it| it.0);
    let found = name.and_then(|name| plan.index_of(&name, "objective of plans", known.into_iter()));
    plan.finish();
    found.and_then(|at| OBJECTIVES.get(at)).map(|it| it.1)
}

fn robot(mut robot: Fields<'_>) -> Option<Robot> {
    let mass_g = robot.integer("mass_g", POSITIVE);
    let speed_max = robot.integer("speed_max_mm_s", SPEEDS).map(MillimetresPerSecond);
    let impact_energy_max = robot.integer("impact_energy_max_mj", POSITIVE).map(Millijoules);
    let stated = robot.optional_integer("speed_harmless_mm_s", SPEEDS);
    let computed = mass_g.zip(impact_energy_max).map(|(mass, energy)| harmless_speed(mass, energy));
    if let Some(computed) = computed {
        let stated = stated.as_ref().ok().copied().flatten().map(MillimetresPerSecond);
        if computed == MillimetresPerSecond::ZERO {
            let message =
                "no speed is harmless: even at 1 mm/s an impact reaches `impact_energy_max_mj`";
            let help = "give a lower mass or a higher energy";
            robot.report(
                Diagnostic::new(robot.span_of("impact_energy_max_mj"), message, "too low")
                    .help(help),
            );
        } else if stated.is_some_and(|stated| stated > computed) {
            let message = "`speed_harmless_mm_s` is not harmless for this mass and impact energy";
            let help = format!("the fastest harmless speed is {computed}");
            robot.report(
                Diagnostic::new(robot.span_of("speed_harmless_mm_s"), message, "too fast")
                    .help(help),
            );
        }
    }
    robot.finish();
    let speed_harmless = stated.ok()?.map_or(computed?, MillimetresPerSecond);
    Some(Robot {
        mass_g: mass_g?,
        speed_max: speed_max?,
        impact_energy_max: impact_energy_max?,
        speed_harmless,
    })
}

fn motion_power(mut fields: Fields<'_>) -> Option<MotionPower> {
    let c0 = fields.integer("c0", AT_LEAST_ZERO);
    let c1 = fields.integer("c1", AT_LEAST_ZERO);
    let c2 = fields.integer("c2", AT_LEAST_ZERO);
    let points = fields.tables("at", false).unwrap_or_default();
    let power = c0.zip(c1).zip(c2).map(|((c0, c1), c2)| MotionPower { c0, c1, c2 });
    for mut point in points {
        let speed = point.integer("speed_mm_s", SPEEDS).map(MillimetresPerSecond);
        let stated = point.integer("power_mw", AT_LEAST_ZERO).map(Milliwatts);
        if let (Some(power), Some(speed), Some(stated)) = (power, speed, stated)
            && power.at(speed) != stated
        {
            let message =
                format!("the coefficients give {} at {speed}, not {stated}", power.at(speed));
            let help = "correct the coefficients, or this value, or leave it out";
            point.report(
                Diagnostic::new(point.span_of("power_mw"), message, "disagrees").help(help),
            );
        }
        point.finish();
    }
    fields.finish();
    power
}

fn hardware(fields: Fields<'_>) -> Option<Vec<Entry<Hardware>>> {
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
            table.finish();
            Some(Hardware { name: name.value.clone(), units: units?, power: power? })
        });
        kinds.push(Entry { id: name.value, item });
    }
    Some(kinds)
}

fn tio(mut fields: Fields<'_>, hardware: &[Entry<Hardware>], supervised: bool) -> Entry<Tio> {
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
    let standing = own_standing(&mut fields, task);
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
        })
    };
    Entry { item: complete(), id }
}

/// Reads time and power of an option that gives them itself: one that receives, delivers, waits, or
/// does a task of the user's own.
fn own_standing(fields: &mut Fields<'_>, task: Option<Task>) -> Result<Option<Standing>, Reported> {
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
fn standing(root: &mut Fields<'_>, tios: &mut [Entry<Tio>]) {
    let has = |task| items(tios).any(|tio| tio.task == task);
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
            .filter(|tio| tio.task == Task::Turn)
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
