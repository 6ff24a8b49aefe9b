//! Characters of a text that are obeyed or hidden where it is shown.
//!
//! Names and texts from files and command lines can hold what moves a cursor, turns the direction
//! of what follows, or cannot be seen. Everything that writes such a text, for a terminal or in a
//! file of another tool, asks here which characters those are.

#[cfg(feature = "alloc")]
use alloc::string::String;
use core::fmt::{self, Write};

/// Whether a terminal, an editor or a page obeys or hides a character in any text: controls (C0,
/// DEL and C1), marks of direction, separators of lines, what has no width, and noncharacters.
///
/// ```
/// use cotama_core::text::is_obeyed;
/// assert!(['\u{1b}', '\u{9b}', '\u{202e}', '\u{2028}', '\u{200b}'].into_iter().all(is_obeyed));
/// assert!(['a', 'ß', '語', ' ', '🤖'].into_iter().all(|c| !is_obeyed(c)));
/// ```
#[must_use]
pub const fn is_obeyed(c: char) -> bool {
    matches!(
        c,
        '\0'..='\x1f'
            | '\x7f'..='\u{9f}'
            | '\u{ad}'
            | '\u{34f}'
            | '\u{61c}'
            | '\u{115f}'..='\u{1160}'
            | '\u{17b4}'..='\u{17b5}'
            | '\u{180b}'..='\u{180f}'
            | '\u{200b}'
            | '\u{200e}'..='\u{200f}'
            | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}'
            | '\u{3164}'
            | '\u{fdd0}'..='\u{fdef}'
            | '\u{feff}'
            | '\u{ffa0}'
            | '\u{fff0}'..='\u{fffb}'
            | '\u{1bca0}'..='\u{1bca3}'
            | '\u{1d173}'..='\u{1d17a}'
            | '\u{e0000}'..='\u{e00ff}'
    ) || (c as u32) & 0xfffe == 0xfffe
}

/// Whether a character chooses how the one before it looks.
const fn is_selector(c: char) -> bool {
    matches!(c, '\u{fe00}'..='\u{fe0f}' | '\u{e0100}'..='\u{e01ef}')
}

/// Whether a character is of a writing in which joiners and selectors mean something: not Latin,
/// Greek, Cyrillic and their neighbours.
const fn joins(c: char) -> bool {
    c > '\u{5ff}' && !is_obeyed(c) && !is_selector(c) && !matches!(c, '\u{200c}' | '\u{200d}')
}

/// The characters of a text, each with whether it is obeyed or hidden there: as [`is_obeyed`] says,
/// and joiners and selectors of variants between letters that they do not belong to.
///
/// ```
/// use cotama_core::text::marked;
/// let hidden = |text| marked(text).filter(|it| it.1).count();
/// assert_eq!(hidden("pay\u{200d}pal"), 1);
/// assert_eq!(hidden("❤\u{fe0f}\u{200d}🔥"), 0);
/// ```
pub fn marked(text: &str) -> impl Iterator<Item = (char, bool)> + '_ {
    let mut rest = text.chars();
    let mut before = false;
    core::iter::from_fn(move || {
        let c = rest.next()?;
        let hidden = match c {
            '\u{200c}' | '\u{200d}' => !(before && rest.clone().next().is_some_and(joins)),
            _ if is_selector(c) => !before,
            _ => is_obeyed(c),
        };
        if !is_selector(c) {
            before = joins(c);
        }
        Some((c, hidden))
    })
}

/// A text in which what is obeyed or hidden is written as its code, as `\u{202e}`.
///
/// ```
/// use cotama_core::text::visible;
/// assert_eq!(visible("a\u{1b}[31m\u{202e}é\n").to_string(), r"a\u{1b}[31m\u{202e}é\u{a}");
/// ```
#[must_use]
pub const fn visible(text: &str) -> Coded<'_> {
    Coded { text, code: Code::Rust }
}

/// A text of JSON in which what is obeyed or hidden is escaped, as `\u202e`: it means the same.
/// Line ends and tabs stay, which JSON has between values only.
///
/// ```
/// use cotama_core::text::json;
/// assert_eq!(json("{\"a\": \"\u{202e}\u{e0041}\"}\n").to_string(),
///     "{\"a\": \"\\u202e\\udb40\\udc41\"}\n");
/// ```
#[must_use]
pub const fn json(text: &str) -> Coded<'_> {
    Coded { text, code: Code::Json }
}

/// A text of TOML in which what is obeyed or hidden is escaped, as `\u202E`: it means the same in a
/// string between double quotes and in a comment. Line ends and tabs stay.
///
/// ```
/// use cotama_core::text::toml;
/// assert_eq!(toml("a = \"\u{202e}\u{e0041}\"\n").to_string(), "a = \"\\u202E\\U000E0041\"\n");
/// ```
#[must_use]
pub const fn toml(text: &str) -> Coded<'_> {
    Coded { text, code: Code::Toml }
}

/// Returns a text for elements and attributes of HTML and XML. What is obeyed or hidden where a
/// text is shown is written as its code, as `\u{202e}`: so are the characters that XML 1.0 cannot
/// hold.
///
/// ```
/// use cotama_core::text::markup;
/// assert_eq!(markup("a<b> & \"c\"\n\0"), "a&lt;b&gt; &amp; &quot;c&quot;&#10;\\u{0}");
/// assert_eq!(markup("</a b='\u{7}\u{202e}"), "&lt;/a b=&#39;\\u{7}\\u{202e}");
/// ```
#[cfg(feature = "alloc")]
#[must_use]
pub fn markup(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for (c, hidden) in marked(text) {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            '\t' => escaped.push_str("&#9;"),
            '\n' => escaped.push_str("&#10;"),
            '\r' => escaped.push_str("&#13;"),
            _ if hidden => escaped.extend(c.escape_unicode()),
            _ => escaped.push(c),
        }
    }
    escaped
}

/// A text with codes in place of what is obeyed or hidden; it is displayed.
#[derive(Clone, Copy, Debug)]
pub struct Coded<'t> {
    text: &'t str,
    code: Code,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Code {
    Rust,
    Json,
    Toml,
}

impl fmt::Display for Coded<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (c, hidden) in marked(self.text) {
            let stays = self.code != Code::Rust && matches!(c, '\n' | '\r' | '\t');
            if !hidden || stays {
                f.write_char(c)?;
                continue;
            }
            match self.code {
                Code::Rust => write!(f, "{}", c.escape_unicode())?,
                Code::Json => {
                    for unit in c.encode_utf16(&mut [0; 2]) {
                        write!(f, "\\u{unit:04x}")?;
                    }
                }
                Code::Toml if c <= '\u{ffff}' => write!(f, "\\u{:04X}", u32::from(c))?,
                Code::Toml => write!(f, "\\U{:08X}", u32::from(c))?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::{is_obeyed, marked, visible};
    use std::string::ToString;

    #[test]
    fn every_control_every_mark_of_direction_and_every_separator_is_obeyed() {
        let all = (0..=0x1f).chain(0x7f..=0x9f).chain([0x61c, 0x200e, 0x200f, 0xfeff]);
        let all = all.chain(0x2028..=0x202e).chain(0x2066..=0x2069).chain([0xfffe, 0x10_ffff]);
        for code in all {
            let c = char::from_u32(code).unwrap();
            assert!(is_obeyed(c), "{code:x}");
            assert!(c.is_control() || !is_obeyed(' '));
        }
        assert!(('\0'..=char::MAX).filter(|c| c.is_control()).all(is_obeyed));
    }

    #[test]
    fn letters_of_any_writing_stay() {
        for text in
            ["Tür", "дверь", "باب", "דלת", "ประตู", "門", "🚪", "a\u{301}", "–·…", "\u{fffd}"]
        {
            assert_eq!(visible(text).to_string(), text);
        }
    }

    #[test]
    fn joiners_stay_where_they_join_and_show_where_they_mislead() {
        for text in
            ["👩\u{200d}🚒", "❤\u{fe0f}\u{200d}🔥", "می\u{200c}خواهم", "क्\u{200d}ष", "☀\u{fe0f}"]
        {
            assert!(marked(text).all(|it| !it.1), "{text}");
        }
        for text in
            ["a\u{200d}b", "\u{200d}門", "門\u{200d}", "a\u{fe0f}", "門\u{200d}a", "\u{200c}"]
        {
            assert_eq!(marked(text).filter(|it| it.1).count(), 1, "{text:?}");
        }
    }
}
