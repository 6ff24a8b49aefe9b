//! A system as Rust source: `net!` and `system!`, so that the compiler reads it again.

use super::OwnedSystem;
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{Arc, PlaceId, Role};
use cotama_core::system::{Delivery, Of, Target};
use cotama_core::text::visible;
use std::collections::BTreeSet;
use std::fmt;

/// The system as Rust source that needs `cotama-core` alone: a module for each net, and one of
/// the name of the system. Names are those of the file: who includes it allows
/// `nonstandard_style`.
///
/// ```
/// use cotama_models::robots::{Robot, supervisors};
/// let system = supervisors::system(&Robot::shipped("transport").unwrap());
/// let source = supervisors::to_rust(&system);
/// assert!(source.contains("restarts_LID1: 1 of 1,"));
/// let line = "LID1_restarts on flag_LID1 [restarts_LID1 >= 1]: Ready => Ready";
/// assert!(source.contains(line), "{source}");
/// ```
pub fn to_rust(system: &OwnedSystem) -> String {
    Source(system).to_string()
}

struct Source<'s>(&'s OwnedSystem);

impl fmt::Display for Source<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(system) = self;
        for (name, net) in &system.nets {
            self::net(f, name, net)?;
        }
        let module = module(&system.name);
        let doc = comment(&system.doc, "    ");
        writeln!(f, "cotama_core::system! {{\n{doc}    pub mod {module} {{")?;
        f.write_str("        nets {\n")?;
        for (name, _) in &system.nets {
            writeln!(f, "            {name}: {},", self::module(name))?;
        }
        f.write_str("        }\n        links {\n")?;
        for it in &system.links {
            let from = self.port(it.from.component, it.from.id.0, |it| &it.outputs);
            let to = self.port(it.to.component, it.to.id.0, |it| &it.events);
            let how = match it.delivery {
                Delivery::Now => "now".to_owned(),
                Delivery::Mail { capacity } => format!("mail {capacity}"),
            };
            writeln!(f, "            {from} => {to} {how};")?;
        }
        f.write_str("        }\n        shared {\n")?;
        for it in &system.bindings {
            if let Target::Place(owner) = it.target {
                let (shared, owner) = (self.place(it.shared), self.place(owner));
                writeln!(f, "            {shared} = {owner};")?;
            }
        }
        f.write_str("        }\n        pending {\n")?;
        for it in &system.bindings {
            if let Target::Mailbox(event) = it.target {
                let event = self.port(event.component, event.id.0, |it| &it.events);
                writeln!(f, "            {} = {event};", self.place(it.shared))?;
            }
        }
        f.write_str("        }\n        clears {\n")?;
        for it in &system.clears {
            let on = self.port(it.on.component, it.on.id.0, |it| &it.events);
            let mailbox = self.port(it.on.component, it.mailbox.0, |it| &it.events);
            writeln!(f, "            {on} empties {mailbox};")?;
        }
        f.write_str("        }\n        laws { left_to_checker; }\n    }\n}\n")
    }
}

/// The name of a net's module: no net of its own is named so.
fn module(name: &str) -> String {
    format!("net_{name}").to_lowercase()
}

impl Source<'_> {
    fn port(
        &self,
        component: u16,
        id: u32,
        list: impl Fn(&OwnedNet) -> &[cotama_core::net::owned::OwnedSignal],
    ) -> String {
        let net = self.0.nets.get(usize::from(component));
        let name = net.and_then(|it| list(&it.1).get(id as usize)).map_or("", |it| &it.name);
        format!("{}.{name}", net.map_or("", |it| &it.0))
    }

    fn place(&self, of: Of<PlaceId>) -> String {
        let net = self.0.nets.get(usize::from(of.component));
        let name = net.and_then(|it| it.1.places.get(of.id.0 as usize)).map_or("", |it| &it.name);
        format!("{}.{name}", net.map_or("", |it| &it.0))
    }
}

fn net(f: &mut fmt::Formatter<'_>, name: &str, net: &OwnedNet) -> fmt::Result {
    let module = module(name);
    let doc = comment(&net.doc, "    ");
    writeln!(f, "cotama_core::net! {{\n{doc}    pub mod {module} {{")?;
    let of = |role: fn(Role) -> bool| net.places.iter().filter(move |it| role(it.role));
    let documented = |it: &OwnedPlace| comment(&it.doc, "            ");
    f.write_str("        places {\n")?;
    for it in of(|it| matches!(it, Role::State)) {
        let marked = if it.initial > 0 { format!(": {}", it.initial) } else { String::new() };
        writeln!(f, "{}            {}{marked},", documented(it), it.name)?;
    }
    f.write_str("        }\n")?;
    let data = || of(|it| matches!(it, Role::Data));
    section(f, "flags", data().filter(|it| !is_counter(it)), |it| {
        format!("{}            {}: {},\n", documented(it), it.name, it.initial > 0)
    })?;
    section(f, "counters", data().filter(|it| is_counter(it)), |it| {
        let OwnedPlace { name, initial, bound, .. } = it;
        format!("{}            {name}: {initial} of {bound},\n", documented(it))
    })?;
    section(f, "shared", of(|it| matches!(it, Role::Shared)), |it| {
        format!("            {},\n", it.name)
    })?;
    for (title, all) in [("events", &net.events), ("outputs", &net.outputs)] {
        section(f, title, all.iter(), |it| {
            format!("{}            {},\n", comment(&it.doc, "            "), it.name)
        })?;
    }
    f.write_str("        transitions {\n")?;
    let mut names = BTreeSet::new();
    for it in &net.transitions {
        line(f, net, it, &mut names)?;
    }
    f.write_str("        }\n        laws { left_to_checker; }\n    }\n}\n\n")
}

/// A section, which is left out where it is empty.
fn section<'n, T: 'n>(
    f: &mut fmt::Formatter<'_>,
    title: &str,
    all: impl Iterator<Item = &'n T>,
    of: impl Fn(&T) -> String,
) -> fmt::Result {
    let all: String = all.map(of).collect();
    if all.is_empty() { Ok(()) } else { write!(f, "        {title} {{\n{all}        }}\n") }
}

/// Whether a place of data counts: stores of restarts do, also those of one.
fn is_counter(it: &OwnedPlace) -> bool {
    it.initial > 0
}

/// A place and the number of tokens that a transition looks for or moves.
fn place(net: &OwnedNet, arc: Arc) -> Option<(&OwnedPlace, u32)> {
    net.places.get(arc.place.0 as usize).map(|it| (it, arc.weight))
}

/// The condition that a place has so many tokens.
fn test(net: &OwnedNet, (it, weight): (&OwnedPlace, u32)) -> String {
    match it.role {
        Role::Complement(of) => match net.places.get(of.0 as usize) {
            Some(of) if is_counter(of) => format!("{} <= {}", of.name, of.bound - weight),
            Some(of) => format!("!{}", of.name),
            None => String::new(),
        },
        _ if is_counter(it) => format!("{} >= {weight}", it.name),
        _ => it.name.clone(),
    }
}

fn line(
    f: &mut fmt::Formatter<'_>,
    net: &OwnedNet,
    it: &OwnedTransition,
    names: &mut BTreeSet<String>,
) -> fmt::Result {
    let is_state = |it: &(&OwnedPlace, u32)| matches!(it.0.role, Role::State);
    let of = |arcs: &[Arc]| -> Vec<(OwnedPlace, u32)> {
        arcs.iter().filter_map(|arc| place(net, *arc)).map(|it| (it.0.clone(), it.1)).collect()
    };
    let (take, give, read) = (of(&it.take), of(&it.give), of(&it.read));
    let state = |arcs: &[(OwnedPlace, u32)]| {
        let all = arcs.iter().filter(|it| is_state(&(&it.0, it.1)));
        all.map(|it| it.0.name.clone()).collect::<Vec<_>>().join(" & ")
    };
    let moved = |arcs: &'_ [(OwnedPlace, u32)]| -> Vec<(OwnedPlace, u32)> {
        arcs.iter().filter(|it| !is_state(&(&it.0, it.1))).cloned().collect()
    };
    let mut tests: Vec<_> = read.iter().map(|it| test(net, (&it.0, it.1))).collect();
    tests.extend(moved(&take).iter().map(|it| test(net, (&it.0, it.1))));
    let changes = moved(&give).into_iter().map(|(it, weight)| match it.role {
        // What is spent is no longer there.
        Role::Complement(of) => {
            let of = net.places.get(of.0 as usize).map_or("", |it| &it.name);
            format!("{of} -= {weight}")
        }
        _ => format!("{} = true", it.name),
    });
    let changes: Vec<_> = changes.collect();
    let event = it.on.and_then(|on| net.events.get(on.0 as usize)).map_or("", |it| &it.name);
    let emits = it.emits.iter().filter_map(|it| net.outputs.get(it.0 as usize));
    let emits: Vec<_> = emits.map(|it| it.name.as_str()).collect();

    let name = new_name(&super::word(&it.name), names);
    let tests = if tests.is_empty() { String::new() } else { format!(" [{}]", tests.join(" & ")) };
    let mut parts = vec![format!("{name} on {event}{tests}:")];
    parts.push(format!("{} => {}", state(&take), state(&give)));
    if !changes.is_empty() {
        parts.push(format!("do {}", changes.join(" & ")));
    }
    if !emits.is_empty() {
        parts.push(format!("emit {}", emits.join(" & ")));
    }
    let parts = parts.iter().map(String::as_str);
    writeln!(f, "{};", wrapped(parts, "            ", "                "))
}

/// Words with blanks between them, in lines of 100 columns with this before the first one and this
/// before the others.
fn wrapped<'t>(words: impl Iterator<Item = &'t str>, first: &str, others: &str) -> String {
    const COLUMNS: usize = 99; // a semicolon may follow
    let mut text = first.to_owned();
    let mut column = first.chars().count();
    for (number, word) in words.enumerate() {
        let length = word.chars().count();
        if number > 0 && column + 1 + length > COLUMNS {
            text += "\n";
            text += others;
            column = others.chars().count();
        } else if number > 0 {
            text += " ";
            column += 1;
        }
        text += word;
        column += length;
    }
    text
}

/// A text as comments of what follows; nothing for an empty one.
fn comment(text: &str, indent: &str) -> String {
    let begin = format!("{indent}/// ");
    let text = visible(text).to_string();
    if text.is_empty() {
        return String::new();
    }
    wrapped(text.split_whitespace(), &begin, &begin) + "\n"
}

/// A name that no line before has.
fn new_name(name: &str, names: &mut BTreeSet<String>) -> String {
    let others = (2..).map(|number| format!("{name}_{number}"));
    let new = std::iter::once(name.to_owned()).chain(others).find(|it| !names.contains(it));
    let new = new.unwrap_or_default();
    names.insert(new.clone());
    new
}
