//! `cotama run two-ways` and `cotama risk observe`: what they answer, write and refuse. The numbers
//! are proven in the tests of `cotama-ways` and `cotama-indicators`.

use crate::common::Folder;
use crate::schemas::validate;

#[test]
fn policies_meet_the_same_discs_and_an_estimate_has_its_reliability() {
    let folder = Folder::new("ways");
    let line =
        ["run", "two-ways", "--policy", "short", "--policy", "mean", "--runs", "2", "--json"];
    let answer = folder.cotama(&line).json(0);
    validate("run-two-ways", &answer);
    assert_eq!(answer["object_speed"], 0.3);
    let [short, mean] = [0, 1].map(|it| answer["policies"][it].clone());
    assert!(short.get("reliability").is_none() && short.get("gain").is_none());
    assert_eq!(mean["reliability"]["of"], 80);
    // The first trial of either is on the short way where nothing is known.
    let first = |it: &serde_json::Value| it["conditions"][0]["ratios"][0].clone();
    assert_eq!(first(&short)["short_first"], first(&mean)["short_first"]);
    assert!(mean["gain"]["low"].as_f64() <= mean["gain"]["mean"].as_f64());
    assert_eq!(folder.cotama(&line).json(0), answer);
}

#[test]
fn a_run_leaves_its_network_its_trials_and_a_picture() {
    let folder = Folder::new("ways_files");
    let line = "cotama run two-ways --policy mean --learned net.bif --csv trials.csv --svg map.svg";
    assert_eq!(folder.shell(&format!("{line} --map 7")).code, Some(0));
    let line = "cotama risk infer net.bif --query status --evidence ratio=r3_1 --json";
    let failed = folder.shell(line).json(0)["posterior"]["failed"].as_f64().unwrap();
    assert!((0.3..1.0).contains(&failed), "{failed}");
    let trials = folder.read("trials.csv");
    assert!(trials.starts_with("ratio,way,status,path_length_m,run_time_s\n"), "{trials}");
    assert!(folder.read("map.svg").contains("<title>Two ways around an obstacle</title>"));
}

#[test]
fn options_of_missions_and_of_the_experiment_do_not_mix() {
    let folder = Folder::new("ways_idle");
    for (line, said) in [
        ("run two-ways --people 3", "--people changes nothing in two-ways"),
        ("run two-ways --report r", "--report changes nothing in two-ways"),
        ("run two-ways --mcap r.mcap", "--mcap changes nothing in two-ways"),
        ("run patrol --policy mean", "--policy is for `cotama run two-ways`"),
        ("run patrol-axes --online", "--online is for `cotama run two-ways`"),
        ("run two-ways --map 3", "--svg"),
    ] {
        let run = folder.shell(&format!("cotama {line}"));
        assert_eq!(run.code, Some(2), "{line}");
        assert!(run.stderr.contains(said), "{line}: {}", run.stderr);
    }
}

#[test]
fn indicators_of_a_drive_become_a_network() {
    let folder = Folder::new("observe");
    let line = "cotama risk observe sidewalk --seconds 60 --people 4 > runs.csv && \
        cotama risk discretise runs.csv --rule frequency --out steps.csv && \
        cotama risk learn steps.csv --out net.bif && cotama risk coherence net.bif --json";
    let run = folder.shell(line);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert_eq!(folder.read("runs.csv").lines().count(), 1 + 120 - 9);
    assert!(run.stdout.contains("map_uncertainty"));
    let run = folder.shell("cotama risk observe attic");
    assert_eq!(run.code, Some(2));
}
