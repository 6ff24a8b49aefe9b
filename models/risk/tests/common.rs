//! Files of `data`.

use cotama_risk::{Data, Network};
use std::fs;
use std::path::Path;

/// Reads a file of the folder `data`.
pub(crate) fn text(name: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("data").join(name)).unwrap()
}

pub(crate) fn network(name: &str) -> Network {
    let (network, notes) = Network::from_bif(&text(&format!("{name}.bif"))).unwrap();
    assert!(notes.is_empty(), "{notes:?}");
    network
}

pub(crate) fn data(name: &str) -> Data {
    Data::from_csv(&text(&format!("{name}.csv"))).unwrap()
}

/// Cells of a file with tabs between them, without its header and comments.
pub(crate) fn cells(name: &str) -> Vec<Vec<String>> {
    let text = text(name);
    let lines = text.lines().filter(|it| !it.starts_with('#')).skip(1);
    lines.map(|it| it.split('\t').map(str::to_owned).collect()).collect()
}
