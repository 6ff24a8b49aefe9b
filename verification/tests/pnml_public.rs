//! Nets of others. The folder of them is given by the environment variable `COTAMA_MCC_DIR`: files
//! `*.pnml`, and `facts.tsv` with the columns model, places, transitions and arcs.

use cotama_golden::public_folder;
use cotama_verification::pnml;
use std::collections::BTreeMap;
use std::path::Path;

/// The numbers of places, transitions and arcs of each model.
fn facts(folder: &Path) -> BTreeMap<String, [usize; 3]> {
    let text = std::fs::read_to_string(folder.join("facts.tsv")).unwrap();
    let mut lines = text.lines().map(|line| line.split('\t').collect::<Vec<_>>());
    let header = lines.next().unwrap();
    let column = |name: &str| header.iter().position(|column| *column == name).unwrap();
    let [places, transitions, arcs] = ["places", "transitions", "arcs"].map(column);
    let row = |row: Vec<&str>| {
        (
            row[column("model")].to_owned(),
            [places, transitions, arcs].map(|column| row[column].parse().unwrap()),
        )
    };
    lines.map(row).collect()
}

#[test]
fn public_nets_have_the_known_numbers_of_places_transitions_and_arcs() {
    let Some(folder) = public_folder("COTAMA_MCC_DIR", "the reader of PNML") else { return };
    let facts = facts(&folder);
    let mut files: Vec<_> =
        std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|file| file.extension().is_some_and(|extension| extension == "pnml"));
    files.sort();
    assert_eq!((files.len(), facts.len()), (30, 30), "one fact for each net");
    for file in files {
        let model = file.file_stem().unwrap().to_str().unwrap();
        let net = match pnml::read(model, &std::fs::read(&file).unwrap()) {
            Ok(net) => net,
            Err(errors) => panic!("{errors}"),
        };
        let arcs = net
            .transitions
            .iter()
            .map(|it| it.take.len() + 2 * it.read.len() + it.give.len())
            .sum();
        assert_eq!([net.places.len(), net.transitions.len(), arcs], facts[model], "{model}");
        let view = net.view();
        assert_eq!(view.net().defect(), None, "{model}");
        assert_eq!(
            pnml::read(model, pnml::write(&view.net()).as_bytes()).as_ref(),
            Ok(&net),
            "{model}"
        );
        assert_eq!(
            pnml::read(model, pnml::write_for_tina(&view.net()).as_bytes()).as_ref(),
            Ok(&net),
            "{model}"
        );
    }
}
