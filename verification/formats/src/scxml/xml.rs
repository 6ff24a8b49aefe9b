//! A state machine as XML text.

use super::machine::{Machine, Move, Timing};
use crate::identifier::identifiers;
use cotama_core::net::{Ignored, Place, PlaceId, Role, Transition, Within};
use cotama_core::text::marked;
use cotama_play::condition;
use std::cmp::Reverse;
use std::fmt::Write as _;

/// Words that are no variable in ECMAScript, strict or not.
const RESERVED: [&str; 51] = [
    "arguments",
    "await",
    "break",
    "case",
    "catch",
    "class",
    "const",
    "continue",
    "debugger",
    "default",
    "delete",
    "do",
    "else",
    "enum",
    "eval",
    "export",
    "extends",
    "false",
    "finally",
    "for",
    "function",
    "if",
    "implements",
    "import",
    "In",
    "Infinity",
    "NaN",
    "in",
    "instanceof",
    "interface",
    "let",
    "new",
    "null",
    "package",
    "private",
    "protected",
    "public",
    "return",
    "static",
    "super",
    "switch",
    "this",
    "throw",
    "true",
    "try",
    "typeof",
    "undefined",
    "var",
    "void",
    "while",
    "with",
];

/// Events that would also match those of the platform, as `error.communication`.
const PLATFORM: [&str; 2] = ["done", "error"];

pub(super) fn document(machine: &Machine<'_>) -> String {
    let net = machine.net;
    let signals = net.events.iter().map(|it| it.name);
    let own = |(it, of): (&Transition<'_>, &Move)| match of.timing {
        Timing::Named => it.name.to_owned(),
        _ => format!("timeout_{}", it.name),
    };
    let own: Vec<String> = net.transitions.iter().zip(&machine.moves).map(own).collect();
    let mut writer = Writer {
        machine,
        text: String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"),
        places: identifiers(net.places.iter().map(|it| it.name), "-", &[]),
        variables: identifiers(net.places.iter().map(|it| it.name), "", &RESERVED),
        events: identifiers(signals.chain(own.iter().map(String::as_str)), "-", &PLATFORM),
        outputs: identifiers(net.outputs.iter().map(|it| it.name), "-", &[]),
    };
    writer.root();
    writer.text
}

struct Writer<'m, 'n> {
    machine: &'m Machine<'n>,
    text: String,
    places: Vec<String>,
    variables: Vec<String>,
    /// The events of the net, then one for each transition: its timeout, or its name.
    events: Vec<String>,
    outputs: Vec<String>,
}

impl Writer<'_, '_> {
    fn root(&mut self) {
        let net = self.machine.net;
        self.comment(0, net.doc);
        let moves = self.machine.moves.iter().zip(net.transitions);
        let unkept = moves
            .filter(|(it, _)| it.timing == Timing::Unkept)
            .map(|(_, transition)| transition.name);
        let unkept: Vec<&str> = unkept.collect();
        if !unkept.is_empty() {
            self.comment(
                0,
                &format!("Intervals that no timer of this chart keeps: {}.", unkept.join(", ")),
            );
        }
        let name = identifiers([net.name].into_iter(), "-", &[]).concat();
        self.text +=
            "<scxml xmlns=\"http://www.w3.org/2005/07/scxml\" xmlns:cotama=\"urn:cotama:net:1\"";
        self.text += " version=\"1.0\" datamodel=\"ecmascript\"";
        self.attribute("name", &name);
        self.attribute("initial", &self.places[self.machine.initial.0 as usize].clone());
        self.original(net.name, &name);
        self.text += ">\n";
        self.datamodel();
        // The transitions of each state in document order.
        let mut order: Vec<usize> = (0..net.transitions.len()).collect();
        order.sort_by_key(|&id| {
            (self.machine.moves[id].from, Reverse(net.transitions[id].priority), id)
        });
        for (id, place) in (0..).map(PlaceId).zip(net.places) {
            if place.role == Role::State {
                let begin = order.partition_point(|&it| self.machine.moves[it].from < id);
                let end = order.partition_point(|&it| self.machine.moves[it].from <= id);
                self.state(id, place, &order[begin..end]);
            }
        }
        self.text += "</scxml>\n";
    }

    fn datamodel(&mut self) {
        if self.machine.variables.is_empty() {
            return;
        }
        self.text += "  <datamodel>\n";
        for (&id, &boolean) in &self.machine.variables {
            let place = &self.machine.net.places[id.0 as usize];
            self.place_comments(4, id, place);
            self.text += "    <data";
            let name = self.variables[id.0 as usize].clone();
            self.attribute("id", &name);
            let start =
                if boolean { (place.initial == 1).to_string() } else { place.initial.to_string() };
            self.attribute("expr", &start);
            self.original(place.name, &name);
            self.text += "/>\n";
        }
        self.text += "  </datamodel>\n";
    }

    fn state(&mut self, id: PlaceId, place: &Place<'_>, transitions: &[usize]) {
        self.place_comments(2, id, place);
        self.text += "  <state";
        let name = self.places[id.0 as usize].clone();
        self.attribute("id", &name);
        self.original(place.name, &name);
        if transitions.is_empty() {
            self.text += "/>\n";
            return;
        }
        self.text += ">\n";
        let timers: Vec<(usize, u32)> = transitions
            .iter()
            .filter_map(|&it| match self.machine.moves[it].timing {
                Timing::Timer(delay) => Some((it, delay)),
                Timing::Untimed | Timing::Unkept | Timing::Named => None,
            })
            .collect();
        if !timers.is_empty() {
            self.text += "    <onentry>\n";
            for &(transition, delay) in &timers {
                self.start_timer(transition, delay);
            }
            self.text += "    </onentry>\n    <onexit>\n";
            for &(transition, _) in &timers {
                self.text += "      <cancel";
                self.attribute("sendid", &self.own_event(transition));
                self.text += "/>\n";
            }
            self.text += "    </onexit>\n";
        }
        for &transition in transitions {
            self.transition(transition);
        }
        self.text += "  </state>\n";
    }

    fn transition(&mut self, id: usize) {
        let (net, it) = (self.machine.net, &self.machine.moves[id]);
        let transition = &net.transitions[id];
        self.comment(4, transition.doc);
        self.text += "    <transition";
        if let Some(event) = transition.on {
            self.attribute("event", &self.events[event.0 as usize].clone());
        } else if it.timing != Timing::Untimed {
            self.attribute("event", &self.own_event(id));
        }
        let cond: Vec<String> =
            self.machine.needs(transition).map(|arc| self.holds(arc.place, arc.weight)).collect();
        if !cond.is_empty() {
            self.attribute("cond", &cond.join(" && "));
        }
        if let Some(to) = it.to {
            self.attribute("target", &self.places[to.0 as usize].clone());
        }
        self.attribute("cotama:name", transition.name);
        if let Some(within) = transition.within {
            self.attribute("cotama:within", &interval(within));
        }
        let begin = self.text.len();
        self.content(id, it, transition);
        if self.text.len() == begin {
            self.text += "/>\n";
        } else {
            self.text.insert_str(begin, ">\n");
            self.text += "    </transition>\n";
        }
    }

    fn content(&mut self, id: usize, it: &Move, transition: &Transition<'_>) {
        for (place, &change) in &it.effect {
            let variable = self.variables[place.0 as usize].clone();
            let expr = match (self.machine.variables.get(place), change > 0) {
                (Some(true), up) => up.to_string(),
                (_, true) => format!("{variable} + {change}"),
                (_, false) => format!("{variable} - {}", change.unsigned_abs()),
            };
            self.text += "      <assign";
            self.attribute("location", &variable);
            self.attribute("expr", &expr);
            self.text += "/>\n";
        }
        for output in transition.emits {
            self.text += "      <send";
            self.attribute("event", &self.outputs[output.0 as usize].clone());
            self.attribute("target", "#_parent");
            self.text += "/>\n";
        }
        // A transition that fires starts its own clock again; one that leaves does so by entering
        // the state.
        if let (Timing::Timer(delay), None) = (it.timing, it.to) {
            self.start_timer(id, delay);
        }
    }

    fn start_timer(&mut self, transition: usize, delay: u32) {
        let timeout = self.own_event(transition);
        self.text += "      <send";
        self.attribute("event", &timeout);
        self.attribute("id", &timeout);
        self.attribute("delay", &format!("{delay}ms"));
        self.text += "/>\n";
    }

    fn own_event(&self, transition: usize) -> String {
        self.events[self.machine.net.events.len() + transition].clone()
    }

    /// Returns the condition that a place that is no state holds at least `weight` tokens.
    fn holds(&self, place: PlaceId, weight: u32) -> String {
        let it = &self.machine.net.places[place.0 as usize];
        let (of, complement) = match it.role {
            Role::Complement(of) => (of, true),
            _ => (place, false),
        };
        let variable = &self.variables[of.0 as usize];
        match (self.machine.variables.get(&of), complement) {
            (Some(true), _) if weight > 1 => "false".to_owned(),
            (Some(true), true) => format!("!{variable}"),
            (Some(true), false) => variable.clone(),
            (_, false) => format!("{variable} >= {weight}"),
            (_, true) => match it.bound.checked_sub(weight) {
                Some(rest) => format!("{variable} <= {rest}"),
                None => "false".to_owned(),
            },
        }
    }

    fn place_comments(&mut self, indent: usize, id: PlaceId, place: &Place<'_>) {
        self.comment(indent, place.doc);
        let net = self.machine.net;
        let ignored = net.ignored.iter().filter(|it| it.place == id);
        let told = |it: &Ignored<'_>| {
            let event = net.events[it.event.0 as usize].name;
            let guard: Vec<_> = it.guard.iter().map(|arc| condition(net, *arc)).collect();
            if guard.is_empty() {
                event.to_owned()
            } else {
                format!("{event} [{}]", guard.join(" & "))
            }
        };
        let ignored: Vec<String> = ignored.map(told).collect();
        if !ignored.is_empty() {
            self.comment(indent, &format!("Left unanswered on purpose: {}.", ignored.join(", ")));
        }
    }

    /// A comment, unless there is nothing to say. Two hyphens would end it, so a blank goes between
    /// them.
    fn comment(&mut self, indent: usize, text: &str) {
        if text.trim().is_empty() {
            return;
        }
        let _ = write!(self.text, "{:indent$}<!-- ", ""); // a String takes everything
        let mut before = ' ';
        for (c, hidden) in marked(text.trim()) {
            if before == '-' && c == '-' {
                self.text.push(' ');
            }
            if hidden && !matches!(c, '\n' | '\t') {
                self.text.extend(c.escape_unicode());
            } else {
                self.text.push(c);
            }
            before = c;
        }
        self.text += " -->\n";
    }

    /// `cotama:name`, where the name had to be changed.
    fn original(&mut self, name: &str, written: &str) {
        if name != written {
            self.attribute("cotama:name", name);
        }
    }

    fn attribute(&mut self, name: &str, value: &str) {
        let _ = write!(self.text, " {name}=\"");
        for (c, hidden) in marked(value) {
            match c {
                '&' => self.text += "&amp;",
                '<' => self.text += "&lt;",
                '>' => self.text += "&gt;",
                '"' => self.text += "&quot;",
                // Left as they are, a reader would make blanks of them.
                '\t' | '\n' | '\r' => {
                    let _ = write!(self.text, "&#{};", c as u32);
                }
                c if !is_xml(c) => self.text.push(char::REPLACEMENT_CHARACTER),
                c if hidden => {
                    let _ = write!(self.text, "&#x{:x};", c as u32);
                }
                c => self.text.push(c),
            }
        }
        self.text.push('"');
    }
}

/// `earliest..latest` in milliseconds.
fn interval(within: Within) -> String {
    match within.latest {
        Some(latest) => format!("{}..{latest}", within.earliest),
        None => format!("{}..", within.earliest),
    }
}

/// Whether an XML 1.0 document can contain a character (its section 2.2).
const fn is_xml(c: char) -> bool {
    matches!(c, '\t' | '\n' | '\r' | '\u{20}'..='\u{FFFD}' | '\u{10000}'..)
}
