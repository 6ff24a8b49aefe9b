//! Lines that are wider than the screen, broken between words.

use super::style::unstyled;

/// Beginnings of lines that are to be copied as a whole.
const WHOLE: [&str; 4] = ["next: ", "report: ", "trace: ", "written: "];

/// The text with each line at most so wide, as far as its words allow. Where a line is broken, it
/// goes on under the last column that begins in its first two thirds, or behind its indent.
pub(crate) fn folded(text: &str, width: usize) -> String {
    let mut lines = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        let seen = unstyled(line.trim_end_matches('\n'));
        if seen.chars().count() <= width || WHOLE.iter().any(|it| seen.starts_with(it)) {
            lines += line;
            continue;
        }
        fold(&mut lines, line, width, hanging(&seen, width));
    }
    lines
}

fn fold(lines: &mut String, line: &str, width: usize, hanging: usize) {
    let mut used = 0;
    for (index, word) in words(line).into_iter().enumerate() {
        let length = unstyled(word.trim_end_matches('\n')).chars().count();
        if index > 0 && used > hanging && used + 1 + length > width {
            lines.truncate(lines.trim_end_matches(' ').len());
            lines.push('\n');
            lines.extend(std::iter::repeat_n(' ', hanging));
            used = hanging;
        } else if index > 0 {
            lines.push(' ');
            used += 1;
        }
        *lines += word;
        used += length;
    }
}

/// Units that stand behind a number.
const UNITS: [&str; 15] =
    ["%", "B", "GiB", "J", "kJ", "KiB", "m", "m/s", "MiB", "min", "mJ", "mm", "mm/s", "ms", "s"];

/// The words of a line: what stands between blanks, a number with its unit and with its further
/// digits as one.
pub(super) fn words(line: &str) -> Vec<&str> {
    let mut words: Vec<&str> = Vec::new();
    let (mut begin, mut next) = (0, 0);
    for word in line.split(' ') {
        let end = next + word.len();
        let seen = unstyled(word);
        let unit = seen.trim_end_matches([',', ';', '.', ':', ')', '\n']);
        let is_digits = unit.len() == 3 && unit.bytes().all(|it| it.is_ascii_digit());
        let before = words.last().map_or(String::new(), |it| unstyled(it));
        let number = before.ends_with(|c: char| c.is_ascii_digit());
        if number && (is_digits || UNITS.contains(&unit)) {
            words.pop();
        } else {
            begin = next;
        }
        words.push(&line[begin..end]);
        next = end + 1;
    }
    words
}

/// How far the rest of a line is indented.
fn hanging(line: &str, width: usize) -> usize {
    let characters: Vec<char> = line.chars().collect();
    let start = characters.iter().take_while(|it| **it == ' ').count();
    let begins = |at: &usize| characters[*at] != ' ' && characters[at - 2..*at] == [' ', ' '];
    let most = (width * 2 / 3).min(characters.len());
    let column = (start + 3..most).rev().find(begins);
    column.unwrap_or_else(|| (start + 2).min(width / 2))
}

#[cfg(test)]
mod tests {
    use super::super::style::{FAINT, HEADING, NAME};
    use super::folded;

    #[test]
    fn a_line_goes_on_under_its_last_column() {
        let line = "  170.0 m  the position was wrong, 1500 mm more\n";
        assert_eq!(
            folded(line, 30),
            "  170.0 m  the position was\n           wrong, 1500 mm more\n"
        );
        assert_eq!(folded(line, 80), line);
        assert_eq!(folded("one two three four", 11), "one two\n  three\n  four");
    }

    #[test]
    fn a_number_stays_with_its_unit_and_its_digits() {
        for (text, folds) in [
            ("left −30182.2 J", "left\n  −30182.2 J"),
            ("after 10 000 000 runs", "after\n  10 000 000\n  runs"),
            ("stops at 1069 mm/s, 3 m", "stops at\n  1069 mm/s,\n  3 m"),
            ("needs 12 % more", "needs 12 %\n  more"),
            ("of 4 robots", "of 4\n  robots"),
        ] {
            assert_eq!(folded(text, if text.starts_with("of") { 9 } else { 12 }), folds);
        }
    }

    #[test]
    fn styles_take_no_room_and_commands_stay_whole() {
        let styled = format!("{HEADING}one{HEADING:#} two {FAINT}three{FAINT:#}\n");
        assert_eq!(folded(&styled, 13), styled);
        assert_eq!(
            folded(&styled, 9),
            format!("{HEADING}one{HEADING:#} two\n  {FAINT}three{FAINT:#}\n")
        );
        let command = format!("next: {NAME}cotama run patrol --trace run.jsonl{NAME:#}\n");
        assert_eq!(folded(&command, 20), command);
    }
}
