//! The styles of the screens, as marks in their texts, and the door through which texts go out.
//!
//! A style is no code of a terminal until its text leaves: [`terminal`] turns marks into codes, and
//! whatever else a terminal would obey into visible ones. A mark holds a key that is drawn anew by
//! each process, so no name in a file can be one.

use anstyle::AnsiColor;
use cotama_core::text;
use std::fmt::{self, Write};
use std::hash::{BuildHasher, RandomState};
use std::sync::LazyLock;

/// A style; as text it is a mark, and with `#` the mark of its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Style(u8);

/// No style.
pub(crate) const PLAIN: Style = Style(0);
/// Titles.
pub(crate) const HEADING: Style = Style(1);
/// Names and commands.
pub(crate) const NAME: Style = Style(2);
/// Style of success.
pub(crate) const GOOD: Style = Style(3);
/// Style of failure.
pub(crate) const BAD: Style = Style(4);
/// Style of notices.
pub(crate) const NOTICE: Style = Style(5);
/// Style of explanations.
pub(crate) const FAINT: Style = Style(6);

/// Styles for families of choices, one after the other.
const FAMILIES: [Style; 6] = [Style(7), NAME, NOTICE, Style(8), Style(9), Style(10)];

/// The end of a style.
const END: u8 = 15;

/// Marks are written in noncharacters, which stand for nothing in any text: this one and 15 more.
const MARKS: u32 = 0xfdd0;
/// How many characters of a mark are its key.
const KEY: usize = 8;

static OWN: LazyLock<[char; KEY]> = LazyLock::new(|| {
    let drawn = RandomState::new().hash_one(MARKS);
    std::array::from_fn(|at| mark((drawn >> (4 * at)) as u8 & 15))
});

fn mark(number: u8) -> char {
    char::from_u32(MARKS + u32::from(number & 15)).unwrap_or('\u{fdd0}')
}

impl fmt::Display for Style {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if *self == PLAIN {
            return Ok(());
        }
        OWN.iter().try_for_each(|&c| f.write_char(c))?;
        f.write_char(mark(if f.alternate() { END } else { self.0 }))
    }
}

impl Style {
    fn ansi(self) -> anstyle::Style {
        match self.0 {
            1 => anstyle::Style::new().bold(),
            2 => AnsiColor::Cyan.on_default(),
            3 => AnsiColor::Green.on_default().bold(),
            4 => AnsiColor::Red.on_default().bold(),
            5 => AnsiColor::Yellow.on_default(),
            6 => anstyle::Style::new().dimmed(),
            7 => AnsiColor::Green.on_default(),
            8 => AnsiColor::Magenta.on_default(),
            9 => AnsiColor::Blue.on_default(),
            10 => AnsiColor::Red.on_default(),
            _ => anstyle::Style::new(),
        }
    }
}

/// A piece of a text: one style, or what stands between two.
enum Piece<'t> {
    Style(Style),
    Text(&'t str),
}

fn pieces(text: &str) -> impl Iterator<Item = Piece<'_>> {
    let key: String = OWN.iter().collect();
    let mut rest = text;
    std::iter::from_fn(move || {
        if rest.is_empty() {
            return None;
        }
        if let Some(after) = rest.strip_prefix(key.as_str()) {
            let number = after.chars().next().map_or(u32::from(END), |it| u32::from(it) - MARKS);
            rest = after.get(mark(0).len_utf8()..).unwrap_or_default();
            return Some(Piece::Style(Style(number as u8)));
        }
        let (piece, after) = rest.split_at(rest.find(key.as_str()).unwrap_or(rest.len()));
        rest = after;
        Some(Piece::Text(piece))
    })
}

/// A text as it goes to a terminal: marks become the codes of styles, and what a terminal would
/// obey is visible. Line ends stay.
pub(crate) fn terminal(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for piece in pieces(text) {
        // Writing to a string cannot fail.
        let _ = match piece {
            Piece::Style(Style(END)) => write!(out, "{}", anstyle::Reset),
            Piece::Style(style) => write!(out, "{}", style.ansi()),
            Piece::Text(text) => {
                let mut lines = text.split('\n');
                let first = lines.next().unwrap_or_default();
                let first = write!(out, "{}", text::visible(first));
                lines.fold(first, |_, line| write!(out, "\n{}", text::visible(line)))
            }
        };
    }
    out
}

/// A text without the marks of styles.
pub(crate) fn unstyled(text: &str) -> String {
    let plain = |it| match it {
        Piece::Text(text) => text,
        Piece::Style(_) => "",
    };
    pieces(text).map(plain).collect()
}

/// Gives each family of choices a style, by the order in which they come: `M5 L2` and `M5 L1` are
/// of the family `M5`.
#[derive(Debug, Default)]
pub(crate) struct Families(Vec<String>);

impl Families {
    /// The style of a choice.
    pub(crate) fn style(&mut self, choice: &str) -> Style {
        let family = choice.split(' ').next().unwrap_or(choice);
        let place = self.0.iter().position(|known| known == family).unwrap_or_else(|| {
            self.0.push(family.to_owned());
            self.0.len() - 1
        });
        FAMILIES[place % FAMILIES.len()]
    }
}

#[cfg(test)]
mod tests {
    use super::{BAD, NAME, PLAIN, mark, terminal, unstyled};

    #[test]
    fn a_mark_becomes_a_code_and_a_code_of_a_name_is_shown() {
        let text = format!("{BAD}no{BAD:#} {PLAIN}\u{1b}[31m\u{9b}1m{PLAIN:#}\n\u{202e}{NAME}x");
        assert_eq!(
            terminal(&text),
            "\u{1b}[1m\u{1b}[31mno\u{1b}[0m \\u{1b}[31m\\u{9b}1m\n\\u{202e}\u{1b}[36mx"
        );
        assert_eq!(unstyled(&format!("{BAD}no{BAD:#}\u{1b}")), "no\u{1b}");
    }

    #[test]
    fn marks_without_the_key_of_the_process_are_no_styles() {
        let forged: String = (0..16).map(mark).collect();
        assert!(!terminal(&forged.repeat(9)).contains('\u{1b}'));
        assert!(terminal(&forged).starts_with("\\u{fdd0}\\u{fdd1}"));
    }
}
