//! Sources of the workspace, their comments and their tests.

use std::fs;
use std::path::Path;

/// A source by its path from the root.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    pub(crate) path: String,
    pub(crate) text: String,
}

/// Returns all sources below a folder, sorted by path.
pub(crate) fn sources(root: &Path) -> Vec<Source> {
    let (mut all, mut open) = (Vec::new(), vec![root.to_owned()]);
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            if path.is_dir() {
                if name != "target" && !name.starts_with('.') {
                    open.push(path);
                }
            } else if name.ends_with(".rs") {
                let text = fs::read_to_string(&path).expect("a source");
                let path = path.strip_prefix(root).expect("a path below the root");
                all.push(Source { path: path.to_string_lossy().replace('\\', "/"), text });
            }
        }
    }
    all.sort_by(|a, b| a.path.cmp(&b.path));
    all
}

/// Splits a line that is a comment into its marker and its text.
fn comment(line: &str) -> Option<(&'static str, &str)> {
    let line = line.trim_start();
    let marker = ["///", "//!", "//"].into_iter().find(|it| line.starts_with(it))?;
    Some((marker, line[marker.len()..].trim_start()))
}

/// Returns the blocks of comments: lines in a row with one marker, joined, with the first line's
/// number.
pub(crate) fn blocks(text: &str) -> Vec<(usize, String)> {
    let mut all: Vec<(usize, String)> = Vec::new();
    let mut last = None;
    for (at, line) in text.lines().enumerate() {
        let found = comment(line);
        match (found, all.last_mut()) {
            (Some((marker, more)), Some(block)) if last == Some(marker) => {
                block.1.push(' ');
                block.1.push_str(more);
            }
            (Some((_, first)), _) => all.push((at + 1, first.to_owned())),
            (None, _) => {}
        }
        last = found.map(|it| it.0);
    }
    all
}

/// Returns the functions marked as tests or as harnesses, each with its line.
pub(crate) fn test_names(text: &str) -> Vec<(usize, String)> {
    let (mut all, mut is_test) = (Vec::new(), false);
    for (at, line) in text.lines().enumerate() {
        let line = line.trim();
        if line == "#[test]" || line.starts_with("#[kani::proof") {
            is_test = true;
        }
        let function = line.strip_prefix("pub ").unwrap_or(line).strip_prefix("fn ");
        if let (true, Some(rest)) = (is_test, function) {
            let name = rest.split(['(', '<']).next().unwrap_or_default();
            all.push((at + 1, name.to_owned()));
            is_test = false;
        }
    }
    all
}
