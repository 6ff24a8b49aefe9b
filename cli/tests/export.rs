//! `cotama export`: models as files of other tools.

use crate::common::{Folder, golden};
use std::path::Path;

const FORMATS: [(&str, &str, &str); 9] = [
    ("dot", "gv", "digraph"),
    ("svg", "svg", "<svg xmlns="),
    ("pnml", "pnml", "<?xml"),
    ("mermaid", "mmd", "stateDiagram-v2"),
    ("scxml", "scxml", "<?xml"),
    ("jani", "jani", "{\n  \"jani-version\": 1"),
    ("matrix", "tsv", "# Matrices"),
    ("net", "net", "net door\npl Closed (1)\n"),
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
    let drawings = [
        ("delivery", None),
        ("global", Some("gs")),
        ("local", Some("ls")),
        ("following", Some("following")),
        ("teleoperation", Some("teleoperation")),
        ("observation", Some("gom")),
        ("permit", Some("permit")),
    ];
    for (model, net) in drawings {
        let part: Vec<_> = net.iter().flat_map(|it| ["--net", it]).collect();
        let line = [&["export", "delivery", "--format", "svg"][..], &part].concat();
        let drawn = folder.cotama(&line);
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

/// A chart of transitions without events would run for ever at its start.
#[test]
fn a_chart_of_a_net_without_events_and_time_waits_for_its_transitions() {
    let folder = Folder::new("export_waits");
    let step = |at| format!("tr t{at} s{at} -> s{}\n", (at + 1) % 20);
    let ring = (0..20).map(step).collect::<Vec<_>>().concat();
    let mut names: Vec<_> = (0..20).map(|at| format!("t{at}")).collect();
    names.sort();
    let cycle = "tr go idle -> busy\ntr stop busy -> idle\npl idle (1)\n";
    for (net, events) in [
        (cycle.to_owned(), "go stop".to_owned()),
        (cycle.replace(" idle ->", " [0,w[ idle ->"), "go stop".to_owned()),
        (format!("{cycle}tr crash busy -> broken\n"), "crash go stop".to_owned()),
        ("tr spin a -> a\npl a (1)\n".to_owned(), "spin".to_owned()),
        ("tr left a -> b\ntr right a -> c\npl a (1)\n".to_owned(), "left right".to_owned()),
        (format!("{ring}pl s0 (1)\n"), names.join(" ")),
    ] {
        folder.write("it.net", &net);
        assert_eq!(folder.shell("cotama export it.net -o it.pnml").code, Some(0));
        for file in ["it.net", "it.pnml"] {
            let ended = folder.cotama(&["export", file, "--format", "scxml"]);
            assert_eq!(ended.code, Some(0), "{ended:?}");
            let said = "note: the net has neither events nor time: each transition of the chart \
                waits for an event of its name, as `cotama simulate` plays it\n";
            assert_eq!(ended.stderr, said, "{net}");
            let lines = ended.stdout.lines().filter(|it| it.contains("<transition "));
            let mut found: Vec<_> = lines
                .map(|it| it.split("event=\"").nth(1).and_then(|it| it.split('"').next()))
                .map(Option::unwrap)
                .collect();
            found.sort_unstable();
            assert_eq!(found.join(" "), events, "{net}");
        }
    }
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

#[test]
#[ignore = "seconds: CI runs it"]
fn a_system_is_exported_as_one_net() {
    let folder = Folder::new("export_system");
    for format in ["pnml", "json"] {
        is_still_the_robot(&folder, "delivery", format);
    }
    let any = ["export", "delivery", "--semantics", "interleaving", "--format", "json"];
    assert!(folder.cotama(&any).stdout.contains("ls.start_drive.room"));
    let door = folder.cotama(&["export", "door", "--semantics", "rounds", "--format", "json"]);
    assert_eq!((door.code, door.stdout.as_str()), (Some(2), ""));
}

#[test]
#[ignore = "a minute: CI runs it"]
fn a_system_is_exported_with_its_instants() {
    is_still_the_robot(&Folder::new("export_instants"), "transport", "net");
}

/// Asks the exported file what holds of the system.
fn is_still_the_robot(folder: &Folder, robot: &str, format: &str) {
    let file = format!("{robot}.{format}");
    let written = folder.cotama(&["export", robot, "--output", &file]);
    assert_eq!(written.code, Some(0), "{written:?}");
    let property = "AG (round & gs.Safe -> ls.Idle)";
    let result =
        folder.cotama(&["check", &file, "--property", property, "--engine", "explicit", "--json"]);
    assert_eq!(result.json(0)["results"][0]["verdict"], "true", "{format}");
}

#[test]
fn a_net_of_tina_is_the_same_for_every_command() {
    let folder = Folder::new("export_tina");
    for model in ["door", "watchdog", "philosophers:3"] {
        let written = folder.cotama(&["export", model, "--output", "it.net"]);
        assert_eq!(written.code, Some(0), "{written:?}");
        let states = |model: &str| {
            let answer = folder.cotama(&["statespace", model, "--json"]).json(0);
            (answer["states"].clone(), answer["arcs"].clone(), answer["markings"].clone())
        };
        assert_eq!(states("it.net"), states(model), "{model}");
        let again = folder.shell("cotama export - --format net < it.net");
        assert_eq!(again.stdout, folder.read("it.net"), "{model}");
        let places = |name: &str| {
            let answer = folder.cotama(&["models", name, "--json"]).json(0);
            answer["models"][0]["places"].clone()
        };
        assert!(places("it.net").as_u64() > Some(0), "{model}");
    }
    // Without intervals it is a plain net, as in PNML.
    let played = folder.cotama(&["simulate", "it.net", "left_first_1", "--json"]).json(0);
    assert_eq!((&played["by_name"], &played["fired"][0]), (&true.into(), &"left_first_1".into()));
    let pnml = folder.shell("cotama export it.net --format pnml | cotama statespace - --json");
    assert_eq!(pnml.code, Some(0), "{pnml:?}");
    let noted = folder.cotama(&["export", "door", "--output", "door.net"]).stderr;
    assert!(noted.contains("note: in the file, priorities and the order of lines are ignored"));
    folder.write("open.net", "tr t ]2,5] a -> b\npl a (1)\n");
    assert_eq!(folder.cotama(&["statespace", "open.net"]).code, Some(0));
    let refused = folder.cotama(&["simulate", "open.net", "+3"]);
    assert_eq!((refused.code, refused.stdout.as_str()), (Some(2), ""));
    golden("bad_tina_open.txt", &refused.stderr);
}

#[test]
fn nodes_of_a_file_have_their_names_and_their_ids() {
    let folder = Folder::new("check_ids");
    let written = folder.cotama(&["export", "door", "--format", "pnml"]).stdout;
    // A file whose places are called otherwise than their ids.
    let id = written.split("<place id=\"").nth(1).unwrap().split('"').next().unwrap().to_owned();
    assert_ne!(id, "Closed");
    folder.write("door.pnml", written);
    let check = |property: &str| {
        folder.cotama(&["check", "door.pnml", "--property", property, "--json"]).json(0)
    };
    let (by_id, by_name) = (check(&format!("AG {id} <= 1")), check("AG Closed <= 1"));
    assert_eq!(by_id["results"][0]["verdict"], by_name["results"][0]["verdict"]);
    assert_eq!(by_id["results"][0]["property"], by_name["results"][0]["property"]);
}
