//! Values of scripts, and when they throw.

use super::syntax::{Assign, Binary, Comparison, Expression};
use super::value::{Value, as_integer, number_of};
use std::fmt;

/// Difference below which numbers count as equal.
const TOLERANCE: f64 = 1.192_092_895_507_812_5e-7;

/// Why a script throws.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScriptError(pub String);

impl fmt::Display for ScriptError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

fn fail<T>(message: impl Into<String>) -> Result<T, ScriptError> {
    Err(ScriptError(message.into()))
}

/// The blackboard as a script sees it.
pub trait Entries {
    /// Returns the value of an entry.
    ///
    /// # Errors
    ///
    /// Fails if the entry does not exist or has no value.
    fn read(&mut self, name: &str) -> Result<Value, ScriptError>;

    /// Makes sure that an entry can be assigned to, before the right side is computed.
    ///
    /// # Errors
    ///
    /// Fails if the entry does not exist and the assignment does not create it.
    fn prepare(&mut self, name: &str, how: Assign) -> Result<(), ScriptError>;

    /// Assigns a value, and returns what the entry holds afterwards.
    ///
    /// # Errors
    ///
    /// Fails if the entry refuses the value.
    fn write(&mut self, name: &str, how: Assign, value: Value) -> Result<Value, ScriptError>;
}

/// Returns the truth value of a result.
///
/// # Errors
///
/// Texts, negative numbers and integers other than 0 and 1 are no truth values.
pub fn truth(value: &Value) -> Result<bool, ScriptError> {
    match value {
        Value::Text(it) => fail(format!("the text '{it}' is no truth value")),
        Value::Integer(it @ (0 | 1)) => Ok(*it == 1),
        Value::Integer(it) => fail(format!("the integer {it} is no truth value: only 0 and 1 are")),
        Value::Real(it) if *it < 0.0 => fail(format!("{it} is below 0 and no truth value")),
        Value::Real(it) => Ok(*it != 0.0),
    }
}

fn number(value: &Value) -> Result<f64, ScriptError> {
    match value {
        Value::Integer(it) => Ok(*it as f64),
        Value::Real(it) => Ok(*it),
        Value::Text(it) => number_of(it).map_or_else(|| fail(format!("'{it}' is no number")), Ok),
    }
}

fn integer(value: &Value) -> Result<i64, ScriptError> {
    match value {
        Value::Integer(it) => Ok(*it),
        Value::Real(it) => as_integer(*it).map_or_else(|| fail(format!("{it} is no integer")), Ok),
        Value::Text(it) => fail(format!("'{it}' is no integer")),
    }
}

/// Returns whether two values are equal for a `Switch`: as texts, or as numbers.
pub(crate) fn same(a: &Value, b: &Value) -> bool {
    let (a, b) = (a.shown(), b.shown());
    let near = |a: f64, b: f64| (a - b).abs() <= TOLERANCE;
    a == b || matches!((a.trim().parse(), b.trim().parse()), (Ok(a), Ok(b)) if near(a, b))
}

fn compare(how: Comparison, a: &Value, b: &Value) -> Result<bool, ScriptError> {
    let ordered = |same: bool, order: Option<std::cmp::Ordering>| match how {
        Comparison::Equal => same,
        Comparison::Different => !same,
        Comparison::Less => order.is_some_and(std::cmp::Ordering::is_lt),
        Comparison::Greater => order.is_some_and(std::cmp::Ordering::is_gt),
        Comparison::AtMost => order.is_some_and(std::cmp::Ordering::is_le),
        Comparison::AtLeast => order.is_some_and(std::cmp::Ordering::is_ge),
    };
    if let (Value::Text(a), Value::Text(b)) = (a, b) {
        return Ok(ordered(a == b, Some(a.cmp(b))));
    }
    let (a, b) = (number(a)?, number(b)?);
    Ok(ordered((a - b).abs() <= TOLERANCE, a.partial_cmp(&b)))
}

fn combine(how: Binary, a: &Value, b: &Value) -> Result<Value, ScriptError> {
    let texts = [a, b].iter().filter(|it| matches!(it, Value::Text(_))).count();
    match (how, texts) {
        (Binary::Join, 1 | 2) | (Binary::Add, 2) => {
            return Ok(Value::text(&(a.shown() + &b.shown())));
        }
        (_, 1 | 2) | (Binary::Join, _) => return fail("this operator does not take these values"),
        _ => {}
    }
    let flag = |it: bool| it as u8 as f64;
    Ok(Value::Real(match how {
        Binary::And => flag(truth(a)? & truth(b)?),
        Binary::Or => {
            let (a, b) = (truth(a)?, truth(b)?);
            flag(a | b)
        }
        Binary::BitAnd => (integer(a)? & integer(b)?) as f64,
        Binary::BitOr => (integer(a)? | integer(b)?) as f64,
        Binary::BitXor => (integer(a)? ^ integer(b)?) as f64,
        Binary::Add => number(a)? + number(b)?,
        Binary::Subtract => number(a)? - number(b)?,
        Binary::Multiply => number(a)? * number(b)?,
        // A zero counts as positive.
        Binary::Divide => number(a)? / Some(number(b)?).filter(|it| *it != 0.0).unwrap_or(0.0),
        Binary::Join => return fail("this operator does not take these values"),
    }))
}

/// Returns the value of an expression; assignments change the entries.
///
/// # Errors
///
/// Returns what the library throws.
pub fn evaluate(expression: &Expression, entries: &mut dyn Entries) -> Result<Value, ScriptError> {
    let flag = |it: bool| Value::Real(it as u8 as f64);
    let plain = |it: &Value| match it {
        Value::Text(_) => fail("this operator takes numbers"),
        it => number(it),
    };
    Ok(match expression {
        Expression::Literal(value) => value.clone(),
        Expression::Entry(name) => entries.read(name)?,
        Expression::Minus(it) => Value::Real(-plain(&evaluate(it, entries)?)?),
        Expression::Complement(it) => {
            let value = plain(&evaluate(it, entries)?)?;
            Value::Real(!(value as i64) as f64)
        }
        Expression::Not(it) => flag(plain(&evaluate(it, entries)?)? == 0.0),
        Expression::Binary(how, a, b) => {
            let (a, b) = (evaluate(a, entries)?, evaluate(b, entries)?);
            combine(*how, &a, &b)?
        }
        Expression::Compare(first, pairs) => {
            let mut left = evaluate(first, entries)?;
            for (how, operand) in pairs {
                let right = evaluate(operand, entries)?;
                if !compare(*how, &left, &right)? {
                    return Ok(flag(false));
                }
                left = right;
            }
            flag(true)
        }
        Expression::Choose(three) => {
            let chosen = match evaluate(&three[0], entries)? {
                Value::Text(it) => !it.is_empty(),
                it => number(&it)? != 0.0,
            };
            evaluate(&three[if chosen { 1 } else { 2 }], entries)?
        }
        Expression::Assign(how, name, right) => {
            entries.prepare(name, *how)?;
            let value = evaluate(right, entries)?;
            entries.write(name, *how, value)?
        }
    })
}

/// Returns what an entry holds after an assignment; `old` is `None` if it had no value.
pub(crate) fn stored(old: Option<&Value>, how: Assign, value: Value) -> Result<Value, ScriptError> {
    let value = match (how, old) {
        (Assign::Create | Assign::Set, None) => return Ok(value),
        (Assign::Create | Assign::Set, Some(Value::Integer(_) | Value::Real(_))) => {
            Value::Real(number(&value)?).or_integer(&value)
        }
        (Assign::Create | Assign::Set, Some(Value::Text(_))) => value,
        (Assign::By(_), None) => return fail("the entry has no value yet"),
        (Assign::By(how), Some(old)) => match (old, &value) {
            (_, Value::Text(_)) if how == Binary::Add => {
                Value::text(&(old.shown() + &value.shown()))
            }
            (Value::Text(_), _) | (_, Value::Text(_)) => {
                return fail("this operator is not for texts");
            }
            _ => combine(how, old, &value)?,
        },
    };
    match (old, value) {
        (Some(Value::Text(_)), value @ Value::Text(_)) => Ok(value),
        (Some(Value::Text(_)), _) | (_, Value::Text(_)) => {
            fail("an entry does not change between text and number")
        }
        (Some(Value::Integer(_)), value) => integer(&value).map(Value::Integer),
        (_, value) => number(&value).map(Value::Real),
    }
}

impl Value {
    /// Keeps an integer exact where a number was made of it.
    fn or_integer(self, from: &Value) -> Value {
        if matches!(from, Value::Integer(_)) { from.clone() } else { self }
    }
}

#[cfg(test)]
mod tests {
    use super::super::syntax::parse;
    use super::*;
    use std::collections::BTreeMap;

    #[derive(Default)]
    struct Board(BTreeMap<String, Option<Value>>);

    impl Entries for Board {
        fn read(&mut self, name: &str) -> Result<Value, ScriptError> {
            let entry = self.0.get(name).cloned().flatten();
            entry.map_or_else(|| fail(format!("no entry {name}")), Ok)
        }

        fn prepare(&mut self, name: &str, how: Assign) -> Result<(), ScriptError> {
            if how == Assign::Create {
                self.0.entry(name.to_owned()).or_default();
            }
            if self.0.contains_key(name) { Ok(()) } else { fail(format!("no entry {name}")) }
        }

        fn write(&mut self, name: &str, how: Assign, value: Value) -> Result<Value, ScriptError> {
            let value = stored(self.0[name].as_ref(), how, value)?;
            self.0.insert(name.to_owned(), Some(value.clone()));
            Ok(value)
        }
    }

    fn run(text: &str) -> Result<String, ScriptError> {
        let mut board = Board::default();
        let mut last = Value::Real(0.0);
        for it in &parse(text).map_err(|e| ScriptError(e.message))?.statements {
            last = evaluate(it, &mut board)?;
        }
        Ok(last.to_string())
    }

    #[test]
    fn operators_bind_as_in_the_library() {
        for (text, value) in [
            ("1 + 2 * 3", "7"),
            ("-2 + 5", "3"),
            ("1 < 2 < 3", "1"),
            ("3 > 2 > 2", "0"),
            ("x := 0x10; x += 1; x", "17"),
            ("a := 'b'; a += 'c'; a .. 1", "'bc1'"),
            ("x := 1; x > 2 ? 'yes' : 'no'", "'no'"),
            ("6 & 3 | 8", "10"),
            ("!0 && true", "1"),
            ("1 / 0", "inf"),
            ("0.1 + 0.2 == 0.3", "1"),
            ("'2' == 2", "1"),
            ("x := 2; x = '3'; x", "3"),
        ] {
            assert_eq!(run(text).as_deref(), Ok(value), "{text}");
        }
    }

    #[test]
    fn misuse_throws() {
        for text in
            ["x = 1", "x := 5; x /= 2", "x := 1; x = 'a'", "2 && 1", "'a' - 'b'", "y + 1", "1 +"]
        {
            assert!(run(text).is_err(), "{text}");
        }
    }
}
