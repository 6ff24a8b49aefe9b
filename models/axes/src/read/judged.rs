//! Reading axes, indicators with their formulas, constraints, and what is asked.

use super::{Case, Reader};
use crate::course::Course;
use crate::fields::{Faults, Fields, LARGEST, distinct, index_of, text, wrong_type};
use crate::formula::Formula;
use crate::formula::forms::{self, Term};
use crate::mission::{Ask, Axis, Constraint, Indicator, Kind, Mission, Relation, Sense};
use crate::tree::{Fault, Node, Value};

const MAX_INDICATORS: usize = 32;

fn indicator_of(at: usize, name: &str, mission: &Mission, faults: &Faults) -> Option<usize> {
    index_of(at, "indicator", name, mission.indicators.iter().map(|it| it.id.as_str()), faults)
}

/// The nodes of an indicator's formulas: of activities that travel, and of those that stand.
type Written<'n> = [Option<&'n Node>; 2];

/// A formula while all of them are read.
#[derive(Clone, Debug)]
enum State {
    Unread,
    /// A block whose parts are being read.
    Begun,
    /// None where there is none, or none that can be used.
    Read(Option<Formula>),
}

impl Reader<'_, '_> {
    pub(super) fn axes(&mut self, nodes: &[Node]) {
        let mut written: Vec<Written<'_>> = Vec::new();
        for node in nodes {
            let mut own = Fields::of(node, "an `axis`", self.faults);
            let id = own.own_name("axis", self.mission.axes.iter().map(|it| it.id.as_str()));
            // Indicators of a second axis of a name may be those that other places mean.
            let is_own = !self.mission.axes.iter().any(|it| it.id == id);
            let id = if is_own { id } else { String::new() };
            let class = own.optional("class").and_then(|it| text(it, "class", self.faults));
            let class = class.and_then(|(at, word)| {
                index_of(at, "class of axis", word, ["minor", "major"].into_iter(), self.faults)
            });
            let axis = self.mission.axes.len();
            for node in own.list("indicator", MAX_INDICATORS) {
                if self.mission.indicators.len() == MAX_INDICATORS {
                    let message =
                        format!("all axes together have at most {MAX_INDICATORS} indicators");
                    self.faults.say(node.at, message);
                    break;
                }
                written.push(self.indicator(node, &id, axis));
            }
            own.finish();
            self.mission.axes.push(Axis { id, is_major: class.map(|it| it == 1) });
        }
        let mut formulas =
            Formulas { reader: self, written: &written, states: Vec::new(), stack: Vec::new() };
        formulas.states = vec![[State::Unread, State::Unread]; written.len()];
        for number in 0..written.len() {
            formulas.of(number, true);
            formulas.of(number, false);
        }
        let states = formulas.states;
        for (it, [travel, stand]) in self.mission.indicators.iter_mut().zip(states) {
            let read = |it| if let State::Read(it) = it { it } else { None };
            (it.travel, it.stand) = (read(travel), read(stand));
        }
    }

    /// Reads an indicator but for its formulas, which may read other indicators.
    fn indicator<'n>(&mut self, node: &'n Node, axis_id: &str, axis: usize) -> Written<'n> {
        let mut own = Fields::of(node, "an `indicator`", self.faults);
        let (at, name) = own.name("id");
        let is_named = !name.is_empty() && !axis_id.is_empty();
        let id = if is_named { format!("{axis_id}.{name}") } else { String::new() };
        let before = self.mission.indicators.iter().map(|it| it.id.as_str());
        let is_own = distinct(at, "indicator", &id, before, self.faults);
        if is_named {
            own.call(format!("the indicator `{id}`"));
        }
        let unit = own.name("unit").1;
        let word = own.word("combine", "way to combine", &["each", "sum"]);
        let written = [own.optional("travel"), own.optional("stand")];
        if written.iter().all(Option::is_none) {
            let message = format!("`{id}` has no formula: `travel`, `stand` or both are needed");
            self.faults.say(node.at, message);
        }
        own.finish();
        let adds_up = word.is_some_and(|it| it.1 == 1);
        let (travel, stand) = (None, None);
        let id = if is_own { id } else { String::new() };
        self.mission.indicators.push(Indicator { id, axis, unit, adds_up, travel, stand });
        written
    }

    pub(super) fn constraint(&mut self, node: &Node) {
        let (mission, faults) = (&self.mission, self.faults);
        let mut own = Fields::of(node, "a `constraint`", faults);
        let id = own.own_name("constraint", mission.constraints.iter().map(|it| it.id.as_str()));
        let named = own.text("indicator");
        let indicator = named.and_then(|(at, name)| indicator_of(at, name, mission, faults));
        let kinds = [Kind::Core, Kind::End, Kind::Running];
        let kind = own.word("kind", "kind", &kinds.map(Kind::word));
        let relation = own.word("op", "operator", &Relation::ALL.map(Relation::sign));
        let goal = own.integer("goal", -LARGEST, LARGEST);
        let (list, mut at) = (own.list("at", super::MAX_ZONES), Vec::new());
        for node in list {
            let mut own = Fields::of(node, "a goal of `at`", faults);
            let zones = mission.zones.iter().map(|it| it.id.as_str());
            let zone = own.text("zone").and_then(|it| index_of(it.0, "zone", it.1, zones, faults));
            at.extend(zone.zip(own.integer("goal", -LARGEST, LARGEST)));
            own.finish();
        }
        own.finish();
        let Some((kind_at, kind)) = kind else { return };
        let kind = kinds.get(kind).copied().unwrap_or(Kind::End);
        if let (Kind::End, Some(first)) = (kind, list.first()) {
            let message = "a goal at the end is one number";
            let help = "leave `at` out, or limit it as `running`";
            faults.add(Fault::new(first.at, message).help(help));
        }
        let Some(it) = indicator.and_then(|it| mission.indicators.get(it)) else { return };
        let name = &it.id;
        match (kind, it.adds_up) {
            (Kind::Core, true) => {
                let message = format!("`{name}` adds up over the mission, and `core` is of each");
                let help = "limit it at its `end`, or as `running`";
                faults.add(Fault::new(kind_at, message).help(help));
            }
            (Kind::End | Kind::Running, false) => {
                let message = format!("`{name}` is of each activity and has no sum");
                faults.add(Fault::new(kind_at, message).help("limit it as `core`"));
            }
            _ => {}
        }
        let (Some(indicator), Some((_, relation)), Some(goal)) = (indicator, relation, goal) else {
            return;
        };
        let relation = Relation::ALL.get(relation).copied().unwrap_or(Relation::Equal);
        self.mission.constraints.push(Constraint { id, indicator, kind, relation, goal, at });
    }

    /// Reads what is asked, and ends the reading.
    pub(super) fn ask(self, fields: &mut Fields<'_, '_>) -> Case {
        let mut ask: Vec<Ask> = Vec::new();
        let form = "`ask` is a list of wishes as `[\"min\", \"energy.RC\"]`, the first counts most";
        match fields.required("ask").map(|it| (it, &it.value)) {
            None => {}
            Some((_, Value::List(items))) if (1..=MAX_INDICATORS).contains(&items.len()) => {
                for item in items {
                    match &item.value {
                        Value::List(pair) if pair.len() == 2 => self.wish(pair, &mut ask),
                        _ => self.faults.say(item.at, form),
                    }
                }
            }
            Some((node, _)) => self.faults.say(node.at, form),
        }
        Case { mission: self.mission, ask, course: Course::default() }
    }

    fn wish(&self, pair: &[Node], ask: &mut Vec<Ask>) {
        let [sense, indicator] = pair else { return };
        let sense = text(sense, "ask", self.faults);
        let sense = sense.and_then(|(at, word)| {
            index_of(at, "sense", word, ["min", "max"].into_iter(), self.faults)
        });
        let Some((at, word)) = text(indicator, "ask", self.faults) else { return };
        let Some(indicator) = indicator_of(at, word, &self.mission, self.faults) else { return };
        if !self.mission.indicators.get(indicator).is_some_and(|it| it.adds_up) {
            let message = format!("`{word}` does not add up over the mission");
            self.faults.add(Fault::new(at, message).help("ask for a sum"));
        }
        if ask.iter().any(|it| it.indicator == indicator) {
            self.faults.say(at, format!("`{word}` is asked for twice"));
        }
        let sense = if sense == Some(1) { Sense::Max } else { Sense::Min };
        ask.push(Ask { sense, indicator });
    }
}

/// Formulas of all indicators, each read once, and after those that it reads.
struct Formulas<'r, 'f, 'n> {
    reader: &'r Reader<'n, 'f>,
    written: &'r [Written<'n>],
    states: Vec<[State; 2]>,
    /// Indicators whose formulas are begun, the outermost first.
    stack: Vec<usize>,
}

impl Formulas<'_, '_, '_> {
    /// Reads a formula, if that is not done yet.
    fn of(&mut self, indicator: usize, travels: bool) -> Option<Formula> {
        let side = usize::from(!travels);
        let state = self.states.get(indicator).and_then(|it| it.get(side))?;
        if let State::Read(formula) = state {
            return formula.clone();
        }
        let written = self.written.get(indicator).and_then(|it| *it.get(side)?);
        let key = if travels { "travel" } else { "stand" };
        self.put(indicator, side, State::Begun);
        self.stack.push(indicator);
        let formula = written.and_then(|it| self.read(it, indicator, key));
        self.stack.pop();
        self.put(indicator, side, State::Read(formula.clone()));
        formula
    }

    fn put(&mut self, indicator: usize, side: usize, state: State) {
        if let Some(own) = self.states.get_mut(indicator).and_then(|it| it.get_mut(side)) {
            *own = state;
        }
    }

    fn read(&mut self, node: &Node, indicator: usize, key: &'static str) -> Option<Formula> {
        let (reader, faults) = (self.reader, self.reader.faults);
        let formula = match &node.value {
            Value::Text(words) => {
                Formula::parse(words, node.at + 1).map_err(|it| faults.add(it)).ok()?
            }
            Value::Table(_) => {
                let whose = reader.mission.indicators.get(indicator)?;
                let travels = key == "travel";
                let mut other = |at: usize, name: &str| self.other(at, name, travels);
                forms::read(node, whose, travels, &mut other, faults)?
            }
            _ => {
                faults.add(wrong_type(node, key, "a formula in text or a form as a table"));
                return None;
            }
        };
        reader.known(node.at + usize::from(matches!(node.value, Value::Text(_))), &formula);
        Some(formula)
    }

    /// Returns another indicator that a form reads, if the word names one.
    fn other(&mut self, at: usize, name: &str, travels: bool) -> Term {
        let reader = self.reader;
        let owner = name.split_once('.').map(|it| it.0);
        if owner.is_none_or(|it| it == "robot" || it == "laptop") {
            return Term::Inducer;
        }
        let all = &reader.mission.indicators;
        let Some(number) = indicator_of(at, name, &reader.mission, reader.faults) else {
            return Term::Wrong;
        };
        let side = usize::from(!travels);
        let state = self.states.get(number).and_then(|it| it.get(side));
        if let Some(State::Begun) = state {
            let from = self.stack.iter().position(|it| *it == number).unwrap_or(0);
            let names = self.stack.iter().skip(from).chain([&number]);
            let names: Vec<_> =
                names.filter_map(|&it| all.get(it)).map(|it| it.id.as_str()).collect();
            reader.faults.say(at, format!("circular: {}", names.join(" reads ")));
            return Term::Wrong;
        }
        let unit = all.get(number).map_or("", |it| &it.unit).to_owned();
        if self.written.get(number).and_then(|it| *it.get(side)?).is_none() {
            let key = if travels { "travel" } else { "stand" };
            reader.faults.say(at, format!("`{name}` has no `{key}`, and is read here"));
            return Term::Wrong;
        }
        match self.of(number, travels) {
            Some(formula) => Term::Indicator { unit, formula },
            None => Term::Wrong,
        }
    }
}
