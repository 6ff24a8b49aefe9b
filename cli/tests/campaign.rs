//! `cotama campaign`: the same bytes however it is run, resumes, and what it refuses.

use crate::common::Folder;
use crate::schemas::validate;
use std::fmt::Write;

const RUNS: &str = "2500";

/// Runs a campaign of the patrol; its answer.
fn patrol(folder: &Folder, more: &[&str]) -> serde_json::Value {
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
fn what_does_not_fit_is_refused_and_nothing_is_changed() {
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
