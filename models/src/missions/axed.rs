//! Missions whose speeds and limits follow from performance axes (Lambert et al., J. Intell. Robot.
//! Syst. 110, 2024, Sections 2 and 6.1).
//!
//! A file of [`FORMAT_3`](super::FORMAT_3) is one of the first or the second format whose
//! `[limits]` are constraints on indicators. Numbers that it gives beyond those are attributes,
//! which formulas read. The largest speed that keeps all core constraints is that of an
//! alternative; constraints on the sums of duration and energy are the limits of the mission.

use super::definition::{Definition, Objective, Task, Tio, Zone};
use super::diagnostic::Diagnostic;
use super::numbers::whole;
use super::reader::Sink;
use cotama_axes::{Case, Ground, Keys, Kind, Speeds, Wrong};
use cotama_core::hardware::Equipment;

/// Reads the axes of a mission whose other parts were read.
pub(super) fn read(definition: Definition, text: &str, sink: &Sink) -> Option<Definition> {
    let parts = [(Keys::Robot, definition.robot.own.seen())].into_iter();
    let parts = parts.chain(definition.hardware.iter().map(|it| (Keys::Hardware, it.own.seen())));
    let parts = parts.chain(definition.tios.iter().map(|it| (Keys::Options, it.own.seen())));
    let parts = parts.chain(definition.zones.iter().map(|it| (Keys::Zones, it.own.seen())));
    let mission = ground(&definition, definition.available());
    let case = Case::over(&Ground { mission, seen: parts.collect() }, text);
    let case = case.map_err(|wrongs| {
        wrongs.all.iter().for_each(|it| sink.report(located(it, text)));
    });
    let case = case.ok()?;
    let running = case.mission.constraints.iter().find(|it| it.kind == Kind::Running);
    if let Some(it) = running {
        let message = format!("`{}` limits a sum while it runs, and a mission its end", it.id);
        let help = "write kind = \"end\"; `cotama-axes/1` knows `running`";
        sink.report(Diagnostic::new(0..0, message, "").help(help));
        return None;
    }
    if !case.ask.is_empty() && definition.planned_for.is_some() {
        let message = "`ask` and `plan.objective` both say what plans are chosen for";
        sink.report(Diagnostic::new(0..0, message, "").help("leave one of them out"));
        return None;
    }
    Some(Definition { axes: Some(Box::new(case)), ..definition })
}

/// An error of the reader of axes, at its place.
fn located(wrong: &Wrong, text: &str) -> Diagnostic {
    let before = text.split_inclusive('\n').take(wrong.line.saturating_sub(1));
    let start: usize = before.map(str::len).sum();
    let line = text.get(start..).unwrap_or("");
    let column = line.char_indices().nth(wrong.column.saturating_sub(1));
    let at = start + column.map_or(0, |it| it.0);
    let it = Diagnostic::new(at..at + usize::from(column.is_some()), &wrong.message, "");
    Diagnostic { help: wrong.help.clone(), ..it }
}

/// The parts of a mission that its axes stand on, with the hardware that works.
pub(super) fn ground(definition: &Definition, available: Equipment) -> cotama_axes::Mission {
    let robot = &definition.robot;
    let most = robot.speed_max.min(robot.speed_harmless);
    let step = robot.own.get("speed_step_mm_s").unwrap_or(1);
    let hardware = definition.hardware.iter().enumerate().map(|(kind, it)| cotama_axes::Hardware {
        id: it.name.clone(),
        units: i64::from(available.of(kind)),
        attributes: it.own.with([("power_mw", Some(it.power.0))]),
    });
    let power = definition.motion_power;
    cotama_axes::Mission {
        robot: robot
            .own
            .with([("mass_g", Some(robot.mass_g)), ("speed_max_mm_s", Some(robot.speed_max.0))]),
        speeds: Speeds::Step { step_mm_s: step, most_mm_s: whole(most.0) },
        motion_power: [power.c0, power.c1, power.c2].map(whole),
        hardware: hardware.collect(),
        options: definition.tios.iter().map(|it| option(it, definition.hardware.len())).collect(),
        objectives: definition.objectives.iter().map(|it| tasks(it, &definition.tios)).collect(),
        zones: definition.zones.iter().map(zone).collect(),
        ..cotama_axes::Mission::empty(&definition.name)
    }
}

fn option(tio: &Tio, kinds: usize) -> cotama_axes::Tio {
    cotama_axes::Tio {
        id: tio.id.clone(),
        task: tio.task.name().to_owned(),
        needs: (0..kinds).map(|kind| i64::from(tio.needs.of(kind))).collect(),
        most_mm_s: tio.speed_max.map(|it| whole(it.0)),
        attributes: tio.own.with([
            ("stand_ms", tio.standing.map(|it| it.duration.0)),
            ("stand_mw", tio.standing.map(|it| it.power.0)),
            ("quality", Some(u64::from(tio.quality))),
            ("quality_per_dm", Some(u64::from(tio.quality_per_dm))),
        ]),
    }
}

fn tasks(objective: &Objective, tios: &[Tio]) -> cotama_axes::Objective {
    let of = |task: &Task| {
        let options = tios.iter().enumerate().filter(|it| it.1.task == *task);
        options.map(|it| it.0).collect()
    };
    cotama_axes::Objective {
        id: objective.id.clone(),
        x_start_mm: whole(objective.x_start.0),
        x_end_mm: whole(objective.x_end.0),
        tasks: objective.tasks.iter().map(of).collect(),
    }
}

fn zone(zone: &Zone) -> cotama_axes::Zone {
    cotama_axes::Zone {
        id: zone.id.clone(),
        x_start_mm: whole(zone.x_start.0),
        x_end_mm: whole(zone.x_end.0),
        blind: zone.blind.clone(),
        require_tio: zone.require_tio.as_ref().map(|it| it.value),
        require_hardware: zone.require_hardware.as_ref().map(|it| it.value.hardware),
        most_mm_s: zone.speed_max.map(|it| whole(it.0)),
        attributes: zone.own.with([]),
    }
}
