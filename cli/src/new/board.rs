//! Parts that a board takes from the crate that it plays: its sources, its module, its events.

use crate::exit::Failure;
use std::fmt::Write;
use std::fs;
use std::path::Path;

/// The lines of the template that name the events of its own net, and its state.
const EVENTS: &str = "const EVENTS: [(u64, Event); 4] =
    [(0, Event::start), (80, Event::heard), (450, Event::heard), (500, Event::start)];";
const STATE: &str = "    println!(\"the supervisor is {:?}\", supervisor.state());";
/// Lines that say the same of any net.
const PLACES: &str = "    for (place, id) in NET.places.iter().zip((0..).map(PlaceId)) {
        if supervisor.tokens(id) > 0 {
            println!(\"{}: {}\", place.name, supervisor.tokens(id));
        }
    }";
const USES: &str = "use cotama_core::units::Millis;";
/// The sources that the crate names, seen from it.
pub(super) fn sources(of: &Path) -> Option<String> {
    let manifest: toml::Table = fs::read_to_string(of.join("Cargo.toml")).ok()?.parse().ok()?;
    let path = manifest.get("dependencies")?.get("cotama-core")?.get("path")?.as_str()?;
    path.strip_suffix("/core").map(str::to_owned)
}

/// Returns what replaces lines of the template, so that the board plays the net of this crate as it
/// is now: each of its events without a payload once, a tenth of a second apart. Nothing where the
/// net is still that of the template, whose text is `unchanged`.
pub(super) fn replaced(
    of: &Path,
    name: &str,
    unchanged: &str,
) -> Result<Vec<(String, String)>, Failure> {
    let file = of.join("src/lib.rs");
    let text = fs::read_to_string(&file).map_err(|error| {
        Failure::of(file.display().to_string(), crate::input::plain(&error))
            .help("a board plays a library: `cotama new net NAME` makes one")
    })?;
    if text == unchanged {
        return Ok(Vec::new());
    }
    let Some((module, events)) = net(&text) else {
        return Err(Failure::of(
            file.display().to_string(),
            "there is no `pub mod` of a net in it",
        )
        .help("write `net! { pub mod NAME { places { .. } transitions { .. } } }` there"));
    };
    let plain: Vec<_> = events.iter().filter(|it| !it.1).collect();
    let mut list = format!("const EVENTS: [(u64, Event); {}] = [", plain.len());
    for (number, event) in plain.iter().enumerate() {
        let _ = write!(list, "\n    ({}, Event::{}),", 100 * number, event.0);
    }
    list += if plain.is_empty() { "];" } else { "\n];" };
    for (event, _) in events.iter().filter(|it| it.1) {
        let _ = write!(list, "\n// `{event}` carries a value: give it one, and add it.");
    }
    let own = name.replace('-', "_");
    let used = format!("use {own}::{own}::{{Event, Firing, Player}};");
    Ok(vec![
        (EVENTS.to_owned(), list),
        (STATE.to_owned(), PLACES.to_owned()),
        (USES.to_owned(), format!("use cotama_core::net::PlaceId;\n{USES}")),
        (used, format!("use {own}::{module}::{{Event, Firing, NET, Player}};")),
    ])
}

/// The module of the first net in a source, and its events with whether they carry a value.
fn net(text: &str) -> Option<(String, Vec<(String, bool)>)> {
    let plain: String = text
        .lines()
        .fold(String::new(), |all, line| all + line.split("//").next().unwrap_or_default() + "\n");
    let (_, rest) = plain.split_once("net!").filter(|it| it.1.contains("pub mod "))?;
    let (_, rest) = rest.split_once("pub mod ")?;
    let module = word(rest);
    let mut events = Vec::new();
    if let Some(list) = section(rest, "events") {
        let mut depth = 0_usize;
        let parts = list.split(|c| {
            match c {
                '(' | '<' | '[' => depth += 1,
                ')' | '>' | ']' => depth = depth.saturating_sub(1),
                _ => {}
            }
            c == ',' && depth == 0
        });
        for part in parts.map(str::trim).filter(|it| !it.is_empty()) {
            let part = part.rsplit_once("]\n").map_or(part, |it| it.1.trim());
            events.push((word(part).to_owned(), part.contains('(')));
        }
    }
    Some((module.to_owned(), events))
}

fn word(text: &str) -> &str {
    let end = text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len());
    &text[..end]
}

/// Returns the text between the braces behind a word.
fn section<'t>(text: &'t str, name: &str) -> Option<&'t str> {
    for (at, _) in text.match_indices(name) {
        let begins = text[..at].ends_with(|c: char| c.is_whitespace() || c == '{' || c == '}');
        let rest = text[at + name.len()..].trim_start();
        if let Some(inside) = rest.strip_prefix('{').filter(|_| begins) {
            return inside.split_once('}').map(|it| it.0);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::net;

    #[test]
    fn a_net_is_found_with_its_events() {
        let said = |text: &str| {
            let (module, events) = net(text)?;
            let events = events.iter().map(|it| it.0.clone() + if it.1 { "(..)" } else { "" });
            Some((module, events.collect::<Vec<_>>().join(" ")))
        };
        for (text, module, events) in [
            (
                "net! { pub mod gate { places { A: 1 } events { open, shut } } }",
                "gate",
                "open shut",
            ),
            (
                "net! {\n pub mod a_b {\n  events {\n   /// Opens, once.\n   open,\n   \
                 go(Pose),\n }}}",
                "a_b",
                "open go(..)",
            ),
            (
                "use x::net;\nnet! { /// Doc\n pub mod m { places { P } transitions { t: P => P; \
                 } } }",
                "m",
                "",
            ),
            ("net! { pub mod m { events {open} outputs { events_on } } }", "m", "open"),
            ("net! { pub mod m { events { at((u8, u8)), b } } }", "m", "at(..) b"),
        ] {
            assert_eq!(said(text), Some((module.to_owned(), events.to_owned())), "{text}");
        }
        assert_eq!(said("pub fn f() {}"), None);
    }
}
