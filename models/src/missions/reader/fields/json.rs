//! The same documents in JSON: the tree that a reader walks, from another syntax.

use super::{Fields, Node, Sink, read_root};
use crate::json::{Advice, Broken, Json, MAX_DEPTH, Shape};
use crate::names::quoted;
use toml::de::{DeArray, DeTable, DeValue};

/// Advice on a file that is no JSON.
const ADVICE: Advice = Advice {
    help: "the file begins as JSON: one object, with the keys that it has in TOML",
    no_number: "this is no number of JSON: write a whole number",
};

/// Reads a document in TOML, or in JSON where it begins with `{`; `read` gets its root unless the
/// text is neither.
pub(crate) fn document_of_either<T>(
    text: &str,
    sink: &Sink,
    format: &'static str,
    read: impl FnOnce(Fields<'_>) -> Option<T>,
) -> Option<T> {
    let start = text.trim_start_matches('\u{feff}').trim_start();
    if !start.starts_with('{') {
        return super::document(text, sink, format, read);
    }
    sink.is_json.set(true);
    let json = &mut Json::new(text, &ADVICE);
    let root = value(json, MAX_DEPTH).and_then(|root| json.end().map(|()| root));
    match root {
        Ok(root) => read_root(root.get_ref().as_table()?, sink, format, read),
        Err(broken) => {
            sink.report(broken);
            None
        }
    }
}

fn value<'t>(json: &mut Json<'t>, depth: usize) -> Result<Node<'t>, Broken> {
    let start = json.start();
    let Some(below) = depth.checked_sub(1) else {
        return Err(json.broken("this is nested too deeply"));
    };
    let value = match json.shape()? {
        Shape::Object => {
            let mut table = DeTable::new();
            json.object(|json, key, span| {
                if table.contains_key(key) {
                    let message = format!("{} is there twice", quoted(key));
                    return Err(Broken::new(span, message, "twice").help("leave out one of them"));
                }
                let value = value(json, below)?;
                table.insert(toml::Spanned::new(span, key.to_owned().into()), value);
                Ok(())
            })?;
            DeValue::Table(table)
        }
        Shape::List => {
            let mut list = DeArray::new();
            json.list(|json, _| {
                list.push(value(json, below)?);
                Ok(())
            })?;
            DeValue::Array(list)
        }
        Shape::Text => DeValue::String(json.text()?.into()),
        Shape::Number => {
            let text = json.number()?;
            // `2000.0` is whole.
            let whole = text.split_once('.').filter(|it| it.1.bytes().all(|it| it == b'0'));
            let number = DeValue::parse(whole.map_or(text, |it| it.0));
            number.map_err(|_| json.broken("this is no number"))?.into_inner()
        }
        Shape::Word => match json.word()? {
            "null" => {
                let help = "leave the key out, or give it a value";
                let span = json.since(start);
                return Err(Broken::new(span, "`null` says nothing here", "null").help(help));
            }
            word => DeValue::Boolean(word == "true"),
        },
    };
    Ok(toml::Spanned::new(json.since(start), value))
}

impl Sink {
    /// Returns a key with a value, as the file would say it.
    pub(super) fn entry(&self, key: &str, value: &str) -> String {
        if self.is_json.get() { format!("\"{key}\": {value}") } else { format!("{key} = {value}") }
    }

    /// Returns the name of a type in the syntax of the file.
    pub(super) fn named<'n>(&self, of_toml: &'n str) -> &'n str {
        match of_toml {
            _ if !self.is_json.get() => of_toml,
            "a table" => "an object",
            "an array" => "a list",
            "a string" => "a text",
            _ => of_toml,
        }
    }
}
