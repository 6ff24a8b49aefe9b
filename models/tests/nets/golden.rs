//! Texts that are kept: `UPDATE_GOLDEN=1 cargo test` writes them anew.

use std::path::Path;

pub(crate) fn check(name: &str, text: &str) {
    cotama_golden::compare(Path::new("tests/golden/nets").join(name), text);
}
