//! Errors in the fields of an instance, each with its path.

use crate::json::{Broken, Json, Shape};
use crate::missions::{Diagnostic, Spanned};
use crate::names::{nearest, quoted};
use std::fmt::Write;
use std::ops::Range;

/// So many errors are kept while a file is read.
const KEPT: usize = 100_000;

/// A step of a path.
#[derive(Clone, Copy, Debug)]
pub(super) enum Step {
    Field(&'static str),
    Number(usize),
}

/// The whole number that a number of JSON is, however it is written: `2000.0` and `2e3` are 2000.
fn whole_number(text: &str) -> Option<i64> {
    let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let fraction = fraction.trim_end_matches('0');
    // So many digits behind the point become whole, and so many zeros follow.
    let zeros = exponent.parse::<i64>().ok()?.checked_sub(i64::try_from(fraction.len()).ok()?)?;
    let digits = [whole, fraction].concat();
    let number: i64 = if zeros < 0 {
        let kept = digits.len().checked_sub(usize::try_from(-zeros).ok()?)?;
        let (kept, cut) = digits.split_at_checked(kept)?;
        let is_whole = cut.bytes().all(|it| it == b'0');
        let kept = if matches!(kept, "" | "-") { "0" } else { kept };
        is_whole.then(|| kept.parse().ok())??
    } else {
        digits.parse().ok()?
    };
    let power = 10_i64.checked_pow(u32::try_from(zeros.max(0)).ok()?);
    if number == 0 { Some(0) } else { number.checked_mul(power?) }
}

/// The path of the reader, and the errors so far.
#[derive(Debug, Default)]
pub(super) struct Context {
    pub(super) errors: Vec<Diagnostic>,
    path: Vec<Step>,
    /// Whether a value could not be read, which is then not reported as missing.
    pub(super) unread: bool,
}

impl Context {
    /// Reads something at a step of the path.
    pub(super) fn at<R>(&mut self, step: Step, act: impl FnOnce(&mut Self) -> R) -> R {
        self.path.push(step);
        let result = act(self);
        self.path.pop();
        result
    }

    /// Something is wrong with the field of the current path.
    pub(super) fn wrong(&mut self, span: Range<usize>, what: &str, help: &str) {
        let mut message = String::new();
        for (number, step) in self.path.iter().enumerate() {
            let _ = match step {
                Step::Field(name) if number == 0 => write!(message, "{name}"),
                Step::Field(name) => write!(message, ".{name}"),
                Step::Number(number) => write!(message, "[{number}]"),
            };
        }
        if !message.is_empty() {
            message += ": ";
        }
        message += what;
        if self.errors.len() < KEPT {
            let error = Diagnostic::new(span, message, "");
            self.errors.push(if help.is_empty() { error } else { error.help(help) });
        }
    }

    /// A field that is missing in the object of this place.
    pub(super) fn missing(&mut self, span: Range<usize>, name: &str, help: &str) {
        if !self.unread {
            let first = span.start..span.start.saturating_add(1);
            self.wrong(first, &format!("`{name}` is missing"), help);
        }
    }

    /// Reads an object with these keys; `member` gets the place of a key among them. A key that is
    /// nearly one of them is an error, any other is passed over.
    pub(super) fn object(
        &mut self,
        json: &mut Json<'_>,
        keys: &[&'static str],
        mut member: impl FnMut(&mut Self, &mut Json<'_>, usize, Range<usize>) -> Result<(), Broken>,
    ) -> Result<(), Broken> {
        if !self.is(json, Shape::Object)? {
            return Ok(());
        }
        let mut seen = vec![false; keys.len()];
        json.object(|json, key, span| {
            let Some(place) = keys.iter().position(|it| *it == key) else {
                if let Some(near) = nearest(key, keys.iter().copied()) {
                    let what = format!("unknown field {}; did you mean `{near}`?", quoted(key));
                    self.wrong(span, &what, &format!("write `{near}`"));
                }
                return json.skip();
            };
            if std::mem::replace(&mut seen[place], true) {
                self.wrong(span, &format!("`{key}` is there twice"), "leave out one of them");
                return json.skip();
            }
            self.at(Step::Field(keys[place]), |all| member(all, json, place, span))
        })
    }

    /// Reads a list, and says whether it is one.
    pub(super) fn list(
        &mut self,
        json: &mut Json<'_>,
        mut element: impl FnMut(&mut Self, &mut Json<'_>) -> Result<(), Broken>,
    ) -> Result<bool, Broken> {
        if !self.is(json, Shape::List)? {
            return Ok(false);
        }
        json.list(|json, number| self.at(Step::Number(number), |all| element(all, json)))?;
        Ok(true)
    }

    /// Reads a text.
    pub(super) fn text(&mut self, json: &mut Json<'_>) -> Result<Option<Spanned<String>>, Broken> {
        if !self.is(json, Shape::Text)? {
            return Ok(None);
        }
        let start = json.start();
        let value = json.text()?;
        Ok(Some(Spanned { value, span: json.since(start) }))
    }

    /// Reads a name that is not empty.
    pub(super) fn name(&mut self, json: &mut Json<'_>) -> Result<Option<Spanned<String>>, Broken> {
        let name = self.text(json)?;
        if let Some(it) = name.as_ref().filter(|it| it.value.is_empty()) {
            self.wrong(it.span.clone(), "a name is empty", "");
        }
        Ok(name)
    }

    /// Reads a whole number within these bounds.
    pub(super) fn whole(
        &mut self,
        json: &mut Json<'_>,
        least: u32,
        most: u32,
    ) -> Result<Option<u32>, Broken> {
        if !self.is(json, Shape::Number)? {
            return Ok(None);
        }
        let start = json.start();
        let text = json.number()?;
        let number = whole_number(text);
        let within = number.and_then(|it| u32::try_from(it).ok());
        let within = within.filter(|it| (least..=most).contains(it));
        if within.is_none() {
            let is_fraction = number.is_none() && text.contains(['.', 'e', 'E']);
            let help = if is_fraction {
                format!(
                    "whole numbers from {least} to {most} are needed; multiply all by the same \
                     factor"
                )
            } else {
                format!("a whole number from {least} to {most} is needed")
            };
            let why = if is_fraction {
                "is not a whole number"
            } else if text.starts_with('-') {
                "is below 0"
            } else {
                "is out of range"
            };
            self.wrong(json.since(start), &format!("{} {why}", quoted(text)), &help);
        }
        Ok(within)
    }

    /// Whether the next value has this shape; if not, it is passed over.
    fn is(&mut self, json: &mut Json<'_>, wanted: Shape) -> Result<bool, Broken> {
        let shape = json.shape()?;
        if shape == wanted {
            return Ok(true);
        }
        let start = json.start();
        json.skip()?;
        let what = format!("{} stands where {} is needed", shape.words(), wanted.words());
        self.wrong(json.since(start), &what, "");
        Ok(false)
    }
}

#[cfg(test)]
mod tests {
    use super::whole_number;

    #[test]
    fn a_number_is_whole_however_it_is_written() {
        for (text, number) in [
            ("2000", Some(2000)),
            ("2000.0", Some(2000)),
            ("2e3", Some(2000)),
            ("2.5e1", Some(25)),
            ("250e-1", Some(25)),
            ("0.0", Some(0)),
            ("0e99999", Some(0)),
            ("-1.0", Some(-1)),
            ("2.5", None),
            ("25e-1", None),
            ("0.4", None),
            ("4e-1", None),
            ("1e30", None),
            ("1e-99999999999999999999", None),
        ] {
            assert_eq!(whole_number(text), number, "{text}");
        }
    }
}
