//! Writing: to standard output and error, and whole files at once.

use crate::args::Color;
use crate::exit::Failure;
use crate::input::plain;
use crate::render::snippet;
use anstream::{AutoStream, ColorChoice};
use serde::Serialize;
use std::fs;
use std::io::{self, ErrorKind, Write};
use std::path::Path;

/// The width where none is known, and the least that is used.
const WIDTH: usize = 100;
const LEAST_WIDTH: usize = 40;

/// Where people and programs read the answers.
#[derive(Debug)]
pub(crate) struct Screen {
    choice: ColorChoice,
    width: usize,
}

impl Screen {
    /// The terminal, or whatever stands in its place.
    pub(crate) fn new(color: Color) -> Self {
        let choice = match color {
            Color::Auto => ColorChoice::Auto,
            Color::Always => ColorChoice::Always,
            Color::Never => ColorChoice::Never,
        };
        let named = std::env::var("COLUMNS").ok().and_then(|columns| columns.parse().ok());
        let measured =
            || terminal_size::terminal_size_of(io::stdout()).map(|(width, _)| usize::from(width.0));
        let width =
            named.or_else(measured).filter(|&width| width > 0).unwrap_or(WIDTH).max(LEAST_WIDTH);
        Self { choice, width }
    }

    /// How many characters fit on a line.
    pub(crate) fn width(&self) -> usize {
        self.width
    }

    /// Writes to standard output; styles are left out where they are not wanted. A reader who has
    /// gone away is no error.
    pub(crate) fn print(&self, text: &str) -> Result<(), Failure> {
        written(write_to(&mut AutoStream::new(io::stdout(), self.choice), text.as_bytes()))
    }

    /// Writes one JSON object to standard output.
    pub(crate) fn json(answer: &impl Serialize) -> Result<(), Failure> {
        let text = serde_json::to_string_pretty(answer).map_err(|error| {
            Failure::new(format!("the answer cannot be written as JSON: {error}"))
        })?;
        Self::raw(format!("{text}\n").as_bytes())
    }

    /// Writes to standard output as it is.
    pub(crate) fn raw(bytes: &[u8]) -> Result<(), Failure> {
        written(write_to(&mut io::stdout(), bytes))
    }

    /// Writes a note to standard error. Who cannot read it does not miss the answer.
    pub(crate) fn note(&self, text: &str) {
        let _ = writeln!(AutoStream::new(io::stderr(), self.choice), "{text}");
    }

    /// Says on standard error why a command cannot do its work.
    pub(crate) fn explain(&self, failure: &Failure) {
        self.note(&snippet::failure(failure, self.width));
    }
}

fn write_to(stream: &mut impl Write, bytes: &[u8]) -> io::Result<()> {
    stream.write_all(bytes)?;
    stream.flush()
}

fn written(result: io::Result<()>) -> Result<(), Failure> {
    match result {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::new(format!("standard output cannot be written: {}", plain(&error))))
        }
        _ => Ok(()),
    }
}

/// Writes a file as a whole: under another name in the same folder, which then takes the place of
/// the old file. Missing folders are made. When it fails, whatever stood there before still does.
pub(crate) fn file(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let shown = path.display();
    let refused = |error: &io::Error| {
        Failure::new(format!("{shown}: it cannot be written: {}", plain(error)))
    };
    if path.is_dir() {
        return Err(Failure::new(format!(
            "{shown}: this is a directory, a file was to be written there"
        )));
    }
    let Some(name) = path.file_name() else {
        return Err(Failure::new(format!("{shown}: this is not the name of a file")));
    };
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    fs::create_dir_all(folder).map_err(|error| {
        Failure::new(format!("{}: this folder cannot be made: {}", folder.display(), plain(&error)))
    })?;
    // A device or a pipe cannot be replaced; it is written to.
    if path.metadata().is_ok_and(|there| !there.is_file()) {
        return fs::write(path, bytes).map_err(|error| refused(&error));
    }
    let mut temporary = std::ffi::OsString::from(".");
    temporary.push(name);
    temporary.push(format!(".{}.part", std::process::id()));
    let temporary = folder.join(temporary);
    let whole = fs::File::create(&temporary)
        .and_then(|mut file| write_to(&mut file, bytes))
        .and_then(|()| fs::rename(&temporary, path));
    whole.map_err(|error| {
        let _ = fs::remove_file(&temporary);
        refused(&error)
    })
}
