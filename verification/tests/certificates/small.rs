//! The checker is small enough to be read.

use std::fs;
use std::path::Path;

#[test]
fn the_checker_has_fewer_than_400_lines() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/certificate/verify");
    let files = fs::read_dir(&folder).unwrap().map(|it| it.unwrap().path());
    let lines: usize = files.map(|it| fs::read_to_string(it).unwrap().lines().count()).sum();
    assert!((1..400).contains(&lines), "{lines} lines");
}

/// What the checker takes from outside of its folder: data types, their reading, and sums.
#[test]
fn the_checker_uses_no_engine() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/certificate");
    let files = [
        "verify/mod.rs",
        "verify/truth.rs",
        "verify/refutation.rs",
        "read.rs",
        "sum.rs",
        "verified.rs",
    ];
    for file in files {
        let text = fs::read_to_string(folder.join(file)).unwrap();
        let foreign = |it: &&str| it.contains("crate::") && !it.contains("crate::certificate");
        assert_eq!(text.lines().find(foreign), None, "{file}");
    }
}
