//! `cotama replay`: traces that come out the same, and those that do not.

use crate::common::Folder;
use serde_json::json;

fn with_trace(name: &str) -> Folder {
    let folder = Folder::new(name);
    let arguments =
        ["run", "patrol", "--seed", "3", "--json", "--no-report", "--trace", "patrol.jsonl"];
    assert_eq!(folder.cotama(&arguments).json(0)["trace"], "patrol.jsonl");
    folder
}

#[test]
fn a_trace_comes_out_the_same() {
    let folder = with_trace("replay_same");
    let arguments =
        ["replay", "patrol.jsonl", "--json", "--trace", "again.jsonl", "--report", "again"];
    let answer = folder.cotama(&arguments).json(0);
    assert_eq!((&answer["identical"], &answer["seed"]), (&json!(true), &json!(3)));
    assert_eq!((&answer["replans"], &answer["report"]), (&json!(3), &json!("again/index.html")));
    assert_eq!(folder.read("again.jsonl"), folder.read("patrol.jsonl"));
    let screen = folder.cotama(&["replay", "patrol.jsonl"]);
    assert!(
        screen.stdout.ends_with("identical: the run was the same again, in every record\n"),
        "{screen:?}"
    );
}

#[test]
fn a_changed_trace_does_not() {
    let folder = with_trace("replay_changed");
    let changed =
        folder.read("patrol.jsonl").replacen("\"real_power_mw\":1", "\"real_power_mw\":2", 1);
    folder.write("changed.jsonl", changed);
    let ended = folder.cotama(&["replay", "changed.jsonl", "--json"]);
    assert_eq!(ended.json(1)["identical"], false);
}

/// How a file is written changes no record of it.
#[test]
fn a_trace_that_another_program_wrote_again_is_the_same() {
    let folder = with_trace("replay_written");
    let text = folder.read("patrol.jsonl");
    let spaced = |line: &str| {
        let value: serde_json::Value = serde_json::from_str(line).unwrap();
        // Keys in the order of their letters, and a space after each comma and colon.
        let pretty = serde_json::to_string_pretty(&value).unwrap();
        pretty.lines().map(str::trim_start).collect::<Vec<_>>().join(" ")
    };
    let floats = |line: &str| line.replace(",\"x_mm\":", ".0,\"x_mm\":");
    let lines = |each: &dyn Fn(&str) -> String, end: &str| {
        text.lines().map(each).collect::<Vec<_>>().join(end) + end
    };
    for (name, other) in [
        ("carriage returns", text.replace('\n', "\r\n")),
        ("spaces and sorted keys", lines(&spaced, "\n")),
        ("floats", lines(&floats, "\n")),
        ("no end of the last line", text.trim_end().to_owned()),
        ("empty lines at the end", text.clone() + "\n\r\n\n"),
        ("all of it", lines(&|it| spaced(&floats(it)), "\r\n").trim_end().to_owned()),
    ] {
        assert_ne!(other, text, "{name}");
        folder.write("other.jsonl", other);
        let answer = folder.cotama(&["replay", "other.jsonl", "--json"]).json(0);
        assert_eq!(
            (&answer["identical"], &answer["returns"]),
            (&json!(true), &json!(null)),
            "{name}"
        );
    }
}

/// Lines are counted where a difference is told.
#[test]
fn an_empty_line_among_the_records_of_a_trace_is_refused_at_its_place() {
    let folder = with_trace("replay_empty_line");
    let text = folder.read("patrol.jsonl");
    for (place, line) in [(0, 1), (1, 2), (2, 3), (7, 8)] {
        for empty in ["\n", "\r\n", " \t\n"] {
            let mut lines: Vec<_> = text.split_inclusive('\n').collect();
            lines.insert(place, empty);
            folder.write("other.jsonl", lines.concat());
            let error = folder.cotama(&["replay", "other.jsonl", "--json"]).json(2);
            let found = (&error["message"], &error["line"]);
            assert_eq!(found, (&json!("an empty line among the records"), &json!(line)), "{error}");
        }
    }
}

/// The record, the field and both values of the first difference.
#[test]
fn a_record_that_differs_is_named() {
    let folder = with_trace("replay_named");
    let text = folder.read("patrol.jsonl");
    let lines: Vec<_> = text.lines().map(str::to_owned).collect();
    let at = |kind: &str| {
        lines.iter().position(|it| it.contains(&format!("\"record\":\"{kind}\""))).unwrap()
    };
    let end = lines.len() - 1;
    for (line, kind, from, to, field, values) in [
        (
            0,
            "header",
            "\"path_length_mm\":187000",
            "\"path_length_mm\":9",
            "path_length_mm",
            Some(("9", "187000")),
        ),
        (
            at("sample"),
            "sample",
            "\"speed_mm_s\":410",
            "\"speed_mm_s\":411",
            "speed_mm_s",
            Some(("411", "410")),
        ),
        (
            at("plan"),
            "plan",
            "\"choice\":\"M5 L2\"",
            "\"choice\":\"M9\"",
            "plan[0].choice",
            Some(("\"M9\"", "\"M5 L2\"")),
        ),
        (
            at("event"),
            "event",
            "\"delay_ms\":1000",
            "\"delay_ms\":1001",
            "event.delay_ms",
            Some(("1001", "1000")),
        ),
        (
            end,
            "end",
            "\"outcome\":\"completed\"",
            "\"outcome\":\"safe\"",
            "outcome",
            Some(("\"safe\"", "\"completed\"")),
        ),
        (
            end,
            "end",
            "\"replans\":3",
            "\"replans\":3,\"by\":\"hand\"",
            "by",
            Some(("\"hand\"", "null")),
        ),
    ] {
        let mut changed = lines.clone();
        assert!(changed[line].contains(from), "{}", changed[line]);
        changed[line] = changed[line].replacen(from, to, 1);
        folder.write("changed.jsonl", changed.join("\n"));
        let answer = folder.cotama(&["replay", "changed.jsonl", "--json"]).json(1);
        assert_eq!(answer["identical"], false);
        // A header with another seed is run so, and is the same again: nothing here is random.
        let found = &answer["difference"];
        let expected = (&json!(line + 1), &json!(kind), &json!(field));
        assert_eq!((&found["line"], &found["record"], &found["field"]), expected, "{found}");
        if let Some((stored, now)) = values {
            assert_eq!(found["stored"], stored, "{found}");
            assert_eq!(found["now"].as_str().unwrap_or("null"), now, "{found}");
            let screen = folder.cotama(&["replay", "changed.jsonl"]).stdout;
            assert!(
                screen.contains(&format!("line {}, {kind}: `{field}` was {stored}", line + 1)),
                "{screen}"
            );
        }
    }
}

/// An own mission without `[plan]`, which a search plans, and limits that leave little.
fn hall(folder: &Folder) {
    let made = folder.cotama(&["new", "mission", "hall"]);
    assert_eq!(made.code, Some(0), "{made:?}");
}

/// Every file that a campaign writes comes back: by the command that it prints, with the mission
/// named, and from the page.
#[test]
fn each_failure_of_a_campaign_comes_back() {
    let folder = Folder::new("replay_found");
    hall(&folder);
    let mut count = 0;
    for (mission, out, more) in [
        ("hall.toml", "h1", &["--require", "time<=70000", "--require", "completed"][..]),
        ("hall.toml", "h2", &["--require", "completed", "--objective", "paper"]),
        (
            "hall.toml",
            "h3",
            &["--require", "completed", "--objective", "min-energy", "--policy", "upward"],
        ),
        ("hall.toml", "h4", &["--require", "not-failed", "--policy", "rigid", "--seed", "7"]),
        ("patrol", "p1", &["--require", "completed", "--objective", "quality", "--steps", "1000"]),
        ("patrol", "p2", &["--require", "energy<=8600000", "--policy", "exact"]),
        (
            "delivery",
            "d1",
            &["--require", "requests<=0", "--require", "in-time", "--require", "AG !gs.Security"],
        ),
    ] {
        let words =
            [&["campaign", mission, "--runs", "300", "--shrink", "4", "--out", out], more].concat();
        let screen = folder.cotama(&words);
        assert_eq!(screen.code, Some(1), "{screen:?}");
        let next = screen.stdout.lines().find_map(|it| it.strip_prefix("next: ")).unwrap();
        assert_eq!(next, format!("cotama replay {out}/failures/001.toml"));
        assert!(screen.stdout.contains("planner: "), "{}", screen.stdout);
        assert_eq!(folder.shell(next).code, Some(0), "{next}");
        let page = folder.read(&format!("{out}/index.html"));
        for file in folder.files(&format!("{out}/failures")) {
            let path = format!("{out}/failures/{file}");
            assert!(page.contains(&format!("<code>cotama replay {path}</code>")), "{path}");
            let answer = folder.cotama(&["replay", &path, "--json"]).json(0);
            assert_eq!(
                (&answer["returns"], &answer["identical"]),
                (&json!(true), &json!(true)),
                "{path}"
            );
            let named = ["replay", &path, "--mission", mission, "--json"];
            assert_eq!(folder.cotama(&named).json(0), answer, "{path}");
            count += 1;
        }
    }
    assert!(count >= 20, "{count}");
}

/// A team's file as well, whatever its network and its auctions are like.
#[test]
fn each_failure_of_a_team_comes_back_and_a_mended_one_does_not() {
    let folder = Folder::new("replay_teams");
    let edited = |team: &str, edits: &[(&str, &str)]| {
        let text = folder.cotama(&["show", team]).stdout;
        edits.iter().fold(text, |text, (old, new)| {
            assert!(text.contains(old), "{old}");
            text.replacen(old, new, 1)
        })
    };
    let mut count = 0;
    for (number, (team, edits, requirement, looser)) in [
        ("service", &[][..], "time<=300000", "time<=9000000"),
        ("service", &[("loss_permille = 0", "loss_permille = 200")], "time<=250000", "completed"),
        ("service", &[("second_best = true", "second_best = false")], "energy<=1", "not-failed"),
        ("service", &[("slack_permille = 500", "slack_permille = 90")], "time<=0", "not-failed"),
        ("fleet", &[("\"optimal\"", "\"rounds\"")], "time<=250000", "energy<=9000000000"),
    ]
    .into_iter()
    .enumerate()
    {
        let file = format!("own{number}.toml");
        folder.write(&file, edited(team, edits));
        let out = format!("o{number}");
        let runs = if team == "fleet" { "6" } else { "30" };
        let words = ["campaign", &file, "--runs", runs, "--shrink", "3", "--out", &out];
        let ended = folder.cotama(&[&words[..], &["--require", requirement]].concat());
        assert_eq!(ended.code, Some(1), "{ended:?}");
        for name in folder.files(&format!("{out}/failures")) {
            let path = format!("{out}/failures/{name}");
            let answer = folder.cotama(&["replay", &path, "--json"]).json(0);
            let same = (&answer["returns"], &answer["identical"]);
            assert_eq!(same, (&json!(true), &json!(true)), "{file} {path}");
            let text = folder.read(&path);
            let asked = format!("requirement = \"{requirement}\"");
            assert!(text.contains(&asked), "{text}");
            let time = text.lines().find(|it| it.starts_with("time_ms = ")).unwrap();
            for other in [
                text.replace(&asked, &format!("requirement = \"{looser}\"")),
                text.replace(time, "time_ms = 1"),
            ] {
                folder.write("other.toml", other);
                let answer = folder.cotama(&["replay", "other.toml", "--json"]).json(1);
                assert_eq!(answer["returns"], false, "{file} {path}");
            }
            count += 1;
        }
    }
    assert!(count >= 5, "{count}");
}

/// A limit that was raised, an event that was taken out, a requirement that was loosened.
#[test]
fn a_failure_that_was_mended_does_not_come_back() {
    let folder = Folder::new("replay_mended");
    hall(&folder);
    let words = [
        "campaign",
        "hall.toml",
        "--runs",
        "300",
        "--shrink",
        "4",
        "--out",
        "found",
        "--require",
        "completed",
    ];
    assert_eq!(folder.cotama(&words).code, Some(1));
    let mission = folder.read("hall.toml");
    let limit = mission.lines().find(|it| it.trim_start().starts_with("duration_ms")).unwrap();
    folder.write("wide.toml", mission.replacen(limit, "duration_ms = 90000000", 1));
    let files = folder.files("found/failures");
    for name in &files {
        let path = format!("found/failures/{name}");
        let text = folder.read(&path);
        let started = text.find("event = [").unwrap_or(text.find("\n[planner]").unwrap());
        let nothing = format!(
            "format = \"panorama-faults/1\"\n{}",
            &text[text.find("\n[planner]").unwrap()..]
        );
        assert!(started > 0);
        folder.write("nothing.toml", nothing);
        let answer = folder.cotama(&["replay", "nothing.toml", "--json"]).json(1);
        assert_eq!(
            (&answer["returns"], &answer["failure"]["broken"]),
            (&json!(false), &json!(false))
        );
        let screen = folder.cotama(&["replay", "nothing.toml"]);
        let said = "does not return: `completed` is not broken any more\n  \
             expected: `completed` is broken, ";
        assert!(screen.stdout.contains(said), "{}", screen.stdout);
        let looser =
            text.replace("requirement = \"completed\"", "requirement = \"energy<=99000000\"");
        folder.write("looser.toml", looser);
        assert_eq!(folder.cotama(&["replay", "looser.toml", "--json"]).json(1)["returns"], false);
        let line = text.lines().find(|it| it.starts_with("time_ms = ")).unwrap();
        folder.write("changed.toml", text.replace(line, "time_ms = 1"));
        let answer = folder.cotama(&["replay", "changed.toml", "--json"]).json(1);
        let difference = &answer["failure"]["differences"][0];
        assert_eq!((&difference["key"], &difference["expected"]), (&json!("time_ms"), &json!("1")));
    }
    assert!(!files.is_empty());
}

/// A wide limit mends what only the limit breaks.
#[test]
fn a_limit_that_is_raised_mends_a_run_that_was_beyond_it() {
    let folder = Folder::new("replay_raised");
    hall(&folder);
    let words = [
        "campaign",
        "hall.toml",
        "--runs",
        "300",
        "--shrink",
        "2",
        "--out",
        "found",
        "--require",
        "not-failed",
        "--policy",
        "rigid",
    ];
    assert_eq!(folder.cotama(&words).code, Some(1));
    let mission = folder.read("hall.toml");
    let raised = |key: &str, text: &str| {
        let line = text.lines().find(|it| it.trim_start().starts_with(key)).unwrap().to_owned();
        text.replacen(&line, &format!("{key} = 900000000"), 1)
    };
    let wide = raised("energy_mj", &raised("duration_ms", &mission));
    for name in folder.files("found/failures") {
        let path = format!("found/failures/{name}");
        assert_eq!(folder.cotama(&["replay", &path]).code, Some(0), "{path}");
        folder.write("hall.toml", &wide);
        assert_eq!(folder.cotama(&["replay", &path]).code, Some(1), "{path}");
        folder.write("hall.toml", &mission);
    }
}

#[test]
fn a_file_of_faults_without_an_end_says_that_nothing_is_compared() {
    let folder = Folder::new("replay_faults");
    folder.write(
        "faults.toml",
        "format = \"panorama-faults/1\"\nrandom = \
        [{ name = \"people\", per_km = 50, kind = \"obstacle\", delay_ms = 90 }]\n",
    );
    let arguments = ["replay", "faults.toml", "--mission", "patrol", "--seed", "5", "--json"];
    let answer = folder.cotama(&arguments).json(0);
    assert_eq!((&answer["identical"], &answer["returns"]), (&json!(null), &json!(null)));
    assert_eq!(answer["outcome"], "completed");
    assert!(!answer["events"].as_array().unwrap().is_empty());
    let screen = folder.cotama(&arguments[..6]).stdout;
    assert!(screen.contains("nothing to compare with: the file records no end"), "{screen}");
    // Without a mission there is nothing to run.
    let refused = folder.cotama(&["replay", "faults.toml"]);
    assert_eq!(refused.code, Some(2));
    assert!(refused.stderr.contains("a file of faults needs a mission"), "{}", refused.stderr);
}

#[test]
fn a_recorded_failure_is_read_with_its_place() {
    let folder = Folder::new("replay_recorded");
    let end =
        "requirement = \"completed\"\noutcome = \"safe\"\ntime_ms = 1\nenergy_mj = 1\nx_mm = 1\n";
    for (more, said) in [
        ("[expected]\nrequirement = \"completed\"\n", "missing key `outcome`"),
        (&format!("[expected]\n{}", end.replace("safe", "saved")), "unknown outcome `saved`"),
        (&format!("[expected]\n{}", end.replace("time_ms = 1", "time_ms = -1")), "`time_ms`"),
        (&format!("[expected]\n{end}tme = 3\n"), "unknown key `tme`"),
        (
            &format!("[expected]\n{}", end.replace("completed", "compleated")),
            "`compleated` is no requirement",
        ),
        (
            &format!("[expected]\n{}", end.replace("completed", "in-time")),
            "`in-time` is about supervisors",
        ),
        ("[planner]\nobjective = \"quality\"\n", "missing key `allocator`"),
        (
            "[planner]\nobjective = \"fast\"\nallocator = \"exact\"\n",
            "unknown objective of plans `fast`",
        ),
        ("[planner]\nobjective = \"paper\"\nallocator = \"exact\"\nsteps = 0\n", "`steps`"),
    ] {
        folder.write("f.toml", format!("format = \"panorama-faults/1\"\n{more}"));
        let refused = folder.cotama(&["replay", "f.toml", "--mission", "patrol"]);
        assert_eq!(refused.code, Some(2), "{more}: {}", refused.stdout);
        assert!(refused.stderr.contains(said), "{more}: {}", refused.stderr);
    }
}
