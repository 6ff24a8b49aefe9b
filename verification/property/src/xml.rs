//! The elements and texts of an XML file, bounded, each with its place in the file. Entities other
//! than the five of XML are refused, so nothing grows. Attributes and namespaces mean nothing here.

use super::error::Fault;
use crate::source::quoted;
use quick_xml::errors::{Error, IllFormedError};
use quick_xml::events::Event;
use quick_xml::reader::Reader;
use std::ops::Range;

/// The longest file, in bytes.
pub(super) const MAX_FILE: usize = 1 << 28;

/// The longest text of an element, in bytes.
const MAX_TEXT: usize = 1 << 16;

/// How deep elements may be nested.
const MAX_ELEMENTS: usize = 4 * super::MAX_DEPTH;

/// The start of an element.
#[derive(Clone)]
pub(super) struct Element<'a> {
    /// Name without prefix.
    pub(super) name: &'a str,
    pub(super) span: Range<usize>,
}

pub(super) struct Xml<'a> {
    text: &'a str,
    reader: Reader<&'a [u8]>,
    /// The elements that are open: their full names and start tags.
    open: Vec<(&'a str, Range<usize>)>,
    rooted: bool,
}

enum Piece<'a> {
    Start(Element<'a>),
    Text(String, Range<usize>),
    End,
    Eof,
}

/// The text of a file without its byte order mark.
pub(super) fn decode(bytes: &[u8]) -> Result<&str, (Fault, String)> {
    if bytes.len() > MAX_FILE {
        let fault =
            Fault::new(0..0, format!("the file has {} bytes, more than {MAX_FILE}", bytes.len()));
        return Err((fault.help("split it"), String::new()));
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    std::str::from_utf8(bytes).map_err(|error| {
        let at = error.valid_up_to();
        let fault = Fault::new(at..at, format!("the byte 0x{:02X} is not UTF-8", bytes[at]));
        (fault.help("save the file as UTF-8"), String::from_utf8_lossy(&bytes[..at]).into_owned())
    })
}

impl<'a> Xml<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        let mut reader = Reader::from_str(text);
        let config = reader.config_mut();
        config.expand_empty_elements = true;
        config.check_end_names = false;
        config.allow_unmatched_ends = true;
        Self { text, reader, open: Vec::new(), rooted: false }
    }

    /// The next element inside of the one that is open; `None` when that one ends, which closes it.
    /// At first: the element of the file.
    pub(super) fn child(&mut self) -> Result<Option<Element<'a>>, Fault> {
        loop {
            match self.next()? {
                Piece::Start(element) => return Ok(Some(element)),
                Piece::End | Piece::Eof => return Ok(None),
                Piece::Text(text, span) if !text.trim().is_empty() => {
                    let lead = self
                        .text
                        .get(span.clone())
                        .map_or(0, |raw| raw.len() - raw.trim_start().len());
                    let message = format!("the text {} is not expected here", quoted(text.trim()));
                    return Err(Fault::new(span.start + lead..span.end, message)
                        .help("an element is expected"));
                }
                Piece::Text(..) => {}
            }
        }
    }

    /// The text of the element that is open, without white space around it, and closes it.
    pub(super) fn text(&mut self) -> Result<(String, Range<usize>), Fault> {
        let (mut text, mut span) = (String::new(), self.at()..self.at());
        loop {
            match self.next()? {
                Piece::Text(part, place) => {
                    text.push_str(&part);
                    span.end = place.end;
                    if text.len() > MAX_TEXT {
                        let fault =
                            Fault::new(span, format!("a text is longer than {MAX_TEXT} bytes"));
                        return Err(fault.help("the file is damaged or made to do harm"));
                    }
                }
                Piece::Start(element) => {
                    let message = format!("the element {} is not expected here", element.shown());
                    return Err(Fault::new(element.span, message).help("a text is expected"));
                }
                Piece::End | Piece::Eof => {
                    let raw = self.text.get(span.clone()).unwrap_or("");
                    let start = span.start + raw.len() - raw.trim_start().len();
                    return Ok((text.trim().to_owned(), start..start + raw.trim().len()));
                }
            }
        }
    }

    /// Closes the element that is open, whatever is in it.
    pub(super) fn skip(&mut self) -> Result<(), Fault> {
        let outside = self.open.len().saturating_sub(1);
        while self.open.len() > outside {
            self.next()?;
        }
        Ok(())
    }

    fn at(&self) -> usize {
        (self.reader.buffer_position() as usize).min(self.text.len())
    }

    fn next(&mut self) -> Result<Piece<'a>, Fault> {
        loop {
            let start = self.at();
            let event = self.reader.read_event();
            let span = start..self.at();
            match event.map_err(|error| self.syntax(&error, span.clone()))? {
                Event::Start(tag) => {
                    for attribute in tag.attributes() {
                        attribute.map_err(|error| {
                            Fault::new(span.clone(), format!("this is not XML: {error}"))
                        })?;
                    }
                    return self.start(span).map(Piece::Start);
                }
                Event::End(_) => return self.end(span).map(|()| Piece::End),
                Event::Text(text) => return self.content(&text, span),
                Event::CData(text) => return self.content(&text, span),
                Event::GeneralRef(reference) => {
                    let character = match &*reference {
                        "lt" => Some('<'),
                        "gt" => Some('>'),
                        "amp" => Some('&'),
                        "quot" => Some('"'),
                        "apos" => Some('\''),
                        _ => reference.resolve_char_ref().ok().flatten(),
                    };
                    let Some(character) = character else {
                        let shown = quoted(&format!("&{};", &*reference));
                        return Err(Fault::new(span, format!("{shown} is not known")).help(
                            "only `&lt;`, `&gt;`, `&amp;`, `&quot;`, `&apos;` and characters such \
                             as `&#228;` are",
                        ));
                    };
                    return self.content(character.encode_utf8(&mut [0; 4]), span);
                }
                Event::DocType(doctype) if doctype.contains('[') => {
                    return Err(Fault::new(
                        span,
                        "the DOCTYPE makes declarations of its own, which are not read",
                    )
                    .help("remove the DOCTYPE"));
                }
                Event::Eof => return self.eof(),
                _ => {}
            }
        }
    }

    fn content(&self, text: &str, span: Range<usize>) -> Result<Piece<'a>, Fault> {
        if self.open.is_empty() && !text.trim().is_empty() {
            return Err(Fault::new(span, "text outside of the element of the file")
                .help("this is not a property file, or it is damaged"));
        }
        Ok(Piece::Text(text.to_owned(), span))
    }

    fn eof(&self) -> Result<Piece<'a>, Fault> {
        let end = self.text.len()..self.text.len();
        match self.open.last() {
            Some((name, _)) => {
                Err(Fault::new(end, format!("the file ends before {} is closed", tag(name)))
                    .help("the file is cut off"))
            }
            None if self.rooted => Ok(Piece::Eof),
            None => Err(Fault::new(end, "the file has no element").help(
                "a property file of the Model Checking Contest has one `<property-set>` element",
            )),
        }
    }

    fn start(&mut self, span: Range<usize>) -> Result<Element<'a>, Fault> {
        let raw = self.text.get(span.start + 1..span.end).unwrap_or("");
        let full = raw.split([' ', '\t', '\r', '\n', '/', '>']).next().unwrap_or("");
        if self.open.is_empty() && std::mem::replace(&mut self.rooted, true) {
            let fault = Fault::new(span, format!("a second element {} in the file", tag(full)));
            return Err(fault.help("put its properties into the first"));
        }
        if self.open.len() >= MAX_ELEMENTS {
            let fault =
                Fault::new(span, format!("elements are nested more than {MAX_ELEMENTS} deep"));
            return Err(fault.help("the file is damaged or made to do harm"));
        }
        self.open.push((full, span.clone()));
        Ok(Element { name: full.split_once(':').map_or(full, |(_, local)| local), span })
    }

    fn end(&mut self, span: Range<usize>) -> Result<(), Fault> {
        // An element that closes itself ends with nothing.
        let raw = self.text.get(span.clone()).unwrap_or("");
        let name = raw.strip_prefix("</").map(|raw| raw.trim_end_matches('>').trim_end());
        match (self.open.pop(), name) {
            (Some((open, _)), Some(name)) if open != name => {
                let message = format!("{} closes {}", tag(&format!("/{name}")), tag(open));
                Err(Fault::new(span, message).help(format!("write `</{open}>` first")))
            }
            (Some(_), _) => Ok(()),
            (None, _) => {
                let message =
                    format!("{} closes nothing", tag(&format!("/{}", name.unwrap_or(""))));
                Err(Fault::new(span, message).help("remove it"))
            }
        }
    }

    fn syntax(&self, error: &Error, span: Range<usize>) -> Fault {
        let mut start =
            (self.reader.error_position() as usize).clamp(span.start, span.end.max(span.start));
        while !self.text.is_char_boundary(start) {
            start -= 1;
        }
        match error {
            Error::IllFormed(IllFormedError::UnclosedReference) => {
                Fault::new(start..start, "`&` stands alone").help("write `&amp;`")
            }
            other => Fault::new(start..start, format!("this is not XML: {other}")),
        }
    }
}

impl Element<'_> {
    /// Returns the tag as a message shows it.
    pub(super) fn shown(&self) -> String {
        tag(self.name)
    }
}

fn tag(name: &str) -> String {
    let name = quoted(name);
    format!("`<{}>`", name.trim_matches('`'))
}
