//! Outputs that are made of results: the page, the table, the files of failures.
//!
//! They are removed before runs go on and written anew when all is known, so that those of an
//! earlier call, or of a part of the runs, never stand beside results that they are not made of.

use crate::exit::Failure;
use crate::output;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// The folder of failures in one of results.
pub(super) fn failures(folder: &Path) -> PathBuf {
    folder.join("failures")
}

/// The file of a failure, by its number from 1.
pub(super) fn failure(folder: &Path, number: usize) -> PathBuf {
    failures(folder).join(format!("{number:03}.toml"))
}

/// Removes those that a campaign wrote.
///
/// # Errors
/// When a file stands where one of a failure belongs and no campaign wrote it, or one cannot be
/// removed.
pub(super) fn clear(folder: &Path) -> Result<(), Failure> {
    let there = failures(folder);
    let mut old = Vec::new();
    let entries = fs::read_dir(&there).into_iter().flatten().flatten();
    for path in entries.map(|it| it.path()).filter(|it| is_numbered(it)) {
        // Files of an unlike kind are not text, perhaps.
        let text = fs::read(&path).unwrap_or_default();
        if !text.starts_with(b"# Breaks `") {
            let message = "no campaign wrote this file, and one would write over it";
            return Err(
                Failure::of(path.display().to_string(), message).help("move it to another folder")
            );
        }
        old.push(path);
    }
    old.sort();
    old.extend(["index.html", "runs.parquet"].map(|it| folder.join(it)));
    for path in old {
        match fs::remove_file(&path) {
            Err(error) if error.kind() != ErrorKind::NotFound => {
                return Err(output::unwritten(&path, &error));
            }
            _ => {}
        }
    }
    // One with files of somebody else stays.
    let _ = fs::remove_dir(there);
    Ok(())
}

/// Whether a file is called as that of a failure.
fn is_numbered(path: &Path) -> bool {
    let is_toml = path.extension().is_some_and(|it| it == "toml");
    let stem = path.file_stem().and_then(|it| it.to_str()).unwrap_or_default();
    is_toml && stem.len() >= 3 && stem.bytes().all(|it| it.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_a_campaign_wrote_is_removed() {
        let folder = std::env::temp_dir().join(format!("cotama-derived-{}", std::process::id()));
        fs::create_dir_all(failures(&folder)).unwrap();
        let write = |name: &str, text: &str| fs::write(folder.join(name), text).unwrap();
        for name in ["failures/001.toml", "failures/017.toml", "failures/1234.toml"] {
            write(name, "# Breaks `completed`: ..\n");
        }
        let kept = ["failures/mine.toml", "failures/01.toml", "failures/notes.md", "runs.jsonl"];
        kept.iter().for_each(|it| write(it, "kept"));
        ["index.html", "runs.parquet"].iter().for_each(|it| write(it, "old"));
        clear(&folder).unwrap();
        let mut left: Vec<_> = ["failures", "."]
            .iter()
            .flat_map(|it| fs::read_dir(folder.join(it)).unwrap())
            .map(|it| it.unwrap().file_name().into_string().unwrap())
            .collect();
        left.sort();
        assert_eq!(left, ["01.toml", "failures", "mine.toml", "notes.md", "runs.jsonl"]);
        // Files of others are never written over, and nothing is removed then.
        write("failures/002.toml", "# my own\n");
        write("index.html", "new");
        let refused = clear(&folder).unwrap_err();
        assert!(format!("{refused:?}").contains("002.toml"), "{refused:?}");
        assert!(folder.join("index.html").exists());
        fs::remove_dir_all(&folder).unwrap();
        // A folder that is not there has nothing to remove.
        clear(&folder).unwrap();
    }
}
