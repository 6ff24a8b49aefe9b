//! The folder of traces and trees, which is not part of the project.

use cotama_trees::diagnostic::Refusal;
use cotama_trees::kinds::LeafKind;
use cotama_trees::reader::{Loaded, Options, read};
use std::path::{Path, PathBuf};

pub(crate) fn folder() -> Option<PathBuf> {
    cotama_golden::public_folder("COTAMA_BT_DIR", "behaviour trees")
}

pub(crate) fn text(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|it| panic!("{}: {it}", path.display()))
}

pub(crate) fn load(path: &Path, options: &Options) -> Result<Loaded, Refusal> {
    let mut files = |path: &str| std::fs::read(path).map_err(|it| it.to_string());
    read(path.to_str().unwrap(), &mut files, options)
}

/// Returns the options with which the real trees were explored.
pub(crate) fn real(folder: &Path, main: Option<&str>) -> Options {
    let models = folder.join("trees/nav2/nav2_tree_nodes.xml");
    Options {
        models: vec![models.to_str().unwrap().to_owned()],
        unknown: Some(LeafKind::Stateful),
        main: main.map(str::to_owned),
        ..Options::default()
    }
}
