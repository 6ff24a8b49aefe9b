//! JSON (RFC 8259) read once, from the front to the back, with the place of everything.

use crate::missions::Diagnostic;
use std::ops::Range;

/// Values are read to this depth.
pub(crate) const MAX_DEPTH: usize = 64;

/// Advice on a text that is no JSON.
#[derive(Debug)]
pub(crate) struct Advice {
    /// The remedy.
    pub(crate) help: &'static str,
    /// The cure for a number of another language that JSON does not have.
    pub(crate) no_number: &'static str,
}

/// The error that ends the reading: the text is no JSON.
pub(crate) type Broken = Diagnostic;

/// The type of a value, by its first letter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shape {
    Object,
    List,
    Text,
    Number,
    Word,
}

impl Shape {
    pub(crate) const fn words(self) -> &'static str {
        match self {
            Self::Object => "an object",
            Self::List => "a list",
            Self::Text => "a text",
            Self::Number => "a number",
            Self::Word => "a word",
        }
    }
}

/// A text and how far it has been read.
#[derive(Debug)]
pub(crate) struct Json<'t> {
    text: &'t str,
    at: usize,
    advice: &'static Advice,
}

impl<'t> Json<'t> {
    /// From the front on, behind a byte order mark if there is one.
    pub(crate) fn new(text: &'t str, advice: &'static Advice) -> Self {
        Self { text, at: if text.starts_with('\u{feff}') { 3 } else { 0 }, advice }
    }

    /// The place of the next value, before it is read.
    pub(crate) fn start(&mut self) -> usize {
        self.space();
        self.at
    }

    /// The place from there to what was read last.
    pub(crate) const fn since(&self, start: usize) -> Range<usize> {
        start..self.at
    }

    /// Returns the type of the next value.
    pub(crate) fn shape(&mut self) -> Result<Shape, Broken> {
        self.space();
        match self.next() {
            Some(b'{') => Ok(Shape::Object),
            Some(b'[') => Ok(Shape::List),
            Some(b'"') => Ok(Shape::Text),
            Some(b'-') if self.rest().starts_with("-I") => Err(self.no_value()),
            Some(b'-' | b'0'..=b'9') => Ok(Shape::Number),
            Some(b't' | b'f' | b'n') if !self.rest().starts_with("nan") => Ok(Shape::Word),
            _ => Err(self.no_value()),
        }
    }

    /// No value begins here, but perhaps a word of another language.
    fn no_value(&self) -> Broken {
        let rest = self.rest();
        let unsigned = rest.strip_prefix('-').unwrap_or(rest);
        let end = |it: char| !it.is_ascii_alphanumeric();
        let word = unsigned.split(end).next().unwrap_or("");
        let said = match word {
            "NaN" | "nan" | "Infinity" | "inf" => self.advice.no_number,
            "None" | "True" | "False" | "undefined" => {
                "this is no word of JSON: write `null`, `true` or `false`"
            }
            _ if rest.starts_with('\'') => "a text stands in double quotation marks",
            _ => "a value is needed here",
        };
        self.broken(said)
    }

    /// Reads an object; `member` reads the value of each key, whose place is given.
    pub(crate) fn object(
        &mut self,
        mut member: impl FnMut(&mut Self, &str, Range<usize>) -> Result<(), Broken>,
    ) -> Result<(), Broken> {
        self.expect(b'{', "`{` is needed here")?;
        if self.take(b'}') {
            return Ok(());
        }
        loop {
            let start = self.start();
            if self.next() != Some(b'"') {
                return Err(self.broken("a key in quotation marks is needed here"));
            }
            let key = self.text()?;
            let span = self.since(start);
            self.expect(b':', "`:` is needed behind a key")?;
            member(self, &key, span)?;
            if self.take(b'}') {
                return Ok(());
            }
            self.expect(b',', "`,` or `}` is needed here")?;
        }
    }

    /// Reads a list; `element` reads the one of each number.
    pub(crate) fn list(
        &mut self,
        mut element: impl FnMut(&mut Self, usize) -> Result<(), Broken>,
    ) -> Result<(), Broken> {
        self.expect(b'[', "`[` is needed here")?;
        if self.take(b']') {
            return Ok(());
        }
        let mut number = 0;
        loop {
            element(self, number)?;
            number += 1;
            if self.take(b']') {
                return Ok(());
            }
            self.expect(b',', "`,` or `]` is needed here")?;
        }
    }

    /// Reads a text.
    pub(crate) fn text(&mut self) -> Result<String, Broken> {
        self.expect(b'"', "a text is needed here")?;
        let mut text = String::new();
        loop {
            let rest = self.rest();
            let end = rest.find(|c: char| c == '"' || c == '\\' || c < ' ').unwrap_or(rest.len());
            text += &rest[..end];
            self.at += end;
            match self.next() {
                Some(b'"') => {
                    self.at += 1;
                    return Ok(text);
                }
                Some(b'\\') => text.push(self.escaped()?),
                _ => return Err(self.broken("a text ends with `\"`, on the line where it begins")),
            }
        }
    }

    /// Reads the character behind a backslash.
    fn escaped(&mut self) -> Result<char, Broken> {
        let wrong = "after `\\` comes one of \" \\ / b f n r t, or u and four digits";
        self.at += 1;
        let one = match self.next() {
            Some(it @ (b'"' | b'\\' | b'/')) => char::from(it),
            Some(b'b') => '\u{8}',
            Some(b'f') => '\u{c}',
            Some(b'n') => '\n',
            Some(b'r') => '\r',
            Some(b't') => '\t',
            Some(b'u') => {
                self.at += 1;
                let first = self.unit(wrong)?;
                if !(0xd800..0xdc00).contains(&first) {
                    return char::from_u32(first).ok_or_else(|| self.broken(wrong));
                }
                if !self.rest().starts_with("\\u") {
                    return Err(
                        self.broken("the second half of a pair `\\uD800\\uDC00` is missing")
                    );
                }
                self.at += 2;
                let second = self.unit(wrong)?;
                let low = second.checked_sub(0xdc00).filter(|it| *it < 0x400);
                let whole = low.map(|it| 0x1_0000 + ((first - 0xd800) << 10) + it);
                return whole.and_then(char::from_u32).ok_or_else(|| self.broken(wrong));
            }
            _ => return Err(self.broken(wrong)),
        };
        self.at += 1;
        Ok(one)
    }

    /// Four hexadecimal digits.
    fn unit(&mut self, wrong: &str) -> Result<u32, Broken> {
        let digits = self.rest().get(..4).filter(|it| it.bytes().all(|it| it.is_ascii_hexdigit()));
        let unit = digits.and_then(|it| u32::from_str_radix(it, 16).ok());
        let unit = unit.ok_or_else(|| self.broken(wrong))?;
        self.at += 4;
        Ok(unit)
    }

    /// Reads a number, as it is written.
    pub(crate) fn number(&mut self) -> Result<&'t str, Broken> {
        self.space();
        let rest = self.rest();
        let end = rest.find(|c: char| !(c.is_ascii_digit() || "+-.eE".contains(c)));
        let number = &rest[..end.unwrap_or(rest.len())];
        let digits = |it: &str| !it.is_empty() && it.bytes().all(|it| it.is_ascii_digit());
        let (mantissa, exponent) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, "0"));
        let whole = whole.strip_prefix('-').unwrap_or(whole);
        let exponent = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
        let leading = whole.len() > 1 && whole.starts_with('0');
        if !digits(whole) || leading || !digits(fraction) || !digits(exponent) {
            return Err(self.broken("this is no number of JSON"));
        }
        self.at += number.len();
        Ok(number)
    }

    /// Whether the next value is `null`, which is read.
    pub(crate) fn null(&mut self) -> bool {
        self.space();
        let is = self.rest().starts_with("null");
        self.at += if is { 4 } else { 0 };
        is
    }

    /// Passes over a value.
    pub(crate) fn skip(&mut self) -> Result<(), Broken> {
        self.skip_to(MAX_DEPTH)
    }

    fn skip_to(&mut self, depth: usize) -> Result<(), Broken> {
        let Some(below) = depth.checked_sub(1) else {
            return Err(self.broken("this is nested too deeply"));
        };
        match self.shape()? {
            Shape::Object => self.object(|json, _, _| json.skip_to(below)),
            Shape::List => self.list(|json, _| json.skip_to(below)),
            Shape::Text => self.text().map(|_| ()),
            Shape::Number => self.number().map(|_| ()),
            Shape::Word => self.word().map(|_| ()),
        }
    }

    /// Reads `true`, `false` or `null`.
    pub(crate) fn word(&mut self) -> Result<&'static str, Broken> {
        let words = ["true", "false", "null"];
        let Some(word) = words.into_iter().find(|it| self.rest().starts_with(it)) else {
            return Err(self.no_value());
        };
        self.at += word.len();
        Ok(word)
    }

    /// Nothing may follow.
    pub(crate) fn end(&mut self) -> Result<(), Broken> {
        self.space();
        if self.at == self.text.len() { Ok(()) } else { Err(self.broken("nothing may follow")) }
    }

    /// The text is no JSON from here on.
    pub(crate) fn broken(&self, what: &str) -> Broken {
        let rest = self.rest();
        let end = self.at + rest.chars().next().map_or(0, char::len_utf8);
        let cut = if rest.is_empty() { "the text is cut off: " } else { "" };
        Diagnostic::new(self.at..end, format!("{cut}{what}"), "here").help(self.advice.help)
    }

    fn rest(&self) -> &'t str {
        self.text.get(self.at..).unwrap_or("")
    }

    fn next(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    fn space(&mut self) {
        while matches!(self.next(), Some(b' ' | b'\t' | b'\n' | b'\r')) {
            self.at += 1;
        }
    }

    fn take(&mut self, wanted: u8) -> bool {
        self.space();
        let is = self.next() == Some(wanted);
        self.at += usize::from(is);
        is
    }

    fn expect(&mut self, wanted: u8, otherwise: &str) -> Result<(), Broken> {
        if self.take(wanted) { Ok(()) } else { Err(self.broken(otherwise)) }
    }
}
