//! Broken files and what is said about them, in `tests/golden/fmeca_broken.txt`.

use super::{SMALL, with};
use cotama_models::fmeca::Analysis;
use std::fmt::Write;

const HEAD: &str = "id,function,component,failure,cause,effect,severity,mtbf_h";

#[test]
fn each_error_has_its_place_and_its_help() {
    let toml: [(&str, &[(&str, &str)]); 17] = [
        ("no title, no mode", &[(SMALL, "format = \"cotama-fmeca/1\"\n")]),
        ("another format", &[("cotama-fmeca/1", "panorama-mission/1")]),
        ("no format", &[("format = \"cotama-fmeca/1\"", "")]),
        ("severity misspelt", &[("severity = \"hard\"", "severity = \"hrad\"")]),
        ("severity unlike any", &[("severity = \"hard\"", "severity = \"10\"")]),
        ("id twice", &[("id = \"LID2\"", "id = \"LID1\"")]),
        ("id with a space", &[("id = \"LID1\"", "id = \"LID 1\"")]),
        ("flag not declared", &[("flags = [\"lidar silent\"]", "flags = [\"lidar silnt\"]")]),
        (
            "flag in both lists",
            &[("sometimes = [\"lidar silent\"]", "sometimes = [\"lidar late\"]")],
        ),
        ("flag twice", &[("name = \"lidar late\"", "name = \"lidar silent\"")]),
        ("probe of no row", &[("shows = [\"LID1\"]", "shows = [\"LID7\"]")]),
        ("silent with flags", &[("flags = []", "silent = \"nothing\"")]),
        ("no latency", &[("latency_ms = 100\nmtbf_h = 500", "mtbf_h = 500")]),
        (
            "rates",
            &[
                ("mtbf_h = 500\n", "mtbf_h = 0\n"),
                ("failures_per_million_h = 20_000", "mtbf_h = \"often\""),
                ("mtbf_h = 0.5\n", "mtbf_h = 0.0005\nfailures_per_million_h = 3\n"),
                ("mtbf_h = 1e5", ""),
            ],
        ),
        (
            "texts",
            &[
                ("function = \"see\"", "function = \"\""),
                ("component = \"lidar\"", "component = 7"),
                ("failure = \"no supply\"", "failure = \"no \\u001B[31m supply\""),
                ("name = \"force low\"", "name = \"force; low\""),
            ],
        ),
        ("misspelt key", &[("component = \"lidar\"", "componnet = \"lidar\"")]),
        ("not TOML", &[("id = \"LID1\"", "id = \"LID1")]),
    ];
    let row = |cells: &str| format!("{HEAD}\n{cells}\n");
    let csv: [(&str, String); 12] = [
        ("empty", String::new()),
        ("heading alone", format!("{HEAD}\n")),
        ("columns missing", "id,failure\nA,x\n".to_owned()),
        ("column unknown", format!("{HEAD},severty\nA,f,c,x,y,z,weak,5,\n")),
        ("column twice", format!("{HEAD},failure_mode\nA,f,c,x,y,z,weak,5,x\n")),
        ("semicolons", HEAD.replace(',', ";")),
        ("a cell too many", row("A,f,c,x, and y,y,z,weak,5")),
        ("open quote", row("A,\"f,c,x,y,z,weak,5\nB,f,c,x,y,z,weak,5")),
        ("quote inside", row("A,\"f\" or g,c,x,y,z,weak,5")),
        ("cells empty", row("A,f,c,,y,z,,")),
        ("words in place of numbers", format!("{HEAD},latency_ms\nA,f,c,x,y,z,weak,5 h,fast\n")),
        ("id twice", row("A,f,c,x,y,z,weak,5\nA,f,c,x,y,z,weak,5")),
    ];
    let mut said = String::new();
    let mut say = |name: &str, read: Result<Analysis, _>| {
        let errors: cotama_models::missions::MissionErrors = read.expect_err(name);
        for it in errors.diagnostics() {
            assert!(
                errors.text().get(it.span.clone()).is_some()
                    && (it.help.is_some() || it.message.starts_with("not TOML")),
                "{it:?}"
            );
        }
        writeln!(said, "# {name}\n{errors}\n").unwrap();
    };
    for (name, edits) in toml {
        say(name, Analysis::parse("my.toml", &with(edits)));
    }
    for (name, text) in csv {
        say(name, Analysis::parse_csv("my.csv", &text));
    }
    cotama_golden::compare("tests/golden/fmeca_broken.txt", &said);
}
