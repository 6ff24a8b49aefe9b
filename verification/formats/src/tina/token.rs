//! The words and signs of a file.

use super::error::Finding;
use cotama_property::source::quoted;
use std::borrow::Cow;

/// A word or a sign.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Token<'t> {
    /// Letters, digits, `'` and `_`: a keyword, a name or a number, as its place says.
    Bare(&'t str),
    /// A name in braces, without them and without its escapes.
    Braced(Cow<'t, str>),
    /// `->`
    Arrow,
    /// One of `: ( ) [ ] , * ? ! - < >`
    Sign(char),
    /// Nothing is left.
    End,
}

impl Token<'_> {
    /// As a message names it.
    pub(super) fn shown(&self) -> String {
        match self {
            Self::Bare(word) => quoted(word),
            Self::Braced(name) => quoted(&format!("{{{name}}}")),
            Self::Arrow => "`->`".to_owned(),
            Self::Sign(sign) => format!("`{sign}`"),
            Self::End => "the end of the file".to_owned(),
        }
    }
}

/// A file, from the byte where reading stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tokens<'t> {
    text: &'t str,
    at: usize,
}

impl<'t> Tokens<'t> {
    pub(super) fn new(text: &'t str) -> Self {
        Self { text, at: 0 }
    }

    /// The next token and the byte where it starts.
    pub(super) fn next(&mut self) -> Result<(usize, Token<'t>), Finding> {
        loop {
            let rest = &self.text[self.at..];
            let start = self.at;
            let Some(first) = rest.chars().next() else { return Ok((start, Token::End)) };
            let length = match first {
                ' ' | '\t' | '\r' | '\n' => {
                    self.at += 1;
                    continue;
                }
                '#' => {
                    self.at += rest.find('\n').unwrap_or(rest.len());
                    continue;
                }
                _ if in_name(first) => rest.find(|c| !in_name(c)).unwrap_or(rest.len()),
                '-' if rest.starts_with("->") => 2,
                '{' => {
                    let (name, length) =
                        braced(rest).map_err(|(at, message)| Finding::new(start + at, message))?;
                    self.at += length;
                    return Ok((start, Token::Braced(name)));
                }
                ':' | '(' | ')' | '[' | ']' | ',' | '*' | '?' | '!' | '-' | '<' | '>' => 1,
                '.' => {
                    return Err(Finding::new(start, "a dot cannot stand here")
                        .help("a name with a dot needs braces: `{a.b}`; numbers are integers"));
                }
                _ => {
                    let shown = quoted(first.encode_utf8(&mut [0; 4]));
                    return Err(Finding::new(
                        start,
                        format!(
                            "the character {shown} cannot stand \
                        here"
                        ),
                    )
                    .help(
                        "a name with other characters than letters, digits, `'` and `_` \
                            needs braces: `{a b}`",
                    ));
                }
            };
            self.at += length;
            let token = match (first, length) {
                ('-', 2) => Token::Arrow,
                _ if in_name(first) => Token::Bare(&rest[..length]),
                _ => Token::Sign(first),
            };
            return Ok((start, token));
        }
    }
}

/// Whether a name without braces may have this character.
pub(super) fn in_name(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '\'' || c == '_'
}

/// The name at the start of a text that begins with a brace, and how many bytes it takes; or what
/// is wrong, and where.
fn braced(text: &str) -> Result<(Cow<'_, str>, usize), (usize, &'static str)> {
    let mut name = Cow::Borrowed("");
    let mut start = 1;
    let mut escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        match c {
            '{' | '}' | '\\' if escaped => escaped = false,
            _ if escaped => {
                return Err((at - 1, "a backslash in a name stands before `{`, `}` or `\\` only"));
            }
            '\\' => {
                name += &text[start..at];
                (start, escaped) = (at + 1, true);
            }
            '{' => return Err((at, "a brace in a name needs a backslash: `\\{`")),
            '}' => {
                name += &text[start..at];
                return Ok((name, at + 1));
            }
            _ => {}
        }
    }
    Err((0, "this name is not closed before the file ends"))
}
