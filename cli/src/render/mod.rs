//! What people see.

pub(crate) mod allocate;
pub(crate) mod assign;
pub(crate) mod campaign;
pub(crate) mod check;
pub(crate) mod conform;
pub(crate) mod estimate;
pub(crate) mod fmeca;
pub(crate) mod fold;
pub(crate) mod models;
pub(crate) mod numbers;
pub(crate) mod plan;
pub(crate) mod reason;
pub(crate) mod run;
pub(crate) mod simulate;
pub(crate) mod snippet;
pub(crate) mod sparkline;
pub(crate) mod statespace;
pub(crate) mod style;
pub(crate) mod supervised;
pub(crate) mod table;
pub(crate) mod team;
pub(crate) mod verify;

/// The command that suggests itself, if one does.
fn next(command: Option<String>) -> String {
    command.map_or_else(String::new, |it| {
        format!("\nnext: {NAME}{}{NAME:#}\n", visible(&it), NAME = style::NAME)
    })
}

/// A text of a file as a screen shows it: what a terminal would obey is written as its code.
pub(crate) fn visible(text: &str) -> String {
    let obeyed = |c: char| {
        c.is_control()
            || ('\u{200e}'..='\u{200f}').contains(&c)
            || ('\u{2028}'..='\u{202e}').contains(&c)
            || ('\u{2066}'..='\u{2069}').contains(&c)
    };
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        if obeyed(c) {
            shown.extend(c.escape_unicode());
        } else {
            shown.push(c);
        }
    }
    shown
}

/// A text in lines of at most `width`, as far as its words allow, each behind `indent`.
pub(crate) fn wrapped(text: &str, width: usize, indent: &str) -> String {
    let mut lines = String::new();
    let mut line = indent.to_owned();
    for word in text.split(' ') {
        if line.len() > indent.len() && line.chars().count() + 1 + word.chars().count() > width {
            lines += &line;
            lines.push('\n');
            line = format!("{indent}  ");
        } else if line.len() > indent.len() {
            line.push(' ');
        }
        line += word;
    }
    lines + &line + "\n"
}

/// A term, in a column of this many characters, and a text in lines beside it.
pub(crate) fn described(
    term: &str,
    column: usize,
    style: anstyle::Style,
    text: &str,
    width: usize,
) -> String {
    let indent = " ".repeat(column + 4);
    // Not narrower than some words, whatever the term.
    let lines = wrapped(text, width.max(indent.len() + 20), &indent);
    let first = lines.get(indent.len()..).unwrap_or_default().trim_end();
    let hanging = format!("\n{indent}  ");
    let beside = first.replace(&hanging, &format!("\n{indent}"));
    if beside.is_empty() {
        return format!("  {style}{term}{style:#}\n");
    }
    let space = " ".repeat(column.saturating_sub(term.chars().count()));
    format!("  {style}{term}{style:#}{space}  {beside}\n")
}

#[cfg(test)]
mod tests {
    use super::{described, visible, wrapped};

    #[test]
    fn what_a_terminal_obeys_is_written_as_its_code() {
        assert_eq!(visible("a\u{1b}[31m\u{202e}é"), "a\\u{1b}[31m\\u{202e}é");
    }

    #[test]
    fn a_text_stands_beside_its_term() {
        let text = described("term", 6, anstyle::Style::new(), "one two three four five six", 20);
        assert_eq!(text, "  term    one two three four\n          five six\n");
        assert_eq!(described("term", 4, anstyle::Style::new(), "", 80), "  term\n");
    }

    #[test]
    fn long_texts_are_wrapped_between_words() {
        assert_eq!(wrapped("one two three four", 11, "  "), "  one two\n    three\n    four\n");
        assert_eq!(wrapped("unbreakable", 4, ""), "unbreakable\n");
    }
}
