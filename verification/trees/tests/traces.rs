//! Traces of the library.

use crate::folder::{folder, load, real, text};
use cotama_trees::conform::{conform, read};
use cotama_trees::reader::Options;

#[test]
fn every_trace_of_the_library_is_accepted() {
    let Some(folder) = folder() else { return };
    let (mut runs, mut rows, mut trees) = (0, 0, 0);
    for line in text(&folder.join("traces/index.tsv")).lines().filter(|it| !it.starts_with('#')) {
        let columns: Vec<_> = line.split('\t').collect();
        let (name, clock) = (columns[0], columns[1] == "yes");
        let (tree, main) = match columns[4].strip_prefix("of ") {
            Some(of) => {
                let (path, main) = of.split_once(", main tree ").unwrap_or((of, ""));
                (path.to_owned(), Some(main).filter(|it| !it.is_empty()))
            }
            None => (format!("traces/{name}.xml"), None),
        };
        let options =
            if name.starts_with("real/") { real(&folder, main) } else { Options::default() };
        let loaded = load(&folder.join(&tree), &options).unwrap_or_else(|it| panic!("{it}"));
        let trace = read(&text(&folder.join(format!("traces/{name}.tsv")))).unwrap();
        let accepted = conform(&loaded.tree, &trace, clock);
        let accepted = accepted.unwrap_or_else(|it| panic!("{name}: {it:#?}"));
        runs += accepted.runs;
        rows += accepted.rows;
        trees += 1;
    }
    assert_eq!((trees, runs), (68, 1_272));
    assert_eq!(rows, 10_055);
}
