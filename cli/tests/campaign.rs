//! `cotama campaign`: the same bytes however it is run, resumes, and what it refuses.

use crate::common::Folder;
use crate::schemas::validate;
use std::fmt::Write;

const RUNS: &str = "2500";

/// Runs a campaign of the patrol; its answer.
pub(crate) fn patrol(folder: &Folder, more: &[&str]) -> serde_json::Value {
    let words = [&["campaign", "patrol", "--runs", RUNS, "--json", "--shrink", "3"], more].concat();
    let answer = folder.cotama(&words);
    assert!(matches!(answer.code, Some(0 | 1)), "{}", answer.stdout);
    let answer = serde_json::from_str(&answer.stdout).unwrap();
    validate("campaign", &answer);
    answer
}

#[test]
fn threads_shards_and_resumes_change_no_byte() {
    let folder = Folder::new("campaign_same");
    let one = patrol(&folder, &["--jobs", "1", "--out", "one"]);
    let runs = folder.read("one/runs.jsonl");
    assert_eq!((one["runs"].as_u64(), runs.lines().count()), (Some(2500), 2500));
    let two = patrol(&folder, &["--jobs", "2", "--out", "two"]);
    assert_eq!(one["digest"], two["digest"]);
    assert!(folder.read("two/runs.jsonl") == runs);
    for shard in ["1", "2"] {
        let (which, out) = (format!("{shard}/2"), format!("part{shard}"));
        patrol(&folder, &["--shard", &which, "--out", &out]);
    }
    let merge =
        ["campaign", "merge", "part2", "part1", "--out", "whole", "--json", "--shrink", "3"];
    let merged: serde_json::Value = serde_json::from_str(&folder.cotama(&merge).stdout).unwrap();
    assert_eq!((&merged["digest"], &merged["failing"]), (&one["digest"], &one["failing"]));
    for file in ["runs.jsonl", "campaign.json"] {
        let same = folder.read(&format!("whole/{file}")) == folder.read(&format!("one/{file}"));
        assert!(same, "{file}");
    }
    // Killed in its second block, with a torn line at the end.
    folder.write("two/runs.jsonl", &runs[..runs.len() / 2]);
    let again = patrol(&folder, &["--out", "two"]);
    assert_eq!(again["digest"], one["digest"]);
    assert!(folder.read("two/runs.jsonl") == runs);
}

#[test]
fn a_failure_is_a_file_that_replays() {
    let folder = Folder::new("campaign_failure");
    let words = "campaign delivery --runs 60 --require requests<=0 --shrink 2 --out found --json";
    let words: Vec<_> = words.split(' ').collect();
    let answer = folder.cotama(&words).json(1);
    validate("campaign", &answer);
    let file = answer["failures"][0]["fault_file"].as_str().unwrap();
    assert_eq!(folder.read(file), answer["failures"][0]["scenario"].as_str().unwrap());
    let again = folder.cotama(&["run", "delivery", "--faults", file, "--no-report", "--json"]);
    let again: serde_json::Value = serde_json::from_str(&again.stdout).unwrap();
    assert!(again["operator_requests"].as_u64().unwrap() > 0, "{again}");
}

#[test]
fn results_that_do_not_fit_are_refused_and_nothing_is_changed() {
    let folder = Folder::new("campaign_refused");
    let shard = |seed: &str, which: &str, out: &str| {
        let (seed, which) = (seed.to_owned(), which.to_owned());
        patrol(&folder, &["--seed", &seed, "--shard", &which, "--out", out]);
    };
    shard("0", "1/2", "a");
    shard("0", "2/2", "b");
    shard("7", "2/2", "other");
    let before = folder.read("a/runs.jsonl");
    let broken = before.replacen("\"run\":3,", "\"run\":4,", 1);
    patrol(&folder, &["--shard", "1/2", "--out", "broken"]);
    folder.write("broken/runs.jsonl", broken);
    patrol(&folder, &["--shard", "1/2", "--out", "torn"]);
    folder.write("torn/runs.jsonl", &before[..before.len() - 9]);
    patrol(&folder, &["--shard", "1/2", "--out", "old"]);
    let old = folder.read("old/campaign.json").replacen("\"0.1.0\"", "\"0.0.9\"", 1);
    folder.write("old/campaign.json", old);
    let mut said = String::new();
    for words in [
        "merge",
        "merge a",
        "merge a a b",
        "merge a other",
        "merge torn b",
        "merge broken b",
        "merge old b",
        "merge a nowhere",
        "patrol --out a --runs 2500",
        "patrol a",
        "patrol --require in-time",
        "delivery --require flies",
        "patrol --shard 3/2 --out c",
    ] {
        let all: Vec<_> = ["campaign"].into_iter().chain(words.split(' ')).collect();
        let refused = folder.cotama(&all);
        assert_eq!(refused.code, Some(2), "{words}");
        writeln!(said, "$ cotama campaign {words}\n{}", refused.stderr).unwrap();
    }
    cotama_golden::compare("tests/golden/bad_campaigns.txt", &said);
    assert!(folder.read("a/runs.jsonl") == before);
}

/// The lines of shards that another program wrote again are the same records.
#[test]
fn shards_are_merged_by_their_records() {
    let folder = Folder::new("campaign_written");
    for shard in ["1", "2"] {
        let (which, out) = (format!("{shard}/2"), format!("part{shard}"));
        patrol(&folder, &["--shard", &which, "--out", &out]);
    }
    let merge = |out: &str| {
        let words =
            ["campaign", "merge", "part1", "part2", "--out", out, "--json", "--shrink", "0"];
        let ended = folder.cotama(&words);
        assert_eq!(ended.code, Some(1), "{}", ended.stderr);
        let answer: serde_json::Value = serde_json::from_str(&ended.stdout).unwrap();
        (answer["digest"].clone(), folder.read(&format!("{out}/runs.jsonl")))
    };
    let one = merge("whole");
    let text = folder.read("part2/runs.jsonl");
    let sorted = |line: &str| {
        let value: serde_json::Value = serde_json::from_str(line).unwrap();
        let pretty = serde_json::to_string_pretty(&value).unwrap();
        pretty.lines().map(str::trim_start).collect::<Vec<_>>().join(" ")
    };
    let lines =
        |each: &dyn Fn(&str) -> String| text.lines().map(|it| each(it) + "\n").collect::<String>();
    for (number, other) in [
        text.replace('\n', "\r\n"),
        lines(&sorted),
        lines(&|it| it.replace(",\"x_mm\"", ".0,\"x_mm\"")),
        text.trim_end().to_owned(),
        text.clone() + "\n\n",
    ]
    .into_iter()
    .enumerate()
    {
        assert_ne!(other, text);
        folder.write("part2/runs.jsonl", other);
        assert!(merge(&format!("whole{number}")) == one, "{number}");
    }
}

/// A campaign is asked for its planner as a run, and makes the same plans.
#[test]
fn a_campaign_plans_as_a_run_does() {
    let folder = Folder::new("campaign_planner");
    assert_eq!(folder.cotama(&["new", "mission", "own"]).code, Some(0));
    folder.write("none.toml", "format = \"panorama-faults/1\"\n");
    for mission in ["own.toml", "patrol", "delivery"] {
        for planner in [
            &[][..],
            &["--objective", "quality"],
            &["--objective", "min-energy"],
            &["--objective", "paper"],
            &["--objective", "paper", "--allocator", "exact"],
            &["--allocator", "panorama"],
        ] {
            let run =
                [&["run", mission, "--faults", "none.toml", "--no-report", "--json"], planner]
                    .concat();
            let run = folder.cotama(&run);
            let Ok(run) = serde_json::from_str::<serde_json::Value>(&run.stdout) else {
                panic!("{run:?}")
            };
            let plan = folder.cotama(&[&["plan", mission, "--json"], planner].concat());
            let plan: serde_json::Value = serde_json::from_str(&plan.stdout).unwrap();
            if plan["status"] == "infeasible" {
                continue;
            }
            let rows = |plan: &serde_json::Value| {
                let rows = plan.as_array().unwrap().iter().map(|it| it["choice"].clone());
                rows.collect::<Vec<_>>()
            };
            assert_eq!(
                rows(&run["plans"][0]["plan"]),
                rows(&plan["plan"]),
                "{mission} {planner:?}"
            );
            // A run of a campaign in which nothing that is drawn is met ends as that run.
            let words = [
                &[
                    "campaign",
                    mission,
                    "--runs",
                    "40",
                    "--json",
                    "--shrink",
                    "1",
                    "--require",
                    "time<=1",
                ],
                planner,
            ];
            let campaign = folder.cotama(&words.concat());
            assert_eq!(campaign.code, Some(1), "{}", campaign.stderr);
            let campaign: serde_json::Value = serde_json::from_str(&campaign.stdout).unwrap();
            let scenario = campaign["failures"][0]["scenario"].as_str().unwrap();
            folder.write("found.toml", scenario);
            let again = folder.cotama(&["replay", "found.toml", "--json"]);
            assert_eq!(again.code, Some(0), "{}", again.stdout);
            let again: serde_json::Value = serde_json::from_str(&again.stdout).unwrap();
            assert_eq!(
                (&again["duration_ms"], &again["energy_mj"]),
                (&run["duration_ms"], &run["energy_mj"])
            );
            assert_eq!(campaign["planner"], again["planner"]);
        }
    }
    let both =
        folder.cotama(&["campaign", "patrol", "--policy", "exact", "--objective", "quality"]);
    assert_eq!(both.code, Some(2));
    assert!(both.stderr.contains("--policy exact says who plans"), "{}", both.stderr);
}

/// Runs a command in a folder; what it answers in JSON, and its exit code.
pub(crate) fn answered(folder: &Folder, line: &str) -> (Option<i32>, serde_json::Value) {
    let words: Vec<_> = line.split('|').map(str::trim).collect();
    let ended = folder.cotama(&[&["campaign"], &words[..], &["--json"]].concat());
    let answer = serde_json::from_str(&ended.stdout).unwrap_or(serde_json::Value::Null);
    if matches!(ended.code, Some(0 | 1 | 3)) {
        validate("campaign", &answer);
    }
    (ended.code, answer)
}
