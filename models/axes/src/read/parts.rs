//! Reading options, objectives and zones.

use super::Reader;
use super::keys::Keys;
use crate::fields::{Faults, Fields, distinct, index_of, integer, text};
use crate::mission::{Mission, Objective, Tio, Zone};
use crate::tree::{Fault, Node};

const MAX_TASKS: usize = 4;

fn hardware_of(at: usize, name: &str, mission: &Mission, faults: &Faults) -> Option<usize> {
    index_of(at, "hardware", name, mission.hardware.iter().map(|it| it.id.as_str()), faults)
}

impl<'n> Reader<'n, '_> {
    pub(super) fn tio(&mut self, node: &'n Node) {
        let mission = &self.mission;
        let mut own = Fields::of(node, "a `tio`", self.faults);
        let id = own.own_name("option", mission.options.iter().map(|it| it.id.as_str()));
        let task = own.name("task").1;
        if let Some(software) = own.optional("software") {
            text(software, "software", self.faults);
        }
        let mut needs = vec![0; mission.hardware.len()];
        for entry in own.named("needs", super::MAX_HARDWARE) {
            let kind = hardware_of(entry.key_at, &entry.key, mission, self.faults);
            let Some(kind) = kind else { continue };
            let units = mission.hardware.get(kind).map_or(0, |it| it.units);
            let need = integer(&entry.node, &entry.key, 1, units, self.faults);
            if let (Some(own), Some(need)) = (needs.get_mut(kind), need) {
                *own = need;
            }
        }
        self.seen.push((Keys::Options, own.left()));
        let attributes = own.attributes();
        self.mission.options.push(Tio { id, task, needs, most_mm_s: None, attributes });
    }

    pub(super) fn objective(&mut self, node: &Node, length: i64) {
        let (mission, faults) = (&self.mission, self.faults);
        let mut own = Fields::of(node, "an `objective`", faults);
        let id = own.own_name("objective", mission.objectives.iter().map(|it| it.id.as_str()));
        let begin = own.optional("x_start_mm");
        let start = match begin {
            Some(node) => integer(node, "x_start_mm", 0, length, faults),
            None => own.integer("x_start_mm", 0, length),
        };
        let (before, x_start_mm) = (mission.objectives.last(), start.unwrap_or(0));
        if let (true, Some(begin), Some(start)) = (self.is_strict, begin, start)
            && let Some(it) = before.filter(|it| start < it.x_end_mm)
        {
            let message =
                format!("it begins at {start}, before the end of `{}`, {}", it.id, it.x_end_mm);
            faults.add(Fault::new(begin.at, message).help("objectives are done one after another"));
        }
        let x_end_mm = own.integer("x_end_mm", x_start_mm, length).unwrap_or(x_start_mm);
        let (mut tasks, mut names, mut leads) = (Vec::new(), Vec::new(), false);
        let list = own.list("tasks", MAX_TASKS);
        for node in list {
            let Some((at, task)) = text(node, "tasks", faults) else {
                leads = true;
                continue;
            };
            distinct(at, "task of the objective", task, names.iter().copied(), faults);
            names.push(task);
            let of_task = mission.options.iter().map(|it| it.task.as_str());
            let options: Vec<_> = of_task.clone().enumerate().filter(|it| it.1 == task).collect();
            let options: Vec<_> = options.into_iter().map(|it| it.0).collect();
            let first = options.first().and_then(|&it| mission.options.get(it));
            // What no option implements is one fault, not two.
            leads |= first.is_none_or(Tio::leads);
            if first.is_none() {
                index_of(at, "task", task, of_task, faults);
            }
            tasks.push(options);
        }
        let place = own.place();
        own.finish();
        if !leads {
            let message = "`tasks` needs a task besides `LOC`: something that the robot does";
            faults.say(place, message);
        }
        self.mission.objectives.push(Objective { id, x_start_mm, x_end_mm, tasks });
    }

    pub(super) fn zone(&mut self, node: &'n Node, length: i64) {
        let (mission, faults) = (&self.mission, self.faults);
        let mut own = Fields::of(node, "a `zone`", faults);
        let id = own.own_name("zone", mission.zones.iter().map(|it| it.id.as_str()));
        let start = own.integer("x_start_mm", 0, length);
        let x_start_mm = start.unwrap_or(0);
        // A zone without length acts nowhere.
        let least = x_start_mm + i64::from(self.is_strict);
        let x_end_mm = own.integer("x_end_mm", least.min(length), length).unwrap_or(length);
        let mut blind = Vec::new();
        for node in own.list("blind", super::MAX_HARDWARE) {
            let name = text(node, "blind", faults);
            blind.extend(name.and_then(|(at, it)| hardware_of(at, it, mission, faults)));
        }
        let options = mission.options.iter().map(|it| it.id.as_str());
        let required = own.optional("require_tio");
        let name = required.and_then(|it| text(it, "require_tio", faults));
        let require_tio = name.and_then(|(at, it)| index_of(at, "option", it, options, faults));
        let name = own.optional("require_hardware");
        let name = name.and_then(|it| text(it, "require_hardware", faults));
        let require_hardware = name.and_then(|(at, it)| hardware_of(at, it, mission, faults));
        self.seen.push((Keys::Zones, own.left()));
        let attributes = own.attributes();
        let zone = Zone {
            id,
            x_start_mm,
            x_end_mm,
            blind,
            require_tio,
            require_hardware,
            most_mm_s: None,
            attributes,
        };
        if let (true, Some(node)) = (self.is_strict, required) {
            self.at_odds(node.at, &zone);
        }
        self.mission.zones.push(zone);
    }

    /// Refuses a zone that requires another option of a task than one that it overlaps.
    fn at_odds(&self, at: usize, zone: &Zone) {
        let option = |it: &Zone| it.require_tio.and_then(|it| self.mission.options.get(it));
        let Some(own) = option(zone) else { return };
        for other in &self.mission.zones {
            let overlaps = zone.x_start_mm < other.x_end_mm && other.x_start_mm < zone.x_end_mm;
            let is_other = |it: &&Tio| it.task == own.task && it.id != own.id;
            if let Some(its) = option(other).filter(|it| overlaps && is_other(it)) {
                let message = format!(
                    "`{}` overlaps `{}`, which requires `{}` for the task `{}`, not `{}`",
                    zone.id, other.id, its.id, own.task, own.id
                );
                self.faults.say(at, message);
            }
        }
    }
}
