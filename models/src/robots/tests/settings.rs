//! Settings of modules, and times that cannot be kept: each cause of refusal once.

use super::broken::{FILE, refused};
use crate::robots::Robot;

#[test]
fn settings_and_times_that_make_no_sense_are_refused() {
    let change = "change the value";
    let loses = "loses = [\"lidar\"]";
    let scan = "[module.scan]";
    let particles = "[module.drive.parameter.n]\ndefault = 5\nleast = 2\nmost = 9\n[module.scan]";
    let cases = [
        (
            loses,
            format!("{loses}\nset = {{ holds_ms = 3 }}"),
            "40:7: this sets nothing",
            "say which values change, or how much of the speed is left",
        ),
        (
            loses,
            format!("{loses}\nset = {{ speed_permille = 0 }}"),
            "40:26: `speed_permille` must be 1 to 999, not `0`",
            change,
        ),
        (
            loses,
            format!("{loses}\nset = {{ values = {{ \"drive.n\" = 3 }} }}"),
            "40:20: unknown parameter `drive.n`",
            "none is defined",
        ),
        (
            loses,
            format!("{loses}\nset = {{ speed_permille = 9, mode = \"both\" }}"),
            "40:36: unknown mode `both`",
            "known: autonomous, operator",
        ),
        (
            loses,
            format!("{loses}\nrestart = {{ times = 1 }}"),
            "40:11: missing key `module` in `restart`",
            "add `module`",
        ),
        (
            scan,
            particles.replace("default = 5", "default = 1"),
            "9:11: 1 is not from 2 to 9",
            "give `least` and `most` with `default` between them",
        ),
        (
            scan,
            "priority = 256\n[module.scan]".into(),
            "8:12: `priority` must be 0 to 255, not `256`",
            change,
        ),
        (
            scan,
            "period_ms = 10\ncost_us = 10_001\n[module.scan]".into(),
            "21:8: `Careful` is not in time: `drive`: its cost, 10001 us, is above deadline and \
             extra time, 10000 us; no job would ever be done",
            "lower a cost or a parameter, or lengthen a period or a deadline",
        ),
        (
            scan,
            "period_ms = 10\ncost_us = 6_000\n[module.scan]\nperiod_ms = 20\ncost_us = 9_000"
                .into(),
            "23:8: `Careful` is not in time: `scan` may take 21000 us, and has 20000 us",
            "lower a cost or a parameter, or lengthen a period or a deadline",
        ),
        (
            "severity = { autonomous = \"weak\", operator = \"fatal\" }",
            "severity = { autonomous = \"fatal\" }\nset = { speed_permille = 9 }".into(),
            "42:6: `LNK1` ends the mission, and sets something",
            "leave `set` out, or say with `times` how often it is tried first",
        ),
    ];
    for (from, to, message, help) in cases {
        assert_eq!(refused(from, &to), format!("r.toml:{message} | help: {help}"));
    }
    let beyond = FILE.replace(scan, particles);
    let beyond =
        beyond.replace(loses, &format!("{loses}\nset = {{ values = {{ \"drive.n\" = 1 }} }}"));
    let errors = Robot::parse("r.toml", &beyond).unwrap_err().to_string();
    assert!(errors.starts_with("r.toml:44:20: 1 is no value of `drive.n`: 2 to 9"), "{errors}");
}
