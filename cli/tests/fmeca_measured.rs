//! Measured detections: kept, shown, drawn from.

use crate::common::Folder;
use crate::schemas::validate;
use serde_json::json;

#[test]
fn a_measurement_that_was_written_shows_the_runs_that_were_made() {
    let folder = Folder::new("fmeca_measured");
    let measure = ["fmeca", "--measure", "delivery", "--seeds", "1", "--output", "m.toml"];
    let shown = folder.cotama(&measure);
    let again = ["fmeca", "--measured", "m.toml", "--detections"];
    assert_eq!(folder.cotama(&again).stdout, shown.stdout);
    let measured = folder.cotama(&[&again[..], &["--json"]].concat()).json(0);
    validate("measure", &measured);
    for row in measured["rows"].as_array().unwrap() {
        let count = |key: &str| row[key].as_u64().unwrap();
        let taken = row["taken_for"].as_array().unwrap().iter();
        assert_eq!(count("found"), taken.map(|it| it["runs"].as_u64().unwrap()).sum::<u64>());
        // A row that is named too seldom says why.
        assert!(count("named") > 0 || row["why"].is_string(), "{row}");
    }
}

#[test]
fn the_rank_by_runs_stands_beside_the_assumed_one_in_every_format() {
    let folder = Folder::new("fmeca_by_runs");
    let by_runs = ["fmeca", "--measured", "p3dx-delivery"];
    let answer = folder.cotama(&[&by_runs[..], &["--json"]].concat()).json(0);
    validate("fmeca", &answer);
    let row = |id: &str| {
        let rows = answer["rows"].as_array().unwrap();
        rows.iter().find(|it| it["id"] == id).unwrap()["criticality"].clone()
    };
    // The array is found in time.
    assert_eq!(
        (&row("SON2")["detection"], &row("SON2")["measured"]["detection"]),
        (&json!(3), &json!(3))
    );
    // The laptop itself is down: no device is harmed, and nothing was measured.
    assert!(row("PWR1").get("measured").is_none());
    let printed =
        |format: &str| folder.cotama(&[&by_runs[..], &["--format", format]].concat()).stdout;
    assert!(
        printed("md")
            .lines()
            .any(|it| it.ends_with("| AP | D measured | RPN measured | AP measured |"))
    );
    let csv = printed("csv");
    assert!(csv.lines().any(|it| it.starts_with("SON2,") && it.ends_with(",M,3,105,M")), "{csv}");
    assert!(printed("html").contains("by runs 105, with D 3"));
    let refused = folder.cotama(&["fmeca", "transport", "--measured", "p3dx-delivery"]);
    assert_eq!(refused.code, Some(2));
    let why = "this measures the robot `p3dx-delivery`, and `transport` is needed here";
    assert!(refused.stderr.contains(why), "{}", refused.stderr);
}

#[test]
fn failures_on_a_line_are_found_as_they_were_measured() {
    let folder = Folder::new("run_measured");
    let text = "format = \"cotama-measurement/1\"\nrobot = \"p3dx-delivery\"\n\
        mission = \"delivery\"\nseeds = 1\nx_mm = 9000\nwindow_ms = 120000\n[[failure]]\n\
        id = \"BAT2\"\nruns = 1\nmissed = 0\ntaken = [{ for = [\"BAT1\"], delays_ms = [4700] }]\n";
    folder.write("m.toml", text);
    folder.write(
        "bat2.toml",
        "format = \"panorama-faults/1\"\n\
         event = [{ x_mm = 8000, kind = \"failure\", mode = \"BAT2\" }]\n",
    );
    let run = ["run", "delivery", "--faults", "bat2.toml", "--measured", "m.toml", "--no-report"];
    let answer = folder.cotama(&[&run[..], &["--trace", "t.jsonl", "--json"]].concat()).json(1);
    let found = &answer["supervised"]["failures"][0];
    let after = found["detected_ms"].as_u64().unwrap() - found["t_ms"].as_u64().unwrap();
    assert_eq!((after, &found["candidates"]), (4_700, &json!(["BAT1"])));
    let again = folder.cotama(&["replay", "t.jsonl", "--json"]).json(1);
    assert_eq!(again["identical"], true);
    let signals = folder.cotama(&[&run[..], &["--fidelity", "signal"]].concat());
    assert_eq!(signals.code, Some(2));
    assert!(signals.stderr.contains("by signals none is told"), "{}", signals.stderr);
}
