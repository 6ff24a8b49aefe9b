//! Broken files: each has one cause, and one message at its place.

use super::small::WALK;
use cotama_axes::{Case, Lifted, Steps, Stop, Table};

/// The walk with something replaced, and what is said about it.
fn said(from: &str, to: &str) -> String {
    assert!(WALK.contains(from), "{from}");
    let case = match Case::parse(&WALK.replacen(from, to, 1)) {
        Ok(case) => case,
        Err(wrong) => return wrong.to_string(),
    };
    match Table::new(&case.mission, Lifted::default(), &mut Steps::default()) {
        Err(Stop::Wrong(wrong)) => wrong.to_string(),
        Err(Stop::Limit) => "a limit".into(),
        Ok(_) => "nothing".into(),
    }
}

#[test]
fn a_broken_file_is_refused_with_its_cause_and_its_place() {
    let travel = "travel = \"div_up(option(cost) * length_mm, 1000)\"";
    for (from, to, expected) in [
        ("format = \"cotama-axes/1\"", "format = \"axes/1\"", "1:10: unknown format; there are: "),
        (
            "name = \"walk\"",
            "name = \"the walk\"",
            "2:8: `the walk` is no name: a name has 1 to 64",
        ),
        ("path_length_mm = 10000", "", "1:1: `path_length_mm` is missing in the file"),
        ("10000\nask", "1e4\nask", "3:18: `path_length_mm` must be an integer, not a float"),
        ("ask = [[\"min\"", "ask = [[\"least\"", "4:9: unknown sense `least`; there are: min, max"),
        (
            "\"work.cost\"]]",
            "\"work.cots\"]]",
            "4:16: unknown indicator `work.cots`; there are: work.cost",
        ),
        (
            "\"work.cost\"]]",
            "\"noise.level\"]]",
            "4:16: `noise.level` does not add up over the mission",
        ),
        (
            "speed_step_mm_s = 100",
            "speed_step_mm_s = 0",
            "7:19: `speed_step_mm_s` must be 1 to 100000",
        ),
        ("speed_max_mm_s = 500", "speed_max_mm_s = 50", "6:18: `speed_max_mm_s` must be 100 to"),
        ("c2 = 0", "c2 = 0\nc3 = 0", "12:1: unknown key `c3` in `motion_power`"),
        ("detect_by = \"option\"", "detect_by = \"robot\"", "13:13: unknown way to detect `robot`"),
        ("bumper = 1 }", "bumper = 2 }", "20:20: `bumper` must be 1 to 1, not 2"),
        ("bumper = 1 }", "laser = 1 }", "20:11: unknown hardware `laser`; there are: bumper"),
        ("id = \"M2\"", "id = \"M1\"", "24:6: a second option is called `M1`"),
        ("tasks = [\"DET\"]", "tasks = [\"FLY\"]", "48:10: no option implements the task `FLY`"),
        ("tasks = [\"DET\"]", "tasks = []", "44:1: `tasks` needs a task besides `LOC`"),
        ("x_end_mm = 5000", "x_end_mm = 50000", "52:12: `x_end_mm` must be 0 to 10000, not 50000"),
        ("combine = \"sum\"", "combine = \"most\"", "58:11: unknown way to combine `most`"),
        (travel, "travel = \"option(cost\"", "59:22: no formula: `)` is needed here"),
        (travel, "travel = \"length_m + 1\"", "59:11: unknown inducer `length_m`"),
        (
            travel,
            "travel = \"laptop.idle\"",
            "59:11: the formula reads `laptop.idle`, which is not",
        ),
        (
            travel,
            "travel = \"div_up(1, length_mm - 5000)\"",
            "59:11: a division by zero in the value of `work.cost`",
        ),
        (
            travel,
            "travel = \"2 + length_mm * 999999999 * 999999999\"",
            "59:37: a number beyond 64 bits in the value of",
        ),
        (
            travel,
            "travel = \"length_mm * 999999999999\"",
            "59:11: the value of `work.cost` is beyond 1000000000000000",
        ),
        (
            "[[axis]]\nid = \"noise\"",
            "[[axis]]\nid = \"work\"",
            "68:6: a second axis is called `work`",
        ),
        ("[robot]", "[robot", "5:7: not TOML: "),
    ] {
        let said = said(from, to);
        assert!(said.starts_with(expected), "{to}: {said}");
    }
}

#[test]
fn a_broken_constraint_is_refused_with_its_cause_and_its_place() {
    let whole = "[[constraint]]\nid = \"c\"\nindicator = \"work.cost\"\nkind = \"end\"\n\
                 op = \"<=\"\ngoal = 5\n";
    for (from, to, expected) in [
        ("\"work.cost\"", "\"work.pay\"", "3:13: unknown indicator `work.pay`"),
        ("\"end\"", "\"core\"", "4:8: `work.cost` adds up over the mission: limit it at its `end`"),
        (
            "\"work.cost\"",
            "\"noise.level\"",
            "4:8: `noise.level` is of each activity and has no sum",
        ),
        ("\"end\"", "\"last\"", "4:8: unknown kind `last`; there are: core, end, running"),
        ("\"<=\"", "\"==\"", "5:6: unknown operator `==`; there are: <, <=, =, >=, >"),
        ("goal = 5", "goal = \"5\"", "6:8: `goal` must be an integer, not a text"),
        ("goal = 5", "", "1:1: `goal` is missing in a `constraint`"),
        (
            "goal = 5",
            "goal = 5\nat = [{ zone = \"near\", goal = 4 }]",
            "7:7: a goal at the end is one",
        ),
        ("goal = 5", "goal = 5\nat = [{ zone = \"far\", goal = 4 }]", "7:16: unknown zone `far`"),
        ("goal = 5", "goal = 5\nunit = \"mJ\"", "7:1: unknown key `unit` in a `constraint`"),
    ] {
        let wrong = Case::parse(&format!("{WALK}{}", whole.replace(from, to))).unwrap_err();
        let own = WALK.lines().count();
        let said = format!("{}:{}: {}", wrong.line - own, wrong.column, wrong.message);
        assert!(said.starts_with(expected), "{to}: {said}");
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
