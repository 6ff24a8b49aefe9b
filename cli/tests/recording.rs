//! Files of a run for other tools.

use crate::common::Folder;
use std::fs;

const FILES: [&str; 4] = ["a.csv", "a.mcap", "a.odometry.tum", "a.truth.tum"];

fn all<'a>(name: &[&'a str; 3]) -> [&'a str; 6] {
    ["--mcap", name[0], "--csv", name[1], "--tum", name[2]]
}

#[test]
fn a_run_in_the_plane_leaves_files_that_a_replay_makes_again() {
    let folder = Folder::new("recording");
    let run = ["run", "delivery", "--fidelity", "plane", "--no-report", "--trace", "run.jsonl"];
    let said = folder.cotama(&[&run[..], &all(&["a.mcap", "a.csv", "a"])].concat()).stdout;
    assert!(said.contains("\nrecording: a.mcap\nrecording: a.csv\nrecording: a.truth.tum\n"));
    let replay = ["replay", "run.jsonl", "--json"];
    let answer = folder.cotama(&[&replay[..], &all(&["b.mcap", "b.csv", "b"])].concat()).json(0);
    let named: Vec<_> = answer["recordings"].as_array().unwrap().iter().collect();
    assert_eq!(named, ["b.mcap", "b.csv", "b.truth.tum", "b.odometry.tum"]);
    for file in FILES {
        let again = file.replacen('a', "b", 1);
        let [first, second] = [file, &again].map(|it| fs::read(folder.path().join(it)).unwrap());
        assert!(first == second && !first.is_empty(), "{file}");
    }
}

#[test]
fn files_of_poses_are_refused_for_a_run_on_a_line_and_nothing_is_written() {
    let folder = Folder::new("recording_line");
    for option in ["--mcap", "--tum", "--indicators"] {
        let ended = folder.cotama(&["run", "delivery", option, "a"]);
        assert_eq!(ended.code, Some(2));
        let said = format!("error: {option} needs poses, and a robot on a line has none\n");
        assert!(ended.stderr.starts_with(&said), "{}", ended.stderr);
        assert!(ended.stderr.contains("--fidelity plane"), "{}", ended.stderr);
    }
    assert_eq!(folder.files("."), [""; 0]);
    let line = "cotama run delivery --no-report --csv a.csv --trace line.jsonl";
    assert_eq!(folder.shell(line).code, Some(0));
    let ended = folder.cotama(&["replay", "line.jsonl", "--mcap", "a.mcap"]);
    assert_eq!(ended.code, Some(2));
    assert!(ended.stderr.contains("record it in the plane"), "{}", ended.stderr);
    assert_eq!(folder.files("."), ["a.csv", "line.jsonl"]);
}

#[test]
fn teams_and_places_that_cannot_be_written_are_refused() {
    let folder = Folder::new("recording_refused");
    for (line, says) in [
        ("run fleet --csv a.csv", "--csv is for missions, and this is a team"),
        ("run fleet --fidelity plane", "--fidelity is for missions, and this is a team"),
        ("run delivery --fidelity plane --tum no/a", "there is no such folder"),
    ] {
        let ended = folder.cotama(&line.split(' ').collect::<Vec<_>>());
        assert_eq!(ended.code, Some(2), "{line}");
        assert!(ended.stderr.contains(says), "{line}: {}", ended.stderr);
    }
    assert_eq!(folder.files("."), [""; 0]);
}

#[test]
fn indicators_of_a_run_become_a_network() {
    let folder = Folder::new("recording_indicators");
    for line in [
        "run delivery --fidelity plane --no-report --indicators runs.csv --trace run.jsonl",
        "replay run.jsonl --indicators again.csv",
        "risk learn steps.csv --out delivery.bif",
        "risk coherence delivery.bif",
    ] {
        if line.contains("learn") {
            let steps = folder.cotama(&["risk", "discretise", "runs.csv", "--bins", "3"]);
            folder.write("steps.csv", steps.stdout);
        }
        let ended = folder.cotama(&line.split(' ').collect::<Vec<_>>());
        assert_eq!(ended.code, Some(0), "{line}: {ended:?}");
    }
    let head = "map_uncertainty,pose_uncertainty,map_information,path_length,waypoints,\
        angle_variance,angle_sum,voronoi_waypoints,speed,heading_variance\n";
    let rows = folder.read("runs.csv");
    assert!(rows.starts_with(head) && rows.lines().count() > 300);
    assert_eq!(rows, folder.read("again.csv"));
}
