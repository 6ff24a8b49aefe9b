//! With `--json` an error is one object, too; and a file of another kind, or a place where nothing
//! can be written, is said in one line.

use crate::common::{Folder, golden, patrol};
use serde_json::{Value, json};
use std::fmt::Write;

const LAMP: &str = "net lamp\ntr on off -> lit\ntr out lit -> off\npl off (1)\n";

#[test]
fn an_error_is_an_object_of_its_own_schema() {
    let folder = Folder::new("errors_json");
    let ended = folder.cotama(&["plan", "patroll", "--json"]);
    let error = ended.json(2);
    assert_eq!(ended.stderr, "");
    assert_eq!(
        error,
        json!({
            "schema": "cotama/error/1",
            "message": "there is no mission `patroll`, and no file of this name; did you mean \
                        `patrol`?",
            "file": null, "line": null, "column": null,
            "help": "missions that come with the program: patrol, delivery, shift, ward, \
                     patrol-axes; or give the path of a mission file",
        })
    );
    let error = folder.cotama(&["plan", "no.toml", "--json"]).json(2);
    assert_eq!(
        (&error["file"], &error["message"]),
        (&json!("no.toml"), &json!("there is no such file"))
    );
}

#[test]
fn an_error_in_a_file_has_its_place_and_the_others_follow() {
    let folder = Folder::new("errors_place");
    let wrong =
        [("path_length_mm = 187000", "path_length_mm = \"far\""), ("units = 2 ", "unit = 2 ")];
    folder.write("wrong.toml", patrol(&wrong));
    let error = folder.cotama(&["plan", "wrong.toml", "--json"]).json(2);
    let place = |it: &Value| (it["line"].as_u64().unwrap(), it["column"].as_u64().unwrap());
    assert_eq!((place(&error), &error["file"]), ((12, 18), &json!("wrong.toml")));
    let more = error["more"].as_array().unwrap();
    assert_eq!((more.len(), place(&more[0])), (1, (35, 1)));
    assert!(more[0]["help"].as_str().unwrap().contains("write `units`"), "{error}");
    let error = folder.cotama(&["check", "door", "--property", "AG (a &", "--json"]).json(2);
    assert_eq!((place(&error).0, &error["file"]), (1, &json!("property")));
}

#[test]
fn a_command_line_that_cannot_be_understood_is_an_object_too() {
    let folder = Folder::new("errors_line");
    let error = folder.cotama(&["plan", "patrol", "--json", "--objective", "speed"]).json(2);
    let said = |name: &str| error[name].as_str().unwrap().to_owned();
    assert!(said("message").starts_with("invalid value 'speed' for '--objective <WHAT>'"));
    let error = folder.cotama(&["plan", "--json", "--fuel", "3"]).json(2);
    assert!(error["help"].as_str().unwrap().contains("Usage: cotama plan"), "{error}");
    // Behind `--` it is no option, and help is no error.
    assert_eq!(folder.cotama(&["fly", "--", "--json"]).stdout, "");
    let help = folder.cotama(&["plan", "--json", "--help"]);
    assert!(help.code == Some(0) && help.stdout.starts_with("Splits a mission"), "{help:?}");
}

#[test]
fn a_file_of_another_kind_leads_to_the_command_that_reads_it() {
    let folder = Folder::new("errors_kind");
    folder.cotama(&["export", "door", "--output", "door.pnml"]);
    folder.cotama(&["export", "door", "--output", "door.json"]);
    folder.cotama(&["run", "patrol", "--no-report", "--trace", "t.jsonl"]);
    folder.cotama(&[
        "check",
        "kanban:2",
        "--property",
        "deadlock_free",
        "--certificate",
        "it.json",
    ]);
    folder.write("lamp.net", LAMP);
    folder.write("walk.toml", patrol(&[]));
    folder.write("faults.toml", "format = \"panorama-faults/1\"\n");
    folder.write("small.json", "{\"limits\": {}, \"activities\": []}");
    let mut said = String::new();
    for line in [
        "plan door.pnml",
        "run lamp.net",
        "plan door.json",
        "plan t.jsonl",
        "plan faults.toml",
        "run patrol --faults walk.toml",
        "check walk.toml",
        "statespace t.jsonl",
        "export it.json --format dot",
        "simulate walk.toml Call",
        "allocate door.json",
        "allocate walk.toml",
        "replay door.pnml",
        "replay walk.toml",
        "verify door.json",
        "verify door.pnml",
        "check door --properties door.pnml",
        "models small.json",
        "run door",
        "plan philosophers:3",
        "check patrol",
        "simulate delivery.toml",
        "models patrol",
    ] {
        let ended = folder.shell(&format!("cotama {line}"));
        assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{line}: {ended:?}");
        assert!(ended.stderr.lines().count() <= 4, "{line}: {}", ended.stderr);
        writeln!(said, "$ cotama {line}\n{}", ended.stderr.trim_end()).unwrap();
    }
    golden("bad_kinds.txt", &said);
}

#[test]
fn an_unlike_name_suggests_nothing() {
    let folder = Folder::new("errors_unlike");
    for (line, guess) in [
        ("check nope", None),
        ("plan nope", None),
        ("simulate xyz", None),
        ("check dor", Some("door")),
        ("models filosophers:3", Some("philosophers:3")),
        ("run delivry", Some("delivery")),
    ] {
        let said = folder.shell(&format!("cotama {line}")).stderr;
        let guessed = said.split("did you mean `").nth(1).and_then(|it| it.split('`').next());
        assert_eq!(guessed, guess, "{line}: {said}");
    }
}

#[test]
fn a_file_without_a_folder_is_refused_before_the_work() {
    let folder = Folder::new("errors_place_to_write");
    folder.write("file", "kept");
    let mut said = String::new();
    for line in [
        "export door --output no/such/door.svg",
        "export door --output file/door.svg",
        "fmeca --output no/it.html",
        "run patrol --report no/such",
        "run patrol --report file",
        "run patrol --no-report --trace no/t.jsonl",
        "replay t.jsonl --report no/such",
        "check delivery --certificate no/it.json",
        "check delivery --trace no/it.html",
    ] {
        let ended = folder.shell(&format!("cotama {line}"));
        assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{line}: {ended:?}");
        writeln!(said, "$ cotama {line}\n{}", ended.stderr.trim_end()).unwrap();
    }
    golden("bad_places.txt", &said);
    assert_eq!(folder.files(""), ["file"]);
    // The folder of a report is made, and so are those of its usual place.
    assert_eq!(folder.cotama(&["run", "patrol", "--report", "mine"]).code, Some(0));
    assert_eq!(folder.cotama(&["run", "patrol"]).code, Some(0));
    assert_eq!(folder.files(""), ["file", "mine", "report"]);
}
