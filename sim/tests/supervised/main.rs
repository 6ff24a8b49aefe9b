//! Missions under COTAMA's supervisors.
//!
//! `UPDATE_GOLDEN=1 cargo test -p cotama-sim --test supervised` rewrites the golden files.
#![allow(missing_docs, clippy::pedantic, clippy::unwrap_used)]

mod answers;
mod crashes;
mod ends;
mod limits;
mod matrix;
mod moments;
mod observers;
mod other_missions;
mod pairs;
mod passing;
mod recovery;
mod rules;
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
    cotama_golden::compare(std::path::Path::new("tests/golden").join(name), found);
}
