//! The first document of a YAML text as a tree with places, for files of ROS.
//!
//! ```
//! use cotama_floor::yaml::{self, Expected, Value};
//! use cotama_models::reading::Sink;
//! let sink = Sink::default();
//! let expected = Expected { text: "the text of a lamp", example: "write `power: 60`" };
//! let (tree, whole) = yaml::read("power: 60", expected, &sink).unwrap();
//! let entries = tree.entries(whole, expected, &sink).unwrap();
//! let Value::Text(power) = &entries[0].1.value else { panic!() };
//! assert_eq!((yaml::number(power), entries[0].1.span.clone()), (Some(60.0), 7..9));
//! ```

use cotama_models::missions::MissionErrors;
use cotama_models::reading::{Diagnostic, Sink, errors, quoted};
use saphyr_parser::{Event, Parser, ScalarStyle, Span};
use std::collections::BTreeMap;
use std::ops::Range;

/// The most values of a text.
const MAX_VALUES: usize = 4_096;

/// The text that is read, for messages.
#[derive(Clone, Copy, Debug)]
pub struct Expected {
    /// A name of the text, as in "is it the text of a map?".
    pub text: &'static str,
    /// Lines to write where there are none.
    pub example: &'static str,
}

/// A value; those inside it stand in front of it.
#[derive(Debug)]
pub struct Node {
    /// Bytes of the value in the text.
    pub span: Range<usize>,
    /// The value itself.
    pub value: Value,
}

impl Node {
    /// Reports that the value of a key must be something else.
    pub fn wrong(&self, key: &str, expected: &str, help: &str, sink: &Sink) {
        let found = match &self.value {
            Value::Text(text) => quoted(text),
            Value::Nothing => "nothing".into(),
            Value::List(items) => format!("a list of {}", items.len()),
            Value::Map(_) => "a mapping".into(),
        };
        let message = format!("`{key}` must be {expected}, not {found}");
        let it = Diagnostic::new(self.span.clone(), message, format!("expected {expected}"));
        sink.report(it.help(help));
    }
}

/// A value of YAML.
#[derive(Debug)]
pub enum Value {
    /// A scalar, quoted or not.
    Text(String),
    /// Nothing, or `~`.
    Nothing,
    /// Numbers of values in the tree.
    List(Vec<usize>),
    /// Keys and values in the order of the text.
    Map(Vec<(usize, usize)>),
}

/// A list or a mapping that is still open, with the name that aliases say.
struct Open {
    span: Range<usize>,
    name: usize,
    is_map: bool,
    items: Vec<usize>,
}

/// The values of a text; the last one is the whole.
#[derive(Debug, Default)]
pub struct Tree {
    nodes: Vec<Node>,
}

impl Tree {
    /// Returns the value of a number.
    pub fn get(&self, at: usize) -> Option<&Node> {
        self.nodes.get(at)
    }

    fn add(&mut self, span: Range<usize>, value: Value) -> usize {
        self.nodes.push(Node { span, value });
        self.nodes.len() - 1
    }

    /// Returns the keys and values of the whole, or reports that it has none.
    pub fn entries(
        &self,
        whole: usize,
        expected: Expected,
        sink: &Sink,
    ) -> Option<Vec<(&Node, &Node)>> {
        let node = self.get(whole)?;
        if let Value::Map(entries) = &node.value {
            return entries.iter().map(|it| Some((self.get(it.0)?, self.get(it.1)?))).collect();
        }
        let it = Diagnostic::new(node.span.clone(), "the text has no keys with values", "no key");
        sink.report(it.help(expected.example));
        None
    }
}

/// Reads a text of at most so many bytes; `read` makes of its tree, and of the place of the whole
/// in it, what is wanted, and reports what is wrong.
///
/// # Errors
/// All that was reported, with places. `source_name` is the name of the text in messages.
pub fn parse<T>(
    (source_name, text): (&str, &str),
    most: usize,
    expected: Expected,
    read: impl FnOnce(&Tree, usize, &Sink) -> Option<T>,
) -> Result<T, MissionErrors> {
    let sink = Sink::default();
    let found = if text.len() > most {
        let it = Diagnostic::new(0..0, format!("the text has more than {most} bytes"), "");
        sink.report(it.help(format!("is it {}?", expected.text)));
        None
    } else {
        self::read(text, expected, &sink).and_then(|(tree, whole)| read(&tree, whole, &sink))
    };
    found.filter(|_| sink.is_empty()).ok_or_else(|| errors(source_name, text, sink))
}

/// Reads the first document of a text; returns the place of the whole in the tree.
pub fn read(text: &str, expected: Expected, sink: &Sink) -> Option<(Tree, usize)> {
    // The parser counts characters.
    let mut starts: Vec<usize> = text.char_indices().map(|it| it.0).collect();
    starts.push(text.len());
    let byte = |at: usize| starts.get(at).copied().unwrap_or(text.len());
    let range = |it: Span| byte(it.start.index())..byte(it.end.index());
    let mut tree = Tree::default();
    let (mut open, mut names) = (Vec::<Open>::new(), BTreeMap::<usize, usize>::new());
    for event in Parser::new_from_str(text) {
        let (event, span) = match event {
            Ok(it) => it,
            Err(error) => {
                let at = byte(error.marker().index());
                let message = format!("not YAML: {}", error.info());
                let it = Diagnostic::new(at..at, message, "YAML syntax");
                sink.report(it.help("write a key, a colon, a space and the value in each line"));
                return None;
            }
        };
        let span = range(span);
        if tree.nodes.len() >= MAX_VALUES {
            let it = Diagnostic::new(span, format!("more than {MAX_VALUES} values"), "too many");
            sink.report(it.help(format!("is it {}?", expected.text)));
            return None;
        }
        let (at, name) = match event {
            Event::Scalar(text, style, name, _) => {
                let plain = style == ScalarStyle::Plain;
                let nothing = plain && matches!(&*text, "" | "~" | "null" | "Null" | "NULL");
                let value = if nothing { Value::Nothing } else { Value::Text(text.into_owned()) };
                (tree.add(span, value), name)
            }
            Event::SequenceStart(name, _) => {
                open.push(Open { span, name, is_map: false, items: Vec::new() });
                continue;
            }
            Event::MappingStart(name, _) => {
                open.push(Open { span, name, is_map: true, items: Vec::new() });
                continue;
            }
            Event::SequenceEnd | Event::MappingEnd => {
                let Some(it) = open.pop() else { continue };
                let pairs = it.items.chunks_exact(2).filter_map(|it| Some((it[0], *it.get(1)?)));
                let value =
                    if it.is_map { Value::Map(pairs.collect()) } else { Value::List(it.items) };
                (tree.add(it.span.start..span.end.max(it.span.start), value), it.name)
            }
            Event::Alias(name) => {
                // A name is known once its value is whole, so no value holds itself.
                let Some(at) = names.get(&name) else {
                    let it = Diagnostic::new(span, "this alias is inside its own value", "alias");
                    sink.report(it.help("write the value"));
                    return None;
                };
                (*at, 0)
            }
            Event::DocumentEnd => break,
            _ => continue,
        };
        if name > 0 {
            names.insert(name, at);
        }
        match open.last_mut() {
            Some(it) => it.items.push(at),
            None => return Some((tree, at)),
        }
    }
    let it = Diagnostic::new(0..0, "the text is empty", "nothing");
    sink.report(it.help(expected.example));
    None
}

/// Reads a number as streams of C++ do: digits with a point and an exponent.
pub fn number(text: &str) -> Option<f64> {
    let text = text.trim_end_matches([' ', '\t', '\n', '\r']);
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    let good = |c: char| c.is_ascii_digit() || matches!(c, '.' | 'e' | 'E' | '+' | '-');
    let number = text.parse::<f64>().ok()?;
    let begins = digits.starts_with(|c: char| c.is_ascii_digit() || c == '.');
    (begins && digits.chars().all(good) && number.is_finite()).then_some(number)
}

/// Reads a truth value: a whole number with its prefix of C, or a word.
pub fn truth(text: &str) -> Option<bool> {
    let trimmed = text.trim_end_matches([' ', '\t', '\n', '\r']);
    let digits = trimmed.strip_prefix(['+', '-']).unwrap_or(trimmed);
    let (digits, radix) = match digits.as_bytes() {
        [b'0', b'x' | b'X', ..] => (digits.get(2..)?, 16),
        [b'0', _, ..] => (digits, 8),
        _ => (digits, 10),
    };
    if digits.starts_with(|c: char| c.is_digit(radix)) {
        let magnitude = i64::from_str_radix(digits, radix).ok()?;
        let most = i64::from(i32::MAX) + i64::from(trimmed.starts_with('-'));
        return (magnitude <= most).then_some(magnitude != 0);
    }
    let small = text.to_ascii_lowercase();
    let (first, rest) = text.split_at_checked(1)?;
    let is_cased = text == small
        || text == text.to_ascii_uppercase()
        || (first == first.to_ascii_uppercase() && rest == rest.to_ascii_lowercase());
    match small.as_str() {
        "y" | "yes" | "true" | "on" if is_cased => Some(true),
        "n" | "no" | "false" | "off" if is_cased => Some(false),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::{number, truth};

    #[test]
    fn numbers_are_those_of_streams_of_cpp() {
        for (text, read) in [
            ("0.05", Some(0.05)),
            ("5e-2", Some(0.05)),
            (".5", Some(0.5)),
            ("5.", Some(5.0)),
            ("+1", Some(1.0)),
            ("-0", Some(0.0)),
            ("1 ", Some(1.0)),
            (" 1", None),
            ("0x10", None),
            ("1_0", None),
            ("1e", None),
            ("1e999", None),
            ("inf", None),
            (".nan", None),
            ("--1", None),
            ("", None),
        ] {
            assert_eq!(number(text), read, "{text:?}");
        }
    }

    #[test]
    fn truths_are_those_of_yaml_cpp() {
        for (text, read) in [
            ("0", Some(false)),
            ("1", Some(true)),
            ("-3", Some(true)),
            ("0x0", Some(false)),
            ("010", Some(true)),
            ("08", None),
            ("2147483648", None),
            ("-2147483648", Some(true)),
            ("yes", Some(true)),
            ("OFF", Some(false)),
            ("True", Some(true)),
            ("tRUE", None),
            ("0.5", None),
            ("y", Some(true)),
            ("", None),
        ] {
            assert_eq!(truth(text), read, "{text:?}");
        }
    }
}
