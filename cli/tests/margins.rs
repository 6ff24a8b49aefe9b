//! Margins learned from runs, held back and watched by `cotama run` and `cotama campaign`.

use crate::common::{Ended, Folder, patrol};
use serde_json::{Value, json};

/// Patrols that drift, with the plan of the start.
const DRIFT: &str = "campaign patrol --rates drift --policy rigid";

fn said(folder: &Folder, line: &str) -> Ended {
    folder.cotama(&line.split(' ').collect::<Vec<_>>())
}

/// A folder with `margins.toml` of 200 patrols, for 90 %.
fn learned(name: &str) -> Folder {
    let folder = Folder::new(name);
    let line = format!("{DRIFT} --runs 200 --seed 1 --activities runs.csv");
    assert_eq!(said(&folder, &line).code, Some(1)); // some patrols fail
    let line = "risk calibrate runs.csv --coverage 0.9 --out margins.toml";
    assert_eq!(said(&folder, line).code, Some(0));
    folder
}

/// How often promises of an answer were missed, in all.
fn missed(answer: &Value) -> u64 {
    let rows = answer["held"]["watched"].as_array().unwrap();
    rows.iter().map(|it| it["missed"].as_u64().unwrap()).sum()
}

#[test]
fn a_run_says_whether_it_kept_within_its_margins() {
    let folder = learned("margins_run");
    let line = "run patrol --margins margins.toml --no-report --trace run.jsonl";
    let answer = said(&folder, &format!("{line} --json")).json(0);
    let held = &answer["held"];
    assert_eq!((&held["coverage"], &held["holds"]), (&json!(0.9), &json!(true)));
    // 17 activities on two axes; of two of them more was used than in 90 of 100 runs.
    assert_eq!((held["watched"].as_array().unwrap().len(), missed(&answer)), (34, 2));
    assert_eq!(held["watched"][0]["missed_share"]["low"], 0.0);
    let shown = said(&folder, line).stdout;
    let lines = [
        "margins for 90 %: the calibration holds",
        "A1    duration   90.05 %  85.56 to 93.78   100 %  0 of 1  0 to 97.5",
        "and 32 promises from later activities on, 2 missed: see --json",
        "next: cotama replay run.jsonl",
    ];
    assert!(lines.iter().all(|it| shown.contains(it)), "{shown}");
    // A trace holds them, so that a replay says the same.
    let again = said(&folder, "replay run.jsonl --json").json(0);
    assert_eq!(again["identical"], true);
    let plain = said(&folder, "run patrol --no-report --json").json(0);
    assert!(plain.get("held").is_none());
}

#[test]
fn a_campaign_says_that_its_margins_no_longer_hold() {
    let folder = learned("margins_campaign");
    let same = format!("{DRIFT} --runs 150 --seed 2 --margins margins.toml --json");
    assert_eq!(said(&folder, &same).json(1)["held"]["holds"], true);
    let line = format!("{DRIFT} --runs 150 --seed 3 --per-run 4..6 --margins margins.toml");
    let answer = said(&folder, &format!("{line} --json --activities worse.csv")).json(1);
    let energy = &answer["held"]["watched"][1];
    assert_eq!(answer["held"]["holds"], false);
    assert_eq!((&energy["missed"], &energy["runs"]), (&json!(63), &json!(150)));
    assert_eq!(energy["broken_after"], 48);
    // The exact interval of 63 of 150: no promise of 10 %.
    assert!(energy["missed_share"]["low"].as_f64().unwrap() > 0.339);
    let shown = said(&folder, &line).stdout;
    let found = "63 of 150     34 to 50.32  broken, after 48";
    assert!(shown.contains(found) && shown.contains("learn it anew"), "{shown}");
    // The table of the same runs, held against the same margins, says the same.
    let table = said(&folder, "risk calibrate worse.csv --against margins.toml --json").json(1);
    assert_eq!(table["watched"], answer["held"]["watched"]);
}

#[test]
fn a_mission_names_its_margins() {
    let folder = learned("margins_named");
    let mission = patrol(&[("[run]\n", "[run]\nmargins = \"margins.toml\"\n")]);
    std::fs::create_dir(folder.path().join("missions")).unwrap();
    folder.write("missions/mine.toml", &mission);
    std::fs::rename(
        folder.path().join("margins.toml"),
        folder.path().join("missions/margins.toml"),
    )
    .unwrap();
    let run = |options: &str| {
        said(&folder, &format!("run missions/mine.toml --no-report --json{options}")).json(0)
    };
    let (named, none) = (run(""), run(" --margins none"));
    assert_eq!((&named["replans"], &none["replans"]), (&json!(1), &json!(3)));
    assert_eq!(named["held"]["coverage"], 0.9);
    assert!(none.get("held").is_none());
    assert_eq!(named["plans"], run(" --margins missions/margins.toml")["plans"]);
    // Kept results do not say what was held back.
    for (options, option) in [("--out kept", "--out"), ("--compare", "--compare")] {
        let line = format!("campaign missions/mine.toml --runs 5 {options}");
        let refused = said(&folder, &line);
        let message = format!("error: {option} goes without margins, and `patrol` names some");
        assert_eq!(refused.code, Some(2));
        assert!(refused.stderr.starts_with(&message), "{}", refused.stderr);
        assert!(refused.stderr.contains("say --margins none"), "{}", refused.stderr);
        assert_ne!(said(&folder, &format!("{line} --margins none")).code, Some(2));
    }
    folder.write("missions/lost.toml", mission.replace("margins.toml", "marigns.toml"));
    let refused = said(&folder, "run missions/lost.toml");
    let message = "error: missions/marigns.toml: there is no such file";
    assert!(refused.code == Some(2) && refused.stderr.starts_with(message), "{}", refused.stderr);
}
