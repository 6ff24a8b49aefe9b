//! Files that are looked at again and again.

use crate::args::CheckArgs;
use crate::exit::Failure;
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::{Duration, SystemTime};

/// How often files are looked at.
const PERIOD: Duration = Duration::from_millis(200);

/// When a file was written, and how long it is; `None` where it is not there.
pub(super) type Stamp = Option<(SystemTime, u64)>;

/// The files that a check reads.
pub(super) fn files(args: &CheckArgs) -> Result<Vec<PathBuf>, Failure> {
    let named = std::iter::once(&args.model).chain(&args.properties);
    let files: Vec<_> = named.filter(|it| Path::new(it).is_file()).map(PathBuf::from).collect();
    if files.is_empty() {
        let message = format!("there is no file to watch: `{}` is none", args.model);
        return Err(Failure::new(message).help("name a file, or leave --watch out"));
    }
    Ok(files)
}

pub(super) fn stamps(files: &[PathBuf]) -> Vec<Stamp> {
    let stamp = |it: &PathBuf| {
        let there = it.metadata().ok()?;
        Some((there.modified().ok()?, there.len()))
    };
    files.iter().map(stamp).collect()
}

/// Waits until a file is another one. One that an editor has just taken away is waited for.
pub(super) fn until_changed(files: &[PathBuf], before: &[Stamp]) {
    loop {
        sleep(PERIOD);
        let now = stamps(files);
        if now != before && now.iter().all(Option::is_some) {
            return;
        }
    }
}
