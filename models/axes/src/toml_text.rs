//! TOML 1.0 as a tree, in the order of the file.

use crate::tree::{Entry, Fault, Node, Value};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Reads a text as a document of TOML.
pub(crate) fn parse(text: &str) -> Result<Node, Fault> {
    match DeTable::parse(text) {
        Ok(root) => table(root.get_ref(), 0),
        Err(error) => {
            let at = error.span().map_or(0, |it| it.start);
            Err(Fault::new(at, format!("not TOML: {}", error.message())))
        }
    }
}

fn table(table_of: &DeTable<'_>, at: usize) -> Result<Node, Fault> {
    let mut entries = Vec::new();
    for (key, value) in table_of {
        let key_at = key.span().start;
        entries.push(Entry { key: key.get_ref().to_string(), key_at, node: node(value)? });
    }
    entries.sort_by_key(|it| it.key_at);
    Ok(Node { at, value: Value::Table(entries) })
}

fn node(of: &Spanned<DeValue<'_>>) -> Result<Node, Fault> {
    let at = of.span().start;
    let value = match of.get_ref() {
        DeValue::Integer(it) => {
            let whole = i64::from_str_radix(it.as_str(), it.radix());
            Value::Integer(whole.map_err(|_| Fault::new(at, format!("`{it}` is too large")))?)
        }
        DeValue::String(it) => Value::Text(it.to_string()),
        DeValue::Array(list) => Value::List(list.iter().map(node).collect::<Result<_, _>>()?),
        DeValue::Table(it) => return table(it, at),
        DeValue::Float(_) => Value::Other("a float"),
        DeValue::Boolean(_) => Value::Other("`true` or `false`"),
        DeValue::Datetime(_) => Value::Other("a date"),
    };
    Ok(Node { at, value })
}
