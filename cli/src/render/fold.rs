//! Lines that are wider than the screen, broken between words.

/// What begins a line that is to be copied as a whole.
const WHOLE: [&str; 4] = ["next: ", "report: ", "trace: ", "written: "];

/// The text with each line at most so wide, as far as its words allow. Where a line is broken, it
/// goes on under the last column that begins in its first two thirds, or behind its indent.
pub(crate) fn folded(text: &str, width: usize) -> String {
    let mut lines = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        let seen = shown(line.trim_end_matches('\n'));
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
    for (index, word) in line.split(' ').enumerate() {
        let length = shown(word.trim_end_matches('\n')).chars().count();
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

/// How far the rest of a line is indented.
fn hanging(line: &str, width: usize) -> usize {
    let characters: Vec<char> = line.chars().collect();
    let start = characters.iter().take_while(|it| **it == ' ').count();
    let begins = |at: &usize| characters[*at] != ' ' && characters[at - 2..*at] == [' ', ' '];
    let most = (width * 2 / 3).min(characters.len());
    let column = (start + 3..most).rev().find(begins);
    column.unwrap_or_else(|| (start + 2).min(width / 2))
}

/// What a terminal shows of a line: not the codes of styles.
fn shown(line: &str) -> String {
    let mut shown = String::with_capacity(line.len());
    let mut rest = line;
    while let Some((before, code)) = rest.split_once('\u{1b}') {
        shown += before;
        rest = code.split_once('m').map_or("", |it| it.1);
    }
    shown + rest
}

#[cfg(test)]
mod tests {
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
    fn styles_take_no_room_and_commands_stay_whole() {
        let styled = "\u{1b}[1mone\u{1b}[0m two \u{1b}[2mthree\u{1b}[0m\n";
        assert_eq!(folded(styled, 13), styled);
        assert_eq!(folded(styled, 9), "\u{1b}[1mone\u{1b}[0m two\n  \u{1b}[2mthree\u{1b}[0m\n");
        let command = "next: \u{1b}[1mcotama run patrol --trace run.jsonl\u{1b}[0m\n";
        assert_eq!(folded(command, 20), command);
    }
}
