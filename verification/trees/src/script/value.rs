//! Values of entries: integers, reals and texts.

use std::fmt;
use std::rc::Rc;

/// The value of a blackboard entry.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// An integer literal, or an entry that began as one.
    Integer(i64),
    /// A real literal, `true`, `false`, and all that is computed.
    Real(f64),
    /// A text.
    Text(Rc<str>),
}

impl Value {
    /// Returns a text.
    pub fn text(text: &str) -> Value {
        Value::Text(Rc::from(text))
    }

    /// Returns a key that is equal for equal values alone.
    pub(crate) fn key(&self) -> (u8, u64, Rc<str>) {
        match self {
            Value::Integer(it) => (0, *it as u64, Rc::from("")),
            Value::Real(it) => (1, it.to_bits(), Rc::from("")),
            Value::Text(it) => (2, 0, it.clone()),
        }
    }

    /// Returns the text that a script joins or compares.
    pub(crate) fn shown(&self) -> String {
        match self {
            Value::Integer(it) => it.to_string(),
            Value::Real(it) if it.is_nan() => "nan".to_owned(),
            Value::Real(it) => format!("{it:.6}"),
            Value::Text(it) => it.to_string(),
        }
    }
}

/// Writes a value as traces have it: numbers as `%.15g`, texts in quotes.
impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Value::Integer(it) => f.write_str(&general(*it as f64)),
            Value::Real(it) => f.write_str(&general(*it)),
            Value::Text(it) => write!(f, "'{it}'"),
        }
    }
}

/// Formats a number as `%.15g` of C does.
fn general(number: f64) -> String {
    if number.is_nan() {
        return "nan".to_owned();
    }
    if number.is_infinite() {
        return if number > 0.0 { "inf" } else { "-inf" }.to_owned();
    }
    let scientific = format!("{number:.14e}");
    let (digits, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let cut = |text: &str| match text.split_once('.') {
        Some(_) => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        None => text.to_owned(),
    };
    if (-4..15).contains(&exponent) {
        cut(&format!("{number:.*}", (14 - exponent) as usize))
    } else {
        let sign = if exponent < 0 { '-' } else { '+' };
        format!("{}e{sign}{:02}", cut(digits), exponent.abs())
    }
}

/// Returns the integer that a number is, if it is one.
pub(crate) fn as_integer(number: f64) -> Option<i64> {
    let whole = number.fract() == 0.0 && number.abs() < 9.2e18;
    whole.then_some(number as i64)
}

/// Returns the number that a text is.
pub(crate) fn number_of(text: &str) -> Option<f64> {
    match text {
        "true" => Some(1.0),
        "false" => Some(0.0),
        _ => text.trim().parse().ok(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_c_writes_them() {
        for (number, text) in [
            (0.1 + 0.2, "0.3"),
            (1.0 / 3.0, "0.333333333333333"),
            (1e20, "1e+20"),
            (1.5e-7, "1.5e-07"),
            (-7.0, "-7"),
            (123_456_789_012_345.0, "123456789012345"),
        ] {
            assert_eq!(general(number), text);
        }
    }
}
