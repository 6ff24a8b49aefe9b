//! Records of JSON lines, whatever program wrote the line: the order of keys, spaces, and whole
//! numbers written as floats (`2000.0`, `2e3`) change no record.
//!
//! Traces, results of campaigns and their digests compare records in the one form that this
//! program writes.

use cotama_formats::json::{Wrong, read_object};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

/// A record that was read.
#[derive(Clone, Debug, PartialEq)]
pub struct Read<T> {
    /// The record.
    pub record: T,
    /// The line as this program writes it.
    pub line: String,
    /// The first thing of the line that is not in the record.
    pub foreign: Option<Differing>,
}

/// Something in which two records differ.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Differing {
    /// The path of the field, as `margins.energy_mj` or `plan[3].choice`.
    pub field: String,
    /// The value in the first one, as JSON; `None` if it has no such field.
    pub first: Option<String>,
    /// The value in the second one.
    pub second: Option<String>,
}

/// Reads a record from a line of JSON.
///
/// ```
/// use cotama_sim::canonical::read;
/// use cotama_sim::trace::Used;
/// let line = r#"{ "energy_mj": 7, "duration_ms": 2000.0 }"#;
/// let read = read::<Used>(line).unwrap();
/// assert_eq!(read.line, r#"{"duration_ms":2000,"energy_mj":7}"#);
/// assert_eq!(read.foreign, None);
/// ```
///
/// # Errors
/// The errors of the reader of JSON, for a line that is no such record.
pub fn read<T: DeserializeOwned + Serialize>(line: &str) -> Result<Read<T>, Wrong> {
    let written = line.trim();
    let direct = match read_object::<T>(line) {
        Ok(record) => {
            let line = line_of(&record);
            if line == written {
                return Ok(Read { record, line, foreign: None });
            }
            Ok(record)
        }
        Err(error) => Err(error),
    };
    let mut value: Value = read_object(line)?;
    let floats = make_whole(&mut value);
    let record = match direct {
        Ok(record) => record,
        Err(error) if floats => read_object(&value.to_string()).map_err(|_| error)?,
        Err(error) => return Err(error),
    };
    let line = line_of(&record);
    Ok(Read { foreign: differing(&value, &value_of(&line)), line, record })
}

/// The line of a record. Writing these types to memory cannot fail.
fn line_of<T: Serialize>(record: &T) -> String {
    serde_json::to_string(record).unwrap_or_default()
}

/// The value of a line. Records have no fractions, so that a line says all of one; to make the
/// value of the record itself would compile a second writer for each type.
fn value_of(line: &str) -> Value {
    serde_json::from_str(line).unwrap_or_default()
}

/// The first thing in which two records differ, in the order of the fields of the second.
pub fn difference<T: Serialize>(first: &T, second: &T) -> Option<Differing> {
    differing(&value(first), &value(second))
}

/// The fields of a record, as JSON.
pub(crate) fn value<T: Serialize>(record: &T) -> Value {
    value_of(&line_of(record))
}

/// Whole floats become integers; whether there were any.
fn make_whole(value: &mut Value) -> bool {
    /// Up to here a float says one whole number.
    const EXACT: f64 = 9_007_199_254_740_992.0;
    match value {
        Value::Number(it) => {
            let float = it.as_f64().filter(|it| it.abs() <= EXACT && it.fract().abs() <= 0.0);
            match float.filter(|_| it.is_f64()) {
                Some(whole) => {
                    #[allow(clippy::cast_possible_truncation)] // it is whole, and small enough
                    let whole = whole as i64;
                    *value = whole.into();
                    true
                }
                None => false,
            }
        }
        Value::Array(items) => items.iter_mut().fold(false, |any, it| make_whole(it) | any),
        Value::Object(fields) => fields.values_mut().fold(false, |any, it| make_whole(it) | any),
        Value::Null | Value::Bool(_) | Value::String(_) => false,
    }
}

fn differing(first: &Value, second: &Value) -> Option<Differing> {
    let text = |it: Option<&Value>| it.map(ToString::to_string);
    let at = |field: String, first: Option<&Value>, second: Option<&Value>| {
        let below = match (first, second) {
            (Some(first), Some(second)) => differing(first, second),
            // A field that says nothing is as one that is not there.
            (None | Some(Value::Null), None | Some(Value::Null)) => None,
            _ => Some(Differing { field: String::new(), first: text(first), second: text(second) }),
        }?;
        let dot = if below.field.is_empty() || below.field.starts_with('[') { "" } else { "." };
        Some(Differing { field: format!("{field}{dot}{}", below.field), ..below })
    };
    match (first, second) {
        (Value::Object(one), Value::Object(other)) => {
            let own = other.iter().find_map(|(key, it)| at(key.clone(), one.get(key), Some(it)));
            let missing = one.keys().filter(|it| !other.contains_key(*it));
            own.or_else(|| missing.into_iter().find_map(|it| at(it.clone(), one.get(it), None)))
        }
        (Value::Array(one), Value::Array(other)) => {
            let most = one.len().max(other.len());
            (0..most).find_map(|it| at(format!("[{it}]"), one.get(it), other.get(it)))
        }
        (one, other) if one == other => None,
        (one, other) => Some(Differing {
            field: String::new(),
            first: text(Some(one)),
            second: text(Some(other)),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::Record;

    const LINE: &str = r#"{"record":"event","t_us":5,"x_mm":7,"event":{"kind":"obstacle","delay_ms":900},"lost_us":900000}"#;

    #[test]
    fn how_a_line_is_written_changes_no_record() {
        let own = read::<Record>(LINE).unwrap();
        assert_eq!((own.line.as_str(), &own.foreign), (LINE, &None));
        for other in [
            LINE.replace(':', ": ").replace(',', ", "),
            LINE.replace("900000}", "900000.0}"),
            LINE.replace("900000}", "9e5}"),
            LINE.replace("\"t_us\":5,\"x_mm\":7", "\"x_mm\":7.0,\"t_us\":5"),
            LINE.replace(
                "{\"kind\":\"obstacle\",\"delay_ms\":900}",
                "{\"delay_ms\":9.0E2,\"kind\":\"obst\\u0061cle\"}",
            ),
            format!("  {LINE}\r"),
            LINE.replace("\"x_mm\"", "\"random\":null,\"x_mm\""),
        ] {
            assert_eq!(read::<Record>(&other).unwrap(), own, "{other}");
        }
    }

    #[test]
    fn a_field_that_a_record_lacks_is_named() {
        for (other, field, first) in [
            (LINE.replace("\"x_mm\":7", "\"x_mm\":7,\"y_mm\":1"), "y_mm", "1"),
            (LINE.replace(":900}", ":900,\"why\":[1]}"), "event.why", "[1]"),
        ] {
            let found = read::<Record>(&other).unwrap().foreign.unwrap();
            assert_eq!((found.field.as_str(), found.first.as_deref()), (field, Some(first)));
            assert_eq!(found.second, None);
        }
        for bad in [
            LINE.replace("900000}", "900000.5}"),
            LINE.replace("900000}", "\"900000\"}"),
            LINE.replace("\"t_us\":5,", "\"t_us\":5,\"t_us\":6,"),
            LINE.replace("\"t_us\":5,", ""),
            LINE.replace("900000}", "1e300}"),
        ] {
            assert!(read::<Record>(&bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn the_first_difference_of_two_records_is_named_with_both_values() {
        let one = read::<Record>(LINE).unwrap().record;
        for (from, to, field, values) in [
            ("\"t_us\":5", "\"t_us\":6", "t_us", ("5", "6")),
            ("\"x_mm\":7", "\"x_mm\":0", "x_mm", ("7", "0")),
            ("\"delay_ms\":900", "\"delay_ms\":901", "event.delay_ms", ("900", "901")),
            ("900000}", "900001}", "lost_us", ("900000", "900001")),
            ("\"event\":", "\"random\":\"r\",\"event\":", "random", ("", "\"r\"")),
        ] {
            let other = read::<Record>(&LINE.replacen(from, to, 1)).unwrap().record;
            let found = difference(&one, &other).unwrap();
            let first = found.first.unwrap_or_default();
            assert_eq!(found.field, field);
            assert_eq!((first.as_str(), found.second.as_deref()), (values.0, Some(values.1)));
        }
        assert_eq!(difference(&one, &one), None);
    }
}
