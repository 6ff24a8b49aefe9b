//! Missions whose speeds and limits follow from axes: what they come to, and what is said of broken
//! ones; the messages are in `tests/golden/axed.txt`.
#![cfg(feature = "std")]
#![allow(clippy::unwrap_used, clippy::format_push_string)]

use cotama_models::missions::known::NO_LIMIT;
use cotama_models::missions::{FORMAT_3, Grows, Mission, NotUpgraded, embedded};

/// The delivery with its limits as constraints, and a sum of its own: the battery of the laptop.
fn delivery() -> String {
    let known = embedded::mission("delivery").unwrap();
    let mission = Mission::parse(known.name, known.text).unwrap();
    let laptop = r#"ask = [["min", "energy.total"]]
[[axis]]
id = "laptop"
[[axis.indicator]]
id = "total"
unit = "mJ"
combine = "sum"
travel = { form = "power_times_time", power = ["laptop.idle_mw", "option(laptop_mw)"] }
stand = { form = "power_times_time", power = ["laptop.idle_mw"] }
[[constraint]]
id = "laptop"
indicator = "laptop.total"
kind = "end"
op = "<="
goal = 9000000
[laptop]
idle_mw = 9000
[configuration."PF.OPT"]
laptop_mw = 14000
[configuration."PF.DEG"]
laptop_mw = 5000
"#;
    let text = mission.upgraded().unwrap();
    let (head, rest) = text.split_once("[[axis]]").unwrap();
    let (wishes, axis) = laptop.split_once('\n').unwrap();
    let (_, run) = rest.split_once("\n[[tio]]").unwrap();
    let sums = rest.split_once("\n[[tio]]").unwrap().0;
    format!("{head}{wishes}\n[[axis]]{sums}\n{axis}\n[[tio]]{run}")
}

fn parsed(text: &str) -> Mission {
    Mission::parse("axed.toml", text).unwrap()
}

#[test]
fn sums_beyond_duration_and_energy_grow_with_time_or_with_the_way() {
    let mission = parsed(&delivery());
    let grows: Vec<_> = mission.scenario().ends.iter().map(|it| it.grows).collect();
    assert_eq!(grows, [Grows::Counted(0), Grows::Counted(1), Grows::WithTime]);
    assert_eq!(mission.limits, [900_000, 7_200_000]);
    // 9 W and 14 W for 40 m at 0.3 m/s.
    let drive = &mission.scenario().activities[0];
    let full = drive.labels.iter().position(|it| it == "PF.OPT").unwrap();
    let laptop = mission.case().unwrap().mission.indicator("laptop.total").unwrap();
    assert_eq!(drive.derived[full].value(laptop), 3_066_659);
}

#[test]
fn an_axis_without_a_limit_is_none_to_plan_within() {
    let text = delivery();
    let (before, after) = text.split_once("[[constraint]]\nid = \"energy\"").unwrap();
    let (_, after) = after.split_once("7200000").unwrap();
    let free = parsed(&format!("{before}{}", after.split_once('\n').unwrap().1));
    assert_eq!(free.limits, [900_000, NO_LIMIT]);
    let errors = free.with_limits([None, Some(1)]).unwrap_err().to_string();
    assert!(errors.contains("no end constraint of this mission limits its energy"), "{errors}");
    let short = free.with_limits([Some(800_000), None]).unwrap();
    assert_eq!(short.limits, [800_000, NO_LIMIT]);
}

#[test]
fn a_mission_that_has_axes_is_not_upgraded_again() {
    let again = parsed(&delivery()).upgraded();
    assert_eq!(again, Err(NotUpgraded::AlreadyDone));
    let patrol = embedded::mission("patrol").unwrap();
    let inline = "limits = { order = [\"duration\", \"energy\"], duration_ms = 600000, energy_mj = \
                  8640000 }\n";
    let (head, tail) = patrol.text.split_once("[limits]").unwrap();
    let tail = tail.split_once("[rounding]").unwrap().1;
    let (format, rest) = head.split_once("name =").unwrap();
    let text = format!("{format}{inline}name ={rest}[rounding]{tail}");
    let upgraded = Mission::parse("inline.toml", &text).unwrap().upgraded();
    assert_eq!(upgraded, Err(NotUpgraded::Written));
}

#[test]
fn broken_missions_with_axes_are_refused_at_their_places() {
    let text = delivery();
    let patrol = cotama_axes::PATROL.replace("cotama-axes/1", FORMAT_3);
    let patrol = patrol.split_once("\n[run]\n").unwrap().0;
    let cases: &[(&str, &str, &str)] = &[
        (
            &text,
            "[[constraint]]\nid = \"duration\"",
            "[limits]\nduration_ms = 1\n[[constraint]]\nid = \"duration\"",
        ),
        (&text, "ask = [[\"min\", \"energy.total\"]]", ""),
        (&text, "ask = [[\"min\"", "ask = [[\"least\""),
        (&text, "name = \"delivery\"", "name = \"delivery\"\nplan.objective = \"quality\""),
        (&text, "configuration.\"PF.OPT\"", "configuration.\"PF.OPD\""),
        (&text, "laptop_mw = 14000", "laptop_m = 14000"),
        (&text, "laptop_mw = 14000", "laptop_mw = 14.5"),
        (&text, "\"option(laptop_mw)\"", "\"option(laptop_ma)\""),
        (&text, "laptop.idle_mw\"]", "laptop.idle_ms\"]"),
        (&text, "goal = 9000000", "goal = \"9 Wh\""),
        (&text, "indicator = \"laptop.total\"", "indicator = \"laptop.all\""),
        (
            &text,
            "kind = \"end\"\nop = \"<=\"\ngoal = 9000000",
            "kind = \"running\"\nop = \"<=\"\ngoal = 9000000",
        ),
        (&text, "op = \"<=\"\ngoal = 9000000", "op = \"=\"\ngoal = 9000000"),
        (&text, "form = \"length_over_speed\"", "form = \"length_by_speed\""),
        (&text, "x_end_mm = 40000", "x_end_mm = 50000"),
        (&text, "[[axis]]\nid = \"laptop\"", "[[axes]]\nid = \"laptop\""),
        (patrol, "speed_step_mm_s = 10", "speed_step_mm_s = 0"),
        (patrol, "blind = [\"laser\"]", "blind = [\"lazer\"]"),
        (patrol, "width_mm = 1700", "widht_mm = 1700"),
        (patrol, "width_mm = 1700", "width_mm = 400"),
        (patrol, "stand_ms = 8000", "stand_ms = -1"),
        (patrol, "units = 2", "units = \"two\""),
        (patrol, "zone_min(width_mm)", "zone_min(breadth_mm)"),
        (patrol, "mass_g = 25000", "mass_g = 250000000"),
    ];
    let mut said = String::new();
    for (text, old, new) in cases {
        assert!(text.contains(old), "{old}");
        let errors = Mission::parse("axed.toml", &text.replacen(old, new, 1)).err();
        let errors = errors.unwrap_or_else(|| panic!("{new} is accepted"));
        said += &format!("--- {} => {}\n{errors}\n", old.escape_debug(), new.escape_debug());
    }
    cotama_golden::compare("tests/golden/axed.txt", &said);
}
