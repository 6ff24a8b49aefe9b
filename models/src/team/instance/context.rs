//! What is wrong with the fields of an instance, each with its path.

use super::json::{Broken, Json, Shape};
use crate::missions::{Diagnostic, Spanned};
use crate::names::{nearest, quoted};
use std::fmt::Write;
use std::ops::Range;

/// So many errors are kept while a file is read.
const KEPT: usize = 10_000;

/// A step of a path.
#[derive(Clone, Copy, Debug)]
pub(super) enum Step {
    Field(&'static str),
    Number(usize),
}

/// Where the reader is, and the errors so far.
#[derive(Debug, Default)]
pub(super) struct Context {
    pub(super) errors: Vec<Diagnostic>,
    path: Vec<Step>,
    /// What could not be read is not missing.
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
        let number = text.parse().ok().filter(|it| (least..=most).contains(it));
        if number.is_none() {
            let help = format!("a whole number from {least} to {most} is needed");
            let why = if text.contains(['.', 'e', 'E']) {
                "is not written as a whole number"
            } else if text.starts_with('-') {
                "is below 0"
            } else {
                "is out of range"
            };
            self.wrong(json.since(start), &format!("{} {why}", quoted(text)), &help);
        }
        Ok(number)
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
