//! Golden files: texts that tests keep, and compare with what they find; public files, which the
//! project does not keep; figures that pages print.

mod figures;
mod json;

pub use figures::{figure, figures};
pub use json::json_lines;

use std::ffi::OsStr;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// Compares what a test found with a kept file. A relative path starts at the folder of the
/// package, in which Cargo runs its tests.
///
/// With `UPDATE_GOLDEN` set the file is written first; then it is compared all the same.
///
/// # Panics
/// When the file cannot be written or read, and when it differs.
#[track_caller]
pub fn compare(path: impl AsRef<Path>, found: &str) {
    let path = path.as_ref();
    let name = path.display();
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        write(path, found).unwrap_or_else(|error| panic!("{name}: {error}"));
    }
    let kept = fs::read_to_string(path)
        .unwrap_or_else(|error| panic!("{name}: {error}; UPDATE_GOLDEN=1 writes it"));
    if kept == found {
        return;
    }
    // Behind the last line of both, only the ends of lines differ.
    let (mut kept, mut found) = (kept.lines(), found.lines());
    for line in 1.. {
        let (kept, found) = (kept.next(), found.next());
        assert!(
            kept == found && kept.is_some(),
            "{name} differs in line {line}; UPDATE_GOLDEN=1 writes it anew\n kept: {}\nfound: {}",
            kept.unwrap_or("(its end)"),
            found.unwrap_or("(its end)")
        );
    }
}

/// Writes a file at once: other tests may be reading it.
fn write(path: &Path, text: &str) -> std::io::Result<()> {
    static WRITTEN: AtomicU32 = AtomicU32::new(0);
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    let number = WRITTEN.fetch_add(1, Relaxed);
    let new = path.with_extension(format!("{}-{number}.new", std::process::id()));
    fs::write(&new, text)?;
    fs::rename(new, path)
}

/// The folder of public files that this environment variable names; `None`, said loudly, where it
/// names none and tests of public files are to be [skipped](skips). Then `what` is not tested.
///
/// # Panics
/// When the variable names a folder that is not there, or that is empty; when it names none and the
/// test is not to be skipped.
#[must_use]
#[track_caller]
pub fn public_folder(variable: &str, what: &str) -> Option<PathBuf> {
    let named = std::env::var_os(variable).map(PathBuf::from);
    match folder_or_skip(named, skips()) {
        Ok(Some(folder)) => Some(folder),
        Ok(None) => {
            skipped(&format!("{variable} names no folder to test {what} with"));
            None
        }
        Err(why) => panic!("{variable}: {why}"),
    }
}

/// The folder that was named, or none where none was and that is no mistake.
///
/// # Errors
/// What is wrong with the folder, or that there must be one.
pub fn folder_or_skip(named: Option<PathBuf>, skips: bool) -> Result<Option<PathBuf>, String> {
    let Some(folder) = named else {
        let why = "it names no folder; COTAMA_SKIP_PUBLIC=1 skips this test";
        return if skips { Ok(None) } else { Err(why.into()) };
    };
    match fs::read_dir(&folder).map(|mut files| files.next().is_some()) {
        Ok(true) => Ok(Some(folder)),
        Ok(false) => Err(format!("{} is empty", folder.display())),
        Err(error) => Err(format!("{}: {error}", folder.display())),
    }
}

/// Whether tests that need what is no part of the project, public files or Graphviz, are skipped
/// where it is missing: if `COTAMA_SKIP_PUBLIC` is 1. Cargo sets it so in this workspace
/// (`.cargo/config.toml`), so that tests pass where nothing else is installed; who has all of it
/// sets 0, as `.ci/run` does.
#[must_use]
pub fn skips() -> bool {
    is_skip(std::env::var_os("COTAMA_SKIP_PUBLIC").as_deref())
}

/// Returns whether this value of `COTAMA_SKIP_PUBLIC` says to skip: a missing tool or file is
/// passed over only where it is 1.
#[must_use]
pub fn is_skip(value: Option<&OsStr>) -> bool {
    value.is_some_and(|it| it == "1")
}

/// Whether a tool that is no part of the project is there; where it is not, that is said loudly,
/// and `what` is not tested.
///
/// # Panics
/// When it cannot be run and the test is not to be skipped.
#[must_use]
#[track_caller]
pub fn has_tool(tool: &str, what: &str) -> bool {
    let runs = |it: &mut Command| it.stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok();
    match tool_or_skip(runs(Command::new(tool).arg("-V")), skips()) {
        Ok(true) => true,
        Ok(false) => {
            skipped(&format!("{tool} is not installed to test {what} with"));
            false
        }
        Err(why) => panic!("{tool}: {why}"),
    }
}

/// Whether a tool is there, or lacks and that is no mistake.
///
/// # Errors
/// That there must be one.
pub fn tool_or_skip(is_there: bool, skips: bool) -> Result<bool, &'static str> {
    match (is_there, skips) {
        (true, _) => Ok(true),
        (false, true) => Ok(false),
        (false, false) => Err("it is not installed; COTAMA_SKIP_PUBLIC=1 skips this test"),
    }
}

/// Says what a test does not test here, and why.
pub fn skipped(why: &str) {
    // Not by `eprintln`, which says nothing when a test passes.
    let _ = std::io::stderr().write_all(format!("SKIPPED: {why}\n").as_bytes());
}
