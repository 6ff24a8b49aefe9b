//! Names in a text, with their places.

use super::Wrong;
use serde::de::{Deserialize, Deserializer, Error, Visitor};
use std::fmt;

/// A text that was read, and the address at which it stands, for messages.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Name {
    pub(super) text: String,
    /// Address of its first character; `None` where it is written with escapes.
    address: Option<usize>,
}

impl Name {
    pub(super) fn as_str(&self) -> &str {
        &self.text
    }
}

impl<'de> Deserialize<'de> for Name {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Read;

        impl<'de> Visitor<'de> for Read {
            type Value = Name;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a string")
            }

            fn visit_borrowed_str<E: Error>(self, text: &'de str) -> Result<Name, E> {
                Ok(Name { text: text.to_owned(), address: Some(text.as_ptr().addr()) })
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<Name, E> {
                Ok(Name { text: text.to_owned(), address: None })
            }
        }

        deserializer.deserialize_str(Read)
    }
}

/// An error that is about a name of the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Misnamed {
    /// The name; `None` where the error is about the whole text.
    pub(super) name: Option<Name>,
    pub(super) message: String,
    pub(super) help: Option<String>,
}

impl Misnamed {
    pub(super) fn new(name: &Name, message: String) -> Self {
        Self { name: Some(name.clone()), message, help: None }
    }

    /// An error about a name that need not be there.
    pub(super) fn about(name: Option<&Name>, message: String) -> Self {
        Self { name: name.cloned(), message, help: None }
    }

    pub(super) fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }

    /// The error with its place in the text from which the name was read: that of the quotation
    /// mark before it.
    pub(super) fn placed(self, text: &str) -> Wrong {
        let Self { name, message, help } = self;
        let at = name.and_then(|it| {
            let found = it.address.and_then(|it| it.checked_sub(text.as_ptr().addr()));
            // One that is written with escapes is looked for as it would be written.
            let escaped = || text.find(&serde_json::to_string(&it.text).unwrap_or_default());
            found.map(|it| it.saturating_sub(1)).or_else(escaped)
        });
        let before = text.get(..at.unwrap_or(0)).unwrap_or_default();
        let line = 1 + before.matches('\n').count();
        let column = 1 + before.len() - before.rfind('\n').map_or(0, |it| it + 1);
        Wrong { line, column, message, help, cut_off: false }
    }
}

/// Asks for the name that was probably meant.
pub(super) fn meant<'n>(wrong: &str, known: impl Iterator<Item = &'n str>) -> Option<String> {
    let length = wrong.chars().count();
    let allowed = (length / 3).clamp(1, 8);
    // Long names, and those that differ in length, are not compared letter by letter.
    let short = known.filter(|it| length <= 64 && it.chars().count().abs_diff(length) <= allowed);
    let near = short.map(|it| (strsim::osa_distance(wrong, it), it));
    let near = near.filter(|it| it.0 <= allowed && it.0 < length).min_by_key(|it| it.0);
    near.map(|it| format!("did you mean `{}`?", it.1))
}
