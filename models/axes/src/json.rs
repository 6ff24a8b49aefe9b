//! JSON (RFC 8259) as a tree, with whole numbers alone.

use crate::tree::{Entry, Fault, Node, Value};

/// Values are read to this depth.
const MAX_DEPTH: usize = 16;
/// An object has at most so many keys.
const MAX_KEYS: usize = 512;

/// Reads a text as one value of JSON.
pub(crate) fn parse(text: &str) -> Result<Node, Fault> {
    let mut reader = Reader { text, at: 0 };
    let node = reader.value(MAX_DEPTH)?;
    reader.space();
    if reader.at == text.len() { Ok(node) } else { Err(reader.wrong("nothing may follow")) }
}

struct Reader<'t> {
    text: &'t str,
    at: usize,
}

impl Reader<'_> {
    fn rest(&self) -> &str {
        self.text.get(self.at..).unwrap_or("")
    }

    fn wrong(&self, what: &str) -> Fault {
        let cut = if self.rest().is_empty() { "the text is cut off: " } else { "" };
        Fault::new(self.at, format!("not JSON: {cut}{what}"))
    }

    fn space(&mut self) {
        let rest = self.rest();
        self.at += rest.len() - rest.trim_start_matches([' ', '\t', '\n', '\r']).len();
    }

    fn take(&mut self, wanted: char) -> bool {
        self.space();
        let is = self.rest().starts_with(wanted);
        self.at += usize::from(is);
        is
    }

    fn value(&mut self, depth: usize) -> Result<Node, Fault> {
        self.space();
        let at = self.at;
        let Some(below) = depth.checked_sub(1) else {
            return Err(self.wrong("this is nested too deeply"));
        };
        let value = match self.rest().chars().next() {
            Some('{') => self.object(below)?,
            Some('[') => self.list(below)?,
            Some('"') => Value::Text(self.string()?),
            Some('-' | '0'..='9') => self.number()?,
            _ => self.word()?,
        };
        Ok(Node { at, value })
    }

    fn object(&mut self, below: usize) -> Result<Value, Fault> {
        self.at += 1;
        let mut entries: Vec<Entry> = Vec::new();
        if self.take('}') {
            return Ok(Value::Table(entries));
        }
        loop {
            self.space();
            let key_at = self.at;
            if !self.rest().starts_with('"') {
                return Err(self.wrong("a key in quotation marks is needed here"));
            }
            let key = self.string()?;
            if entries.len() == MAX_KEYS {
                return Err(Fault::new(key_at, format!("an object has more than {MAX_KEYS} keys")));
            }
            if entries.iter().any(|it| it.key == key) {
                return Err(Fault::new(key_at, format!("the key `{key}` stands twice")));
            }
            if !self.take(':') {
                return Err(self.wrong("`:` is needed behind a key"));
            }
            let node = self.value(below)?;
            entries.push(Entry { key, key_at, node });
            if self.take('}') {
                return Ok(Value::Table(entries));
            }
            if !self.take(',') {
                return Err(self.wrong("`,` or `}` is needed here"));
            }
        }
    }

    fn list(&mut self, below: usize) -> Result<Value, Fault> {
        self.at += 1;
        let mut items = Vec::new();
        if self.take(']') {
            return Ok(Value::List(items));
        }
        loop {
            items.push(self.value(below)?);
            if self.take(']') {
                return Ok(Value::List(items));
            }
            if !self.take(',') {
                return Err(self.wrong("`,` or `]` is needed here"));
            }
        }
    }

    /// Reads a text; its first character is a quotation mark.
    fn string(&mut self) -> Result<String, Fault> {
        self.at += 1;
        let mut text = String::new();
        loop {
            let rest = self.rest();
            let end = rest.find(|c: char| c == '"' || c == '\\' || c < ' ').unwrap_or(rest.len());
            text += rest.get(..end).unwrap_or("");
            self.at += end;
            if self.rest().starts_with('"') {
                self.at += 1;
                return Ok(text);
            }
            if !self.rest().starts_with('\\') {
                return Err(self.wrong("a text ends with `\"`, on the line where it begins"));
            }
            text.push(self.escaped()?);
        }
    }

    /// Reads a character behind a backslash; pairs of UTF-16 are no names here.
    fn escaped(&mut self) -> Result<char, Fault> {
        let mut letters = self.rest().chars().skip(1);
        let (one, length) = match letters.next() {
            Some(it @ ('"' | '\\' | '/')) => (Some(it), 2),
            Some('b') => (Some('\u{8}'), 2),
            Some('f') => (Some('\u{c}'), 2),
            Some('n') => (Some('\n'), 2),
            Some('r') => (Some('\r'), 2),
            Some('t') => (Some('\t'), 2),
            Some('u') => {
                let digits =
                    self.rest().get(2..6).filter(|it| it.chars().all(|c| c.is_ascii_hexdigit()));
                let code = digits.and_then(|it| u32::from_str_radix(it, 16).ok());
                (code.and_then(char::from_u32), 6)
            }
            _ => (None, 0),
        };
        let one = one.ok_or_else(|| self.wrong("this escape is not read here"))?;
        self.at += length;
        Ok(one)
    }

    fn number(&mut self) -> Result<Value, Fault> {
        let rest = self.rest();
        let end = rest.find(|c: char| !(c.is_ascii_digit() || "+-.eE".contains(c)));
        let number = rest.get(..end.unwrap_or(rest.len())).unwrap_or("");
        let digits = number.strip_prefix('-').unwrap_or(number);
        if digits.contains(['.', 'e', 'E']) {
            let cure = "all quantities are whole numbers, of mm, ms, mW and the like";
            return Err(Fault::new(self.at, format!("`{number}` is no whole number: {cure}")));
        }
        if digits.len() > 1 && digits.starts_with('0') || digits.is_empty() {
            return Err(self.wrong("this is no number of JSON"));
        }
        let Ok(value) = number.parse() else {
            let what = if digits.len() > 18 { "too large" } else { "no number of JSON" };
            return Err(self.wrong(&format!("this is {what}")));
        };
        self.at += number.len();
        Ok(Value::Integer(value))
    }

    fn word(&mut self) -> Result<Value, Fault> {
        for (word, words) in [("true", "`true`"), ("false", "`false`"), ("null", "`null`")] {
            if self.rest().starts_with(word) {
                self.at += word.len();
                return Ok(Value::Other(words));
            }
        }
        Err(self.wrong("a value is needed here"))
    }
}
