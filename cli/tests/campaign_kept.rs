//! The folder of a campaign: kept, refused and cleared files.

use crate::campaign::answered;
use crate::common::Folder;

#[test]
fn options_outside_the_header_change_nothing_that_is_kept() {
    let folder = Folder::new("campaign_kept");
    let (_, whole) = answered(&folder, "patrol | --runs | 3500 | --shrink | 0 | --out | a");
    let files = ["a/runs.jsonl", "a/runs.sums", "a/campaign.json"];
    let before = files.map(|it| folder.read(it));
    assert_eq!(before[0].lines().count(), 3_500);
    for more in [
        "--at-most | 0.5",
        "--at-most | 0.001",
        "--confidence | 0.5 | --at-most | 0.9",
        "--shrink | 1",
        "--confidence | 0.999",
        "--jobs | 3",
        "--junit | b.xml",
    ] {
        let line = format!("patrol | --runs | 3500 | --out | a | {more}");
        let (code, answer) = answered(&folder, &line);
        assert!(matches!(code, Some(0 | 1 | 3)), "{line}");
        assert_eq!((&answer["runs"], &answer["digest"]), (&whole["runs"], &whole["digest"]));
        assert!(files.map(|it| folder.read(it)) == before, "{line}");
    }
    // A test that stops leaves whole blocks, and the campaign goes on after them.
    let stopped = "patrol | --runs | 3500 | --shrink | 0 | --out | b | --at-most | 0.5";
    let (code, answer) = answered(&folder, stopped);
    assert_eq!((code, answer["runs"].as_u64()), (Some(0), Some(1_000)));
    assert!(answer["decision"]["runs"].as_u64().unwrap() < 1_000);
    assert!(before[0].starts_with(&folder.read("b/runs.jsonl")));
    let (_, again) = answered(&folder, stopped);
    assert_eq!((&again["decision"], &again["digest"]), (&answer["decision"], &answer["digest"]));
    answered(&folder, "patrol | --runs | 3500 | --shrink | 0 | --out | b");
    assert!(folder.read("b/runs.jsonl") == before[0] && folder.read("b/runs.sums") == before[1]);
}

#[test]
fn results_that_were_changed_are_refused_by_the_line_and_other_spellings_are_not() {
    let folder = Folder::new("campaign_changed");
    let line = "patrol | --runs | 1500 | --shrink | 0 | --out | a";
    let (_, before) = answered(&folder, line);
    let (runs, sums, header) =
        (folder.read("a/runs.jsonl"), folder.read("a/runs.sums"), folder.read("a/campaign.json"));
    assert_eq!(sums.lines().count(), 2);
    let line_of = |number: usize| runs.lines().nth(number - 1).unwrap().to_owned();
    let edit = |number: usize, to: &dyn Fn(&str) -> String| {
        let lines = runs.lines().enumerate();
        let all =
            lines.map(|(at, it)| if at + 1 == number { to(it) } else { it.to_owned() } + "\n");
        all.collect::<String>()
    };
    let completed =
        |it: &str| it.replace("\"safe\"", "\"completed\"").replace("\"failed\"", "\"completed\"");
    let stopped = (1..=1_500).find(|it| completed(&line_of(*it)) != line_of(*it)).unwrap();
    let numbers = |it: &str, key: &str| {
        let at = it.find(key).unwrap() + key.len();
        let (head, rest) = it.split_at(at);
        format!("{head}1{rest}")
    };
    for (number, changed) in [
        (stopped, edit(stopped, &completed)),
        (17, edit(17, &|it| numbers(it, "\"time_ms\":"))),
        (1_000, edit(1_000, &|it| numbers(it, "\"energy_mj\":"))),
        (1_001, edit(1_001, &|it| numbers(it, "\"requests\":"))),
        (1_500, edit(1_500, &|it| numbers(it, "\"x_mm\":"))),
        (3, edit(3, &|it| it.replace("\"faults\":[", "\"faults\":[\"lidar\","))),
        (5, edit(5, &|_| line_of(6))),
    ] {
        folder.write("a/runs.jsonl", &changed);
        for command in [line, "merge | a"] {
            let (code, said) = answered(&folder, command);
            assert_eq!(code, Some(2), "{number} {command}");
            let place = format!("a/runs.jsonl:{number}");
            assert_eq!(said["file"], place, "{said}");
        }
        assert!(folder.read("a/runs.jsonl") == changed, "nothing is thrown away");
    }
    // A line that is no run, and one run more.
    for changed in [format!("{runs}{}\n", line_of(1_500)), edit(9, &|_| "{}".to_owned())] {
        folder.write("a/runs.jsonl", &changed);
        assert_eq!(answered(&folder, line).0, Some(2));
        assert_eq!(answered(&folder, "merge | a").0, Some(2));
    }
    folder.write("a/runs.jsonl", &runs);
    // Checksums and headers that are not those of the results.
    for (file, old, new) in [
        ("a/runs.sums", &sums, sums.replacen("0 ", "0 f", 1)),
        ("a/runs.sums", &sums, String::new()),
        ("a/runs.sums", &sums, "x\n".to_owned()),
        ("a/runs.sums", &sums, sums.lines().next().unwrap().to_owned() + "\n"),
        ("a/campaign.json", &header, header.replacen("\"seed\": 0", "\"seed\": 1", 1)),
        ("a/campaign.json", &header, header.replacen("not-failed", "completed", 1)),
    ] {
        folder.write(file, &new);
        let (code, said) = answered(&folder, "merge | a");
        assert_eq!(code, Some(2), "{new}");
        assert!(said["file"].as_str().unwrap().contains("a/runs."), "{said}");
        folder.write(file, old);
    }
    // Records are the same in another spelling.
    let spaced = |it: &str| it.replace("\":", "\" : ");
    let mut turned: Vec<String> = Vec::new();
    for it in runs.lines() {
        let value: serde_json::Map<String, serde_json::Value> = serde_json::from_str(it).unwrap();
        let mut keys: Vec<_> = value.keys().collect();
        keys.sort_by_key(|it| std::cmp::Reverse(it.as_str()));
        let all = keys.iter().map(|it| format!("{:?}: {}", it, value[it.as_str()]));
        turned.push(format!("{{ {} }}", all.collect::<Vec<_>>().join(", ")));
    }
    for other in [
        runs.replace('\n', "\r\n"),
        runs.trim_end().to_owned(),
        format!("\u{feff}{runs}"),
        format!("{runs}\n \n"),
        turned.join("\n") + "\n",
        runs.lines().map(|it| spaced(it) + "\n").collect(),
    ] {
        folder.write("a/runs.jsonl", &other);
        let (code, merged) = answered(&folder, "merge | a | --out | whole | --shrink | 0");
        assert_eq!(code, Some(1));
        assert_eq!(merged["digest"], before["digest"]);
        assert!(folder.read("whole/runs.jsonl") == runs && folder.read("whole/runs.sums") == sums);
        assert_eq!(answered(&folder, line).1["digest"], before["digest"]);
    }
    // Another spelling of the mission is the same campaign.
    let patrol = cotama_models::missions::embedded::mission("patrol").unwrap().text;
    folder.write("own.toml", patrol);
    let own = "own.toml | --runs | 1200 | --shrink | 0 | --out | own";
    let (_, first) = answered(&folder, own);
    folder.write("own.toml", patrol.replace('\n', "\r\n") + "# a comment\r\n");
    let (code, again) = answered(&folder, own);
    assert_eq!((code, &again["digest"]), (Some(1), &first["digest"]));
}

#[test]
fn outputs_of_an_earlier_call_do_not_stay_beside_new_ones() {
    let folder = Folder::new("campaign_stale");
    let call = |shrink: &str| {
        let all = "patrol | --runs | 300 | --require | completed | --out | a | --shrink |";
        answered(&folder, &format!("{all} {shrink}"))
    };
    let (_, many) = call("20");
    let count = many["failures"].as_array().unwrap().len();
    assert!(count > 2, "{count}");
    assert_eq!(folder.files("a/failures").len(), count);
    folder.write("a/failures/mine.toml", "kept");
    for (shrink, files) in [("1", 1), ("0", 0), ("20", count), ("2", 2), ("0", 0)] {
        let (_, answer) = call(shrink);
        let written = answer["failures"].as_array().unwrap().len();
        assert!(written <= files.max(1), "{shrink}");
        let mut there = folder.files("a/failures");
        there.retain(|it| it != "mine.toml");
        assert_eq!(there.len(), written, "{shrink}: {there:?}");
        assert_eq!(folder.read("a/failures/mine.toml"), "kept");
    }
    // One that no campaign wrote is not written over.
    folder.write("a/failures/001.toml", "# my own\n");
    let (code, said) = call("20");
    assert_eq!(code, Some(2), "{said}");
    assert_eq!(folder.read("a/failures/001.toml"), "# my own\n");
    // The page of fewer runs is gone while more are made.
    let stop = "patrol | --runs | 3000 | --shrink | 0 | --out | b | --at-most | 0.5";
    answered(&folder, stop);
    assert!(folder.read("b/index.html").contains("of 1000 runs"));
    folder
        .write("b/runs.jsonl", folder.read("b/runs.jsonl").replacen("\"run\":7,", "\"run\":8,", 1));
    assert_eq!(answered(&folder, stop).0, Some(2));
}
