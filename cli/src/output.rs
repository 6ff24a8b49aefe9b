//! Writing: to standard output and error, and whole files at once.

use crate::answers::error::ErrorAnswer;
use crate::args::Color;
use crate::exit::Failure;
use crate::input::{folder_of, plain};
use crate::names::quoted;
use crate::render::fold::folded;
use crate::render::snippet;
use crate::render::style::terminal;
use anstream::{AutoStream, ColorChoice};
use cotama_core::text;
use serde::Serialize;
use std::fs;
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// The width where none is known, and the least that is used.
const WIDTH: usize = 100;
const LEAST_WIDTH: usize = 40;

/// The screen: where people and programs read the answers.
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
        Self { choice, width: width() }
    }

    /// How many characters fit on a line.
    pub(crate) fn width(&self) -> usize {
        self.width
    }

    /// Writes to standard output, in lines that fit; styles are left out where they are not wanted.
    /// A reader who has gone away is no error.
    pub(crate) fn print(&self, text: &str) -> Result<(), Failure> {
        let text = terminal(&folded(text, self.width));
        written(write_to(&mut AutoStream::new(io::stdout(), self.choice), text.as_bytes()))
    }

    /// Writes what the program itself says of its command line to standard output.
    pub(crate) fn printed(&self, own: &clap::builder::StyledStr) -> Result<(), Failure> {
        let text = own.ansi().to_string();
        written(write_to(&mut AutoStream::new(io::stdout(), self.choice), text.as_bytes()))
    }

    /// Writes one JSON object to standard output.
    pub(crate) fn json(answer: &impl Serialize) -> Result<(), Failure> {
        let text = serde_json::to_string_pretty(answer).map_err(|error| {
            Failure::new(format!("the answer cannot be written as JSON: {error}"))
        })?;
        // Escaped, it is the same text for a program, and none that a terminal obeys.
        Self::raw(format!("{}\n", text::json(&text)).as_bytes())
    }

    /// Writes to standard output as it is: a file in a format whose writer escapes names.
    pub(crate) fn raw(bytes: &[u8]) -> Result<(), Failure> {
        written(write_to(&mut io::stdout(), bytes))
    }

    /// Writes a note to standard error. Who cannot read it does not miss the answer.
    pub(crate) fn note(&self, text: &str) {
        self.say(&terminal(text));
    }

    fn say(&self, codes: &str) {
        let _ = writeln!(AutoStream::new(io::stderr(), self.choice), "{codes}");
    }

    /// Says why a command cannot do its work: to a program as an object on standard output, else
    /// on standard error.
    pub(crate) fn refuse(&self, failure: &Failure, is_json: bool) {
        if !is_json || Self::json(&ErrorAnswer::from(failure)).is_err() {
            self.explain(failure);
        }
    }

    /// Says on standard error why something cannot be done.
    pub(crate) fn explain(&self, failure: &Failure) {
        self.say(&snippet::failure(failure, self.width));
    }
}

/// How many characters fit on a line: what `COLUMNS` says, or what the terminal has.
pub(crate) fn width() -> usize {
    let named = std::env::var("COLUMNS").ok().and_then(|columns| columns.parse().ok());
    let measured =
        || terminal_size::terminal_size_of(io::stdout()).map(|(width, _)| usize::from(width.0));
    named.or_else(measured).filter(|&width| width > 0).unwrap_or(WIDTH).max(LEAST_WIDTH)
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

/// A place for a file that a command is to write: refused before the work begins where nothing can
/// be written.
pub(crate) fn place(path: &Path) -> Result<(), Failure> {
    if path.is_dir() {
        return Err(is_folder(path).help("give the name of a file in it"));
    }
    if path.file_name().is_none() {
        return Err(wrong(path, "this is not the name of a file"));
    }
    there(folder_of(&target(path)?))
}

/// A place for the folder of a report, which is made if it is not there.
pub(crate) fn report(folder: &Path) -> Result<(), Failure> {
    if folder.is_dir() {
        let page = folder.join("index.html");
        return if page.is_dir() { Err(is_folder(&page)) } else { Ok(()) };
    }
    if folder.exists() {
        return Err(wrong(folder, "this is a file, and the report is a folder"));
    }
    there(folder_of(folder))
}

fn is_folder(path: &Path) -> Failure {
    wrong(path, "this is a directory, a file was to be written there")
}

fn there(folder: &Path) -> Result<(), Failure> {
    if folder.is_dir() {
        return Ok(());
    }
    if folder.exists() {
        return Err(wrong(folder, "this is a file, and a folder is needed there"));
    }
    let make = quoted(&folder.display().to_string());
    Err(wrong(folder, "there is no such folder").help(format!("make it: mkdir -p {make}")))
}

fn wrong(path: &Path, message: impl Into<String>) -> Failure {
    Failure::of(path.display().to_string(), message)
}

/// Writes a file as a whole: under another name in the same folder, which then takes the place of
/// the old file. When it fails, whatever stood there before still does.
pub(crate) fn file(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    place(path)?;
    // A device or a pipe cannot be replaced; it is written to.
    if path.metadata().is_ok_and(|there| !there.is_file()) {
        return fs::write(path, bytes).map_err(|error| unwritten(path, &error));
    }
    replaced(path, |file| write_to(file, bytes).map_err(|error| unwritten(path, &error)))
}

/// Writes a file piece by piece under another name in the same folder, which then takes the place
/// of the old file; where that fails, whatever stood there before still does.
pub(crate) fn replaced(
    path: &Path,
    write: impl FnOnce(&mut fs::File) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let target = target(path)?;
    let mut temporary = std::ffi::OsString::from(".");
    temporary.push(target.file_name().unwrap_or_default());
    temporary.push(format!(".{}.part", std::process::id()));
    let temporary = folder_of(&target).join(temporary);
    let wrong = |error: io::Error| unwritten(path, &error);
    // The new file has the permissions of the old one, and no others.
    let mode = target.metadata().ok().map(|it| it.permissions());
    let whole = fs::File::create(&temporary)
        .and_then(|file| mode.map_or(Ok(()), |it| file.set_permissions(it)).map(|()| file))
        .map_err(wrong)
        .and_then(|mut file| write(&mut file))
        .and_then(|()| fs::rename(&temporary, &target).map_err(wrong));
    whole.inspect_err(|_| {
        let _ = fs::remove_file(&temporary);
    })
}

/// The file that a path names: of a symbolic link the one that it leads to, there or not.
fn target(path: &Path) -> Result<PathBuf, Failure> {
    /// As many links as Linux follows.
    const MOST: usize = 40;
    let mut target = path.to_owned();
    for _ in 0..MOST {
        match fs::read_link(&target) {
            Ok(next) => target = folder_of(&target).join(next),
            Err(_) => return Ok(target),
        }
    }
    Err(wrong(path, "this symbolic link leads to links without end"))
}

/// Makes a folder, and those that it is in.
pub(crate) fn make_folder(path: &Path) -> Result<(), Failure> {
    fs::create_dir_all(path).map_err(|error| unwritten(path, &error))
}

/// Says why something cannot be written.
pub(crate) fn unwritten(path: &Path, error: &io::Error) -> Failure {
    let failure = wrong(path, format!("it cannot be written: {}", plain(error)));
    match error.kind() {
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            failure.help("choose a folder in which you may write")
        }
        _ => failure,
    }
}
