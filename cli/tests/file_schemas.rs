//! The schemas of files that users write, for editors of TOML: what the program takes, they take;
//! what is wrong by its shape, they refuse; and their keys are those that the reader knows.

use crate::common::Folder;
use jsonschema::Validator;
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;

/// The schema of a kind of file, as the program prints it.
pub(crate) fn schema(kind: &str) -> Value {
    // Tests that run beside each other have folders of their own.
    let folder = Folder::new(&format!("file_schema_{kind}_{:?}", std::thread::current().id()));
    serde_json::from_str(&folder.cotama(&["schema", kind]).stdout).unwrap()
}

fn validator(kind: &str) -> Validator {
    let schema = schema(kind);
    assert_eq!(schema["$schema"], "http://json-schema.org/draft-07/schema#");
    assert!(jsonschema::meta::validate(&schema).is_ok(), "{kind}");
    jsonschema::validator_for(&schema).unwrap()
}

fn wrong(validator: &Validator, text: &str) -> Vec<String> {
    let file: Value = toml::from_str(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let said = |it: jsonschema::ValidationError| format!("{}: {it}", it.instance_path());
    validator.iter_errors(&file).map(said).collect()
}

/// The TOML files of a page, by name.
fn files_of_page(page: &str) -> Vec<(String, String)> {
    let blocks = page.split("\n```toml ").skip(1).filter_map(|it| it.split_once('\n'));
    let text = |it: &str| it.split("\n```").next().unwrap().to_owned();
    blocks.map(|(name, rest)| (name.to_owned(), text(rest))).collect()
}

#[test]
fn every_mission_and_every_file_of_faults_is_as_its_schema_says() {
    let folder = Folder::new("file_schemas_files");
    folder.cotama(&["new", "mission", "template"]);
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut files = vec![
        ("patrol".to_owned(), folder.cotama(&["show", "patrol"]).stdout),
        ("delivery".to_owned(), folder.cotama(&["show", "delivery"]).stdout),
        ("template".to_owned(), folder.read("template.toml")),
    ];
    let shuttle = root.join("sim/tests/runs/common/shuttle.toml");
    files.push(("shuttle".to_owned(), std::fs::read_to_string(shuttle).unwrap()));
    for page in std::fs::read_dir(root.join("docs")).unwrap() {
        let page = page.unwrap().path();
        if page.extension().is_some_and(|it| it == "md") {
            files.extend(files_of_page(&std::fs::read_to_string(page).unwrap()));
        }
    }
    let (mission, faults) = (validator("mission"), validator("faults"));
    let (mut missions, mut scripts) = (0, 0);
    for (name, text) in files {
        let is_mission = text.contains("\nformat = \"panorama-mission/1\"")
            || text.starts_with("format = \"panorama-mission/1\"")
            || text.contains("format = \"panorama-mission/2\"");
        let is_script = text.contains("format = \"panorama-faults/1\"");
        (missions, scripts) =
            (missions + usize::from(is_mission), scripts + usize::from(is_script));
        let wrong = match (is_mission, is_script) {
            (true, _) => wrong(&mission, &text),
            (_, true) => wrong(&faults, &text),
            _ => continue,
        };
        // The page of missions shows a typing error.
        assert_eq!(wrong.is_empty(), name != "typo.toml", "{name}: {wrong:?}");
    }
    assert!(missions >= 5 && scripts >= 2, "{missions} {scripts}");
}

#[test]
fn every_robot_is_as_its_schema_says() {
    let folder = Folder::new("file_schemas_robots");
    folder.cotama(&["new", "robot", "cart", "--json"]).json(0);
    let validator = validator("robot");
    let shipped = ["p3dx-delivery", "p3dx-patrol", "transport"];
    let shipped = shipped.map(|it| folder.cotama(&["show", it]).stdout);
    for text in shipped.into_iter().chain([folder.read("cart.toml")]) {
        assert_eq!(wrong(&validator, &text), Vec::<String>::new());
        for (right, instead) in [
            ("mode = \"autonomous\"", "mode = \"alone\""),
            ("[[configuration]]", "[[configurations]]"),
            ("speed_max_mm_s", "speed_max"),
            ("latency_ms = ", "latency_ms = -"),
        ] {
            assert!(text.contains(right));
            let text = text.replacen(right, instead, 1);
            assert_ne!(wrong(&validator, &text), Vec::<String>::new(), "{instead}");
            folder.write("wrong.toml", text);
            assert_eq!(folder.cotama(&["check", "wrong.toml"]).code, Some(2), "{instead}");
        }
    }
}

/// Files that are wrong by their shape: a mission that is right, what stands in it, and what would
/// be wrong there.
const WRONG_MISSIONS: [(&str, &str, &str); 40] = [
    ("patrol", "format = \"panorama-mission/1\"\n", ""),
    ("patrol", "panorama-mission/1", "panorama-mission/2"),
    ("patrol", "name = \"patrol\"", "name = \"\""),
    ("patrol", "name = \"patrol\"", "name = 7"),
    ("patrol", "path_length_mm = 187000", "path_length_mm = \"187 m\""),
    ("patrol", "path_length_mm = 187000", "path_length_m = 187"),
    ("patrol", "path_length_mm = 187000", "path_length_mm = -1"),
    ("patrol", "path_length_mm = 187000", "path_length_mm = 187000.5"),
    ("patrol", "plan.objective = \"paper\"", "plan.objective = \"fast\""),
    ("patrol", "[limits]", "[limit]"),
    ("patrol", "[limits]", "[limits]\nmoney = 3"),
    ("patrol", "duration_ms = 600000", "duration_ms = 0"),
    ("patrol", "order = [\"duration\", \"energy\"]", "order = [\"duration\", \"duration\"]"),
    ("patrol", "order = [\"duration\", \"energy\"]", "order = [\"duration\"]"),
    ("patrol", "order = [\"duration\", \"energy\"]", "order = [\"energy\", \"quality\"]"),
    ("patrol", "[robot]", "[robot]\ncolour = \"red\""),
    ("patrol", "[motion_power]", "[motion_power]\nsource = 3"),
    ("patrol", "units = 2 ", "units = 16 "),
    ("patrol", "units = 2 ", "unit = 2 "),
    ("patrol", "[hardware.laser]", "[hardware.'la ser']"),
    ("patrol", "task = \"MOV\"", "task = \"MOVE\""),
    ("patrol", "task = \"MOV\"", "task = \"MOV\"\nduration_ms = 5"),
    ("patrol", "task = \"MOV\"", "task = \"WAI\""),
    ("patrol", "task = \"MOV\"", "task = \"MOV\"\nconfiguration = \"SMZ\""),
    ("patrol", "[fixed]", "[fixed_]"),
    ("patrol", "turn_ms", "turn_s"),
    ("patrol", "tasks = [\"MOV\", \"LOC\"]", "tasks = []"),
    ("patrol", "tasks = [\"MOV\", \"LOC\"]", "tasks = [\"MOV\", \"MOV\"]"),
    ("patrol", "tasks = [\"MOV\", \"LOC\"]", "tasks = \"MOV\""),
    ("patrol", "tasks = [\"MOV\", \"LOC\"]", "tasks = [\"MOV\", \"LOC\"]\ndoes = \"drive\""),
    ("patrol", "[[zone]]", "[[zone]]\nrequire_units = 1"),
    ("patrol", "monitor_period_ms = 1000", "monitor_period_ms = 3600001"),
    ("patrol", "monitor_period_ms", "monitor_periods_ms"),
    ("patrol", "kind = \"obstacle\"", "kind = \"operator\""),
    ("delivery", "robot = \"p3dx-delivery\"", ""),
    ("delivery", "robot = \"p3dx-delivery\"", "robot = 3"),
    ("delivery", "does = \"drive\"", ""),
    ("delivery", "does = \"drive\"", "does = \"Fly\""),
    ("delivery", "[limits]", "[supervision]\ndecides = \"cotama\"\n[limits]"),
    ("delivery", "power_mw = 4600", ""),
];

/// The same of faults: an event of the patrol, or of the delivery where it is for supervisors.
const WRONG_FAULTS: [(&str, &str); 20] = [
    ("patrol", "[[event]]\nx_mm = 1\nkind = \"obstacl\"\ndelay_ms = 3"),
    ("patrol", "[[event]]\nx_mm = 1\nkind = \"obstacle\""),
    ("patrol", "[[event]]\nx_mm = 1\nkind = \"obstacle\"\ndelay_ms = 0"),
    ("patrol", "[[event]]\nx_mm = 1\nkind = \"obstacle\"\ndelay_ms = -3"),
    ("patrol", "[[event]]\nx_mm = 1\nkind = \"obstacle\"\ndelay_s = 3"),
    ("patrol", "[[event]]\nx_mm = 1\nkind = \"obstacle\"\ndelay_ms = 3\nextra_mm = 3"),
    ("patrol", "[[event]]\nx_mm = \"1 m\"\nkind = \"obstacle\"\ndelay_ms = 3"),
    ("patrol", "[[event]]\nkind = \"obstacle\"\ndelay_ms = 3"),
    ("patrol", "[[event]]\nx_mm = 1\nkind = \"fault\"\nhardware = \"laser\""),
    ("patrol", "[[event]]\nx_mm = 1\nkind = \"fault\"\nhardware = \"laser\"\nunits_back = 1"),
    ("patrol", "[[event]]\nx_mm = 1\nkind = \"fault\"\nhardware = \"laser\"\nunits_lost = 16"),
    ("patrol", "[event]\nx_mm = 1\nkind = \"obstacle\"\ndelay_ms = 3"),
    ("patrol", "[[random]]\nname = \"n\"\nper_km = 0\nkind = \"obstacle\"\ndelay_ms = 3"),
    ("patrol", "[[random]]\nname = \"n\"\nper_km = 1\nkind = \"fault\"\ndelay_ms = 3"),
    ("patrol", "[[random]]\nper_km = 1\nkind = \"obstacle\"\ndelay_ms = 3"),
    ("patrol", "[power_error_permille]\nglass = -1000"),
    ("patrol", "monitor_period_ms = 3"),
    ("delivery", "[[event]]\nx_mm = 1\nkind = \"failure\"\nmode = 1"),
    ("delivery", "[[event]]\nx_mm = 1\nkind = \"operator\"\nanswers = []\ndelay_ms = 0"),
    ("delivery", "[[event]]\nx_mm = 1\nkind = \"repair\"\nmode = \"SON1\"\nhardware = \"PF.OPT\""),
];

#[test]
fn a_file_of_wrong_shape_is_refused_by_the_reader_and_by_the_schema() {
    let folder = Folder::new("file_schemas_wrong");
    let (mission, faults) = (validator("mission"), validator("faults"));
    let mut taken = Vec::new();
    for (base, right, instead) in WRONG_MISSIONS {
        let text = folder.cotama(&["show", base]).stdout;
        assert!(text.contains(right), "{right:?} is not in the {base}");
        let text = text.replacen(right, instead, 1);
        folder.write("wrong.toml", &text);
        let by_reader = folder.cotama(&["plan", "wrong.toml"]).code != Some(2);
        let by_schema = wrong(&mission, &text).is_empty();
        taken.extend((by_reader || by_schema).then_some((instead, by_reader, by_schema)));
    }
    for (mission, script) in WRONG_FAULTS {
        let text = format!("format = \"panorama-faults/1\"\n{script}\n");
        folder.write("wrong.toml", &text);
        let run = ["run", mission, "--no-report", "--faults", "wrong.toml"];
        let by_reader = folder.cotama(&run).code != Some(2);
        let by_schema = wrong(&faults, &text).is_empty();
        taken.extend((by_reader || by_schema).then_some((script, by_reader, by_schema)));
    }
    assert!(taken.is_empty(), "taken by the reader, by the schema: {taken:#?}");
}

/// The keys that the reader says it knows where it finds `nonsense`.
pub(crate) fn known(said: &str) -> BTreeSet<String> {
    let (_, known) = said.split_once("known keys here: ").unwrap_or_else(|| panic!("{said}"));
    let (known, _) = known.split_once("\n\n").unwrap_or((known, ""));
    known.split([',', ' ', '\n']).filter(|it| !it.is_empty()).map(str::to_owned).collect()
}

/// The keys of a table of a schema, without those that are not read.
pub(crate) fn keys(table: &Value) -> BTreeSet<String> {
    let keys = table["properties"].as_object().unwrap().keys().cloned();
    keys.filter(|it| !matches!(it.as_str(), "source" | "power_source")).collect()
}

#[test]
fn an_event_has_the_keys_that_the_reader_knows_for_its_kind() {
    let folder = Folder::new("file_schemas_events");
    let faults = schema("faults");
    let validator = validator("faults");
    folder.write("rounds.toml", include_str!("../../sim/tests/runs/common/rounds.toml"));
    let said = |text: &str| {
        folder.write("faults.toml", format!("format = \"panorama-faults/1\"\n{text}\n"));
        let mission = if text.contains("door") { "rounds.toml" } else { "delivery" };
        folder.cotama(&["run", mission, "--no-report", "--faults", "faults.toml"]).stderr
    };
    assert_eq!(keys(&faults), known(&said("nonsense = 1")));
    let point = "[[event]]\nx_mm = 1\n";
    let random = "[[random]]\nname = \"n\"\nper_km = 1\n";
    let mut met = [("event", BTreeSet::new()), ("random", BTreeSet::new())];
    for (table, start, kind, details) in [
        (0, point, "obstacle", "delay_ms = 3"),
        (0, point, "odometry", "extra_mm = 3"),
        (0, point, "fault", "hardware = \"PF.OPT\"\nunits_lost = 1"),
        (0, point, "repair", "hardware = \"PF.OPT\"\nunits_back = 1"),
        (0, point, "repair", "mode = \"SON1\""),
        (0, point, "failure", "mode = \"SON1\""),
        (0, "[[event]]\nt_ms = 1\n", "failure", "mode = \"SON1\""),
        (0, "[[event]]\nduring = \"Waits\"\n", "failure", "mode = \"SON1\""),
        (0, point, "failure", "mode = \"SON1\"\nuntil_during = \"Waits\""),
        (0, point, "operator", "answers = [\"give_up\"]\ndelay_ms = 0"),
        (0, point, "door", "door = \"door B\"\nbecomes = \"closed\""),
        (1, random, "obstacle", "delay_ms = 3"),
        (1, random, "odometry", "extra_mm = 3"),
    ] {
        let text = format!("{start}kind = \"{kind}\"\n{details}\n");
        let (right, nonsense) = (said(&text), said(&format!("{text}nonsense = 1")));
        assert!(!right.contains("error"), "{right}");
        let file = |text: &str| format!("format = \"panorama-faults/1\"\n{text}");
        assert_eq!(wrong(&validator, &file(&text)), [""; 0], "{text}");
        // Each key that the reader knows is needed, and so it is by the schema.
        let known = known(&nonsense);
        // A failure names its end if it likes; it and a door their moment in one of three ways.
        let is_needed = |it: &&String| {
            !it.starts_with("until_") && text.lines().any(|line| line.starts_with(it.as_str()))
        };
        for key in known.iter().filter(is_needed) {
            let less = text.lines().filter(|it| !it.starts_with(key.as_str()));
            let less = less.collect::<Vec<_>>().join("\n");
            assert_ne!(wrong(&validator, &file(&less)), [""; 0], "{less}");
        }
        met[table].1.extend(known);
    }
    for (table, met) in met {
        assert_eq!(keys(&faults["properties"][table]["items"]), met, "{table}");
    }
}
