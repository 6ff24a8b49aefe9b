//! Numbers and maps that several tests use.
#![allow(dead_code, clippy::unwrap_used, clippy::cast_precision_loss)]

use cotama_floor::Grid;
use cotama_floor::map_server::{Map, Metadata};
use cotama_fuzz::Random;
use std::path::{Path, PathBuf};

/// A number from 0 to 1.
pub(crate) fn part(random: &mut Random) -> f64 {
    random.below(1 << 40) as f64 / (1_u64 << 40) as f64
}

/// The folder of the public maps; says so where it is not given.
pub(crate) fn folder() -> Option<PathBuf> {
    cotama_golden::public_folder("COTAMA_MAPS_DIR", "ways on the public maps")
}

/// Compares what broken files are answered with what is kept.
#[track_caller]
pub(crate) fn compare(file: &str, said: &[(String, String)]) {
    let mut blocks: Vec<_> = said.iter().map(|it| format!("# {}\n{}\n", it.0, it.1)).collect();
    blocks.push(String::new());
    let found = blocks.join("\n");
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    cotama_golden::compare(folder.join(file), &found);
}

/// The maps of a folder, by name.
pub(crate) fn maps(folder: &Path) -> Vec<(String, Grid)> {
    let files = std::fs::read_dir(folder).unwrap().map(|it| it.unwrap().path());
    let mut files: Vec<_> =
        files.filter(|it| it.extension().is_some_and(|it| it == "yaml")).collect();
    files.sort();
    let read = |file: &PathBuf| {
        let name = file.file_stem().unwrap().to_string_lossy().into_owned();
        let text = std::fs::read_to_string(file).unwrap();
        let (metadata, warnings) = Metadata::parse(&name, &text).unwrap();
        assert!(warnings.is_empty());
        let image = std::fs::read(metadata.image_path(file)).unwrap();
        (name, Map::read(&metadata, &metadata.image, &image).unwrap().grid().unwrap())
    };
    files.iter().map(read).collect()
}
