//! A file as a tree of values with their places, whatever its notation.

use std::fmt;

/// A value and its place in the file.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    /// In bytes.
    pub(crate) at: usize,
    pub(crate) value: Value,
}

#[derive(Clone, Debug)]
pub(crate) enum Value {
    Integer(i64),
    Text(String),
    List(Vec<Node>),
    /// In the order of the file.
    Table(Vec<Entry>),
    /// A value that no key takes, in words.
    Other(&'static str),
}

/// A key and its value.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub(crate) key: String,
    pub(crate) key_at: usize,
    pub(crate) node: Node,
}

impl Value {
    pub(crate) const fn words(&self) -> &'static str {
        match self {
            Self::Integer(_) => "an integer",
            Self::Text(_) => "a text",
            Self::List(_) => "a list",
            Self::Table(_) => "a table",
            Self::Other(words) => words,
        }
    }
}

/// An error at a place, in bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Fault {
    pub(crate) at: usize,
    pub(crate) message: String,
    pub(crate) help: Option<String>,
}

impl Fault {
    pub(crate) fn new(at: usize, message: impl Into<String>) -> Self {
        Self { at, message: message.into(), help: None }
    }

    /// The same with a remedy.
    pub(crate) fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }

    /// The same with its line and column.
    pub(crate) fn in_text(self, text: &str) -> Wrong {
        let mut at = self.at.min(text.len());
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        let before = text.get(..at).unwrap_or("");
        let line = 1 + before.matches('\n').count();
        let start = before.rfind('\n').map_or(0, |it| it + 1);
        let column = 1 + before.get(start..).unwrap_or("").chars().count();
        Wrong { line, column, message: self.message, help: self.help }
    }
}

/// Cause and place of an error in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wrong {
    /// From 1.
    pub line: usize,
    /// In characters, from 1.
    pub column: usize,
    /// Cause.
    pub message: String,
    /// Remedy, where one is known.
    pub help: Option<String>,
}

impl fmt::Display for Wrong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.line, self.column, self.message)?;
        self.help.iter().try_for_each(|it| write!(f, "; {it}"))
    }
}

impl std::error::Error for Wrong {}

/// All errors of a file: at least one, in the order of their places.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wrongs {
    /// The first ones.
    pub all: Vec<Wrong>,
    /// Number of further ones.
    pub omitted: usize,
}

impl fmt::Display for Wrongs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (number, it) in self.all.iter().enumerate() {
            let end = if number == 0 { "" } else { "\n" };
            write!(f, "{end}{it}")?;
        }
        match self.omitted {
            0 => Ok(()),
            more => write!(f, "\nand {more} more"),
        }
    }
}

impl std::error::Error for Wrongs {}
