//! Keys of a table, each asked for once; the first error ends the reading.

use crate::mission::Attributes;
use crate::tree::{Entry, Fault, Node, Value};

/// Numbers of files lie within this one and its negative.
pub(crate) const LARGEST: i64 = 1_000_000_000_000_000;
/// The longest name, in characters.
const MAX_NAME: usize = 64;

/// The entries of a table, less those that were asked for.
#[derive(Debug)]
pub(crate) struct Fields<'n> {
    at: usize,
    /// A few words for the table.
    what: String,
    left: Vec<&'n Entry>,
}

impl<'n> Fields<'n> {
    pub(crate) fn of(node: &'n Node, what: &str) -> Result<Self, Fault> {
        let Value::Table(entries) = &node.value else {
            return Err(wrong_type(node, what, "a table"));
        };
        Ok(Self { at: node.at, what: what.to_owned(), left: entries.iter().collect() })
    }

    /// The place of the table.
    pub(crate) const fn place(&self) -> usize {
        self.at
    }

    pub(crate) fn optional(&mut self, key: &str) -> Option<&'n Node> {
        let place = self.left.iter().position(|it| it.key == key)?;
        Some(&self.left.remove(place).node)
    }

    pub(crate) fn required(&mut self, key: &str) -> Result<&'n Node, Fault> {
        let missing = || Fault::new(self.at, format!("`{key}` is missing in {}", self.what));
        let place = self.left.iter().position(|it| it.key == key).ok_or_else(missing)?;
        Ok(&self.left.remove(place).node)
    }

    pub(crate) fn integer(&mut self, key: &str, least: i64, most: i64) -> Result<i64, Fault> {
        integer(self.required(key)?, key, least, most)
    }

    pub(crate) fn text(&mut self, key: &str) -> Result<(usize, &'n str), Fault> {
        text(self.required(key)?, key)
    }

    /// A name: no longer than a line of a table bears, without white space.
    pub(crate) fn name(&mut self, key: &str) -> Result<(usize, &'n str), Fault> {
        let (at, name) = self.text(key)?;
        named(at, name)?;
        Ok((at, name))
    }

    /// A list of at most so many items; an empty one where the key is missing.
    pub(crate) fn list(&mut self, key: &str, most: usize) -> Result<&'n [Node], Fault> {
        let Some(node) = self.optional(key) else { return Ok(&[]) };
        let Value::List(items) = &node.value else { return Err(wrong_type(node, key, "a list")) };
        if items.len() > most {
            let message = format!("`{key}` has {} items, at most {most} are read", items.len());
            return Err(Fault::new(node.at, message));
        }
        Ok(items)
    }

    /// The entries of a table with names of the file's own, at most so many.
    pub(crate) fn named(&mut self, key: &str, most: usize) -> Result<&'n [Entry], Fault> {
        let Some(node) = self.optional(key) else { return Ok(&[]) };
        let Value::Table(entries) = &node.value else {
            return Err(wrong_type(node, key, "a table"));
        };
        if entries.len() > most {
            let message = format!("`{key}` has {} keys, at most {most} are read", entries.len());
            return Err(Fault::new(node.at, message));
        }
        for it in entries {
            named(it.key_at, &it.key)?;
        }
        Ok(entries)
    }

    /// Whatever is left, as attributes.
    pub(crate) fn attributes(self) -> Result<Attributes, Fault> {
        let mut attributes = Vec::new();
        for entry in self.left {
            let value = integer(&entry.node, &entry.key, -LARGEST, LARGEST)?;
            attributes.push((entry.key.clone(), value));
        }
        Ok(Attributes(attributes))
    }

    /// Nothing may be left.
    pub(crate) fn finish(self) -> Result<(), Fault> {
        match self.left.first() {
            None => Ok(()),
            Some(it) => {
                let message = format!("unknown key `{}` in {}", short(&it.key), self.what);
                Err(Fault::new(it.key_at, message))
            }
        }
    }
}

pub(crate) fn integer(node: &Node, key: &str, least: i64, most: i64) -> Result<i64, Fault> {
    match node.value {
        Value::Integer(it) if (least..=most).contains(&it) => Ok(it),
        Value::Integer(it) => {
            let message = format!("`{}` must be {least} to {most}, not {it}", short(key));
            Err(Fault::new(node.at, message))
        }
        _ => Err(wrong_type(node, key, "an integer")),
    }
}

pub(crate) fn text<'n>(node: &'n Node, key: &str) -> Result<(usize, &'n str), Fault> {
    match &node.value {
        Value::Text(it) => Ok((node.at, it)),
        _ => Err(wrong_type(node, key, "a text")),
    }
}

fn named(at: usize, name: &str) -> Result<(), Fault> {
    let fits = !name.is_empty() && name.chars().count() <= MAX_NAME;
    if fits && !name.contains(|it: char| it.is_whitespace() || it.is_control()) {
        return Ok(());
    }
    let rule = format!("a name has 1 to {MAX_NAME} characters and no white space");
    Err(Fault::new(at, format!("`{}` is no name: {rule}", short(name))))
}

pub(crate) fn wrong_type(node: &Node, key: &str, expected: &str) -> Fault {
    let is = node.value.words();
    Fault::new(node.at, format!("`{}` must be {expected}, not {is}", short(key)))
}

/// A text of a file as messages say it.
pub(crate) fn short(text: &str) -> String {
    let start: String = text.chars().take(MAX_NAME).collect();
    let more = if start.len() < text.len() { "..." } else { "" };
    format!("{}{more}", start.escape_debug())
}

/// Finds a name among known ones.
pub(crate) fn index_of<'k>(
    at: usize,
    what: &str,
    name: &str,
    known: impl Iterator<Item = &'k str> + Clone,
) -> Result<usize, Fault> {
    known.clone().position(|it| it == name).ok_or_else(|| {
        let all: Vec<_> = known.take(20).collect();
        let there = if all.is_empty() { "none is defined".into() } else { all.join(", ") };
        Fault::new(at, format!("unknown {what} `{}`; there are: {there}", short(name)))
    })
}

/// Refuses a name that stands before it in the same list.
pub(crate) fn distinct<'k>(
    at: usize,
    what: &str,
    name: &str,
    mut before: impl Iterator<Item = &'k str>,
) -> Result<(), Fault> {
    if before.any(|it| it == name) {
        return Err(Fault::new(at, format!("a second {what} is called `{}`", short(name))));
    }
    Ok(())
}
