//! From the bytes of a file to its text.

use super::error::{Finding, Span};
use cotama_property::source::quoted;
use std::borrow::Cow;

/// The text of a file without its byte order mark; or as much of it as could be decoded, and why
/// not more.
///
/// UTF-8 and UTF-16 are known by their byte order marks or first characters, ISO-8859-1 and
/// US-ASCII by the XML declaration. Every character of the text is one that XML 1.0 allows.
pub(super) fn decode(bytes: &[u8]) -> Result<Cow<'_, str>, (String, Finding)> {
    let text = match bytes {
        [] => return Err(refused("the file is empty", "give the name of a PNML file")),
        [0xff, 0xfe, 0, 0, ..] | [0, 0, 0xfe, 0xff, ..] => {
            return Err(refused("the file is encoded in UTF-32", "save it as UTF-8"));
        }
        [0x1f, 0x8b, ..] | [b'P', b'K', 3, 4, ..] => {
            return Err(refused("the file is compressed", "unpack it first"));
        }
        [0xff, 0xfe, rest @ ..] => Cow::Owned(utf16(rest, u16::from_le_bytes)?),
        [0xfe, 0xff, rest @ ..] => Cow::Owned(utf16(rest, u16::from_be_bytes)?),
        [b'<', 0, ..] => Cow::Owned(utf16(bytes, u16::from_le_bytes)?),
        [0, b'<', ..] => Cow::Owned(utf16(bytes, u16::from_be_bytes)?),
        [0xef, 0xbb, 0xbf, rest @ ..] => Cow::Borrowed(utf8(rest)?),
        _ => declared_encoding(bytes)?,
    };
    match forbidden(&text) {
        None => Ok(text),
        Some(span) => {
            let code = text[span.start..span.end].chars().next().map_or(0, u32::from);
            let finding = Finding::new(
                span,
                format!("the character U+{code:04X} cannot stand in an XML file"),
            )
            .help("this is not a PNML file, or it is damaged");
            Err((text.into_owned(), finding))
        }
    }
}

fn refused(message: &str, help: &str) -> (String, Finding) {
    (String::new(), Finding::new(Span::default(), message).help(help))
}

fn declared_encoding(bytes: &[u8]) -> Result<Cow<'_, str>, (String, Finding)> {
    let Some(span) = declaration(bytes) else { return Ok(Cow::Borrowed(utf8(bytes)?)) };
    let declared = String::from_utf8_lossy(&bytes[span.start..span.end]);
    let until_here = || String::from_utf8_lossy(&bytes[..span.end]).into_owned();
    match declared.to_ascii_lowercase().as_str() {
        "utf-8" | "utf8" => Ok(Cow::Borrowed(utf8(bytes)?)),
        "iso-8859-1" | "iso_8859-1" | "iso8859-1" | "latin1" | "latin-1" => {
            Ok(Cow::Owned(bytes.iter().copied().map(char::from).collect()))
        }
        "us-ascii" | "ascii" => match bytes.iter().position(|byte| !byte.is_ascii()) {
            None => Ok(Cow::Borrowed(utf8(bytes)?)),
            Some(at) => {
                let finding =
                    Finding::new(Span { start: at, end: at + 1 }, "a byte that is not US-ASCII")
                        .help("declare the encoding that the file has, such as UTF-8 or ISO-8859-1")
                        .related(span);
                Err((format!("{}\u{fffd}", String::from_utf8_lossy(&bytes[..at])), finding))
            }
        },
        "utf-16" | "utf-16le" | "utf-16be" => {
            let finding = Finding::new(span, "the file is declared to be UTF-16, and is not")
                .help("if it is UTF-8, declare `encoding=\"UTF-8\"`");
            Err((until_here(), finding))
        }
        _ => {
            let finding =
                Finding::new(span, format!("the encoding {} is not known", quoted(&declared)))
                    .help(
                        "save the file as UTF-8; UTF-16, ISO-8859-1 and US-ASCII are read as well",
                    );
            Err((until_here(), finding))
        }
    }
}

/// Returns the position of the value of `encoding` in the XML declaration.
fn declaration(bytes: &[u8]) -> Option<Span> {
    let bytes = &bytes[..bytes.len().min(1024)];
    if !bytes.starts_with(b"<?xml") {
        return None;
    }
    let end = bytes.windows(2).position(|two| two == b"?>")?;
    let key = bytes[..end].windows(8).position(|word| word == b"encoding")? + 8;
    let quote = key + bytes[key..end].iter().position(|byte| matches!(byte, b'"' | b'\''))?;
    let start = quote + 1;
    let length = bytes[start..end].iter().position(|&byte| byte == bytes[quote])?;
    Some(Span { start, end: start + length })
}

fn utf8(bytes: &[u8]) -> Result<&str, (String, Finding)> {
    std::str::from_utf8(bytes).map_err(|error| {
        let at = error.valid_up_to();
        let readable = String::from_utf8_lossy(&bytes[..at]);
        let span = Span { start: at, end: at + char::REPLACEMENT_CHARACTER.len_utf8() };
        let finding = Finding::new(span, format!("the byte 0x{:02X} is not UTF-8", bytes[at]))
            .help(
                "save the file as UTF-8, or declare its encoding, as in `<?xml version=\"1.0\" \
                encoding=\"ISO-8859-1\"?>`",
            );
        (format!("{readable}\u{fffd}"), finding)
    })
}

fn utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Result<String, (String, Finding)> {
    let (pairs, rest) = bytes.as_chunks::<2>();
    let mut text = String::with_capacity(pairs.len());
    for character in char::decode_utf16(pairs.iter().map(|&pair| unit(pair))) {
        let Ok(character) = character else { return Err(broken_utf16(text)) };
        text.push(character);
    }
    if rest.is_empty() { Ok(text) } else { Err(broken_utf16(text)) }
}

fn broken_utf16(mut text: String) -> (String, Finding) {
    let start = text.len();
    text.push(char::REPLACEMENT_CHARACTER);
    let finding = Finding::new(Span { start, end: text.len() }, "half a character of UTF-16")
        .help("the file is cut off or damaged; save it as UTF-8");
    (text, finding)
}

/// Whether XML 1.0 has a way to write a character.
pub(super) fn is_xml(c: char) -> bool {
    !matches!(c, '\0'..='\u{8}' | '\u{b}' | '\u{c}' | '\u{e}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}')
}

/// The first character that XML 1.0 does not allow. It looks at bytes: files are long.
fn forbidden(text: &str) -> Option<Span> {
    let bytes = text.as_bytes();
    let bad = |start: &usize| match bytes[*start] {
        b'\t' | b'\n' | b'\r' => false,
        0..=0x1f => true,
        0xef => {
            bytes[*start..].starts_with(b"\xef\xbf\xbe")
                || bytes[*start..].starts_with(b"\xef\xbf\xbf")
        }
        _ => false,
    };
    let start = (0..bytes.len()).find(bad)?;
    let length = if bytes[start] == 0xef { 3 } else { 1 };
    Some(Span { start, end: start + length })
}
