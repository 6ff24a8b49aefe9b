//! Reading a mission file, section by section.

use super::entry::{Entry, Names};
use super::faults;
use super::fields::Fields;
use super::form::Form;
use super::ground::Ground;
use super::options::{hardware, items, standing, tio};
use super::path::{objective, one_after_the_other, zone};
use super::people;
use super::supervision;
use crate::missions::definition::{AXES, Definition, Hardware, Robot, Tio, Zone};
use crate::missions::diagnostic::Diagnostic;
use crate::missions::faults::PowerError;
use crate::missions::known::{
    AT_LEAST_ZERO, ATTRIBUTES, ENERGIES, NAME_LENGTHS, NO_LIMIT, OBJECTIVES, POSITIVE, ROUNDINGS,
    SPEEDS,
};
use crate::missions::people::People;
use crate::missions::terms::{MotionPower, PlannedFor, harmless_speed};
use crate::missions::under::Under;
use crate::missions::way::Way;
use crate::names::quoted;
use crate::robots::{EMBEDDED, RobotFile};
use cotama_core::units::{Millijoules, Millimetres, MillimetresPerSecond, Milliwatts};
use std::ops::Range;

/// Reads the whole file of a mission whose robot has a file of its own: body, hardware and options
/// of moving are those of the robot.
pub(in crate::missions) fn definition_of(
    mut root: Fields<'_>,
    robot: Option<&RobotFile>,
    way: Option<&Way>,
    axed: bool,
) -> Option<Definition> {
    let form = Form { supervised: true, axed };
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
    let limits = limits_or_axes(&mut root, axed);
    let planned_for = root.optional_table("plan").map(|plan| plan.and_then(planned_for));
    let Some(mut of) = of else {
        root.abandon();
        return None;
    };
    let entry = |it: &Hardware| Entry { id: it.name.clone(), item: Some(it.clone()) };
    let hardware: Vec<_> = of.hardware.iter().map(entry).collect();
    let mut tios: Vec<_> = all(root.tables("tio", false), |it| tio(it, &hardware, form));
    if axed {
        configurations(&mut root, &mut of.tios, &mut of.hardware);
        if let Ok(Some(mut fields)) = root.optional_table("attributes") {
            of.body.own = fields.numbers(&ATTRIBUTES);
            fields.finish();
        }
    }
    tios.extend(of.tios.into_iter().map(|it| Entry { id: it.id.clone(), item: Some(it) }));
    let objectives =
        all(root.tables("objective", true), |table| objective(table, ground.as_mut(), &tios, true));
    let path_length = said.or_else(|| ground.as_ref()?.length());
    let read = |table| zone(table, path_length, (ground.as_ref(), form), &hardware, &tios);
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
        axes: None,
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
pub(in crate::missions) fn definition(mut root: Fields<'_>, axed: bool) -> Option<Definition> {
    let form = Form { supervised: false, axed };
    // All else that such a file says is another form of the same mistake.
    if supervision::refuse(&root) {
        return None;
    }
    let name = name(&mut root);
    let path_length = root.integer("path_length_mm", POSITIVE).map(Millimetres);
    let limits = limits_or_axes(&mut root, axed);
    if let Ok(Some(table)) = root.optional_table("rounding") {
        rounding(table);
    }
    let planned_for = root.optional_table("plan").map(|plan| plan.and_then(planned_for));
    let robot = root.table("robot").and_then(|it| robot(it, form));
    let motion_power = root.table("motion_power").and_then(motion_power);
    let hardware = root
        .table("hardware")
        .and_then(|it| hardware(it, form))
        .unwrap_or_else(|| vec![Entry::unreadable()]);
    let mut tios = all(root.tables("tio", true), |table| tio(table, &hardware, form));
    standing(&mut root, &mut tios);
    let read = |table| zone(table, path_length, (None, form), &hardware, &tios);
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
        axes: None,
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

/// Reads the limits; those of a mission with axes follow from its constraints, which are read
/// afterwards.
fn limits_or_axes(root: &mut Fields<'_>, axed: bool) -> Option<([u64; 2], [usize; 2])> {
    if !axed {
        return root.table("limits").and_then(limits);
    }
    for key in ["laptop", "detection", "axis", "constraint", "ask"] {
        root.knows(key);
    }
    if root.has("limits") {
        root.knows("limits");
        let message = "limits of a mission with axes are constraints";
        let it = Diagnostic::new(root.span_of("limits"), message, "not here");
        root.report(it.help("write a [[constraint]] with kind = \"end\" on each sum"));
    }
    Some(([NO_LIMIT; 2], [0, 1]))
}

/// Reads attributes of the robot's configurations, which are options and hardware of the mission.
fn configurations(root: &mut Fields<'_>, tios: &mut [Tio], hardware: &mut [Hardware]) {
    let Ok(Some(table)) = root.optional_table("configuration") else { return };
    for (name, fields) in table.named_tables().unwrap_or_default() {
        let Some(mut fields) = fields else { continue };
        let names: Vec<_> = tios.iter().map(|it| it.id.clone()).collect();
        let names = names.iter().map(String::as_str);
        let at = fields.index_of(&name, "configuration of the robot", names);
        let numbers = fields.numbers(&ATTRIBUTES);
        fields.finish();
        if let Some(tio) = at.and_then(|at| tios.get_mut(at)) {
            for it in hardware.iter_mut().filter(|it| it.name == tio.id) {
                it.own = numbers.clone();
            }
            tio.own = numbers;
        }
    }
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

fn robot(mut robot: Fields<'_>, form: Form) -> Option<Robot> {
    let mass_g = robot.integer("mass_g", POSITIVE);
    let speed_max = robot.integer("speed_max_mm_s", SPEEDS).map(MillimetresPerSecond);
    let is_free = form.axed && !robot.has("impact_energy_max_mj");
    let impact_energy_max = if is_free {
        // A constraint says what is harmless, if anything is to.
        robot.knows("impact_energy_max_mj");
        Some(Millijoules(u64::MAX))
    } else {
        robot.integer("impact_energy_max_mj", POSITIVE).map(Millijoules)
    };
    let step = if form.axed { robot.optional_integer("speed_step_mm_s", SPEEDS) } else { Ok(None) };
    let stated = robot.optional_integer("speed_harmless_mm_s", SPEEDS);
    let harmless = || Some(harmless_speed(mass_g?, impact_energy_max?));
    let computed = if is_free { speed_max } else { harmless() };
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
    let mut own = form.numbers(&mut robot);
    if let Ok(Some(step)) = step {
        own.add("speed_step_mm_s", robot.span_of("speed_step_mm_s"), step);
    }
    robot.finish();
    let speed_harmless = stated.ok()?.map_or(computed?, MillimetresPerSecond);
    Some(Robot {
        mass_g: mass_g?,
        speed_max: speed_max?,
        impact_energy_max: impact_energy_max?,
        speed_harmless,
        own,
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
