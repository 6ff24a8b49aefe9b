//! Files of robots that are refused: each cause once, with its place and what to do.

use crate::robots::Robot;

pub(super) const FILE: &str = r#"format = "cotama-robot/1"
name = "scout"
[hardware.base]
[hardware.lidar]
[hardware.radio]
[module.drive]
hardware = ["base"]
[module.scan]
hardware = ["lidar"]
needs = ["drive"]
[module.link]
hardware = ["radio"]
[observer.eye]
needs = ["drive"]
flags = ["late", "silent", "stuck"]
[operator]
needs = ["link"]
[[configuration]]
name = "Careful"
sub_objective = "Follow"
mode = "autonomous"
required = ["scan"]
speed_mm_s = 500
[[configuration]]
name = "Blind"
sub_objective = "Follow"
mode = "autonomous"
required = ["drive"]
[[configuration]]
name = "Hand"
sub_objective = "Manual"
mode = "operator"
required = ["drive", "link"]
[[failure]]
id = "LID1"
mode = "no scan"
severity = { autonomous = "medium" }
flags = ["late"]
loses = ["lidar"]
mean_hours = 400
[[failure]]
id = "LNK1"
mode = "no link"
severity = { autonomous = "weak", operator = "fatal" }
flags = ["silent"]
loses = ["radio"]
[[failure]]
id = "STK1"
mode = "stuck"
severity = { autonomous = "hard" }
flags = ["stuck"]
"#;

/// The first error of the file with a text replaced, and what to do.
pub(super) fn refused(from: &str, to: &str) -> String {
    assert_eq!(FILE.matches(from).count(), 1, "{from}");
    let errors = Robot::parse("r.toml", &FILE.replace(from, to)).unwrap_err().to_string();
    errors.lines().take(2).map(str::trim).collect::<Vec<_>>().join(" | ")
}

#[test]
fn the_file_itself_is_a_robot() {
    let robot = Robot::parse("r.toml", FILE).unwrap();
    assert_eq!(robot.losses.losses.len(), 2);
}

#[test]
fn each_cause_has_one_message_with_its_place_and_what_to_do() {
    let cases = [
        (
            "robot/1",
            "robot/2",
            "1:10: unknown format `cotama-robot/2`",
            "this program reads `format = \"cotama-robot/1\"` here",
        ),
        (
            "name = \"scout\"",
            "name = \"a b\"",
            "2:8: `a b` is not an id",
            "use 1 to 64 ASCII letters, digits, `-`, `_` and `.`",
        ),
        (
            "[hardware.base]",
            "[hardware.base]\nunits = 0",
            "4:9: `units` must be 1 to 255, not `0`",
            "change the value",
        ),
        (
            "[hardware.base]",
            "[hardware.base]\nweight = 3",
            "4:1: unknown key `weight` in `base`",
            "known keys here: title, units, power_mw, kind, source",
        ),
        (
            "[hardware.radio]",
            "[hardware.radio]\n[hardware.drive]",
            "7:9: `drive` names hardware and a module",
            "give each a name of its own",
        ),
        (
            "[module.drive]\nhardware = [\"base\"]",
            "[module.drive]\nhardware = [\"bse\"]",
            "7:13: unknown hardware `bse`; did you mean `base`?",
            "write `base`",
        ),
        (
            "[module.drive]\nhardware = [\"base\"]",
            "[module.drive]",
            "6:9: `drive` stands on no hardware",
            "say in `hardware`, here or in what it needs, on what it runs",
        ),
        (
            "[module.drive]",
            "[module.drive]\nneeds = [\"scan\"]",
            "6:9: `drive` needs itself, through what it needs",
            "leave one of the needs out",
        ),
        (
            "[module.drive]",
            "[module.drive]\none_of = [\"nothing\"]",
            "7:11: unknown module `nothing`",
            "known: drive, scan, link",
        ),
        (
            "[module.drive]",
            "[module.drive]\ncost_us = 5",
            "6:1: a deadline and a cost are those of a module that runs in a period",
            "add `period_ms`, or leave both out",
        ),
        (
            "[module.drive]",
            "[module.drive]\nperiod_ms = 0",
            "7:13: `period_ms` must be 1 to 3600000, not `0`",
            "change the value",
        ),
        (
            "[observer.eye]\nneeds = [\"drive\"]",
            "[observer.eye]\nneeds = [\"scan\"]",
            "35:6: `LID1` takes what each observer needs that would see it",
            "let an observer see it that does not need what is lost",
        ),
        (
            "[\"late\", \"silent\", \"stuck\"]",
            "[\"late\", \"late\", \"stuck\"]",
            "15:18: the flag `late` is there twice, or has no name",
            "one observer raises a flag",
        ),
        (
            "[\"late\", \"silent\", \"stuck\"]",
            "[\"late\", \"silent\", \"odd\", \"stuck\"]",
            "15:28: no failure raises the flag `odd`",
            "name it in `flags` of a failure, or leave it out",
        ),
        (
            "[operator]\nneeds = [\"link\"]\n",
            "",
            "28:8: the operator decides in `Manual`, but is not reached",
            "say in `[operator]` which modules he is reached by: `needs = [\"lan\"]`",
        ),
        (
            "[operator]\nneeds = [\"link\"]",
            "[operator]\nneeds = []",
            "17:9: `needs` is empty",
            "give at least one entry",
        ),
        (
            "name = \"Blind\"",
            "name = \"Careful\"",
            "25:8: the supervisors have another `Careful`",
            "choose another name",
        ),
        (
            "name = \"Blind\"",
            "name = \"3D\"",
            "25:8: `3D` does not begin with a letter",
            "choose another name",
        ),
        (
            "name = \"Blind\"",
            "name = \"Loop\"",
            "25:8: `Loop` is a word of Rust",
            "choose another name",
        ),
        (
            "id = \"LNK1\"",
            "id = \"refusal\"",
            "42:6: the supervisors have another `refusal`",
            "choose another name",
        ),
        (
            "name = \"Blind\"",
            "name = \"gom\"",
            "25:8: the supervisors have another `gom`",
            "choose another name",
        ),
        (
            "name = \"Blind\"",
            "name = \"Blind\"\nrank = 0",
            "27:17: two configurations of `Follow` have the rank 0",
            "0 is the best; give each a rank of its own",
        ),
        (
            "required = [\"scan\"]",
            "required = [\"scam\"]",
            "22:13: unknown module `scam`; did you mean `scan`?",
            "write `scan`",
        ),
        (
            "required = [\"scan\"]",
            "required = []",
            "22:12: `required` is empty",
            "give at least one entry",
        ),
        (
            "mode = \"operator\"",
            "mode = \"manual\"",
            "32:8: unknown mode `manual`",
            "known: autonomous, operator",
        ),
        (
            "sub_objective = \"Manual\"",
            "sub_objective = \"Follow\"",
            "31:17: `Follow` is served in two modes",
            "give the sub-objective of the operator a name of its own",
        ),
        (
            "required = [\"drive\"]",
            "required = [\"drive\", \"scan\"]",
            "25:8: `Blind` never runs: whatever is lost, a better one runs, or it cannot either",
            "let a failure lose what the better ones need, or change the ranks",
        ),
        (
            "speed_mm_s = 500",
            "speed_mm_s = -1",
            "23:14: `speed_mm_s` must be 0 to 10000, not `-1`",
            "change the value",
        ),
        (
            "id = \"LNK1\"",
            "id = \"LID1\"",
            "42:6: two failures are called `LID1`",
            "give each a short name of its own",
        ),
        (
            "severity = { autonomous = \"medium\" }",
            "severity = { autonomous = \"medim\" }",
            "37:27: unknown severity `medim`; did you mean `medium`?",
            "write `medium`",
        ),
        (
            "severity = { autonomous = \"medium\" }",
            "severity = \"medium\"",
            "37:12: `severity` must be a table, not a string",
            "change the value",
        ),
        (
            "flags = [\"late\"]",
            "flags = [\"lte\"]",
            "38:10: unknown flag `lte`; did you mean `late`?",
            "write `late`",
        ),
        ("flags = [\"late\"]", "flags = []", "38:9: `flags` is empty", "give at least one entry"),
        (
            "flags = [\"late\"]",
            "flags = [\"late\"]\nunseen = \"it is dark\"",
            "39:10: a failure that flags show is seen",
            "leave out `unseen` or `flags`",
        ),
        (
            "flags = [\"late\"]",
            "flags = [\"late\"]\npersistence = \"often\"",
            "39:15: unknown persistence `often`",
            "known: permanent, intermittent, transient",
        ),
        (
            "flags = [\"late\"]",
            "flags = [\"late\"]\neach = [\"lidar\"]",
            "39:9: unknown module `lidar`",
            "known: drive, scan, link",
        ),
        (
            "flags = [\"late\"]",
            "flags = [\"late\"]\nrestart = { module = \"scan\", times = 0 }",
            "39:38: `times` must be 1 to 9, not `0`",
            "change the value",
        ),
        (
            "loses = [\"lidar\"]",
            "loses = [\"lider\"]",
            "39:10: unknown hardware or module `lider`; did you mean `lidar`?",
            "write `lidar`",
        ),
        (
            "flags = [\"late\"]",
            "flags = [\"late\"]\nrestart = { module = \"link\", times = 1 }",
            "35:6: `LID1` starts `link` anew, which works without what it loses",
            "start a module that needs what is lost, or leave `restart` out",
        ),
        (
            "loses = [\"lidar\"]",
            "loses = [\"lidar\"]\nmotion = \"runaway\"",
            "40:10: a motor that runs away is stopped by a halt alone, and this is not fatal",
            "call it `fatal` in both modes, or name another motion",
        ),
        (
            "loses = [\"lidar\"]",
            "loses = [\"lidar\"]\nmotion = \"runs\"",
            "40:10: unknown effect on motion `runs`",
            "known: blocked, runaway, dead, silent, mindless",
        ),
        (
            "loses = [\"lidar\"]",
            "loses = [\"lidar\"]\nmotion = \"dead\"\nslowed_permille = 500",
            "40:10: a failure has one effect on motion",
            "leave one of them out",
        ),
        (
            "mean_hours = 400",
            "mean_hours = 0",
            "40:14: `0` is no mean time in hours",
            "write a positive number with three decimals at most",
        ),
        (
            "mean_hours = 400",
            "mean_hours = 0.00001",
            "40:14: `0.00001` is no mean time in hours",
            "write a positive number with three decimals at most",
        ),
    ];
    for (from, to, message, help) in cases {
        assert_eq!(refused(from, to), format!("r.toml:{message} | help: {help}"));
    }
}

#[test]
fn keys_that_missions_need_are_read_as_strictly() {
    let body = |rest: &str| {
        format!("[body]\nspeed_max_mm_s = 9\nacceleration_mm_s2 = 9\n{rest}\n[hardware.base]")
    };
    let power = "motion_power = { c0 = 1, c1 = 1, c2 = 0 }";
    let (hardware, speed, loses) = ("[hardware.base]", "speed_mm_s = 500", "loses = [\"lidar\"]");
    let change = "change the value";
    let cases = [
        (
            hardware,
            format!("{hardware}\npower_mw = -1"),
            "4:12: `power_mw` must be 0 to 10000000, not `-1`",
            change,
        ),
        (
            hardware,
            format!("{hardware}\nunits = 0"),
            "4:9: `units` must be 1 to 255, not `0`",
            change,
        ),
        (
            hardware,
            body(power).replace("s = 9", "s = 0"),
            "4:18: `speed_max_mm_s` must be 1 to 10000, not `0`",
            change,
        ),
        (
            hardware,
            body("motion_power = { c0 = 1, c1 = 1 }"),
            "6:16: missing key `c2` in `motion_power`",
            "add `c2`",
        ),
        (
            hardware,
            body(&format!("impact_energy_max_mj = 3\n{power}")),
            "6:24: the energy of an impact is that of a mass",
            "add `mass_g`, or leave `impact_energy_max_mj` out",
        ),
        (
            hardware,
            body(&format!("period_ms = 5\n{power}")),
            "6:13: `period_ms` must be 10 to 1000, not `5`",
            change,
        ),
        (
            speed,
            "speed_mm_s = 20000".into(),
            "23:14: `speed_mm_s` must be 0 to 10000, not `20000`",
            change,
        ),
        (speed, "takes_ms = 0".into(), "23:12: `takes_ms` must be 1 to 3600000, not `0`", change),
        (speed, "rank = 256".into(), "23:8: `rank` must be 0 to 255, not `256`", change),
        (
            loses,
            format!("{loses}\nslowed_permille = 1000"),
            "40:19: `slowed_permille` must be 1 to 999, not `1000`",
            change,
        ),
        (
            loses,
            format!("{loses}\nends_ms = 0"),
            "40:11: `ends_ms` must be 1 to 3600000, not `0`",
            change,
        ),
        (
            loses,
            format!("{loses}\nhelped = 1"),
            "40:10: `helped` must be `true` or `false`, not an integer",
            change,
        ),
        (
            loses,
            format!("{loses}\nno_plan = true"),
            "40:11: the planner tells this, no flag",
            "leave out `no_plan` or `flags`",
        ),
        (
            loses,
            format!("{loses}\npersistence = \"long\""),
            "40:15: unknown persistence `long`",
            "known: permanent, intermittent, transient",
        ),
        (
            "[operator]",
            "[supervisors]\nlocal = 3\n[operator]".into(),
            "17:9: `local` must be a string, not an integer",
            change,
        ),
        (
            "[operator]",
            "[supervisors]\n[operator]".into(),
            "16:1: missing key `local` in `supervisors`",
            "add `local`",
        ),
        (
            "[operator]",
            "[supervisors]\nlocal = \"x\"\n[operator]".into(),
            "17:9: no other file is read here",
            "`cotama export ROBOT --net ls --format json` writes one",
        ),
    ];
    for (from, to, message, help) in cases {
        assert_eq!(refused(from, &to), format!("r.toml:{message} | help: {help}"));
    }
}
