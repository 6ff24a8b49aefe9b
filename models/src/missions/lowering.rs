//! Missions of a robot that has a file of its own: its body, hardware and options.

use super::definition::{Definition, Hardware, Robot, Task, Tio};
use super::diagnostic::Diagnostic;
use super::numbers::Numbers;
use super::reader::Sink;
use super::terms::{MotionPower, harmless_speed};
use super::under::{Under, of_robot};
use crate::robots::{self, Mode, Parts, RobotFile};
use cotama_core::hardware::{Equipment, MAX_KINDS};
use cotama_core::units::{Millijoules, Milliwatts};
use std::ops::Range;

/// Returns the robot that a text of the second format names.
pub(super) fn named(text: &str) -> Option<String> {
    Some(of_robot(text)?.get("robot")?.as_str()?.to_owned())
}

/// The parts of a mission that its robot gives.
pub(super) struct Of {
    pub(super) under: Under,
    pub(super) body: Robot,
    pub(super) motion_power: MotionPower,
    pub(super) hardware: Vec<Hardware>,
    pub(super) tios: Vec<Tio>,
}

impl Under {
    /// A plain mission under the supervisors of a robot, if one is given. Modules that serve an
    /// option of the mission are hardware that it needs.
    pub(super) fn given(
        mut definition: Definition,
        file: Option<RobotFile>,
        sink: &Sink,
    ) -> Option<Definition> {
        let Some(file) = file else { return Some(definition) };
        let refused = |span: Range<usize>, message: String, help: &str| {
            sink.report(Diagnostic::new(span, message, "").help(help));
            None
        };
        if file.robot().body.is_none() {
            let message = format!("the robot `{}` has no [body]", file.robot().name);
            return refused(0..0, message, "a mission needs to know its speed and power: add it");
        }
        let mut modules = Vec::new();
        for (module, it) in file.robot().modules.iter().enumerate() {
            if !definition.tios.iter().any(|tio| tio.id == it.serves) {
                continue;
            }
            let kind = definition.hardware.len();
            if kind >= MAX_KINDS {
                let message = format!("more than {MAX_KINDS} kinds of hardware, with the modules");
                return refused(0..0, message, "let fewer modules serve an option");
            }
            let (name, power) = (it.name.clone(), Milliwatts(0));
            let own = Numbers::default();
            definition.hardware.push(Hardware { name, units: 1, power, own });
            for tio in definition.tios.iter_mut().filter(|tio| tio.id == it.serves) {
                tio.needs = tio.needs.with(kind, 1).unwrap_or(tio.needs);
            }
            modules.push((module, kind));
        }
        definition.under = Some(Self { file, configurations: Vec::new(), modules });
        Some(definition)
    }

    /// What a robot gives a mission of the second format, which names it at `span`.
    pub(super) fn of(file: &RobotFile, span: Range<usize>, sink: &Sink) -> Option<Of> {
        let robot = file.robot();
        let refused = |message: String, help: &str| {
            sink.report(Diagnostic::new(span.clone(), message, "this robot").help(help));
            None
        };
        let Some(body) = &robot.body else {
            let message = format!("the robot `{}` has no [body]", robot.name);
            return refused(message, "a mission needs to know its speed and power: add it");
        };
        let moves = robot.sub_objectives.iter();
        let Some(moving) = moves.clone().find(|it| it.moves && it.mode == Mode::Autonomous) else {
            let message = format!("the robot `{}` never moves by itself", robot.name);
            return refused(message, "give a configuration of mode `autonomous` a `speed_mm_s`");
        };
        let all: Vec<usize> = moving.configurations.clone();
        if all.len() > MAX_KINDS {
            let message = format!("`{}` has more than {MAX_KINDS} configurations", moving.name);
            return refused(message, "leave some out");
        }
        let (mut hardware, mut tios) = (Vec::new(), Vec::new());
        for (kind, it) in all.iter().enumerate() {
            let configuration = robot.configurations.get(*it)?;
            let name = configuration.name.clone();
            let power = power_of(robot, configuration.required);
            hardware.push(Hardware {
                name: name.clone(),
                units: 1,
                power,
                own: Numbers::default(),
            });
            let worse = (all.len() - kind) as u32;
            tios.push(Tio {
                id: name,
                span: span.clone(),
                task: Task::Move,
                needs: Equipment::NONE.with(kind, 1)?,
                speed_max: Some(configuration.speed),
                quality_per_dm: worse,
                quality: 0,
                standing: None,
                own: Numbers::default(),
            });
        }
        let harmless = body.impact.map(|(mass, energy)| harmless_speed(mass, Millijoules(energy)));
        let (mass_g, energy) = body.impact.unwrap_or((0, u64::MAX));
        Some(Of {
            under: Self { file: file.clone(), configurations: all, modules: Vec::new() },
            body: Robot {
                mass_g,
                speed_max: body.speed_max,
                impact_energy_max: Millijoules(energy),
                speed_harmless: harmless.unwrap_or(body.speed_max),
                own: Numbers::default(),
            },
            motion_power: body.motion_power,
            hardware,
            tios,
        })
    }

    /// Returns the hardware that a mission can plan with when these parts are known to be lost.
    pub fn units(&self, mission: &Definition, lost: Parts) -> Equipment {
        let robot = self.file.robot();
        let available = robot.usable(lost);
        if !self.configurations.is_empty() {
            let runs = |it: &usize| {
                robot.configurations.get(*it).is_some_and(|it| it.required & !available == 0)
            };
            let left = self.configurations.iter().enumerate().filter(|it| runs(it.1));
            return left.fold(Equipment::NONE, |all, (kind, _)| all.with(kind, 1).unwrap_or(all));
        }
        let mut units = mission.available();
        for (number, it) in robot.hardware.iter().enumerate() {
            let kind = mission.hardware.iter().position(|known| known.name == it.kind);
            if let (1, Some(kind)) = (lost.hardware >> number & 1, kind) {
                units = units.without(kind, it.units);
            }
        }
        for &(module, kind) in &self.modules {
            if available >> module & 1 == 0 {
                units = units.without(kind, 1);
            }
        }
        units
    }
}

/// The power of all hardware that these modules stand on.
pub(super) fn power_of(robot: &robots::Robot, modules: u64) -> Milliwatts {
    let used = (0..robot.modules.len()).filter(|it| modules >> it & 1 == 1);
    let used =
        used.filter_map(|it| robot.modules.get(it)).fold(0, |all, it| all | it.needs.hardware);
    let all = robot.hardware.iter().enumerate().filter(|it| used >> it.0 & 1 == 1);
    Milliwatts(all.map(|it| it.1.power.0).sum())
}
