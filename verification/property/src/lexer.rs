//! The words of the property language.

use super::error::Fault;
use crate::source::quoted;
use std::fmt::Write as _;
use std::ops::Range;

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Token<'a> {
    /// A name without quotes, or a word of the language.
    Word(&'a str),
    /// A name in quotes or braces.
    Quoted(String),
    Number(u64),
    Symbol(&'static str),
    End,
}

pub(super) struct Lexeme<'a> {
    pub(super) token: Token<'a>,
    pub(super) span: Range<usize>,
}

/// A symbol stands before those that it starts with.
const SYMBOLS: [&str; 22] = [
    "<->", "->", "<=", ">=", "==", "!=", "||", "&&", "<", ">", "=", "|", "&", "!", "(", ")", "[",
    "]", "+", "-", "*", ",",
];

/// Words that a place of the same name needs quotes for.
const WORDS: [&str; 25] = [
    "A",
    "E",
    "X",
    "F",
    "G",
    "U",
    "AX",
    "EX",
    "AF",
    "EF",
    "AG",
    "EG",
    "and",
    "or",
    "not",
    "true",
    "false",
    "deadlock",
    "fireable",
    "bounds",
    "bound",
    "live",
    "quasi_live",
    "stable",
    "one_safe",
];

/// The words of a text, the last of them its end.
pub(super) fn lexemes(text: &str) -> Result<Vec<Lexeme<'_>>, Fault> {
    let mut list = Vec::new();
    let mut at = 0;
    loop {
        let rest = &text[at..];
        at += rest.len() - rest.trim_start().len();
        let rest = &text[at..];
        let Some(first) = rest.chars().next() else { break };
        let (token, length) = if first == '"' || first == '{' {
            name(rest, at)?
        } else if first.is_ascii_digit() {
            number(rest, at)?
        } else if let length @ 1.. = word(rest) {
            (Token::Word(&rest[..length]), length)
        } else if let Some(symbol) = SYMBOLS.into_iter().find(|symbol| rest.starts_with(symbol)) {
            (Token::Symbol(symbol), symbol.len())
        } else {
            let fault = Fault::new(
                at..at + first.len_utf8(),
                format!("{} is not part of the language", quoted(&first.to_string())),
            );
            return Err(fault.help("put a name with such characters in quotes, as in `\"a b\"`"));
        };
        list.push(Lexeme { token, span: at..at + length });
        at += length;
    }
    list.push(Lexeme { token: Token::End, span: text.len()..text.len() });
    Ok(list)
}

/// How long the word is that a text starts with; 0 without one.
fn word(text: &str) -> usize {
    let part = |c: char| c.is_alphanumeric() || c == '_' || c == '\'';
    if !text.starts_with(|c: char| c.is_alphabetic() || c == '_') {
        return 0;
    }
    let mut length = 0;
    loop {
        length += text[length..].find(|c| !part(c)).unwrap_or(text.len() - length);
        let dotted = text[length..].strip_prefix('.').is_some_and(|rest| rest.starts_with(part));
        if !dotted {
            return length;
        }
        length += 1;
    }
}

fn number(text: &str, at: usize) -> Result<(Token<'_>, usize), Fault> {
    let length = text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    let number = text[..length].parse().map_err(|_| {
        Fault::new(at..at + length, format!("the number {} is too large", quoted(&text[..length])))
            .help(format!("the largest is {}", u64::MAX))
    })?;
    Ok((Token::Number(number), length))
}

/// The name in quotes or braces that a text starts with.
fn name(text: &str, start: usize) -> Result<(Token<'_>, usize), Fault> {
    let quotes = text.starts_with('"');
    let (close, escapes) = if quotes {
        ('"', "`\\\"`, `\\\\` and `\\u{1b}`")
    } else {
        ('}', "`\\{`, `\\}` and `\\\\`")
    };
    let mut name = String::new();
    let mut characters = text.char_indices().skip(1);
    while let Some((at, character)) = characters.next() {
        match character {
            _ if character == close => return Ok((Token::Quoted(name), at + 1)),
            '\\' => {
                let escaped = characters.next().map_or('\0', |(_, escaped)| escaped);
                match escaped {
                    '\\' => name.push('\\'),
                    '"' if quotes => name.push('"'),
                    '{' | '}' if !quotes => name.push(escaped),
                    'u' if quotes => {
                        let code =
                            text[at + 2..].strip_prefix('{').and_then(|rest| rest.split_once('}'));
                        let code =
                            code.map(|(code, _)| code).filter(|code| (1..=6).contains(&code.len()));
                        let character =
                            code.filter(|code| code.bytes().all(|byte| byte.is_ascii_hexdigit()));
                        let character =
                            character.and_then(|code| u32::from_str_radix(code, 16).ok());
                        let Some(character) = character.and_then(char::from_u32) else {
                            return Err(Fault::new(
                                start + at..start + at + 2,
                                "this is not the code of a character",
                            )
                            .help("write it as in `\\u{1b}`"));
                        };
                        name.push(character);
                        // The code and its braces are ASCII.
                        characters.nth(code.map_or(0, str::len) + 1);
                    }
                    _ => {
                        return Err(Fault::new(
                            start + at..start + at + 1,
                            "this `\\` escapes nothing",
                        )
                        .help(format!("in such names there are {escapes}")));
                    }
                }
            }
            '{' if !quotes => {
                return Err(Fault::new(start + at..start + at + 1, "a brace in a name in braces")
                    .help("write `\\{`, or close the name with `}` before"));
            }
            _ => name.push(character),
        }
    }
    Err(Fault::new(start..start + 1, "the name that starts here is not closed")
        .help(format!("write `{close}` at its end")))
}

pub(super) fn is_reserved(word: &str) -> bool {
    WORDS.contains(&word)
}

/// A name as the language writes it.
pub(super) fn written(name: &str) -> String {
    if word(name) == name.len() && !name.is_empty() && !is_reserved(name) {
        return name.to_owned();
    }
    let mut text = String::from("\"");
    for (c, hidden) in cotama_core::text::marked(name) {
        if c == '"' || c == '\\' {
            text.push('\\');
        }
        if hidden {
            let _ = write!(text, "{}", c.escape_unicode()); // writing to a String cannot fail
        } else {
            text.push(c);
        }
    }
    text.push('"');
    text
}
