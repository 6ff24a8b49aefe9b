//! The screens for people.

pub(crate) mod allocate;
pub(crate) mod assign;
pub(crate) mod axes;
pub(crate) mod axes_run;
pub(crate) mod bids;
pub(crate) mod calibrate;
pub(crate) mod campaign;
pub(crate) mod causes;
pub(crate) mod check;
pub(crate) mod conform;
pub(crate) mod curves;
pub(crate) mod estimate;
pub(crate) mod explain;
pub(crate) mod floor;
pub(crate) mod fmeca;
pub(crate) mod fold;
pub(crate) mod measured;
pub(crate) mod models;
pub(crate) mod numbers;
pub(crate) mod plan;
pub(crate) mod reason;
pub(crate) mod risk;
pub(crate) mod run;
pub(crate) mod simulate;
pub(crate) mod snippet;
pub(crate) mod sparkline;
pub(crate) mod statespace;
pub(crate) mod style;
pub(crate) mod supervised;
pub(crate) mod table;
pub(crate) mod team;
pub(crate) mod tree;
pub(crate) mod verify;
pub(crate) mod ways;

/// The command that suggests itself, if one does that can be typed as it is shown.
fn next(command: Option<String>) -> String {
    command
        .filter(|it| visible(it) == *it)
        .map_or_else(String::new, |it| format!("\nnext: {NAME}{it}{NAME:#}\n", NAME = style::NAME))
}

/// A name or a text of a file within a line of a screen: what a terminal would obey is written as
/// its code, line ends too.
pub(crate) fn visible(text: &str) -> String {
    cotama_core::text::visible(text).to_string()
}

/// A text in lines of at most `width`, as far as its words allow, each behind `indent`.
pub(crate) fn wrapped(text: &str, width: usize, indent: &str) -> String {
    let seen = |text: &str| style::unstyled(text).chars().count();
    let mut lines = String::new();
    let mut line = indent.to_owned();
    for word in fold::words(text) {
        let used = seen(&line);
        if line.len() > indent.len() && used + 1 + seen(word) > width {
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
    style: style::Style,
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

/// A title in a column of this many characters, and at most so many names; nothing without names.
pub(crate) fn named(
    title: &str,
    column: usize,
    names: impl Iterator<Item = String>,
    most: usize,
    width: usize,
) -> String {
    let mut names: Vec<_> = names.map(|it| visible(&it)).collect();
    let more = names.len().saturating_sub(most);
    names.truncate(most);
    if more > 0 {
        names.push(format!("and {more} more"));
    }
    if names.is_empty() {
        return String::new();
    }
    described(title, column, style::FAINT, &names.join(", "), width)
}

#[cfg(test)]
mod tests {
    use super::style::PLAIN;
    use super::{described, visible, wrapped};

    #[test]
    fn control_characters_are_written_as_their_codes() {
        assert_eq!(visible("a\u{1b}[31m\u{202e}é"), "a\\u{1b}[31m\\u{202e}é");
    }

    #[test]
    fn a_text_stands_beside_its_term() {
        let text = described("term", 6, PLAIN, "one two three four five six", 20);
        assert_eq!(text, "  term    one two three four\n          five six\n");
        assert_eq!(described("term", 4, PLAIN, "", 80), "  term\n");
    }

    #[test]
    fn long_texts_are_wrapped_between_words() {
        assert_eq!(wrapped("one two three four", 11, "  "), "  one two\n    three\n    four\n");
        assert_eq!(wrapped("unbreakable", 4, ""), "unbreakable\n");
    }
}
