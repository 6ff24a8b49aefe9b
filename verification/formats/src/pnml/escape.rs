//! Texts with any character in XML 1.0, which cannot hold them all.

use super::encoding::is_xml;
use super::error::{Finding, Span};
use cotama_core::text::marked;
use cotama_property::source::quoted;
use std::borrow::Cow;
use std::fmt::{self, Write as _};

/// The value of an attribute that this project defines: `\u{1b}` stands for a character that XML
/// cannot hold, `\\` for a backslash.
pub(super) fn unescape(value: &str, span: Span) -> Result<String, Finding> {
    let mut text = String::with_capacity(value.len());
    let mut rest = value;
    while let Some((before, escape)) = rest.split_once('\\') {
        text.push_str(before);
        if let Some(after) = escape.strip_prefix('\\') {
            text.push('\\');
            rest = after;
        } else {
            let code = escape.strip_prefix("u{").and_then(|code| code.split_once('}'));
            let character = code.and_then(|(digits, after)| {
                let code = u32::from_str_radix(digits, 16).ok()?;
                Some((char::from_u32(code)?, after))
            });
            let Some((character, after)) = character else {
                return Err(Finding::new(
                    span,
                    format!("{} does not stand for a character", quoted(&rest[before.len()..])),
                )
                .help("a backslash is written `\\\\`, any other character `\\u{1b}`"));
            };
            text.push(character);
            rest = after;
        }
    }
    text.push_str(rest);
    Ok(text)
}

/// A text as the value of an attribute that this project defines, and [`unescape`] reads back.
pub(super) struct Exact<'t>(pub(super) &'t str);

impl fmt::Display for Exact<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (c, hidden) in marked(self.0) {
            match c {
                '\\' => f.write_str("\\\\")?,
                '&' => f.write_str("&amp;")?,
                '<' => f.write_str("&lt;")?,
                '"' => f.write_str("&quot;")?,
                '\t' => f.write_str("&#9;")?,
                '\n' => f.write_str("&#10;")?,
                '\r' => f.write_str("&#13;")?,
                c if is_xml(c) && !hidden => f.write_char(c)?,
                c => write!(f, "\\u{{{:x}}}", u32::from(c))?,
            }
        }
        Ok(())
    }
}

/// A text between tags; what is obeyed or hidden where it is shown is a reference to its code, and
/// U+FFFD stands for what XML cannot hold.
pub(super) struct Content<'t>(pub(super) &'t str);

impl fmt::Display for Content<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (c, hidden) in marked(self.0) {
            match c {
                '\n' => f.write_str("&#10;")?,
                '\t' => f.write_str("&#9;")?,
                '&' => f.write_str("&amp;")?,
                '<' => f.write_str("&lt;")?,
                '>' => f.write_str("&gt;")?,
                '\r' => f.write_str("&#13;")?,
                c if is_xml(c) && hidden => write!(f, "&#x{:x};", u32::from(c))?,
                c if is_xml(c) => f.write_char(c)?,
                _ => f.write_char(char::REPLACEMENT_CHARACTER)?,
            }
        }
        Ok(())
    }
}

/// Whether the text of a `<name>` is read back as it was written; if not, the exact name stands
/// elsewhere as well.
pub(super) fn survives(name: &str) -> bool {
    !name.is_empty() && trimmed(Cow::Borrowed(name)) == name && name.chars().all(is_xml)
}

/// A text without white space around it.
pub(super) fn trimmed(text: Cow<'_, str>) -> Cow<'_, str> {
    match text {
        Cow::Borrowed(text) => Cow::Borrowed(text.trim_matches(super::xml::WHITESPACE)),
        Cow::Owned(text) => Cow::Owned(text.trim_matches(super::xml::WHITESPACE).to_owned()),
    }
}
