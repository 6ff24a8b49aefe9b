//! Requirements, guarantees, options and test cases of a campaign.

use crate::campaign::{answered, patrol};
use crate::common::Folder;

#[test]
fn a_requirement_counts_once_wherever_it_is_named() {
    let folder = Folder::new("campaign_once");
    for (mission, named, kept) in [
        ("patrol", &["energy<=0", "completed", "energy<=0"][..], &["energy<=0", "completed"][..]),
        ("patrol", &["time<=0", "time<=00", "time<=000"], &["time<=0"]),
        ("delivery", &["requests<=0", "in-time", "requests<=00"], &["requests<=0", "in-time"]),
        ("delivery", &["never gs.g1", "brakes", "never gs.g1"], &["never gs.g1", "brakes"]),
        ("delivery", &["AG !ls.End", "brakes", "AG  ! ls.End"], &["AG !ls.End", "brakes"]),
    ] {
        let named = named.join(" | --require | ");
        let line = format!("{mission} | --runs | 20 | --shrink | 1 | --require | {named}");
        let (code, answer) = answered(&folder, &line);
        assert!(matches!(code, Some(0 | 1)), "{line}");
        let rows = answer["requirements"].as_array().unwrap();
        let names: Vec<_> = rows.iter().map(|it| it["requirement"].as_str().unwrap()).collect();
        assert_eq!(names, kept);
        for row in rows {
            assert!(row["violated"].as_u64().unwrap() <= 20, "{line}: {row}");
            assert!(row["probability"]["high"].as_f64().unwrap() <= 1.0);
        }
    }
    // A stored header is read as a set too.
    let line = "patrol | --runs | 20 | --require | energy<=0 | --require | completed | --out | a";
    let (_, before) = answered(&folder, line);
    let header = folder.read("a/campaign.json");
    let twice =
        header.replacen("\"energy<=0\",", "\"energy<=0\", \"completed\", \"energy<=00\",", 1);
    folder.write("a/campaign.json", twice);
    let (_, swapped) = answered(&folder, line);
    assert_eq!(swapped["digest"], before["digest"]);
    assert_eq!(swapped["requirements"], before["requirements"]);
}

#[test]
fn guarantees_are_given_where_plans_are_drawn_independently_and_refused_elsewhere() {
    let folder = Folder::new("campaign_guarantees");
    for strategy in ["pairwise", "three-way", "guided", "races", "exhaustive"] {
        for option in ["--at-most | 0.4", "--within | 0.2", "--confidence | 0.9"] {
            let line = format!("patrol | --strategy | {strategy} | {option}");
            let (code, said) = answered(&folder, &line);
            assert_eq!(code, Some(2), "{line}");
            let said = said["message"].as_str().unwrap_or_default().to_owned();
            assert!(said.contains(strategy), "{line}: {said}");
        }
        // Findings are said without an interval.
        let line = format!("patrol | --runs | 50 | --strategy | {strategy} | --shrink | 0");
        let (_, answer) = answered(&folder, &line);
        assert_eq!(answer["failure_probability"], serde_json::Value::Null, "{strategy}");
        assert_eq!(answer["requirements"][0]["probability"], serde_json::Value::Null);
    }
    for strategy in ["uniform", "swarm"] {
        let asked = "--require | completed | --shrink | 0";
        let line = format!("patrol | --strategy | {strategy} | {asked} | --at-most | 0.9");
        let (code, answer) = answered(&folder, &line);
        assert_eq!((code, &answer["decision"]["exact"]), (Some(0), &false.into()), "{strategy}");
        // Wider than the interval of a number of runs that was fixed before.
        let (stopped, runs) = (&answer["failure_probability"], answer["runs"].as_u64().unwrap());
        let line = format!("patrol | --strategy | {strategy} | {asked} | --runs | {runs}");
        let (_, fixed) = answered(&folder, &line);
        let (fixed, number) = (&fixed["failure_probability"], |it: &serde_json::Value| it.as_f64());
        assert_eq!(stopped["estimate"], fixed["estimate"]);
        assert!(number(&stopped["low"]) < number(&fixed["low"]), "{stopped} {fixed}");
        assert!(number(&stopped["high"]) > number(&fixed["high"]), "{stopped} {fixed}");
    }
}

#[test]
fn a_complete_enumeration_is_exact_and_says_so() {
    let folder = Folder::new("campaign_exact");
    let all = "patrol | --strategy | exhaustive | --per-run | 1 | --runs | 100000 | --shrink | 0";
    let (_, whole) = answered(&folder, &format!("{all} | --require | completed"));
    let number = |key: &str| u32::try_from(whole[key].as_u64().unwrap()).unwrap();
    let (runs, failing) = (number("runs"), number("failing"));
    assert!(0 < failing && failing < runs && runs < 1_000, "{failing} of {runs}");
    let share = f64::from(failing) / f64::from(runs);
    for (at_most, code, verdict) in [
        (share + 1e-6, 0, "at_most"),
        (share - 1e-6, 1, "more"),
        (0.999, 0, "at_most"),
        (1e-6, 1, "more"),
        (f64::midpoint(share, 1.0), 0, "at_most"),
    ] {
        let line = format!("{all} | --require | completed | --at-most | {at_most}");
        let (found, answer) = answered(&folder, &line);
        let decision = &answer["decision"];
        assert_eq!((found, decision["verdict"].as_str()), (Some(code), Some(verdict)), "{line}");
        assert_eq!(
            (&decision["exact"], decision["runs"].as_u64()),
            (&true.into(), Some(runs.into()))
        );
        assert_eq!(answer["failure_probability"], serde_json::Value::Null);
    }
    let words: Vec<_> = all.split(" | ").chain(["--at-most", "0.9"]).collect();
    let screen = folder.cotama(&[&["campaign"], &words[..]].concat());
    let said = format!("exactly: 1 of the {runs} plans that there are");
    assert!(screen.stdout.contains(&said), "{}", screen.stdout);
    // Fewer than all say nothing of the others.
    let few = format!(
        "patrol | --strategy | exhaustive | --per-run | 1 | --at-most | 0.9 | --runs | {}",
        runs - 1
    );
    assert_eq!(answered(&folder, &few).0, Some(2));
}

#[test]
fn a_comparison_gives_intervals_to_what_was_drawn_and_counts_what_was_run() {
    let folder = Folder::new("campaign_compared");
    let null = serde_json::Value::Null;
    for (more, sampled) in [
        ("--strategy | uniform", true),
        ("--strategy | swarm", true),
        ("--strategy | pairwise", false),
        ("--strategy | three-way", false),
        ("--strategy | guided", false),
        ("--strategy | races", false),
        ("--strategy | exhaustive | --per-run | 1", false),
    ] {
        let (code, answer) =
            answered(&folder, &format!("patrol | --compare | --runs | 90 | {more}"));
        assert_eq!(code, Some(0), "{more}");
        let rows = answer["policies"].as_array().unwrap();
        for (at, row) in rows.iter().enumerate() {
            let all: u64 =
                row["outcomes"].as_object().unwrap().values().map(|it| it.as_u64().unwrap()).sum();
            assert_eq!(Some(all), answer["runs"].as_u64(), "{more}");
            assert_eq!(row["success"] != null, sampled, "{more}");
            assert_eq!(row["p_value"] != null, sampled && at > 0, "{more}");
            assert_eq!(row["success_difference"] != null, sampled && at > 0, "{more}");
            for mean in ["duration_ms", "energy_mj", "operator_requests", "replans"] {
                assert!(row[mean]["estimate"].is_f64(), "{more}");
                assert_eq!(row[mean]["high"] != null, sampled, "{more} {mean}");
            }
        }
        let is_less = answer["runs"].as_u64().unwrap() < 90;
        assert_eq!(is_less, more.contains("exhaustive"), "{more}: {}", answer["runs"]);
    }
    let high = |more: &str| {
        let (_, answer) = answered(&folder, &format!("patrol | --compare | --runs | 90 {more}"));
        answer["policies"][1]["success"]["high"].as_f64().unwrap()
    };
    assert!(high("| --confidence | 0.99") > high("| --confidence | 0.6"));
}

#[test]
fn an_option_that_would_do_nothing_is_refused() {
    let folder = Folder::new("campaign_idle");
    patrol(&folder, &["--shard", "1/2", "--out", "a"]);
    patrol(&folder, &["--shard", "2/2", "--out", "b"]);
    let merge = "merge | a | b";
    for line in [
        format!("{merge} | --at-most | 0.5"),
        format!("{merge} | --require | completed"),
        format!("{merge} | --seed | 0"),
        format!("{merge} | --strategy | uniform"),
        format!("{merge} | --runs | 2500"),
        format!("{merge} | --jobs | 2"),
        format!("{merge} | --rates | even"),
        format!("{merge} | --per-run | 1..3"),
        format!("{merge} | --policy | usual"),
        format!("{merge} | --within | 0.1"),
        format!("{merge} | --compare"),
        "patrol | --compare | --require | completed".to_owned(),
        "patrol | --compare | --shrink | 3".to_owned(),
        "patrol | --compare | --junit | a.xml".to_owned(),
        "delivery | --strategy | pairwise | --rates | fmeca".to_owned(),
        "delivery | --strategy | guided | --rates | fmeca".to_owned(),
        "patrol | --strategy | exhaustive | --per-run | 1..2".to_owned(),
        "patrol | --strategy | three-way | --per-run | 0..3".to_owned(),
    ] {
        assert_eq!(answered(&folder, &line).0, Some(2), "{line}");
    }
    assert_eq!(folder.files(".").len(), 2);
    let fits = format!("{merge} | --out | c | --shrink | 1 | --confidence | 0.9 | --junit | c.xml");
    assert!(matches!(answered(&folder, &fits).0, Some(0 | 1)));
    // A shard makes its own failures small where that is asked for.
    let line =
        "patrol | --runs | 900 | --require | completed | --shard | 1/1 | --out | d | --shrink | 1";
    let (_, answer) = answered(&folder, line);
    assert_eq!(answer["shrunk"], 1);
}

#[test]
fn a_number_of_runs_beyond_the_limit_is_refused_however_it_is_asked_for() {
    let folder = Folder::new("campaign_many");
    for line in [
        "patrol | --within | 2e-9",
        "patrol | --within | 0.00001",
        "patrol | --within | 0.00004 | --confidence | 0.999",
        "patrol | --compare | --runs | 1000000001",
        "patrol | --runs | 1000000001",
        "patrol | --runs | 0",
        "patrol | --runs | 18446744073709551616",
    ] {
        let (code, said) = answered(&folder, line);
        assert_eq!(code, Some(2), "{line}");
        assert!(said["message"].as_str().unwrap().contains("1000000000"), "{line} {said}");
    }
    patrol(&folder, &["--shard", "1/1", "--out", "a"]);
    let header = folder.read("a/campaign.json");
    for (from, to) in [
        ("\"runs\": 2500", "\"runs\": 460000000000000000"),
        ("\"runs\": 2500", "\"runs\": 0"),
        ("\"of\": 1", "\"of\": 18446744073709551615"),
        ("\"index\": 1", "\"index\": 0"),
        ("    3\n", "    300\n"),
        ("\"uniform\"", "\"unicorn\""),
    ] {
        assert!(header.contains(from), "{from}\n{header}");
        folder.write("a/campaign.json", header.replacen(from, to, 1));
        let (code, said) = answered(&folder, "merge | a");
        assert_eq!(code, Some(2), "{to}");
        assert!(said["file"].as_str().unwrap().contains("campaign.json"), "{said}");
    }
}

#[test]
fn requirements_are_test_cases() {
    let folder = Folder::new("campaign_junit");
    let cases = |text: &str| text.matches("<testcase ").count();
    for (line, code, all, failing, part) in [
        (
            "patrol | --runs | 60 | --require | completed | --require | energy<=99999999",
            1,
            2,
            1,
            "<failure message=\"broken in ",
        ),
        ("patrol | --runs | 60 | --require | not-failed", 0, 1, 0, "name=\"not-failed\"/>"),
        (
            "delivery | --runs | 30 | --shrink | 1 | --require | requests<=0 | --require | brakes",
            1,
            2,
            1,
            "name=\"requests&lt;=0\">",
        ),
        (
            "patrol | --runs | 900 | --require | completed | --at-most | 0.9",
            0,
            1,
            0,
            "completed in all but 0.9 of runs\"/>",
        ),
        (
            "patrol | --runs | 900 | --require | completed | --at-most | 0.05",
            1,
            1,
            1,
            " runs break a requirement\">",
        ),
        (
            "patrol | --runs | 20 | --require | not-failed | --at-most | 0.001",
            3,
            1,
            0,
            "<error message=\"not decided: ",
        ),
        (
            "delivery | --runs | 40 | --shard | 1/2 | --out | part",
            0,
            3,
            0,
            "testsuite name=\"delivery, part 1/2\"",
        ),
    ] {
        let (found, _) = answered(&folder, &format!("{line} | --junit | out.xml"));
        let text = folder.read("out.xml");
        assert_eq!(found, Some(code), "{line}\n{text}");
        assert_eq!((cases(&text), text.matches("<failure ").count()), (all, failing), "{text}");
        assert!(text.contains(part), "{part}\n{text}");
        let mut reader = quick_xml::Reader::from_str(&text);
        while !matches!(reader.read_event().unwrap(), quick_xml::events::Event::Eof) {}
    }
    assert_eq!(answered(&folder, "patrol | --runs | 9 | --junit | no/where.xml").0, Some(2));
}
