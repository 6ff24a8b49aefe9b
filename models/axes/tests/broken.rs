//! Missions that cannot be worked with: arithmetic, cases in JSON, limits.

use super::small::WALK;
use cotama_axes::{Case, Lifted, Steps, Stop, Table};

/// What is said about a mission.
fn said(text: &str) -> String {
    let case = match Case::parse(text) {
        Ok(case) => case,
        Err(wrongs) => return wrongs.to_string(),
    };
    match Table::new(&case.mission, Lifted::default(), &mut Steps::default()) {
        Err(Stop::Wrong(wrong)) => wrong.to_string(),
        Err(Stop::Limit) => "a limit".into(),
        Ok(_) => "nothing".into(),
    }
}

#[test]
fn arithmetic_that_does_not_come_out_is_told_at_its_place() {
    let travel = "travel = \"div_up(option(cost) * length_mm, 1000)\"";
    for (to, expected) in [
        (
            "travel = \"div_up(1, length_mm - 5000)\"",
            "60:11: a division by zero in the value of `work.cost`",
        ),
        (
            "travel = \"2 + length_mm * 999999999 * 999999999\"",
            "60:37: a number beyond 64 bits in the value of `work.cost`",
        ),
        (
            "travel = \"length_mm * 999999999999\"",
            "60:11: the value of `work.cost` is beyond 1000000000000000",
        ),
        (
            "travel = { form = \"rate_times_time\", rate = \"option(cost_coins_s)\" }",
            "60:10: the value of `work.cost` is beyond 1000000000000000",
        ),
    ] {
        let text = WALK.replace("cost = 1\n", "cost = 1\ncost_coins_s = 900000000000000\n");
        assert!(text.contains(travel));
        assert_eq!(said(&text.replacen(travel, to, 1)), expected, "{to}");
    }
}

#[test]
fn a_broken_case_in_json_is_refused_at_its_place() {
    let deep = format!("{{\"a\": {}", "[".repeat(40));
    for (text, expected) in [
        (
            "{\"format\": \"axes-case/1\"",
            "1:25: not JSON: the text is cut off: `,` or `}` is needed",
        ),
        ("{\"format\": 'a'}", "1:12: not JSON: a value is needed here"),
        ("{\n \"format\": \"axes-case/1\",\n \"id\": 1.5}", "3:8: `1.5` is no whole number"),
        ("{\"format\": \"axes-case/1\", \"format\": 1}", "1:27: the key `format` stands twice"),
        ("{\"format\": \"axes-case/1\", \"id\": \"a\"}", "1:1: `mission` is missing in the file"),
        (&deep, "1:22: not JSON: this is nested too deeply"),
        ("{\"format\": \"\\x\"}", "1:13: not JSON: this escape is not read here"),
        ("{} {}", "1:4: not JSON: nothing may follow"),
        ("", "1:1: `format` is missing in the file"),
    ] {
        let said = Case::parse(text).unwrap_err().to_string();
        assert!(said.starts_with(expected), "{text}: {said}");
    }
}

#[test]
fn too_many_combinations_are_a_limit() {
    let mut text = WALK.replace("tasks = [\"DET\"]", "tasks = [\"DET\", \"X\", \"Y\", \"Z\"]");
    for (task, number) in ["X", "Y", "Z"].iter().flat_map(|it| (0..20).map(move |n| (it, n))) {
        let tio = format!("[[tio]]\nid = \"{task}{number}\"\ntask = \"{task}\"\n[[objective]]");
        text = text.replacen("[[objective]]", &tio, 1);
    }
    let case = Case::parse(&text).unwrap();
    let made = Table::new(&case.mission, Lifted::default(), &mut Steps::default());
    assert_eq!(made, Err(Stop::Limit));
}
