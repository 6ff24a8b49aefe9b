//! The XML of a file as a stream of tags and texts: checked, bounded, and each with its place in
//! the file.
//!
//! quick-xml finds where each piece of markup begins and ends; what XML demands beyond that is
//! checked here, so that every error has a place and a message of its own. Namespaces are not told
//! apart: names are compared without their prefixes. Entities other than the five of XML are
//! refused, so nothing grows.

use super::Limits;
use super::encoding::is_xml;
use super::error::{Finding, Span, Spanned};
use cotama_property::source::quoted;
use quick_xml::errors::{Error, IllFormedError, SyntaxError};
use quick_xml::events::Event;
use quick_xml::events::attributes::{AttrError, Attributes};
use quick_xml::reader::Reader;
use std::borrow::Cow;

/// One piece of a file.
pub(super) enum Token<'a> {
    Start(Tag<'a>),
    Text(Spanned<Cow<'a, str>>),
    End,
}

/// A start tag.
pub(super) struct Tag<'a> {
    /// Name without prefix.
    pub(super) name: &'a str,
    pub(super) span: Span,
    pub(super) attributes: Vec<Attribute<'a>>,
}

/// An attribute of a start tag.
pub(super) struct Attribute<'a> {
    pub(super) name: &'a str,
    /// The value with references replaced.
    pub(super) value: Spanned<Cow<'a, str>>,
}

impl<'a> Tag<'a> {
    pub(super) fn get(&self, name: &str) -> Option<&Spanned<Cow<'a, str>>> {
        self.attributes
            .iter()
            .find(|attribute| attribute.name == name)
            .map(|attribute| &attribute.value)
    }
}

pub(super) struct Xml<'a> {
    text: &'a str,
    reader: Reader<&'a [u8]>,
    limits: Limits,
    /// The elements that are open: their full names and start tags.
    open: Vec<(&'a str, Span)>,
    /// The last tag closed itself, its end is still to be told.
    self_closed: bool,
    rooted: bool,
}

impl<'a> Xml<'a> {
    pub(super) fn new(text: &'a str, limits: Limits) -> Self {
        let mut reader = Reader::from_str(text);
        reader.config_mut().check_end_names = false;
        reader.config_mut().allow_unmatched_ends = true;
        Self { text, reader, limits, open: Vec::new(), self_closed: false, rooted: false }
    }

    /// The next piece; `None` at the end of a file whose elements are all closed.
    pub(super) fn next(&mut self) -> Result<Option<Token<'a>>, Finding> {
        if std::mem::take(&mut self.self_closed) {
            self.open.pop();
            return Ok(Some(Token::End));
        }
        loop {
            let start = self.reader.buffer_position() as usize;
            let event = self.reader.read_event();
            let span = Span { start, end: self.reader.buffer_position() as usize };
            let event = event.map_err(|error| self.syntax(&error, span))?;
            let raw = self.text.get(span.start..span.end).unwrap_or("");
            match event {
                Event::Start(_) => return self.start(raw, span, false).map(Some),
                Event::Empty(_) => return self.start(raw, span, true).map(Some),
                Event::End(_) => return self.end(raw, span).map(Some),
                Event::Text(_) | Event::CData(_) | Event::GeneralRef(_) => {
                    let value = match event {
                        Event::Text(_) => newlines(raw),
                        Event::CData(_) => newlines(inside(raw, "<![CDATA[", "]]>")),
                        _ => Cow::Owned(reference(inside(raw, "&", ";"), span)?.into()),
                    };
                    if !self.open.is_empty() {
                        return Ok(Some(Token::Text(Spanned { value, span })));
                    }
                    if !is_blank(&value) {
                        return Err(self.stray_text(&value, span));
                    }
                }
                Event::Decl(_) if span.start > 0 => {
                    return Err(Finding::new(
                        span,
                        "the XML declaration is not at the start of the file",
                    )
                    .help("remove what stands before it"));
                }
                Event::DocType(_) => doctype(raw, span)?,
                Event::Comment(_) | Event::PI(_) | Event::Decl(_) => {}
                Event::Eof => return self.eof().map(|()| None),
            }
        }
    }

    fn stray_text(&self, text: &str, span: Span) -> Finding {
        let lead = text.len() - text.trim_start_matches(WHITESPACE).len();
        let span = Span { start: span.start + lead, ..span };
        let place = if self.rooted { "after" } else { "before" };
        let finding = Finding::new(span, format!("text {place} the element of the file"));
        finding.help(
            "a PNML file has nothing but one `<pnml>` element; this is not one, or it is damaged",
        )
    }

    fn eof(&self) -> Result<(), Finding> {
        let end = Span { start: self.text.len(), end: self.text.len() };
        match self.open.last() {
            Some(&(name, span)) => {
                Err(Finding::new(end, format!("the file ends before {} is closed", tag(name)))
                    .help(format!("the file is cut off, or `</{name}>` is missing"))
                    .related(span))
            }
            None if self.rooted => Ok(()),
            None => Err(Finding::new(end, "the file has no element")
                .help("a PNML file has one `<pnml>` element")),
        }
    }

    fn start(&mut self, raw: &'a str, span: Span, empty: bool) -> Result<Token<'a>, Finding> {
        let content = inside(raw, "<", if empty { "/>" } else { ">" });
        let length = content.find(WHITESPACE).unwrap_or(content.len());
        let (full, attributes) = content.split_at(length);
        if !is_name(full) {
            let shown = if full.is_empty() {
                "`<` stands alone".to_owned()
            } else {
                format!("{} is not the name of an element", quoted(full))
            };
            return Err(Finding::new(Span { end: span.start + 1, ..span }, shown)
                .help("write `&lt;` where `<` is meant as a character"));
        }
        if let Some(at) = content.find('<').filter(|&at| !in_quotes(&content[..at])) {
            let at = span.start + 1 + at;
            return Err(Finding::new(
                span,
                format!("the tag {} is not closed with `>`", tag(full)),
            )
            .help("write `>` at its end")
            .related(Span { start: at, end: at + 1 }));
        }
        if self.open.is_empty() && std::mem::replace(&mut self.rooted, true) {
            return Err(Finding::new(span, format!("a second element {} in the file", tag(full)))
                .help("a PNML file has one `<pnml>` element; its nets stand in that"));
        }
        if self.open.len() >= self.limits.depth {
            return Err(Finding::new(
                span,
                format!("elements are nested more than {} deep", self.limits.depth),
            )
            .help("no PNML needs this; the file is damaged or made to do harm"));
        }
        self.open.push((full, span));
        self.self_closed = empty;
        let attributes =
            if is_blank(attributes) { Vec::new() } else { self.attributes(content, length, span)? };
        Ok(Token::Start(Tag { name: local(full), span, attributes }))
    }

    fn attributes(
        &self,
        content: &'a str,
        length: usize,
        span: Span,
    ) -> Result<Vec<Attribute<'a>>, Finding> {
        let base = span.start + 1;
        let mut attributes = Vec::new();
        for attribute in Attributes::new(content, length) {
            let attribute = attribute.map_err(|error| malformed(&error, content, base))?;
            let (name, Cow::Borrowed(value)) = (attribute.key.0, attribute.value) else { continue };
            let key = position(self.text, name);
            if !is_name(name) {
                return Err(Finding::new(
                    key,
                    format!("{} is not the name of an attribute", quoted(name)),
                )
                .help("write attributes as in `id=\"p1\"`"));
            }
            if attributes.len() >= self.limits.attributes {
                return Err(Finding::new(
                    key,
                    format!("a tag has more than {} attributes", self.limits.attributes),
                )
                .help("no PNML needs this; the file is damaged or made to do harm"));
            }
            let place = position(self.text, value);
            let value = Spanned { value: self.value(value, place)?, span: place };
            attributes.push(Attribute { name, value });
        }
        Ok(attributes)
    }

    /// The value of an attribute: references replaced, white space as blanks.
    fn value(&self, raw: &'a str, span: Span) -> Result<Cow<'a, str>, Finding> {
        if raw.len() > self.limits.text {
            return Err(too_long(span, self.limits.text));
        }
        let special = |c: char| matches!(c, '&' | '<' | '\t' | '\n' | '\r');
        if !raw.contains(special) {
            return Ok(Cow::Borrowed(raw));
        }
        let (mut value, mut rest) = (String::with_capacity(raw.len()), raw);
        while let Some(at) = rest.find(special) {
            value.push_str(&rest[..at]);
            let start = span.end - rest.len() + at;
            let special = &rest[at..];
            let taken = if let Some(after) = special.strip_prefix('&') {
                let Some(length) = after.find(';') else { return Err(bare_ampersand(start)) };
                value.push(reference(&after[..length], Span { start, end: start + length + 2 })?);
                length + 2
            } else if special.starts_with('<') {
                return Err(Finding::new(
                    Span { start, end: start + 1 },
                    "`<` inside of an attribute",
                )
                .help("a quote is missing before, or write `&lt;`"));
            } else {
                value.push(' ');
                if special.starts_with("\r\n") { 2 } else { 1 }
            };
            rest = &special[taken..];
        }
        value.push_str(rest);
        Ok(Cow::Owned(value))
    }

    fn end(&mut self, raw: &'a str, span: Span) -> Result<Token<'a>, Finding> {
        let name = inside(raw, "</", ">").trim_end_matches(WHITESPACE);
        match self.open.pop() {
            Some((open, _)) if open == name => Ok(Token::End),
            Some((open, start)) => {
                let message = format!("{} closes {}", tag(&format!("/{name}")), tag(open));
                Err(Finding::new(span, message)
                    .help(format!("write `</{open}>` first"))
                    .related(start))
            }
            None => {
                let finding =
                    Finding::new(span, format!("{} closes nothing", tag(&format!("/{name}"))));
                Err(finding.help("remove it"))
            }
        }
    }

    fn syntax(&self, error: &Error, span: Span) -> Finding {
        let start = self.reader.error_position() as usize;
        let at = Span { start, end: span.end.min(start + 1) };
        let unclosed = |what: &str, end: &str| {
            Finding::new(at, format!("{what} is not closed before the file ends")).help(format!(
                "write `{end}` where it ends; if nothing is missing there, the file is cut off"
            ))
        };
        match error {
            Error::Syntax(syntax) => match syntax {
                SyntaxError::UnclosedPI | SyntaxError::UnclosedXmlDecl => unclosed("`<?`", "?>"),
                SyntaxError::UnclosedComment => unclosed("a comment", "-->"),
                SyntaxError::UnclosedDoctype => unclosed("the DOCTYPE", ">"),
                SyntaxError::UnclosedCData => unclosed("`<![CDATA[`", "]]>"),
                SyntaxError::UnclosedTag => unclosed("this tag", ">"),
                SyntaxError::UnclosedSingleQuotedAttributeValue => {
                    unclosed("an attribute in this tag", "'")
                }
                SyntaxError::UnclosedDoubleQuotedAttributeValue => {
                    unclosed("an attribute in this tag", "\"")
                }
                SyntaxError::InvalidBangMarkup => {
                    Finding::new(at, "`<!` starts neither a comment nor a DOCTYPE")
                        .help("write `&lt;` where `<` is meant as a character")
                }
            },
            Error::IllFormed(IllFormedError::UnclosedReference) => bare_ampersand(start),
            other => Finding::new(at, format!("this is not XML: {other}")),
        }
    }
}

/// White space of XML.
pub(super) const WHITESPACE: [char; 4] = [' ', '\t', '\r', '\n'];

pub(super) fn is_blank(text: &str) -> bool {
    text.trim_start_matches(WHITESPACE).is_empty()
}

pub(super) fn too_long(span: Span, limit: usize) -> Finding {
    Finding::new(span, format!("a text is longer than {limit} bytes"))
        .help("no PNML needs this; the file is damaged or made to do harm")
}

fn doctype(raw: &str, span: Span) -> Result<(), Finding> {
    if raw.contains("<!ENTITY") {
        return Err(Finding::new(
            span,
            "the DOCTYPE declares entities, which are not read: they can be made to do harm",
        )
        .help("replace `&name;` in the file by what it stands for, and remove the DOCTYPE"));
    }
    if raw.contains("<!") && raw[2..].contains("<!") {
        return Err(Finding::new(
            span,
            "the DOCTYPE makes declarations of its own, which are not read",
        )
        .help("remove the DOCTYPE; PNML needs none"));
    }
    Ok(())
}

fn bare_ampersand(start: usize) -> Finding {
    Finding::new(Span { start, end: start + 1 }, "`&` stands alone").help("write `&amp;`")
}

/// The character that `&name;` stands for.
fn reference(name: &str, span: Span) -> Result<char, Finding> {
    let code = |digits: &str, radix| {
        let digits_only = digits.chars().all(|c| c.is_digit(radix));
        let code = digits_only.then(|| u32::from_str_radix(digits, radix).ok()).flatten();
        code.and_then(char::from_u32).filter(|&c| is_xml(c))
    };
    let character = match name {
        "lt" => Some('<'),
        "gt" => Some('>'),
        "amp" => Some('&'),
        "quot" => Some('"'),
        "apos" => Some('\''),
        _ => match name.strip_prefix("#x") {
            Some(digits) => code(digits, 16),
            None => name.strip_prefix('#').and_then(|digits| code(digits, 10)),
        },
    };
    character.ok_or_else(|| {
        let shown = quoted(&format!("&{name};"));
        if name.starts_with('#') {
            Finding::new(span, format!("{shown} is not a character of XML")).help("remove it")
        } else if is_name(name) {
            Finding::new(span, format!("the entity {shown} is not known")).help(
                "only `&lt;`, `&gt;`, `&amp;`, `&quot;`, `&apos;` and characters such as \
                    `&#228;` are",
            )
        } else {
            bare_ampersand(span.start)
        }
    })
}

fn malformed(error: &AttrError, content: &str, base: usize) -> Finding {
    let at = |position: usize| Span {
        start: base + position,
        end: base + (position + 1).min(content.len()),
    };
    let example = "write attributes as in `id=\"p1\"`";
    match *error {
        AttrError::ExpectedEq(position) => {
            Finding::new(at(position), "an attribute has no `=`").help(example)
        }
        AttrError::ExpectedValue(position) => {
            Finding::new(at(position), "an attribute has no value").help(example)
        }
        AttrError::UnquotedValue(position) => {
            Finding::new(at(position), "the value of an attribute is not in quotes").help(example)
        }
        AttrError::ExpectedQuote(position, quote) => Finding::new(
            at(position),
            format!("a quote `{}` is missing before this", char::from(quote)),
        )
        .help(example),
        AttrError::Duplicated(position, first) => {
            let name = content[position..].split(['=', ' ', '\t', '\r', '\n']).next().unwrap_or("");
            Finding::new(
                at(position),
                format!("the attribute {} stands twice in one tag", quoted(name)),
            )
            .help("remove one of the two")
            .related(at(first))
        }
    }
}

/// Returns the text between two marks.
fn inside<'a>(raw: &'a str, start: &str, end: &str) -> &'a str {
    let raw = raw.strip_prefix(start).unwrap_or(raw);
    raw.strip_suffix(end).unwrap_or(raw)
}

/// Line ends as one `\n` each.
fn newlines(raw: &str) -> Cow<'_, str> {
    if raw.contains('\r') {
        Cow::Owned(raw.replace("\r\n", "\n").replace('\r', "\n"))
    } else {
        Cow::Borrowed(raw)
    }
}

/// Returns the position of a part of the text in it.
fn position(text: &str, part: &str) -> Span {
    let start = (part.as_ptr() as usize).saturating_sub(text.as_ptr() as usize);
    Span { start, end: start + part.len() }
}

fn in_quotes(before: &str) -> bool {
    let quote = before.chars().fold(None, |open, c| match (open, c) {
        (None, '"' | '\'') => Some(c),
        (Some(quote), _) if quote == c => None,
        _ => open,
    });
    quote.is_some()
}

fn is_name(name: &str) -> bool {
    let first = |c: char| c.is_alphabetic() || c == '_' || c == ':' || !c.is_ascii();
    let rest = |c: char| first(c) || c.is_ascii_digit() || c == '-' || c == '.';
    name.starts_with(first) && name.chars().all(rest)
}

fn local(name: &str) -> &str {
    name.split_once(':').map_or(name, |(_, local)| local)
}

/// A tag as a message shows it.
pub(super) fn tag(name: &str) -> String {
    let name = quoted(name);
    format!("`<{}>`", name.trim_matches('`'))
}
