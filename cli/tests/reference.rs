//! The reference of mission files, against the schema, and both against what the reader knows.

use crate::common::Folder;
use crate::file_schemas::{keys, known, schema};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;

/// Each table of the page, where it stands in the schema, a mission that has it, and the line
/// behind which another key is put.
const TABLES: [(&str, &str, &str, &str); 13] = [
    ("the file", "/else/else", "patrol", "format = \"panorama-mission/1\""),
    ("the file of a mission of a robot", "/then", "delivery", "robot = \"p3dx-delivery\""),
    ("[limits]", "/else/else/properties/limits", "patrol", "[limits]"),
    ("[plan]", "/else/else/properties/plan", "patrol", "plan.objective = \"paper\""),
    ("[robot]", "/else/else/properties/robot", "patrol", "[robot]"),
    ("[motion_power]", "/else/else/properties/motion_power", "patrol", "[motion_power]"),
    ("[hardware.NAME]", HARDWARE, "patrol", "[hardware.laser]"),
    ("[fixed]", "/else/else/properties/fixed", "patrol", "[fixed]"),
    ("[[tio]]", "/else/else/properties/tio/items", "patrol", "[[tio]]"),
    ("[[zone]]", "/else/else/properties/zone/items", "patrol", "id = \"glass-out\""),
    ("[[objective]]", "/then/properties/objective/items", "delivery", "[[objective]]"),
    ("[[person]]", "/then/properties/person/items", "rounds", "[[person]]"),
    ("[run]", "/else/else/properties/run", "patrol", "[run]"),
];
/// A mission over the office.
const ROUNDS: &str = include_str!("../../sim/tests/runs/common/rounds.toml");
const HARDWARE: &str = "/else/else/properties/hardware/additionalProperties";

/// Returns the type of a value, in the words of the page.
fn is(value: &Value) -> &'static str {
    match (value["type"].as_str().unwrap(), value["items"]["type"].as_str()) {
        ("integer", _) => "integer",
        ("number", _) => "number",
        ("string", _) => "text",
        ("boolean", _) => "true or false",
        ("array", Some("string")) => "array of text",
        ("array", _) => "array of tables",
        _ if value["additionalProperties"]["type"] == "object" => "table of tables",
        _ => "table",
    }
}

/// The rows that a table of the schema makes on the page.
fn rows(table: &Value) -> BTreeSet<String> {
    let required: Vec<_> = table["required"].as_array().unwrap().iter().collect();
    let row = |key: String| {
        let value = &table["properties"][&key];
        let optional =
            if required.contains(&&Value::from(key.as_str())) { "" } else { ", optional" };
        format!(
            "| `{key}` | {}{optional} | {} |",
            is(value),
            value["description"].as_str().unwrap()
        )
    };
    keys(table).into_iter().map(row).collect()
}

/// The rows of a table of the page.
fn described(page: &str, heading: &str) -> BTreeSet<String> {
    let (_, rest) = page.split_once(&format!("### {heading}\n")).expect(heading);
    let rows = rest.lines().take_while(|it| !it.starts_with('#'));
    rows.filter(|it| it.starts_with("| `")).map(str::to_owned).collect()
}

/// The tables of a robot's file, where they stand in the schema, and the lines that begin them.
const ROBOT_TABLES: [(&str, &str, &str); 16] = [
    ("the file", "", "format = \"cotama-robot/1\""),
    ("[body]", "/properties/body", "[body]"),
    ("[body.motors]", "/properties/body/properties/motors", "[body.motors]"),
    ("[body.battery]", "/properties/body/properties/battery", "[body.battery]"),
    ("[hardware.NAME]", "/properties/hardware/additionalProperties", "[hardware.base]"),
    ("[module.NAME]", "/properties/module/additionalProperties", "[module.scan]"),
    (
        "[module.NAME.parameter.NAME]",
        "/properties/module/additionalProperties/properties/parameter/additionalProperties",
        "[module.scan.parameter.n]",
    ),
    ("[observer.NAME]", "/properties/observer/additionalProperties", "[observer.timing]"),
    ("[operator]", "/properties/operator", "[operator]"),
    ("[supervisors]", "/properties/supervisors", "[supervisors]"),
    ("[[configuration]]", "/properties/configuration/items", "[[configuration]]"),
    ("[[failure]]", "/properties/failure/items", "[[failure]]"),
    ("[failure.restart]", "/properties/failure/items/properties/restart", "[failure.restart]"),
    ("[failure.set]", "/properties/failure/items/properties/set", "[failure.set]"),
    ("[failure.ask]", "/properties/failure/items/properties/ask", "[failure.ask]"),
    ("[failure.mask]", "/properties/failure/items/properties/mask", "[failure.mask]"),
];

#[test]
fn the_page_of_robots_agrees_with_the_schema_and_the_reader() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/robots.md");
    let page = std::fs::read_to_string(page).unwrap();
    assert_eq!(page.matches("\n### ").count(), ROBOT_TABLES.len());
    let folder = Folder::new("reference_robot");
    folder.cotama(&["new", "robot", "cart", "--json"]).json(0);
    let cart = folder.read("cart.toml");
    let inline = "set = { speed_permille = 600 }\n";
    assert!(cart.ends_with(inline));
    let tables = "[failure.set]\nspeed_permille = 600\n[failure.restart]\n\
        module = \"scan\"\ntimes = 1\n\
        [failure.ask]\ntimes = 1\n[failure.mask]\nflags = [\"x\"]\n\
        [module.scan.parameter.n]\ndefault = 1\n[supervisors]\nlocal = \"x.json\"\n\
        [body.motors]\nvoltage_mv = 24_000\nno_load_mrad_s = 24_000\nresistance_mohm = 200\n\
        limit_ma = 40_000\nrolling_permille = 20\nstall_ms = 100\n\
        [body.battery]\ncapacity_mah = 60_000\nfull_mv = 26_000\nempty_mv = 22_200\n\
        cutoff_mv = 22_000\nresistance_mohm = 10\ncells = 12\n";
    let cart = cart.replace(inline, tables);
    let schema = schema("robot");
    let mut wrong = Vec::new();
    for (heading, place, line) in ROBOT_TABLES {
        let line = format!("\n{line}\n");
        assert!(cart.contains(&line), "{line}");
        folder.write("robot.toml", cart.replacen(&line, &format!("{line}nonsense = 1\n"), 1));
        let said = folder.cotama(&["check", "robot.toml"]).stderr;
        let table = schema.pointer(place).unwrap();
        let known: BTreeSet<_> = known(&said).into_iter().filter(|it| it != "source").collect();
        assert_eq!(keys(table), known, "{heading}");
        let (shown, made) = (described(&page, heading), rows(table));
        if shown != made {
            let made: Vec<_> = made.into_iter().collect();
            wrong.push(format!("### {heading}\n{}", made.join("\n")));
        }
    }
    assert!(wrong.is_empty(), "tables of docs/robots.md should have:\n{}", wrong.join("\n"));
}

#[test]
fn the_page_of_missions_agrees_with_the_schema_and_the_reader() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/missions.md");
    let page = std::fs::read_to_string(page).unwrap();
    assert_eq!(page.matches("\n### ").count(), TABLES.len());
    let folder = Folder::new("reference");
    let schema = schema("mission");
    let mut wrong = Vec::new();
    for (heading, place, mission, line) in TABLES {
        let text = match mission {
            "rounds" => format!("{ROUNDS}[[person]]\nid = \"Anna\"\nwalks = [\"lab\"]\n"),
            shipped => folder.cotama(&["show", shipped]).stdout,
        };
        let end = text.match_indices(line).find(|(at, _)| text[..*at].ends_with('\n')).expect(line);
        let end = end.0 + text[end.0..].find('\n').unwrap() + 1;
        let key = if heading == "[plan]" { "plan.nonsense" } else { "nonsense" };
        let text = format!("{}{key} = 1\n{}", &text[..end], &text[end..]);
        folder.write("mission.toml", text);
        let said = folder.cotama(&["plan", "mission.toml"]).stderr;
        let table = schema.pointer(place).unwrap();
        let mut keys = keys(table);
        if heading == "[[tio]]" {
            // The reader knows these only in options that stand.
            keys.retain(|it| !matches!(it.as_str(), "duration_ms" | "power_mw"));
        }
        if heading == "[[objective]]" {
            // An objective that says what it does needs no tasks.
            keys.remove("tasks");
        }
        assert_eq!(keys, known(&said), "{heading}");
        let (shown, made) = (described(&page, heading), rows(table));
        if shown != made {
            let made: Vec<_> = made.into_iter().collect();
            wrong.push(format!("### {heading}\n{}", made.join("\n")));
        }
    }
    assert!(wrong.is_empty(), "tables of docs/missions.md should have:\n{}", wrong.join("\n"));
}
