//! Instances that are none: what is said, and that nothing panics.

use cotama_models::team::instance::Instance;
use proptest::prelude::*;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// The files of a folder, by name.
pub(crate) fn files(folder: &str) -> Vec<(String, String)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(folder);
    let entries = std::fs::read_dir(folder).unwrap().map(|it| it.unwrap().path());
    let mut files: Vec<_> = entries
        .filter(|it| it.extension().is_some_and(|it| it == "json"))
        .map(|it| {
            let name = it.file_name().unwrap().to_str().unwrap().to_owned();
            (name, std::fs::read_to_string(it).unwrap())
        })
        .collect();
    files.sort();
    files
}

/// A right instance, in which tests change something.
const RIGHT: &str = r#"{
 "format": "cotama-team-assignment/1", "name": "right", "kind": "simultaneous",
 "cost_denominator": 2, "robots": ["anna", "ben"],
 "tasks": [
  {"name": "mop", "skip_cost": null, "cost": [3, 2]},
  {"name": "carry", "skip_cost": 9, "combine": "mean", "plans": [
   {"name": "both", "roles": [{"name": "left", "cost": [1, 2]}, {"name": "right", "cost": [2, 1]}]},
   {"name": "alone", "extra_cost": 4, "roles": [{"name": "all", "cost": [null, 5]}]}]}]}"#;

/// Returns the errors of the right instance with one text replaced.
fn said(from: &str, to: &str) -> String {
    assert!(RIGHT.contains(from), "{from}");
    let errors = Instance::parse("it.json", &RIGHT.replacen(from, to, 1)).unwrap_err();
    errors.to_string()
}

#[test]
fn the_broken_files_get_an_error_that_names_the_cause() {
    let mut told = String::new();
    for (name, text) in files("teams/broken") {
        writeln!(told, "{}\n", Instance::parse(&name, &text).unwrap_err()).unwrap();
    }
    let changes = [
        ("assignment/1", "assignment/2"),
        ("\"format\": \"cotama-team-assignment/1\",", ""),
        ("\"kind\": \"simultaneous\"", "\"kind\": \"simultanous\""),
        ("\"kind\": \"simultaneous\"", "\"kind\": \"coalition-mean\""),
        ("\"kind\": \"simultaneous\"", "\"kind\": \"single\""),
        ("\"skip_cost\": null", "\"skip_cots\": null"),
        ("\"skip_cost\": null, ", ""),
        ("\"skip_cost\": null", "\"skip_cost\": 1, \"skip_cost\": 2"),
        ("[3, 2]", "[3, \"2\"]"),
        ("[3, 2]", "[3, 1e-3]"),
        ("[3, 2]", "[3, 1000000001]"),
        ("[3, 2]", "3"),
        ("\"anna\"", "\"\""),
        ("\"carry\"", "\"mop\""),
        ("\"alone\"", "\"both\""),
        ("\"right\", \"cost\"", "\"left\", \"cost\""),
        ("\"right\", \"cost\": [2, 1]", "\"right\", \"cost\": [2]"),
        ("\"right\", \"cost\": [2, 1]", "\"right\""),
        ("\"mean\"", "\"men\""),
        ("\"combine\": \"mean\", ", ""),
        ("\"cost\": [3, 2]", "\"cost\": [3, 2], \"combine\": \"sum\""),
        ("\"cost\": [3, 2]", "\"plans\": []"),
        (", \"cost\": [3, 2]", ""),
        ("\"roles\": [{\"name\": \"all\", \"cost\": [null, 5]}]", "\"roles\": []"),
        ("\"cost_denominator\": 2", "\"cost_denominator\": 0"),
        ("\"cost_denominator\": 2", "\"cost_denominator\": 3"),
        ("\"name\": \"right\", \"kind\"", "\"name\": \"ri\nght\", \"kind\""),
        ("[3, 2]", "[03, 2]"),
        ("[3, 2]", "[3, nil]"),
        ("]}]}]}", "]}]}]} {"),
    ];
    for (from, to) in changes {
        writeln!(told, "{} -> {}\n{}\n", from.escape_debug(), to.escape_debug(), said(from, to))
            .unwrap();
    }
    cotama_golden::compare(Path::new("tests/golden/teams.txt"), &told);
}

#[test]
fn unknown_fields_of_a_file_are_passed_over() {
    let more = RIGHT.replacen("\"tasks\"", "\"drawn_by\": [{\"a\": [1.5e-3, true]}], \"tasks\"", 1);
    assert_eq!(Instance::parse("", &more).unwrap(), Instance::parse("", RIGHT).unwrap());
    let mark = format!("\u{feff}{RIGHT}");
    assert_eq!(Instance::parse("", &mark).unwrap(), Instance::parse("", RIGHT).unwrap());
    let escaped = RIGHT.replacen("mop", "m\\u006fp \\ud83e\\uddf9", 1);
    assert_eq!(Instance::parse("", &escaped).unwrap().tasks[0].name, "mop \u{1f9f9}");
    let deep = RIGHT.replacen("\"tasks\"", &format!("\"deep\": {}", "[".repeat(100_000)), 1);
    let errors = Instance::parse("", &deep).unwrap_err().to_string();
    assert!(errors.contains("nested too deeply"), "{errors}");
}

#[test]
fn many_errors_of_one_cause_are_one_that_is_counted() {
    let costs = format!("[{}]", vec!["-1"; 20_000].join(","));
    let errors = Instance::parse("", &RIGHT.replacen("[3, 2]", &costs, 1)).unwrap_err();
    let [_, one] = errors.diagnostics() else { panic!("{errors}") };
    assert_eq!((one.times, one.also.len(), errors.omitted()), (20_000, 4, 0));
    assert!(errors.to_string().contains("`-1` is below 0 (so at 20000 places)"), "{errors}");
}

proptest! {
    /// Whatever is changed in an instance, it is read or refused; and what is read is answered.
    #[test]
    fn no_change_of_a_file_makes_the_reader_panic(
        number in 0..12_usize,
        changes in prop::collection::vec((any::<prop::sample::Index>(), 0..PIECES.len()), 1..4),
    ) {
        let (name, mut text) = files("teams").swap_remove(number);
        for (at, piece) in changes {
            let mut at = at.index(text.len());
            while !text.is_char_boundary(at) {
                at -= 1;
            }
            let end = at + text[at..].chars().next().map_or(0, char::len_utf8);
            text.replace_range(at..end, PIECES[piece]);
        }
        match Instance::parse(&name, &text) {
            Err(errors) => prop_assert!(!errors.diagnostics().is_empty()),
            Ok(instance) => prop_assert!(instance.solve(20_000).is_ok()),
        }
    }
}

const PIECES: [&str; 16] = [
    "",
    "\"",
    "{",
    "}",
    "[",
    "]",
    ",",
    ":",
    "null",
    "0",
    "1000000000",
    "-",
    ".",
    "\\u",
    "\u{e4}",
    " ",
];
