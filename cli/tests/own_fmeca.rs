//! `cotama fmeca FILE`: an analysis of one's own, on the same path as the robot's.

use crate::common::{Folder, golden};
use serde_json::{Value, json};

/// A folder with the file that `cotama new` writes.
fn arm(name: &str) -> Folder {
    let folder = Folder::new(name);
    let answer = folder.cotama(&["new", "fmeca", "arm", "--json"]).json(0);
    assert_eq!(answer["files"], json!(["arm.toml"]));
    folder
}

#[test]
fn the_screens_of_a_new_file() {
    let folder = arm("own_fmeca_screens");
    golden("own_fmeca.txt", &folder.cotama(&["fmeca", "arm.toml"]).stdout);
    golden("own_fmeca_narrow.txt", &folder.shell("COLUMNS=60 cotama fmeca arm.toml").stdout);
    let told = folder.cotama(&["fmeca", "arm.toml", "--diagnosability"]).stdout;
    golden("own_fmeca_diagnosability.txt", &told);
    golden("own_fmeca.md", &folder.cotama(&["fmeca", "arm.toml", "--format", "md"]).stdout);
    let page = folder.cotama(&["fmeca", "arm.toml", "--format", "html"]).stdout;
    crate::fmeca_page::shows(&page, &folder.cotama(&["fmeca", "arm.toml", "--json"]).json(0));
    let sheet = folder.cotama(&["fmeca", "arm.toml", "--format", "svg"]).stdout;
    assert_eq!(sheet.matches("<g><title>").count(), 6);
}

#[test]
fn the_answer_of_a_new_file() {
    let answer = arm("own_fmeca_json").cotama(&["fmeca", "arm.toml", "--json"]).json(0);
    assert_eq!(answer["schema"], "cotama/fmeca/1");
    let counts = json!({
        "rows": 6, "functions": 3, "detected": 5, "reported": 0, "recorded": 5,
        "undetectable": 1, "unexplained": 0
    });
    assert_eq!(answer["counts"], counts);
    let told = answer["rows"].as_array().unwrap().iter().map(|row| {
        let it = &row["criticality"];
        format!("{} {} {}", row["id"].as_str().unwrap(), it["rpn"], it["class"].as_str().unwrap())
    });
    let told = told.collect::<Vec<_>>();
    // LID1: hard 8, 8,000 h 6, 200 ms 3; 8/8,000 = 0.001. BAT2: fatal 10, a quarter of every
    // 20,000 h is every 80,000 h 5, 1 s 3; 8/80,000 = 0.0001.
    let expected = [
        "LID1 144 tolerable",
        "LID2 105 tolerable",
        "GRP1 144 tolerable",
        "GRP2 480 tolerable",
        "BAT1 108 undesirable",
        "BAT2 150 tolerable",
    ];
    assert_eq!(told, expected);
    assert_eq!(answer["rows"][5]["criticality"]["number_e9"], 80_000);
    assert!(answer["rows"][0]["criticality"].get("number_e9").is_none());
    let [status] = answer["diagnosability"]["statuses"].as_array().unwrap().as_slice() else {
        panic!("{answer}");
    };
    let pair = json!({
        "modes": ["LID1", "LID2"], "flags": ["scan late"], "flags_optional": [],
        "probes": ["current of the lidar", "load of the network"]
    });
    assert_eq!((&status["pairs"], &status["separable"]), (&json!([pair]), &Value::Bool(true)));
    assert_eq!(status["least_probes"], json!(["current of the lidar"]));
    assert!(answer["diagnosability"].get("ambiguous_case").is_none());
}

#[test]
fn each_line_of_the_template_that_is_a_comment_and_holds_a_key_can_be_used() {
    let folder = arm("own_fmeca_keys");
    let text = folder.read("arm.toml");
    let keys: Vec<_> =
        text.lines().filter(|it| it.starts_with("# ") && it.contains(" = ")).collect();
    assert_eq!(keys.len(), 6, "{keys:?}");
    let all = keys.iter().fold(text.clone(), |text, line| text.replacen(line, &line[2..], 1));
    folder.write("all.toml", all);
    let answer = folder.cotama(&["fmeca", "all.toml", "--json"]).json(0);
    let row = &answer["rows"][0];
    assert_eq!(
        (&row["severity_operator"], &row["persistence"]),
        (&json!("medium"), &json!("permanent"))
    );
    assert_eq!(row["flags_sometimes"], json!(["voltage low"]));
    assert_eq!(row["injection"], "hold the motor");
    assert_eq!(text.matches("arm").count(), 5 + text.matches("smarm").count());
}

#[test]
fn a_table_written_is_read_again_and_says_the_same() {
    let folder = arm("own_fmeca_csv");
    for (file, name) in [(Some("arm.toml"), "arm.csv"), (None, "robot.csv")] {
        let from: Vec<&str> = ["fmeca"].into_iter().chain(file).collect();
        let written = folder.cotama(&[&from[..], &["--output", name]].concat());
        assert_eq!(written.code, Some(0), "{written:?}");
        let again = folder.cotama(&["fmeca", name, "--format", "csv"]).stdout;
        assert_eq!(again, folder.read(name));
        let read = |arguments: &[&str]| {
            let answer = folder.cotama(&[arguments, &["--json"]].concat()).json(0);
            let rows = answer["rows"].as_array().unwrap().clone();
            let told = rows.into_iter().map(|it| (it["id"].clone(), it["criticality"].clone()));
            (told.collect::<Vec<_>>(), answer["counts"]["undetectable"].clone())
        };
        assert_eq!(read(&["fmeca", name]), read(&from));
    }
}

#[test]
fn the_page_of_any_file_needs_nothing_else_and_every_link_in_it_leads_somewhere() {
    let folder = Folder::new("own_fmeca_page");
    // Ids that are parts of the page, and texts that HTML, Markdown and a terminal would read.
    folder.write(
        "wicked.csv",
        "id,function,component,failure,cause,effect,severity,mtbf_h,flags,latency_ms\n\
         table,<script>alert(1)</script>,a & b,\"x, \"\"y\"\"\",c|d,*e*,weak,5,<i>;,1\n\
         matrix,f,c,f,c,e,fatal,1e9,<i>;,1\n",
    );
    let page = folder.cotama(&["fmeca", "wicked.csv", "--format", "html"]).stdout;
    assert_eq!((page.matches("<script>").count(), page.contains("<i>")), (1, false));
    assert_eq!(page.matches("<svg class=\"causes\"").count(), 3);
    for target in page.split("href=\"#").skip(1).filter_map(|it| it.split('"').next()) {
        assert_eq!(page.matches(&format!("id=\"{target}\"")).count(), 1, "{target}");
    }
    // Facts that no row gives have no column.
    assert!(!page.contains("Operator drives") && !page.contains("data-column=\"Lost\""));
    let told = folder.cotama(&["fmeca", "wicked.csv", "--format", "md"]).stdout;
    assert!(told.contains("c\\|d") && !told.contains("modules lost"), "{told}");
    for width in [50, 60, 89, 90, 133] {
        let screen = folder.shell(&format!("COLUMNS={width} cotama fmeca wicked.csv")).stdout;
        let lines = screen.lines().filter(|it| !it.starts_with("next: "));
        assert!(lines.map(|it| it.chars().count()).max().unwrap() <= width, "{width}:\n{screen}");
    }
}

#[test]
fn files_that_cannot_be_used() {
    let folder = arm("own_fmeca_bad");
    let arm = folder.read("arm.toml");
    folder.write("typo.toml", arm.replacen("\"scan late\"]", "\"scan lat\"]", 1));
    folder.write("mission.toml", "format = \"panorama-mission/1\"\n");
    folder.write("cut.csv", "id,function,component,failure,cause,effect,severity\nA,b\n");
    let refused = |name: &str, arguments: &[&str]| {
        let ended = folder.cotama(&[&["fmeca"], arguments].concat());
        assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{name}: {ended:?}");
        golden(&format!("bad_own_fmeca_{name}.txt"), &ended.stderr);
    };
    refused("missing", &["none.toml"]);
    refused("end", &["arm.xlsx"]);
    refused("flag", &["typo.toml"]);
    refused("mission", &["mission.toml", "--output", "it.html"]);
    refused("csv", &["cut.csv"]);
    refused("function", &["arm.toml", "--function", "hold a object", "--format", "svg"]);
    let error = folder.cotama(&["fmeca", "typo.toml", "--json"]).json(2);
    assert_eq!((&error["line"], &error["column"]), (&json!(51), &json!(10)), "{error}");
    assert_eq!(folder.files("."), ["arm.toml", "cut.csv", "mission.toml", "typo.toml"]);
}
