//! `cotama export`: models as files of other tools.

use crate::common::{Folder, golden};
use std::path::Path;

const FORMATS: [(&str, &str, &str); 8] = [
    ("dot", "gv", "digraph"),
    ("svg", "svg", "<svg xmlns="),
    ("pnml", "pnml", "<?xml"),
    ("mermaid", "mmd", "stateDiagram-v2"),
    ("scxml", "scxml", "<?xml"),
    ("jani", "jani", "{\n  \"jani-version\": 1"),
    ("matrix", "tsv", "# Matrices"),
    ("json", "json", "{\n  \"schema\": \"cotama/net/1\""),
];

#[test]
fn every_format_is_written_by_its_name_and_by_the_end_of_the_files_name() {
    let folder = Folder::new("export_formats");
    std::fs::create_dir(folder.path().join("out")).unwrap();
    for (format, end, begin) in FORMATS {
        let printed = folder.cotama(&["export", "door", "--format", format]);
        assert!(
            printed.code == Some(0) && printed.stdout.starts_with(begin),
            "{format}: {printed:?}"
        );
        let file = format!("out/door.{end}");
        let written = folder.cotama(&["export", "door", "--output", &file]);
        assert_eq!((written.code, written.stdout.as_str()), (Some(0), ""));
        assert!(written.stderr.ends_with(&format!("written: {file}\n")), "{written:?}");
        assert_eq!(folder.read(&file), printed.stdout, "{format}");
    }
    assert_eq!(folder.files("out").len(), FORMATS.len());
}

/// The page that tells the delivery shows what the program draws; `UPDATE_GOLDEN=1` draws it anew.
#[test]
fn the_drawings_of_the_delivery_are_those_of_the_program() {
    let folder = Folder::new("export_delivery");
    let page = include_str!("../../docs/delivery.md");
    let models = [
        "delivery",
        "global",
        "local",
        "path_following",
        "teleoperation",
        "contextual",
        "observation",
        "permit",
    ];
    for model in models {
        let drawn = folder.cotama(&["export", model, "--format", "svg"]);
        assert_eq!(drawn.code, Some(0), "{drawn:?}");
        let path =
            Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../docs/delivery/{model}.svg"));
        cotama_golden::compare(&path, &drawn.stdout);
        assert!(page.contains(&format!("(delivery/{model}.svg)")), "{model} is not shown");
    }
}

#[test]
fn pnml_and_json_lose_nothing() {
    let folder = Folder::new("export_back");
    for model in ["door", "charger", "operator", "kanban:3"] {
        let json = folder.cotama(&["export", model, "--format", "json"]).stdout;
        for format in ["json", "pnml"] {
            let line =
                format!("cotama export {model} --format {format} | cotama export - --format json");
            assert_eq!(folder.shell(&line).stdout, json, "{model} as {format}");
        }
    }
}

#[test]
fn a_drawing_is_of_states_or_of_places_and_transitions() {
    let folder = Folder::new("export_styles");
    let drawn = |style: &str| {
        folder.cotama(&["export", "door", "--format", "mermaid", "--style", style]).stdout
    };
    assert!(drawn("states").starts_with("stateDiagram-v2"));
    assert!(drawn("auto").starts_with("stateDiagram-v2"));
    assert!(drawn("net").starts_with("flowchart"));
}

#[test]
fn an_interval_that_a_chart_does_not_keep_is_noted() {
    let folder = Folder::new("export_unkept");
    let ended = folder.cotama(&["export", "charger", "--output", "charger.scxml"]);
    assert_eq!(ended.code, Some(0));
    golden("export_unkept.txt", &ended.stderr);
}

#[test]
fn a_file_is_written_as_a_whole_or_left_as_it_was() {
    let folder = Folder::new("export_whole");
    folder.write("door.svg", "kept");
    for name in ["door.svg", "new.svg"] {
        // The system refuses to write more than a few KiB.
        let ended =
            folder.shell(&format!("trap '' XFSZ; ulimit -f 4; cotama export door --output {name}"));
        assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{ended:?}");
        assert_eq!(ended.stderr, format!("error: {name}: it cannot be written: file too large\n"));
    }
    assert_eq!(
        (folder.files(""), folder.read("door.svg")),
        (vec!["door.svg".to_owned()], "kept".to_owned())
    );
}
