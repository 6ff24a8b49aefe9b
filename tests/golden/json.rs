//! JSON as lines that a person compares.

use serde_json::Value;

/// The columns of a file.
const WIDTH: usize = 100;

/// Returns a value of JSON in lines of which each holds as much as fits, so that a changed one says
/// where it stands.
#[must_use]
pub fn json_lines(value: &Value) -> String {
    let mut text = String::new();
    add_lines(&mut text, 0, value);
    text + "\n"
}

/// Appends a value. As many of its parts as fit stand on a line.
fn add_lines(text: &mut String, indent: usize, value: &Value) {
    let column = |text: &str| text.len() - text.rfind('\n').map_or(0, |it| it + 1);
    let line = in_one_line(value);
    if column(text) + line.len() < WIDTH || !(value.is_object() || value.is_array()) {
        *text += &line;
        return;
    }
    let (open, close) = if value.is_object() { ("{ ", " }") } else { ("[", "]") };
    *text += open;
    let named = value.as_object().into_iter().flatten();
    let named = named.map(|(name, it)| (format!("{}: ", Value::from(name.as_str())), it));
    let items = value.as_array().into_iter().flatten().map(|it| (String::new(), it));
    for (at, (name, item)) in named.chain(items).enumerate() {
        *text += if at > 0 { "," } else { "" };
        let fits = column(text) + name.len() + in_one_line(item).len() + 1 < WIDTH;
        if at > 0 && fits && (name.is_empty() || !item.is_object()) {
            *text += " ";
        } else if at > 0 || !fits {
            *text = text.trim_end().to_owned() + "\n" + &" ".repeat(indent + 2);
        }
        *text += &name;
        add_lines(text, indent + 2, item);
    }
    *text += close;
}

fn in_one_line(value: &Value) -> String {
    match value {
        Value::Object(fields) => {
            let field = |(name, it): (&String, &Value)| {
                format!("{}: {}", Value::from(name.as_str()), in_one_line(it))
            };
            format!("{{ {} }}", fields.iter().map(field).collect::<Vec<_>>().join(", "))
        }
        Value::Array(items) => {
            format!("[{}]", items.iter().map(in_one_line).collect::<Vec<_>>().join(", "))
        }
        other => other.to_string(),
    }
}
