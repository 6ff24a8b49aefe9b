//! TOML 1.0 as a tree, in the order of the file.

use crate::fields::Faults;
use crate::tree::{Entry, Node, Value};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Reads a text as a document of TOML; all that is none is said.
pub(crate) fn parse(text: &str, faults: &Faults) -> Option<Node> {
    let (root, errors) = DeTable::parse_recoverable(text);
    for error in &errors {
        let at = error.span().map_or(0, |it| it.start);
        faults.say(at, format!("not TOML: {}", error.message()));
    }
    errors.is_empty().then(|| table(root.get_ref(), 0))
}

fn table(table_of: &DeTable<'_>, at: usize) -> Node {
    let mut entries = Vec::new();
    for (key, value) in table_of {
        let key_at = key.span().start;
        entries.push(Entry { key: key.get_ref().to_string(), key_at, node: node(value) });
    }
    entries.sort_by_key(|it| it.key_at);
    Node { at, value: Value::Table(entries) }
}

fn node(of: &Spanned<DeValue<'_>>) -> Node {
    let at = of.span().start;
    let value = match of.get_ref() {
        DeValue::Integer(it) => {
            let whole = i64::from_str_radix(it.as_str(), it.radix());
            whole.map_or(Value::Other("a number beyond 64 bits"), Value::Integer)
        }
        DeValue::String(it) => Value::Text(it.to_string()),
        DeValue::Array(list) => Value::List(list.iter().map(node).collect()),
        DeValue::Table(it) => return table(it, at),
        DeValue::Float(_) => Value::Other("a float"),
        DeValue::Boolean(_) => Value::Other("`true` or `false`"),
        DeValue::Datetime(_) => Value::Other("a date"),
    };
    Node { at, value }
}
