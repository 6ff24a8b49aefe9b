//! Words and signs of a file in BIF.

use crate::wrong::{Wrong, place};

/// A word or a sign, and where it begins, in bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Token<'t> {
    pub(super) at: usize,
    pub(super) is: Is<'t>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Is<'t> {
    /// A name or a number, also between quotes.
    Word(&'t str),
    /// One of `{ } ( ) [ ] ;`.
    Sign(char),
    End,
}

/// Reads words one after the other.
#[derive(Clone, Debug)]
pub(super) struct Lexer<'t> {
    text: &'t str,
    at: usize,
}

/// Characters that end a word without a quote.
const ENDS: [char; 11] = ['{', '}', '(', ')', '[', ']', ';', ',', '|', '"', '\u{feff}'];

impl<'t> Lexer<'t> {
    pub(super) fn new(text: &'t str) -> Self {
        Self { text, at: 0 }
    }

    pub(super) fn wrong(&self, at: usize, message: impl Into<String>) -> Wrong {
        Wrong::at(place(self.text, at), message)
    }

    fn rest(&self) -> &'t str {
        self.text.get(self.at..).unwrap_or("")
    }

    /// Passes over white space, commas, bars and comments.
    fn space(&mut self) -> Result<(), Wrong> {
        loop {
            let rest = self.rest();
            let blank = |it: char| it.is_whitespace() || [',', '|', '\u{feff}'].contains(&it);
            let bare = rest.trim_start_matches(blank);
            self.at += rest.len() - bare.len();
            if bare.starts_with("//") {
                self.at += bare.find('\n').unwrap_or(bare.len());
            } else if bare.starts_with("/*") {
                let Some(end) = bare.find("*/") else {
                    return Err(self.wrong(self.at, "this comment does not end"));
                };
                self.at += end + 2;
            } else {
                return Ok(());
            }
        }
    }

    /// The next word or sign.
    pub(super) fn next(&mut self) -> Result<Token<'t>, Wrong> {
        self.space()?;
        let (at, rest) = (self.at, self.rest());
        let Some(first) = rest.chars().next() else { return Ok(Token { at, is: Is::End }) };
        if let Some(inside) = rest.strip_prefix('"') {
            let Some((word, _)) = inside.split_once('"') else {
                return Err(self.wrong(at, "this quote does not end"));
            };
            self.at += word.len() + 2;
            return Ok(Token { at, is: Is::Word(word) });
        }
        if ENDS.contains(&first) {
            self.at += first.len_utf8();
            return Ok(Token { at, is: Is::Sign(first) });
        }
        let ends = |it: char| it.is_whitespace() || ENDS.contains(&it);
        let end = rest.find(ends).unwrap_or(rest.len());
        let first = first.len_utf8();
        let comment = ["//", "/*"].iter().filter_map(|it| rest[first..end].find(it)).min();
        let word = &rest[..comment.map_or(end, |it| it + first)];
        self.at += word.len();
        Ok(Token { at, is: Is::Word(word) })
    }

    /// The next word or sign, which is read again after.
    pub(super) fn peek(&self) -> Result<Token<'t>, Wrong> {
        self.clone().next()
    }

    /// The next word, which is a name.
    pub(super) fn name(&mut self, what: &str) -> Result<(usize, &'t str), Wrong> {
        match self.next()? {
            Token { at, is: Is::Word(word) } if !word.is_empty() => Ok((at, word)),
            other => Err(self.needed(other, what)),
        }
    }

    /// The next sign, which is this one.
    pub(super) fn sign(&mut self, sign: char) -> Result<usize, Wrong> {
        match self.next()? {
            Token { at, is: Is::Sign(found) } if found == sign => Ok(at),
            other => Err(self.needed(other, &format!("`{sign}`"))),
        }
    }

    /// All words up to a sign.
    pub(super) fn words(&mut self, end: char) -> Result<Vec<(usize, &'t str)>, Wrong> {
        let mut words = Vec::new();
        loop {
            match self.next()? {
                Token { at, is: Is::Word(word) } => words.push((at, word)),
                Token { is: Is::Sign(found), .. } if found == end => return Ok(words),
                other => return Err(self.needed(other, &format!("`{end}`"))),
            }
        }
    }

    /// Passes over a property, which is any text up to a semicolon outside of quotes.
    pub(super) fn property(&mut self) -> Result<(), Wrong> {
        loop {
            match self.next()? {
                Token { is: Is::Sign(';'), .. } => return Ok(()),
                Token { at, is: Is::End } => return Err(self.ended(at)),
                _ => {}
            }
        }
    }

    fn ended(&self, at: usize) -> Wrong {
        // The end of the last line that says something, not of white space behind it.
        let last = self.text.get(..at).unwrap_or("").trim_end().len();
        self.wrong(last, "the file ends inside a block").help("is it whole?")
    }

    pub(super) fn needed(&self, found: Token<'_>, what: &str) -> Wrong {
        match found.is {
            Is::End => self.ended(found.at),
            Is::Word(word) => self.wrong(found.at, format!("{what} is needed here, not `{word}`")),
            Is::Sign(sign) => self.wrong(found.at, format!("{what} is needed here, not `{sign}`")),
        }
    }
}
