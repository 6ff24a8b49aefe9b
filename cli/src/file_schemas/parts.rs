//! The parts of which the schemas of files are made: values with their meaning, tables, conditions.
//! Draft 07 of JSON Schema, which editors of TOML know.

use cotama_models::missions::known::{DOCUMENTATION, ID_LENGTHS, MAX_ENTRIES};
use serde_json::{Map, Value, json};
use std::ops::RangeInclusive;

/// A whole number within a range.
pub(super) fn integer(range: &RangeInclusive<i64>, meaning: &str) -> Value {
    let (least, most) = (range.start(), range.end());
    json!({ "type": "integer", "minimum": least, "maximum": most, "description": meaning })
}

/// A text.
pub(super) fn text(meaning: &str) -> Value {
    json!({ "type": "string", "description": meaning })
}

/// A text of which the reader knows one form.
pub(super) fn word(word: &str, meaning: &str) -> Value {
    json!({ "type": "string", "const": word, "description": meaning })
}

/// One of some words.
pub(super) fn choice(words: &[&str], meaning: &str) -> Value {
    json!({ "type": "string", "enum": words, "description": meaning })
}

/// Some words out of a set, at least one.
pub(super) fn choices(words: &[&str], meaning: &str) -> Value {
    let items = json!({ "type": "string", "enum": words });
    json!({ "type": "array", "items": items, "minItems": 1, "description": meaning })
}

/// A list of names.
pub(super) fn names(meaning: &str) -> Value {
    json!({ "type": "array", "items": { "type": "string" }, "description": meaning })
}

fn id_pattern() -> String {
    format!("^[A-Za-z0-9_.-]{{{},{}}}$", ID_LENGTHS.start(), ID_LENGTHS.end())
}

/// The name of an entry.
pub(super) fn id(meaning: &str) -> Value {
    json!({ "type": "string", "pattern": id_pattern(), "description": meaning })
}

/// A truth value.
pub(super) fn flag(meaning: &str) -> Value {
    json!({ "type": "boolean", "description": meaning })
}

/// A table whose keys are the names of something, with one kind of value.
pub(super) fn named(value: &Value, meaning: &str) -> Value {
    json!({
        "type": "object", "description": meaning, "additionalProperties": value,
        "propertyNames": { "pattern": id_pattern() }, "maxProperties": MAX_ENTRIES,
    })
}

/// A list of tables.
pub(super) fn tables(table: &Value, least: usize, meaning: &str) -> Value {
    json!({
        "type": "array", "items": table, "minItems": least, "maxItems": MAX_ENTRIES,
        "description": meaning,
    })
}

/// A table with keys that are known: those that must be there, and those that can.
pub(super) fn table(needs: &[(&str, Value)], can: &[(&str, Value)], meaning: &str) -> Value {
    let source = |key: &str| (key.to_owned(), text("where a number comes from; it is not read"));
    let keys = needs.iter().chain(can).map(|(key, value)| ((*key).to_owned(), value.clone()));
    let properties: Map<_, _> = keys.chain(DOCUMENTATION.map(source)).collect();
    let required: Vec<_> = needs.iter().map(|it| it.0).collect();
    json!({
        "type": "object", "description": meaning, "properties": properties, "required": required,
        "additionalProperties": false,
    })
}

/// The same with a value for another keyword of the schema.
pub(super) fn with(mut schema: Value, keyword: &str, value: Value) -> Value {
    schema[keyword] = value;
    schema
}

/// Returns the condition that a key has one of these words.
pub(super) fn says(key: &str, words: &[&str]) -> Value {
    json!({ "properties": { key: { "enum": words } }, "required": [key] })
}

/// Returns the condition that some keys are absent.
pub(super) fn absent(keys: &[&str]) -> Value {
    let keys: Map<_, _> = keys.iter().map(|key| ((*key).to_owned(), false.into())).collect();
    json!({ "properties": keys })
}

/// Returns the conjunction of two conditions.
pub(super) fn both(one: &Value, other: &Value) -> Value {
    json!({ "allOf": [one, other] })
}

/// Returns the condition that these keys and no others of the list are there.
pub(super) fn only(needs: &[&str], all: &[&str]) -> Value {
    let others: Vec<_> = all.iter().copied().filter(|key| !needs.contains(key)).collect();
    both(&json!({ "required": needs }), &absent(&others))
}

/// Returns the implication of two conditions.
pub(super) fn when(condition: &Value, then: &Value) -> Value {
    json!({ "if": condition, "then": then })
}
