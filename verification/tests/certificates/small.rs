//! The checker is small enough to be read.

use std::fs;
use std::path::Path;

/// All of it: the checker, and what it shares with the crate: data types, reading, sums and answers.
const ALL: [&str; 7] = [
    "mod.rs",
    "read.rs",
    "sum.rs",
    "verified.rs",
    "verify/mod.rs",
    "verify/truth.rs",
    "verify/refutation.rs",
];

/// Whether a line says something: no comment, no attribute, no import, no closing bracket alone.
fn is_read(line: &str) -> bool {
    let line = line.trim();
    let starts = ["//", "#[", "use ", "pub use ", "pub(crate) use ", "pub(super) use ", "mod "];
    let closes = line.chars().all(|it| "})],;".contains(it));
    !closes && !starts.iter().any(|it| line.starts_with(it))
}

#[test]
fn what_a_sceptic_reads_is_fewer_than_600_lines() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/certificate");
    let lines = |file: &str| {
        let text = fs::read_to_string(folder.join(file)).unwrap();
        text.lines().filter(|it| is_read(it)).count()
    };
    let lines: usize = ALL.into_iter().map(lines).sum();
    assert!((400..600).contains(&lines), "{lines} lines");
}

/// What the checker takes from outside of its folder: data types, their reading, and sums.
#[test]
fn the_checker_uses_no_engine() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/certificate");
    for file in &ALL[1..] {
        let text = fs::read_to_string(folder.join(file)).unwrap();
        let foreign = |it: &&str| it.contains("crate::") && !it.contains("crate::certificate");
        assert_eq!(text.lines().find(foreign), None, "{file}");
    }
}
