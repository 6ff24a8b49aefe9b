//! XML as tinyxml2 takes it: raw `&` and `<` in values, unknown entities, text between elements and
//! a byte order mark are accepted, as files in use have them.

use crate::diagnostic::Place;
use quick_xml::events::Event;
use quick_xml::reader::Reader;

/// Levels of elements in a file: `root`, `BehaviorTree` and 256 nodes.
pub(crate) const MAX_LEVELS: usize = 258;
/// Bytes of a file.
const MAX_BYTES: usize = 64 << 20;
/// Elements of a file.
const MAX_ELEMENTS: usize = 200_000;

/// An element with its place.
#[derive(Clone, Debug)]
pub(crate) struct Element {
    pub(crate) name: String,
    pub(crate) place: Place,
    pub(crate) attributes: Vec<Attribute>,
    pub(crate) children: Vec<Element>,
}

/// An attribute: its value with references replaced, and the place of the value.
#[derive(Clone, Debug)]
pub(crate) struct Attribute {
    pub(crate) name: String,
    pub(crate) value: String,
    pub(crate) at: Place,
    pub(crate) value_at: Place,
}

impl Element {
    pub(crate) fn attribute(&self, name: &str) -> Option<&Attribute> {
        self.attributes.iter().find(|it| it.name == name)
    }

    pub(crate) fn get(&self, name: &str) -> Option<&str> {
        self.attribute(name).map(|it| it.value.as_str())
    }
}

/// Error of the form: place, cause, remedy.
pub(crate) type Malformed = (Place, String, Option<String>);

/// Reads the root element of a file.
pub(crate) fn read(file: u32, bytes: &[u8]) -> Result<Element, Malformed> {
    let nowhere = Place { file, line: 0, column: 0 };
    let error = |message: String| (nowhere, message, None);
    if bytes.len() > MAX_BYTES {
        return Err(error(format!("the file has more than {MAX_BYTES} bytes")));
    }
    let text = std::str::from_utf8(bytes).map_err(|e| {
        error(format!("the file is not UTF-8: byte {} is damaged", e.valid_up_to()))
    })?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    Parser { text, lines: Lines::new(file, text), open: Vec::new(), elements: 0 }.read()
}

/// Beginnings of lines, by which offsets become places.
struct Lines<'a> {
    file: u32,
    text: &'a str,
    starts: Vec<usize>,
}

impl<'a> Lines<'a> {
    fn new(file: u32, text: &'a str) -> Self {
        let after = text.bytes().enumerate().filter(|it| it.1 == b'\n').map(|it| it.0 + 1);
        Lines { file, text, starts: std::iter::once(0).chain(after).collect() }
    }

    fn place(&self, offset: usize) -> Place {
        let line = self.starts.partition_point(|&it| it <= offset) - 1;
        let before = self.text.get(self.starts[line]..offset).unwrap_or("");
        let column = before.chars().count() as u32 + 1;
        Place { file: self.file, line: line as u32 + 1, column }
    }
}

struct Parser<'a> {
    text: &'a str,
    lines: Lines<'a>,
    open: Vec<Element>,
    elements: usize,
}

impl Parser<'_> {
    fn read(mut self) -> Result<Element, Malformed> {
        let mut reader = Reader::from_str(self.text);
        let config = reader.config_mut();
        config.check_end_names = false;
        config.allow_unmatched_ends = true;
        config.allow_dangling_amp = true;
        let mut root = None;
        loop {
            let start = reader.buffer_position() as usize;
            let event = reader.read_event();
            let end = reader.buffer_position() as usize;
            let here = self.lines.place(start);
            let done = match event {
                Err(error) => return Err((here, format!("not well-formed: {error}"), None)),
                Ok(Event::Eof) => break,
                Ok(Event::Start(_)) => {
                    let element = self.element(start, end, ">")?;
                    self.open.push(element);
                    if self.open.len() > MAX_LEVELS {
                        let message = "more than 256 levels of nodes".to_owned();
                        let help = "the library refuses this too; move a part to a tree of its own";
                        return Err((here, message, Some(help.to_owned())));
                    }
                    None
                }
                Ok(Event::Empty(_)) => Some(self.element(start, end, "/>")?),
                Ok(Event::End(_)) => Some(self.close(start, end)?),
                Ok(_) => None,
            };
            match (done, self.open.last_mut()) {
                (Some(element), Some(parent)) => parent.children.push(element),
                (Some(element), None) => root = root.or(Some(element)),
                (None, _) => {}
            }
        }
        if let Some(open) = self.open.last() {
            let message = format!("<{}> is not closed: the file ends before", open.name);
            return Err((open.place, message, Some(format!("write </{}>", open.name))));
        }
        root.ok_or_else(|| {
            let help = "a file of trees has one element <root>".to_owned();
            (self.lines.place(0), "the file has no element".to_owned(), Some(help))
        })
    }

    fn close(&mut self, start: usize, end: usize) -> Result<Element, Malformed> {
        let raw = &self.text[start..end];
        let name = raw.trim_start_matches("</").trim_end_matches('>').trim();
        match self.open.pop() {
            Some(element) if element.name == name => Ok(element),
            Some(element) => {
                let line = element.place.line;
                let message =
                    format!("</{name}> closes <{}>, which began in line {line}", element.name);
                let help = format!("write </{}>, or <{}/> above", element.name, element.name);
                Err((self.lines.place(start), message, Some(help)))
            }
            None => Err((self.lines.place(start), format!("</{name}> closes nothing"), None)),
        }
    }

    fn element(&mut self, start: usize, end: usize, tail: &str) -> Result<Element, Malformed> {
        self.elements += 1;
        if self.elements > MAX_ELEMENTS {
            let message = format!("more than {MAX_ELEMENTS} elements");
            return Err((self.lines.place(start), message, None));
        }
        let inner = &self.text[start..end];
        let inner = inner.strip_prefix('<').unwrap_or(inner);
        let inner = inner.strip_suffix(tail).unwrap_or(inner);
        let length = inner.find(char::is_whitespace).unwrap_or(inner.len());
        let place = self.lines.place(start);
        let name = inner[..length].to_owned();
        if name.is_empty() {
            return Err((place, "a tag without a name".to_owned(), None));
        }
        let mut attributes: Vec<Attribute> = Vec::new();
        let mut at = length;
        loop {
            at += inner[at..].len() - inner[at..].trim_start().len();
            if at >= inner.len() {
                break;
            }
            let here = self.lines.place(start + 1 + at);
            let broken = |message: String| Err((here, message, None));
            let Some((left, _)) = inner[at..].split_once('=') else {
                return broken(format!("attribute without a value: {}", inner[at..].trim()));
            };
            let (key, after) = (left.trim(), at + left.len() + 1);
            let space = inner[after..].len() - inner[after..].trim_start().len();
            let quote = inner[after + space..].chars().next();
            let Some(quote @ ('"' | '\'')) = quote else {
                return broken(format!("the value of {key} is not in quotes"));
            };
            let begin = after + space + 1;
            let Some(long) = inner[begin..].find(quote) else {
                return broken(format!("the value of {key} has no closing quote"));
            };
            if key.is_empty() || key.contains(char::is_whitespace) {
                return broken(format!("attribute without a value: {key}"));
            }
            if attributes.iter().any(|it| it.name == key) {
                return broken(format!("attribute {key} stands twice in <{name}>"));
            }
            attributes.push(Attribute {
                name: key.to_owned(),
                value: replaced(&inner[begin..begin + long]),
                at: here,
                value_at: self.lines.place(start + 1 + begin),
            });
            at = begin + long + 1;
        }
        Ok(Element { name, place, attributes, children: Vec::new() })
    }
}

/// Replaces references; those that do not exist stay as they are written.
fn replaced(raw: &str) -> String {
    let mut text = String::with_capacity(raw.len());
    let mut rest = raw;
    while let Some(at) = rest.find('&') {
        text.push_str(&rest[..at]);
        rest = &rest[at..];
        let known = rest.find(';').and_then(|end| Some((reference(&rest[1..end])?, end + 1)));
        let (shown, length) = known.unwrap_or(('&', 1));
        text.push(shown);
        rest = &rest[length..];
    }
    text.push_str(rest);
    text
}

fn reference(name: &str) -> Option<char> {
    Some(match name {
        "amp" => '&',
        "lt" => '<',
        "gt" => '>',
        "quot" => '"',
        "apos" => '\'',
        _ => {
            let digits = name.strip_prefix('#')?;
            let code = match digits.strip_prefix(['x', 'X']) {
                Some(hex) => u32::from_str_radix(hex, 16),
                None => digits.parse(),
            };
            char::from_u32(code.ok()?)?
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn raw_signs_and_unknown_entities_stay() {
        let text = "\u{feff}<root a='x && y < 2 &lt; &b; &#65;'>text & more <b/></root>";
        let root = read(0, text.as_bytes()).unwrap();
        assert_eq!(root.get("a"), Some("x && y < 2 < &b; A"));
        assert_eq!(root.children[0].name, "b");
        assert_eq!(root.children[0].place, Place { file: 0, line: 1, column: 49 });
    }

    #[test]
    fn each_break_of_the_form_has_its_message() {
        let message = |text: &str| read(0, text.as_bytes()).unwrap_err().1;
        assert_eq!(message("<a b='1' b='2'/>"), "attribute b stands twice in <a>");
        assert_eq!(message("<a><b></a>"), "</a> closes <b>, which began in line 1");
        assert_eq!(message("<a>"), "<a> is not closed: the file ends before");
        assert_eq!(message(""), "the file has no element");
        assert_eq!(message("<a b=1/>"), "the value of b is not in quotes");
        assert_eq!(message("<a b/>"), "attribute without a value: b");
    }
}
