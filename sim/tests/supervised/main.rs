//! Missions under COTAMA's supervisors.
//!
//! `UPDATE_GOLDEN=1 cargo test -p cotama-sim --test supervised` rewrites the golden files.
#![allow(missing_docs, clippy::pedantic, clippy::unwrap_used)]

mod matrix;
mod other_missions;
mod recovery;
mod seven_points;
mod trace;
mod triples;

use cotama_models::missions::Mission;

fn delivery() -> Mission {
    let delivery = cotama_models::missions::embedded::mission("delivery").unwrap();
    Mission::parse(delivery.name, delivery.text).unwrap()
}

/// Compares with the golden file of this name.
fn golden(name: &str, found: &str) {
    let path = format!("{}/tests/golden/{name}", env!("CARGO_MANIFEST_DIR"));
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        std::fs::write(&path, found).unwrap();
    }
    let expected = std::fs::read_to_string(&path).unwrap_or_default();
    let line = expected.lines().zip(found.lines()).position(|(a, b)| a != b);
    assert!(
        expected == found,
        "{name} differs, first in line {line:?}; UPDATE_GOLDEN=1 rewrites it"
    );
}
