//! The one way in for files: never more than a limit of them, as text in UTF-8 without a byte order
//! mark. A file in another encoding, or with bytes that are no text, is refused with the line and
//! the column, and what to do.

use crate::exit::Failure;
use crate::file_errors::FileErrors;
use crate::names::near;
use std::fs::File;
use std::io::{BufRead, ErrorKind, Read};
use std::path::Path;

/// The most bytes of a mission or a file of faults.
pub(crate) const MISSION_BYTES: u64 = 4 << 20;
/// The most bytes of a measurement: ten thousand runs of each failure.
pub(crate) const MEASUREMENT_BYTES: u64 = 16 << 20;
/// The most bytes of an FMECA.
pub(crate) const FMECA_BYTES: u64 = 4 << 20;
/// The most bytes of an allocation instance, or of a team with its tasks.
pub(crate) const INSTANCE_BYTES: u64 = 64 << 20;
/// The most bytes of a trace.
pub(crate) const TRACE_BYTES: u64 = 256 << 20;
/// The most bytes of a model.
pub(crate) const MODEL_BYTES: u64 = 256 << 20;
/// The most bytes of a file of properties.
pub(crate) const PROPERTIES_BYTES: u64 = 64 << 20;
/// The most bytes of a certificate.
pub(crate) const CERTIFICATE_BYTES: u64 = 64 << 20;
/// The most bytes of a list of events.
pub(crate) const SCRIPT_BYTES: u64 = 1 << 20;

/// The most bytes of an answer of a person.
const ANSWER_BYTES: u64 = 4 << 10;

/// The text of a file, or of standard input for `-`; `what` says what it should be, as `a mission
/// file`.
pub(crate) fn text(path: &str, what: &str, limit: u64) -> Result<String, Failure> {
    utf8(path, what, bytes(path, what, limit)?)
}

/// Reads a file, or standard input for `-`.
pub(crate) fn bytes(path: &str, what: &str, limit: u64) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    let read = if path == "-" {
        std::io::stdin().lock().take(limit + 1).read_to_end(&mut bytes)
    } else {
        File::open(path).and_then(|file| {
            if file.metadata()?.is_dir() {
                return Err(ErrorKind::IsADirectory.into());
            }
            file.take(limit + 1).read_to_end(&mut bytes)
        })
    };
    let name = name(path);
    read.map_err(|error| unreadable(name, what, &error))?;
    if bytes.len() as u64 > limit {
        let message = format!("too large: at most {} MiB are read of {what}", limit >> 20);
        return Err(Failure::of(name, message).help(format!("is this really {what}?")));
    }
    Ok(bytes)
}

/// A line of standard input, without its end; `None` where there is none any more.
pub(crate) fn answer() -> Result<Option<String>, Failure> {
    let mut line = Vec::new();
    let mut limited = std::io::stdin().lock().take(ANSWER_BYTES);
    let read = limited.read_until(b'\n', &mut line);
    read.map_err(|error| unreadable("standard input", "an answer", &error))?;
    Ok((!line.is_empty()).then(|| String::from_utf8_lossy(&line).trim().to_owned()))
}

/// Returns the name of a path in messages.
pub(crate) fn name(path: &str) -> &str {
    if path == "-" { "standard input" } else { path }
}

/// The bytes of a file as text, without a byte order mark.
pub(crate) fn utf8(path: &str, what: &str, bytes: Vec<u8>) -> Result<String, Failure> {
    if let Some(encoding) = wide(&bytes) {
        let message = format!("this is text in {encoding}, and {what} is text in UTF-8");
        return Err(Failure::of(name(path), message).help(
            "save it as UTF-8; in PowerShell: Get-Content FILE | Set-Content -Encoding utf8 NEW",
        ));
    }
    let text = String::from_utf8(bytes).map_err(|error| {
        let offset = error.utf8_error().valid_up_to();
        let byte = error.as_bytes().get(offset).copied().unwrap_or(0);
        let help = if byte >= 0xa0 {
            format!("{what} is text in UTF-8; save it as UTF-8, this may be Latin-1 (Windows-1252)")
        } else {
            format!("{what} is text in UTF-8; is this really {what}?")
        };
        let message = format!("the byte 0x{byte:02x} is not UTF-8");
        let text = String::from_utf8_lossy(error.as_bytes());
        let bare = text.strip_prefix(MARK).unwrap_or(&text);
        let at = offset.saturating_sub(text.len() - bare.len());
        located(path, bare.to_owned(), at, message, help)
    })?;
    let text = match text.strip_prefix(MARK) {
        Some(rest) => rest.to_owned(),
        None => text,
    };
    let Some(nul) = text.find('\0') else { return Ok(text) };
    let help = if text[nul..].bytes().all(|it| it == 0 || it.is_ascii_whitespace()) {
        "the file ends in such bytes, as after a loss of power: remove them"
    } else {
        "remove it; or this is no text at all"
    };
    let message = "a NUL, the byte 0x00, which is in no text".to_owned();
    Err(located(path, text, nul, message, help.to_owned()))
}

/// The byte order mark of UTF-8, as text.
const MARK: char = '\u{feff}';

/// The encoding of a text in units of more than a byte, if that is clear from how it begins.
fn wide(bytes: &[u8]) -> Option<&'static str> {
    match bytes {
        [0xff, 0xfe, 0, 0, ..] | [0, 0, 0xfe, 0xff, ..] => Some("UTF-32"),
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => Some("UTF-16"),
        [first, 0, second, 0, ..] | [0, first, 0, second, ..]
            if first.is_ascii() && second.is_ascii() && *first > 0 && *second > 0 =>
        {
            Some("UTF-16")
        }
        _ => None,
    }
}

/// An error at a byte of a text.
fn located(path: &str, text: String, at: usize, message: String, help: String) -> Failure {
    let before = text.get(..at).unwrap_or(&text);
    let line = 1 + before.matches('\n').count();
    let column = 1 + at - before.rfind('\n').map_or(0, |it| it + 1);
    FileErrors::at(name(path), text, line, column, message).help(help).into()
}

fn unreadable(name: &str, what: &str, error: &std::io::Error) -> Failure {
    match error.kind() {
        ErrorKind::NotFound => absent(name, what),
        ErrorKind::IsADirectory => Failure::of(name, "this is a directory, not a file")
            .help(format!("give the path of {what} in it")),
        kind => {
            let failure = Failure::of(name, format!("it cannot be read: {}", plain(error)));
            match kind {
                ErrorKind::PermissionDenied => failure.help("its owner can allow it, by chmod"),
                _ => failure,
            }
        }
    }
}

/// Says that a file is not there, and which one was probably meant.
fn absent(name: &str, what: &str) -> Failure {
    /// So many files of a folder are looked at.
    const LOOKED_AT: usize = 1000;
    let path = Path::new(name);
    let folder = folder_of(path);
    let file = path.file_name().and_then(|it| it.to_str()).unwrap_or_default();
    let failure = Failure::of(name, "there is no such file");
    let Ok(entries) = std::fs::read_dir(folder) else {
        return failure.help(format!("there is no folder `{}` either", folder.display()));
    };
    let entries = entries.take(LOOKED_AT).filter_map(|it| it.ok()?.file_name().into_string().ok());
    let entries: Vec<_> = entries.collect();
    match near(file, entries.iter().map(String::as_str)) {
        Some(near) => {
            let near = path.with_file_name(near);
            failure.help(format!("did you mean `{}`?", near.display()))
        }
        None => failure.help(format!("give the path of {what}")),
    }
}

/// The folder of a file.
pub(crate) fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|it| !it.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Returns the system's message, without its error number.
pub(crate) fn plain(error: &std::io::Error) -> String {
    let said = error.to_string();
    let said = said.split(" (os error").next().unwrap_or(&said);
    let mut letters = said.chars();
    letters.next().map_or_else(String::new, |first| first.to_lowercase().chain(letters).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_of_just_the_limit_is_read_and_of_a_byte_more_is_not() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml");
        let length = std::fs::metadata(path).unwrap().len();
        let read = |limit| bytes(path, "a manifest", limit).map(|it| it.len() as u64);
        assert_eq!((read(length).ok(), read(length - 1).ok()), (Some(length), None));
    }
}
