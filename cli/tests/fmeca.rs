//! `cotama fmeca`: what can fail, how it is seen, what is done, and what looks alike.

use crate::common::{Folder, golden};
use crate::schemas::validate;
use serde_json::{Value, json};
use std::collections::BTreeSet;

#[test]
fn the_screens_of_the_analysis() {
    let folder = Folder::new("fmeca_screens");
    golden("fmeca.txt", &folder.cotama(&["fmeca"]).stdout);
    golden("fmeca_diagnosability.txt", &folder.cotama(&["fmeca", "--diagnosability"]).stdout);
}

#[test]
fn no_line_is_wider_than_the_window() {
    let folder = Folder::new("fmeca_width");
    for width in [50, 60, 80, 89, 90, 100, 133, 200] {
        for command in ["cotama fmeca", "cotama fmeca --diagnosability"] {
            let screen = folder.shell(&format!("COLUMNS={width} {command}")).stdout;
            let widest = screen
                .lines()
                .filter(|it| !it.starts_with("next: "))
                .map(|line| line.chars().count());
            assert!(widest.max().unwrap() <= width, "{width}:\n{screen}");
        }
    }
}

#[test]
fn every_format_is_written_by_its_name_and_by_the_end_of_the_files_name() {
    let folder = Folder::new("fmeca_formats");
    std::fs::create_dir(folder.path().join("out")).unwrap();
    for format in ["md", "csv", "html", "svg", "toml"] {
        let printed = folder.cotama(&["fmeca", "--format", format]);
        assert_eq!((printed.code, printed.stderr.as_str()), (Some(0), ""), "{format}");
        let file = format!("out/fmeca.{format}");
        let written = folder.cotama(&["fmeca", "--output", &file]);
        assert_eq!((written.code, written.stdout.as_str()), (Some(0), ""));
        assert!(written.stderr.ends_with(&format!("written: {file}\n")), "{written:?}");
        assert_eq!(folder.read(&file), printed.stdout, "{format}");
        if format == "md" {
            golden("fmeca.md", &printed.stdout);
        }
    }
}

#[test]
fn the_values_separated_by_commas_are_those_of_the_models() {
    let printed = Folder::new("fmeca_csv").cotama(&["fmeca", "--format", "csv"]).stdout;
    assert_eq!(printed, cotama_models::fmeca::Analysis::shipped("p3dx-delivery").unwrap().to_csv());
}

#[test]
fn the_page_needs_nothing_else_and_every_link_in_it_leads_somewhere() {
    let page = Folder::new("fmeca_page").cotama(&["fmeca", "--format", "html"]).stdout;
    for alien in ["<script ", "http:", "https:", "url(", "@import", "src=", "fetch", "import("] {
        assert!(!page.contains(alien), "{alien}");
    }
    // One script of its own; what it needs stays hidden without it.
    assert_eq!(page.matches("<script>").count(), 1);
    assert!(page.contains("<form id=\"pick\" hidden>"));
    assert_eq!(page.matches("<svg class=\"causes\"").count(), 16);
    let mut links = 0;
    for target in page.split("href=\"#").skip(1).filter_map(|it| it.split('"').next()) {
        assert_eq!(page.matches(&format!("id=\"{target}\"")).count(), 1, "{target}");
        links += 1;
    }
    assert!(links > 80, "{links}");
}

#[test]
fn each_row_can_be_sorted_by_each_order_and_each_cell_of_a_card_says_its_column() {
    let page = Folder::new("fmeca_cards").cotama(&["fmeca", "--format", "html"]).stdout;
    let orders = page.split_once("<select name=\"order\">").unwrap().1;
    let orders: Vec<&str> = orders
        .split_once("</select>")
        .unwrap()
        .0
        .split("value=\"")
        .skip(1)
        .map(|it| it.split_once('"').unwrap().0)
        .collect();
    assert_eq!(orders, ["place", "rpn", "critical", "severity", "interval", "latency"]);
    let table = page.split_once("<tbody>").unwrap().1.split_once("</tbody>").unwrap().0;
    let rows: Vec<&str> = table.split("<tr ").skip(1).collect();
    assert_eq!(rows.len(), 46);
    for row in &rows {
        assert_eq!(row.matches("<td").count(), 11, "{row}");
        assert_eq!(row.matches(" data-column=\"").count(), 11, "{row}");
        for order in &orders {
            let key = row.split_once(&format!(" data-{order}=\"")).unwrap().1;
            let key: u64 = key.split_once('"').unwrap().0.parse().unwrap();
            // The script reads numbers of 53 bits.
            assert!(key <= 1 << 53, "{order}: {row}");
        }
    }
    let of = |id: &str, order: &str| -> u64 {
        let row = rows.iter().find(|it| it.starts_with(&format!("id=\"{id}\""))).unwrap();
        let key = row.split_once(&format!(" data-{order}=\"")).unwrap().1;
        key.split_once('"').unwrap().0.parse().unwrap()
    };
    // Fatal before medium, 10 h before 400 h, 5 s before 1 s.
    assert!(of("BAT2", "severity") < of("SON1", "severity"));
    assert!(of("SON4", "interval") < of("SON1", "interval"));
    assert!(of("SON1", "latency") < of("SON2", "latency"));
    // 384 before 360; both are intolerable.
    assert!(
        of("OPR1", "rpn") < of("COM1", "rpn") && of("OPR1", "critical") < of("COM1", "critical")
    );
    // Intolerable with 80 before undesirable with 224; the filter knows the class alone.
    assert!(
        of("COL1", "critical") < of("ODO1", "critical") && of("ODO1", "rpn") < of("COL1", "rpn")
    );
    assert_eq!([of("COL1", "class"), of("ODO1", "class"), of("SON1", "class")], [0, 1, 2]);
}

#[test]
fn every_abbreviation_of_the_page_is_in_its_glossary_or_a_row_of_its_table() {
    let page = Folder::new("fmeca_glossary").cotama(&["fmeca", "--format", "html"]).stdout;
    let body = page.split_once("<body>").unwrap().1;
    let (text, glossary) = body.split_once("<section id=\"abbreviations\">").unwrap();
    let glossary = glossary.split_once("</section>").unwrap().0;
    let text: Vec<&str> =
        text.split('<').filter_map(|it| it.split_once('>')).map(|it| it.1).collect();
    let text = text.join(" ");
    let words = text.split(|it: char| !(it.is_alphanumeric() || it == '-'));
    let is_short = |it: &&str| {
        let shape = |it: char| it.is_ascii_uppercase() || it.is_ascii_digit() || it == '-';
        let letters = it.chars().filter(char::is_ascii_uppercase).count();
        it.starts_with(|it: char| it.is_ascii_uppercase())
            && it.chars().all(shape)
            && letters >= 1
            && it.len() >= 2
    };
    let mut found = 0;
    for word in words.map(|it| it.trim_matches('-')).filter(is_short) {
        let begins = |end: &str| page.contains(&format!("<tr id=\"{word}{end}"));
        let row = begins("\"") || begins(".");
        assert!(row || glossary.contains(&format!("<dt>{word}</dt>")), "{word}");
        found += 1;
    }
    assert!(found > 100, "{found}");
    for entry in glossary.split("<dt>").skip(1) {
        let entry = entry.split_once("</dt>").unwrap().0;
        assert!(text.contains(entry), "{entry}");
    }
}

#[test]
fn one_diagram_is_that_of_the_sheet() {
    let folder = Folder::new("fmeca_function");
    let sheet = folder.cotama(&["fmeca", "--format", "svg"]).stdout;
    let one = folder.cotama(&["fmeca", "--function", "localise", "--format", "svg"]).stdout;
    let titles: Vec<_> = one.lines().filter(|it| it.starts_with("<g><title>")).collect();
    assert_eq!(titles.len(), 4);
    assert!(titles.iter().all(|it| sheet.contains(it)));
    assert_eq!(sheet.matches("<g><title>").count(), 46);
}

#[test]
fn the_answer_in_json_has_every_row_and_the_confusable_pairs() {
    let folder = Folder::new("fmeca_json");
    let answer = folder.cotama(&["fmeca", "--json"]).json(0);
    let counts = json!({
        "rows": 46, "functions": 15, "detected": 44,
        "reported": 44, "recorded": 0, "undetectable": 2, "unexplained": 0
    });
    assert_eq!(answer["counts"], counts);
    let rows = answer["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 46);
    assert!(
        rows.iter()
            .all(|it| it["flags_always"] != json!([]) || it["undetectable_reason"].is_string())
    );
    let groups = |status: usize| -> Vec<&Value> {
        let groups = answer["diagnosability"]["statuses"][status]["groups"].as_array().unwrap();
        groups.iter().map(|it| &it["modes"]).collect()
    };
    let sound = [json!(["ODO2", "LOC1", "LOC2"]), json!(["BMP1", "MOT3"]), json!(["CAM2", "COM2"])];
    assert!(sound.iter().all(|it| groups(0).contains(&it)), "{:?}", groups(0));
    let sound = &answer["diagnosability"]["statuses"][0];
    let (modes, none) = (["BMP1", "MOT3"], [""; 0]);
    let alike =
        json!({ "modes": modes, "flags": ["stall"], "flags_optional": none, "probes": none });
    assert!(sound["pairs"].as_array().unwrap().contains(&alike));
    for status in answer["diagnosability"]["statuses"].as_array().unwrap() {
        let listed = status["undetectable"].as_array().unwrap().len()
            + status["impossible"].as_array().unwrap().len();
        assert_eq!(
            status["detectable"].as_u64().unwrap() + listed as u64,
            46,
            "{}",
            status["status"]
        );
    }
}

/// Returns the cells of a line of values separated by commas, of which no text spans lines.
fn cells(line: &str) -> Vec<String> {
    let (mut cells, mut quoted) = (vec![String::new()], false);
    for letter in line.chars() {
        match letter {
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            _ => cells.last_mut().unwrap().push(letter),
        }
    }
    cells
}

/// The table itself is golden in the crate that holds it.
#[test]
fn the_rows_in_json_say_the_same_as_the_table() {
    let folder = Folder::new("fmeca_json_rows");
    let answer = folder.cotama(&["fmeca", "--json"]).json(0);
    let table = folder.cotama(&["fmeca", "--format", "csv"]).stdout;
    let (names, lines) = table.split_once('\n').unwrap();
    let names = cells(names);
    let rows = answer["rows"].as_array().unwrap();
    assert_eq!(lines.lines().count(), rows.len());
    for (row, line) in rows.iter().zip(lines.lines()) {
        let line = cells(line);
        let cell = |name: &str| line[names.iter().position(|it| it == name).unwrap()].as_str();
        for (key, name) in [
            ("id", "id"),
            ("function", "function"),
            ("component", "component"),
            ("failure", "failure_mode"),
            ("cause", "cause"),
            ("effect", "effect"),
            ("severity_autonomous", "severity_auto"),
            ("severity_operator", "severity_teleop"),
            ("loss", "modules_lost"),
            ("observer", "observer"),
            ("detection", "detection_rule"),
            ("class", "cs_event_auto"),
            ("reaction", "reaction"),
            ("persistence", "persistence"),
            ("rate_label", "rate_label"),
            ("rate_source", "rate_source"),
            ("injection", "injection"),
        ] {
            assert_eq!(row[key].as_str().unwrap_or_default(), cell(name), "{}, {key}", row["id"]);
        }
        assert_eq!(row["undetectable_reason"].as_str().unwrap_or_default(), cell("silent"));
        let ranks = ["severity", "occurrence", "detection", "rpn", "class", "action_priority"];
        let names = ["s", "o", "d", "rpn", "criticality", "action_priority"];
        for (key, name) in ranks.into_iter().zip(names) {
            let value = row["criticality"][key].to_string();
            assert_eq!(value.trim_matches('"'), cell(name), "{}, {key}", row["id"]);
        }
        for (key, name) in [("flags_always", "flags"), ("flags_sometimes", "sometimes")] {
            let flags = row[key].as_array().unwrap().iter().map(|it| it.as_str().unwrap());
            let told = cell(name).split(';').map(str::trim).filter(|it| !it.is_empty());
            let (flags, told): (BTreeSet<_>, BTreeSet<_>) = (flags.collect(), told.collect());
            assert_eq!(flags, told, "{}, {key}", row["id"]);
        }
        for (key, name) in [("mtbf_mh", "mtbf_h"), ("detection_latency_ms", "detection_latency_s")]
        {
            let told = cell(name).parse::<f64>().unwrap() * 1000.0;
            assert!((row[key].as_f64().unwrap() - told).abs() < 0.5, "{}, {key}", row["id"]);
        }
    }
}

/// Fields that the table has not: modules, hardware, reports.
#[test]
fn a_row_in_json_says_what_is_lost_with_it() {
    let answer = Folder::new("fmeca_json_lost").cotama(&["fmeca", "--json"]).json(0);
    let row =
        |id: &str| answer["rows"].as_array().unwrap().iter().find(|it| it["id"] == id).unwrap();
    let of =
        |id: &str, keys: &[&str]| keys.iter().map(|it| row(id)[*it].clone()).collect::<Vec<_>>();
    let keys = ["modules_faulty", "resources_lost", "modules_unavailable", "report"];
    let unavailable = json!(["SIM", "UST", "MCL", "SMZ", "DVZ"]);
    assert_eq!(of("SON1", &keys), [json!([]), json!(["sonar_arrays"]), unavailable, json!("SON1")]);
    assert_eq!(row("PWR1")["report"], Value::Null);
}

/// In each status, each pair that can be separated is separated by one of the least probes.
#[test]
fn the_least_probes_separate_all_separable_pairs() {
    let answer = Folder::new("fmeca_least").cotama(&["fmeca", "--json"]).json(0);
    for status in answer["diagnosability"]["statuses"].as_array().unwrap() {
        let least = status["least_probes"].as_array().unwrap();
        for pair in status["pairs"].as_array().unwrap() {
            let probes = pair["probes"].as_array().unwrap();
            let separated = probes.iter().any(|it| least.contains(it));
            assert_eq!(separated, !probes.is_empty(), "{}: {pair}", status["status"]);
        }
    }
}

#[test]
fn arguments_that_make_no_sense() {
    let folder = Folder::new("fmeca_bad");
    let refused = |name: &str, arguments: &[&str]| {
        let ended = folder.cotama(arguments);
        if arguments.contains(&"--json") {
            ended.json(2);
            return;
        }
        assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{name}: {ended:?}");
        golden(&format!("bad_fmeca_{name}.txt"), &ended.stderr);
    };
    refused("function", &["fmeca", "--function", "localize", "--format", "svg"]);
    refused("function_far", &["fmeca", "--function", "fly", "--output", "fly.svg"]);
    refused("function_screen", &["fmeca", "--function", "move"]);
    refused("function_table", &["fmeca", "--function", "move", "--format", "csv"]);
    refused("format", &["fmeca", "--format", "pdf"]);
    refused("end", &["fmeca", "--output", "fmeca.pdf"]);
    refused("both", &["fmeca", "--json", "--format", "md"]);
    refused("diagnosability", &["fmeca", "--diagnosability", "--output", "it.html"]);
    assert_eq!(folder.files(""), Vec::<String>::new());
}

/// The relative luminance of a colour `#rgb` or `#rrggbb`, after WCAG 2.
fn luminance(colour: &str) -> f64 {
    let digits = colour.trim_start_matches('#');
    let wide: String = match digits.len() {
        3 => digits.chars().flat_map(|it| [it, it]).collect(),
        _ => digits.into(),
    };
    let linear = |at: usize| {
        let value = f64::from(u8::from_str_radix(&wide[at..at + 2], 16).unwrap()) / 255.0;
        if value <= 0.040_45 { value / 12.92 } else { libm::pow((value + 0.055) / 1.055, 2.4) }
    };
    0.2126 * linear(0) + 0.7152 * linear(2) + 0.0722 * linear(4)
}

#[test]
fn texts_of_the_page_can_be_read_on_light_and_on_dark() {
    let page = Folder::new("fmeca_contrast").cotama(&["fmeca", "--format", "html"]).stdout;
    let style = page.split_once("<style>").unwrap().1.split_once("</style>").unwrap().0;
    // Paler text would escape the pairs below.
    assert!(!style.contains("opacity"));
    let rules = |with: &str| -> Vec<&str> {
        let all = style.split(":root {").skip(1).filter_map(|it| it.split_once('}'));
        all.map(|it| it.0).filter(|it| it.contains(with)).collect()
    };
    let (themes, severities) = (rules("--bg:"), rules("--fatal:"));
    assert_eq!((themes.len(), severities.len()), (2, 2));
    let mut pairs = 0;
    for theme in themes.into_iter().zip(severities).map(|it| [it.0, it.1].concat()) {
        let value = |name: &str| {
            let rest = theme.split_once(&format!("--{name}: ")).unwrap().1;
            rest.split(';').next().unwrap().to_owned()
        };
        let text = value("ink");
        let mut held = vec![("white on fatal", "#fff".to_owned(), value("fatal"))];
        for ground in ["bg", "soft", "weak", "medium", "hard"] {
            held.push((ground, text.clone(), value(ground)));
        }
        for (words, ground) in [("muted", "bg"), ("muted", "soft"), ("accent", "bg")] {
            held.push((words, value(words), value(ground)));
        }
        for (name, words, ground) in held {
            let (one, other) = (luminance(&words), luminance(&ground));
            let contrast = (one.max(other) + 0.05) / (one.min(other) + 0.05);
            assert!(contrast >= 4.5, "{name}: {words} on {ground}: {contrast:.2}");
            pairs += 1;
        }
    }
    assert_eq!(pairs, 18);
}

#[test]
fn rows_of_a_table_become_those_of_a_robot() {
    let folder = Folder::new("fmeca_rows");
    assert_eq!(folder.cotama(&["new", "robot", "cart"]).code, Some(0));
    let columns = "id,function,component,failure_mode,cause,effect,severity_auto,severity_teleop,\
        modules_lost,flags,detection_latency_s,mtbf_h,reaction";
    let row = "LID2,perceive obstacles,laser scanner,dirty,dust,ranges are short,medium,weak,\
        scan; avoid,scan late;,0.5,300,drive slowly";
    folder.write("more.csv", format!("{columns}\n{row}\n"));
    let rows = folder.cotama(&["fmeca", "more.csv", "--format", "toml"]).stdout;
    let expected = "[[failure]]\nid = \"LID2\"\nfunction = \"perceive obstacles\"\n\
        item = \"laser scanner\"\nmode = \"dirty\"\ncause = \"dust\"\n\
        effect = \"ranges are short\"\n\
        severity = { autonomous = \"medium\", operator = \"weak\" }\nflags = [\"scan late\"]\n\
        latency_ms = 500\nloses = [\"scan\", \"avoid\"]\nmean_hours = 300\n# drive slowly\n";
    assert_eq!(rows, expected);
    folder.write("cart.toml", folder.read("cart.toml") + &rows);
    let analysis = folder.cotama(&["fmeca", "cart.toml", "--json"]).json(0);
    let modes = analysis["rows"].as_array().unwrap();
    assert_eq!(modes[modes.len() - 1]["id"], "LID2");
    assert_eq!(folder.cotama(&["check", "cart.toml"]).code, Some(0));
}

#[test]
fn detections_by_signals_are_measured_failure_by_failure() {
    let folder = Folder::new("fmeca_measure");
    let answer = folder.cotama(&["fmeca", "--measure", "delivery", "--seeds", "1", "--json"]);
    let answer = answer.json(0);
    validate("measure", &answer);
    let rows = answer["rows"].as_array().unwrap();
    let found = |id: &str| {
        let row = rows.iter().find(|it| it["id"] == id).unwrap();
        (row["found"].as_u64(), row["median_ms"].as_u64())
    };
    assert_eq!((rows.len(), found("SON2")), (42, (Some(1), Some(700))));
    assert_eq!(found("BMP1"), (Some(0), None)); // nothing is touched
    let plain = folder.cotama(&["fmeca", "--measure", "patrol"]);
    assert_eq!(plain.code, Some(2));
    assert!(plain.stderr.contains("names no robot"), "{}", plain.stderr);
}
