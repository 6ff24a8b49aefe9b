//! Help texts fitted to the width of a screen.
//!
//! In the source a paragraph is one line. Two more kinds of lines are known by how they begin: an
//! example (`  $ `), and a term with what it means behind at least two spaces (`  +MS  lets ..`).

use super::Cli;
use crate::render::wrapped;
use clap::CommandFactory;
use std::fmt::Write;

/// The widest help, however wide the screen is.
const WIDEST: usize = 100;

/// Names of values that are numbers.
const NUMBERS: [&str; 5] = ["N", "ms", "mJ", "s", "MiB"];

/// The command line, with help for a screen so wide.
pub(crate) fn command(width: usize) -> clap::Command {
    let width = width.min(WIDEST);
    let fit = |command: clap::Command| match command.get_after_long_help().map(ToString::to_string)
    {
        Some(text) => command.after_long_help(fitted(&text, width)),
        None => command,
    };
    let program = Cli::command();
    // `-5` is a wrong number, not an unknown option.
    let number = |arg: clap::Arg| {
        let is_number = arg.get_value_names().is_some_and(|it| NUMBERS.contains(&it[0].as_str()));
        if is_number { arg.allow_negative_numbers(true) } else { arg }
    };
    let fit = |command: clap::Command| fit(command).mut_args(number);
    let program = fit(program).term_width(width);
    let each = |command: clap::Command| command.mut_subcommands(fit);
    program.mut_subcommands(|it| each(fit(it)))
}

/// How an example begins, and how it goes on in another line.
const EXAMPLE: &str = "  $ ";
const CONTINUED: &str = "      ";
/// The least room beside a term; with less, its meaning stands below it.
const LEAST_ROOM: usize = 24;

/// The text in lines of at most `width` characters, as far as its words allow. Examples can still
/// be pasted into a shell.
fn fitted(text: &str, width: usize) -> String {
    let mut lines = String::new();
    for line in text.lines() {
        if let Some(command) = line.strip_prefix(EXAMPLE) {
            example(&mut lines, command, width);
        } else if let Some((term, column, meaning)) = term(line) {
            explained(&mut lines, term, column, meaning, width);
        } else if line.is_empty() || line.starts_with(' ') {
            let _ = writeln!(lines, "{line}");
        } else {
            paragraph(&mut lines, line, width, "");
        }
    }
    lines.truncate(lines.trim_end().len());
    lines
}

/// A term, the column at which its meaning begins, and the meaning.
fn term(line: &str) -> Option<(&str, usize, &str)> {
    let inside = line.strip_prefix("  ").filter(|it| !it.starts_with(' '))?;
    let (term, behind) = inside.split_once("  ")?;
    let meaning = behind.trim_start();
    Some((term, line.chars().count() - meaning.chars().count(), meaning))
}

fn explained(lines: &mut String, term: &str, column: usize, meaning: &str, width: usize) {
    if width < column + LEAST_ROOM {
        let _ = writeln!(lines, "  {term}");
        return paragraph(lines, meaning, width, CONTINUED);
    }
    let indent = " ".repeat(column);
    let mut beside = String::new();
    paragraph(&mut beside, meaning, width, &indent);
    let space = " ".repeat(column - 2 - term.chars().count());
    let _ = write!(lines, "  {term}{space}{}", &beside[column..]);
}

/// Lines that all begin with the indent.
fn paragraph(lines: &mut String, text: &str, width: usize, indent: &str) {
    let hanging = format!("\n{indent}  ");
    *lines += &wrapped(text, width, indent).replace(&hanging, &format!("\n{indent}"));
}

/// A command, with a backslash where it goes on in another line; a comment that does not fit stands
/// below it.
fn example(lines: &mut String, command: &str, width: usize) {
    let comment = command.find("   #").map_or(command.len(), |at| at);
    let (alone, comment) = command.split_at(comment);
    if EXAMPLE.len() + command.chars().count() <= width {
        let _ = writeln!(lines, "{EXAMPLE}{command}");
        return;
    }
    let (mut rest, mut indent, mut open) = (alone.trim_end(), EXAMPLE, None);
    while indent.len() + rest.chars().count() > width {
        // Two characters are kept for the backslash.
        let room = width.saturating_sub(indent.len() + 2);
        let Some((at, quote)) = break_at(rest, room, open) else { break };
        open = quote;
        let end = if quote.is_some() { "" } else { " \\" };
        let _ = writeln!(lines, "{indent}{}{end}", &rest[..at]);
        (rest, indent) = (&rest[at + 1..], CONTINUED);
    }
    let _ = writeln!(lines, "{indent}{rest}");
    let comment = comment.trim();
    if !comment.is_empty() {
        paragraph(lines, comment, width, "      ");
    }
}

/// The last space within so many characters, better one outside of quotes, and the quote that it is
/// in; `quote` is that of the beginning. A quoted one becomes a new line in what is quoted, so that
/// must bear it.
fn break_at(command: &str, room: usize, mut quote: Option<char>) -> Option<(usize, Option<char>)> {
    let (mut plain, mut quoted) = (None, None);
    for (count, (at, c)) in command.char_indices().enumerate() {
        if count > room {
            break;
        }
        match (c, quote) {
            (' ', None) => plain = Some((at, None)),
            (' ', Some(_)) => quoted = Some((at, quote)),
            ('\'' | '"', None) => quote = Some(c),
            (_, Some(open)) if open == c => quote = None,
            _ => {}
        }
    }
    // A break early in the line is worse than one in quotes.
    plain.filter(|it| it.0 * 3 > room || quoted.is_none()).or(quoted)
}

#[cfg(test)]
mod tests {
    use super::fitted;

    #[test]
    fn an_example_breaks_its_line_where_a_shell_goes_on() {
        let text = "  $ cotama check it --property 'AG (a & b)' --json   # exit code 1";
        assert_eq!(
            fitted(text, 40),
            "  $ cotama check it --property \\\n      'AG (a & b)' --json\n      # exit code 1"
        );
        assert_eq!(fitted(text, 80), text);
        let long = "  $ echo '{\"a\": [1, 2, 3, 4, 5, 6, 7, 8, 9]}'";
        assert_eq!(fitted(long, 30), "  $ echo '{\"a\": [1, 2, 3, 4,\n      5, 6, 7, 8, 9]}'");
        let three = "  $ echo '1 2 3 \"4\" 5 6 7 \"8\" 9'";
        assert_eq!(fitted(three, 18), "  $ echo '1 2 3\n      \"4\" 5 6 7\n      \"8\" 9'");
    }

    #[test]
    fn a_meaning_stands_beside_its_term_or_below_it() {
        let text = "Words:\n  EVENT  offers the event at the time that it is now";
        assert_eq!(
            fitted(text, 38),
            "Words:\n  EVENT  offers the event at the time\n         that it is now"
        );
        assert_eq!(
            fitted(text, 30),
            "Words:\n  EVENT\n      offers the event at the\n      time that it is now"
        );
    }
}
