//! The checker is small enough to be read.

use std::fs;
use std::path::Path;

/// All of it: the checker, and what it shares with the crate: data types, reading, sums and
/// answers.
const ALL: [&str; 7] = [
    "lib.rs",
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
fn the_checker_has_fewer_than_600_lines_to_read() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("certificate/src");
    let lines = |file: &str| {
        let text = fs::read_to_string(folder.join(file)).unwrap();
        text.lines().filter(|it| is_read(it)).count()
    };
    let lines: usize = ALL.into_iter().map(lines).sum();
    assert!((400..600).contains(&lines), "{lines} lines");
}

/// The checker takes only data types, their reading, and sums from outside of its folder, and its
/// crate sees no engine.
#[test]
fn the_checker_uses_no_engine() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("certificate");
    for file in &ALL[1..] {
        let text = fs::read_to_string(root.join("src").join(file)).unwrap();
        assert_eq!(text.lines().find(|it| it.contains("cotama_property")), None, "{file}");
    }
    let manifest = fs::read_to_string(root.join("Cargo.toml")).unwrap();
    let depends = manifest.split("[dependencies]\n").nth(1).unwrap().split("\n\n").next().unwrap();
    let names = depends.lines().map(|it| it.split(['.', ' ']).next().unwrap());
    let names: Vec<_> = names.collect();
    assert_eq!(names, ["cotama-core", "cotama-property", "serde", "serde_json"]);
    let below = fs::read_to_string(root.join("../property/Cargo.toml")).unwrap();
    let depends = below.split("[dependencies]\n").nth(1).unwrap().split("\n\n").next().unwrap();
    assert_eq!(depends.matches("cotama-").count(), 1, "{depends}");
}
