//! What people see.

pub(crate) mod allocate;
pub(crate) mod numbers;
pub(crate) mod plan;
pub(crate) mod reason;
pub(crate) mod run;
pub(crate) mod snippet;
pub(crate) mod sparkline;
pub(crate) mod style;
pub(crate) mod table;

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

#[cfg(test)]
mod tests {
    use super::wrapped;

    #[test]
    fn long_texts_are_wrapped_between_words() {
        assert_eq!(wrapped("one two three four", 11, "  "), "  one two\n    three\n    four\n");
        assert_eq!(wrapped("unbreakable", 4, ""), "unbreakable\n");
    }
}
