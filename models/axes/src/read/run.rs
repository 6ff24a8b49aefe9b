//! Reading what happens on the way, and the return.

use super::Reader;
use crate::course::{Course, Event, ModelError, Return, Script, What};
use crate::fields::{Fields, LARGEST, index_of, integer, text};
use crate::tree::{Entry, Fault, Node};

const MAX_EVENTS: usize = 256;
const MAX_ERRORS: usize = 64;
const MAX_COSTS: usize = 32;
/// Real values are at most so much more than planned ones, in parts of a thousand.
const MAX_ERROR: i64 = 10_000;
/// They are no negative part of planned ones.
const LEAST_ERROR: i64 = -1_000;

impl Reader<'_, '_> {
    /// Reads `run`; where it is missing, nothing happens.
    pub(super) fn run(&self, node: Option<&Node>, length: i64) -> Course {
        let Some(node) = node else { return Course::default() };
        let mut own = Fields::of(node, "`run`", self.faults);
        let events = own.list("event", MAX_EVENTS).iter();
        let events = events.filter_map(|it| self.event(it, length)).collect();
        let errors = own.list("error", MAX_ERRORS).iter().filter_map(|it| self.error(it)).collect();
        let withstands = own.optional("withstands");
        let is_asked = own.optional_is_there("return")
            && own.word("return", "return", &["none", "guaranteed"]).is_some_and(|it| it.1 == 1);
        own.finish();
        if let Some(node) = withstands.filter(|_| !is_asked) {
            let fault =
                Fault::new(node.at, "`withstands` speaks of a return that is not asked for");
            self.faults.add(fault.help("write `return = \"guaranteed\"` in `run`"));
        }
        let home = is_asked.then(|| withstands.map_or(Return::default(), |it| self.home(it)));
        Course { script: Script { events, errors }, home }
    }

    fn event(&self, node: &Node, length: i64) -> Option<Event> {
        let mut own = Fields::of(node, "an `event`", self.faults);
        let x_mm = own.integer("x_mm", 0, length);
        let kind = own.word("kind", "kind of an event", &["costs", "fault"]);
        let what = if kind?.1 == 0 {
            let costs = own.named("costs", MAX_COSTS);
            if costs.is_empty() {
                self.faults.say(own.place(), "`costs` is missing in an `event` of costs");
            }
            Some(What::Costs(self.sums(costs, LARGEST)))
        } else {
            let name = own.text("hardware");
            let hardware = name.and_then(|(at, it)| self.hardware(at, it));
            let most =
                hardware.and_then(|it| self.mission.hardware.get(it)).map_or(255, |it| it.units);
            let units = own.integer("units_lost", 1, most);
            hardware.zip(units).map(|(hardware, units)| What::Lost(hardware, units))
        };
        own.finish();
        Some(Event { x_mm: x_mm?, what: what? })
    }

    fn error(&self, node: &Node) -> Option<ModelError> {
        let mut own = Fields::of(node, "an `error`", self.faults);
        let name = own.text("indicator");
        let indicator = name.and_then(|(at, it)| self.sum(at, it));
        let permille = own.integer("permille", LEAST_ERROR, MAX_ERROR);
        let zone = own.optional("zone").and_then(|it| text(it, "zone", self.faults));
        let zones = self.mission.zones.iter().map(|it| it.id.as_str());
        let found = zone.and_then(|(at, it)| index_of(at, "zone", it, zones, self.faults));
        own.finish();
        if zone.is_some() && found.is_none() {
            return None;
        }
        Some(ModelError { indicator: indicator?, zone: found, permille: permille? })
    }

    fn home(&self, node: &Node) -> Return {
        let mut own = Fields::of(node, "`withstands`", self.faults);
        let losses = own.named("losses", super::MAX_HARDWARE).iter().filter_map(|it| {
            let hardware = self.hardware(it.key_at, &it.key)?;
            let most = self.mission.hardware.get(hardware).map_or(255, |it| it.units);
            Some((hardware, integer(&it.node, &it.key, 1, most, self.faults)?))
        });
        let losses = losses.collect();
        let errors = self.sums(own.named("error_permille", MAX_COSTS), MAX_ERROR);
        let costs = self.sums(own.named("costs", MAX_COSTS), LARGEST);
        own.finish();
        Return { losses, errors, costs }
    }

    fn hardware(&self, at: usize, name: &str) -> Option<usize> {
        let known = self.mission.hardware.iter().map(|it| it.id.as_str());
        index_of(at, "hardware", name, known, self.faults)
    }

    /// Finds an indicator whose values add up.
    fn sum(&self, at: usize, name: &str) -> Option<usize> {
        let known = self.mission.indicators.iter().map(|it| it.id.as_str());
        let found = index_of(at, "indicator", name, known, self.faults)?;
        let adds_up = self.mission.indicators.get(found).is_some_and(|it| it.adds_up);
        if !adds_up {
            self.faults.say(at, format!("`{name}` does not add up over the mission"));
        }
        adds_up.then_some(found)
    }

    /// Reads numbers of sums, from zero.
    fn sums(&self, entries: &[Entry], most: i64) -> Vec<(usize, i64)> {
        let read = entries.iter().filter_map(|it| {
            let sum = self.sum(it.key_at, &it.key);
            let number = integer(&it.node, &it.key, 0, most, self.faults);
            Some((sum?, number?))
        });
        read.collect()
    }
}
