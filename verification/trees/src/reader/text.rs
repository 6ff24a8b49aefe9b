//! Texts of attributes: entries, constants, scripts.

use crate::diagnostic::{Findings, Place, Severity};
use crate::script::{Script, Value, parse};
use crate::signature::PortType;
use crate::tree::{EntryType, Port};
use crate::xml::Attribute;

/// Returns the entry that a text names: `{key}` with blanks around.
pub(super) fn pointer(text: &str) -> Option<&str> {
    let inner = text.trim_matches(' ').strip_prefix('{')?.strip_suffix('}')?;
    (!inner.is_empty()).then_some(inner)
}

/// Reads the script of an attribute.
pub(super) fn script(attribute: &Attribute, findings: &mut Findings) -> Option<Script> {
    script_of(&attribute.name, &attribute.value, attribute.value_at, findings)
}

/// Reads a script that stands at this place.
pub(super) fn script_of(
    name: &str,
    text: &str,
    place: Place,
    findings: &mut Findings,
) -> Option<Script> {
    parse(text)
        .map_err(|error| {
            let before = text.get(..error.at).unwrap_or(text).chars().count();
            let message =
                format!("{name}: {}, at column {} of the script", error.message, before + 1);
            let column = place.column + before as u32;
            let help = Some(format!("the script is `{text}`"));
            findings.add(Severity::Error, Place { column, ..place }, message, help);
        })
        .ok()
}

/// Returns the value of a port.
pub(super) fn port(name: &str, text: &str) -> Port {
    match pointer(text) {
        _ if text == "{=}" || text == "=" => Port::Entry(name.to_owned()),
        Some(key) => Port::Entry(key.to_owned()),
        None => Port::Constant(text.to_owned()),
    }
}

pub(super) fn entry_type(kind: PortType) -> Option<EntryType> {
    Some(match kind {
        PortType::Integer | PortType::Unsigned => EntryType::Integer,
        PortType::Real => EntryType::Real,
        PortType::Text => EntryType::Text,
        PortType::Truth => EntryType::Truth,
        PortType::Status | PortType::Any => return None,
    })
}

pub(super) fn named(kind: EntryType) -> &'static str {
    match kind {
        EntryType::Integer => "an integer",
        EntryType::Real => "a number",
        EntryType::Text => "a text",
        EntryType::Truth => "a truth value",
    }
}

/// Returns what a subtree is given: an integer if it looks like one, else a number, else a text.
pub(super) fn constant(text: &str) -> Value {
    let digits = text.strip_prefix('-').unwrap_or(text);
    let is_integer = !digits.is_empty() && digits.bytes().all(|it| it.is_ascii_digit());
    if let (true, Ok(it)) = (is_integer, text.parse()) {
        return Value::Integer(it);
    }
    match text.trim_end().parse() {
        Ok(it) if !text.starts_with(char::is_whitespace) => Value::Real(it),
        _ => Value::text(text),
    }
}
