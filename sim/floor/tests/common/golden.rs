//! Messages of broken files, one block a case, kept in a file.

use std::path::Path;

/// Compares what each case says with the file; with `UPDATE_GOLDEN=1` it is written anew.
#[track_caller]
pub(crate) fn holds(file: &str, said: &[(String, String)]) {
    let block = |(name, said): &(String, String)| format!("# {name}\n{said}\n\n");
    let found: String = said.iter().map(block).collect();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden").join(file);
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        std::fs::write(&path, &found).unwrap();
    }
    let kept = std::fs::read_to_string(&path).unwrap_or_default();
    let blocks = |text: &str| text.split("\n\n").map(str::to_owned).collect::<Vec<_>>();
    for (found, kept) in blocks(&found).iter().zip(blocks(&kept)) {
        assert_eq!(*found, kept, "with UPDATE_GOLDEN=1 {file} is written anew");
    }
    assert_eq!(found, kept, "{file}");
}
