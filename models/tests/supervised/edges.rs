//! Effects of a unit more or less: ends of missions, limits, the order of files.

use crate::file::File;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::missions::faults::{EventKind, Faults};
use cotama_models::missions::infeasible::Relaxation::{self, RaiseLimit, RaiseLimits};
use cotama_models::missions::{Mission, MissionErrors, Unfolded, embedded};
use cotama_models::robots::{Incident, IncidentKind, Moment};

fn delivery_with(edits: &[(&str, &str)]) -> Result<Mission, MissionErrors> {
    let delivery = embedded::mission("delivery").unwrap();
    let edit = |text: String, (old, new): &(&str, &str)| {
        assert!(text.contains(old), "{old}");
        text.replacen(old, new, 1)
    };
    let text = edits.iter().fold(delivery.text.to_owned(), edit);
    Mission::parse("delivery.toml", &text)
}

/// Two events of each kind: at the end of the second drive, and a millimetre behind it.
const LAST_DRIVE: &str = r#"
[[objective]]
id = "DriveC"
does = "drive"
x_start_mm = 80000
x_end_mm = 90000
[run]
event = [
    { x_mm = 80001, kind = "failure", mode = "SON1" },
    { x_mm = 80000, kind = "failure", mode = "RT1" },
    { x_mm = 80001, kind = "obstacle", delay_ms = 1 },
    { x_mm = 80000, kind = "obstacle", delay_ms = 2 },
]
"#;

fn place(incident: &Incident) -> u64 {
    let Moment::Place(x) = incident.when else { unreachable!() };
    x.0
}

#[test]
fn an_event_at_the_end_of_a_shorter_mission_still_happens() {
    let delivery = embedded::mission("delivery").unwrap().text;
    let (mission, _) = delivery.split_once("[run]").unwrap();
    let mission = mission.replacen("path_length_mm = 80000", "path_length_mm = 90000", 1);
    let mission = Mission::parse("longer.toml", &(mission + LAST_DRIVE)).unwrap();
    let places = |mission: &Unfolded| {
        let faults = &mission.run.faults;
        let events: Vec<_> = faults.events.iter().map(|it| it.x.0).collect();
        let incidents: Vec<_> = faults.of_robot.iter().map(place).collect();
        (events, incidents)
    };
    // The file has them in the other order.
    assert_eq!(places(&mission), (vec![80_000, 80_001], vec![80_000, 80_001]));
    let shorter = mission.without_objective(4).unwrap();
    assert_eq!((shorter.path_length.0, shorter.objectives.len()), (80_000, 4));
    assert_eq!(places(&shorter), (vec![80_000], vec![80_000]));
    assert_eq!(mission.without_objective(5), None);
}

#[test]
fn events_at_one_place_keep_the_order_of_the_file() {
    let mission = delivery_with(&[]).unwrap();
    let text = r#"format = "panorama-faults/1"
        event = [
            { x_mm = 9000, kind = "obstacle", delay_ms = 1 },
            { x_mm = 7000, kind = "failure", mode = "SON1" },
            { x_mm = 8000, kind = "obstacle", delay_ms = 2 },
            { x_mm = 6000, kind = "repair", mode = "RT1" },
            { x_mm = 8000, kind = "obstacle", delay_ms = 3 },
            { x_mm = 6000, kind = "failure", mode = "RT1" },
        ]"#;
    let faults = Faults::parse("faults.toml", text, &mission).unwrap();
    let delays = faults.events.iter().map(|it| match it.kind {
        EventKind::Obstacle { delay } => (it.x.0, delay.0),
        _ => unreachable!(),
    });
    assert_eq!(delays.collect::<Vec<_>>(), [(8_000, 2), (8_000, 3), (9_000, 1)]);
    let id = |it: usize| mission.robot().unwrap().robot().failures[it].id.as_str();
    let fails = faults.of_robot.iter().map(|it| match it.kind {
        IncidentKind::Failure { failure, .. } => (place(it), id(failure), true),
        IncidentKind::Repair(failure) => (place(it), id(failure), false),
        IncidentKind::Operator { .. } | IncidentKind::Door { .. } => unreachable!(),
    });
    let expected = [(6_000, "RT1", false), (6_000, "RT1", true), (7_000, "SON1", true)];
    assert_eq!(fails.collect::<Vec<_>>(), expected);
}

#[test]
fn half_a_standing_task_is_refused_even_if_unused() {
    let with = |line: &str| {
        let mut file = File::right(0);
        file.plain();
        file.sections.insert_str(0, &format!("[fixed]\n{line}\n\n"));
        let said = Mission::parse("plain.toml", &file.to_string()).map_err(|it| it.to_string());
        said.err().unwrap_or_default()
    };
    let lacks = |key: &str| {
        let help = format!("help: add `{key}`");
        format!("plain.toml:8:1: missing key `{key}` in `fixed`\n  {help}")
    };
    assert_eq!(with(""), "");
    assert_eq!(with("turn_ms = 1"), lacks("turn_power_mw"));
    assert_eq!(with("turn_power_mw = 5"), lacks("turn_ms"));
    assert_eq!(with("detect_ms = 1"), lacks("detect_power_mw"));
    assert_eq!(with("detect_power_mw = { }"), lacks("detect_ms"));
}

#[test]
fn moments_are_sorted_by_place_then_time_then_state() {
    let mission = delivery_with(&[]).unwrap();
    let text = r#"format = "panorama-faults/1"
        event = [
            { during = "Waits", after_ms = 8, kind = "failure", mode = "RT1" },
            { during = "Teleprogramming", after_ms = 1, kind = "failure", mode = "RT1" },
            { during = "Following", after_ms = 2, kind = "failure", mode = "RT1" },
            { during = "Planning", after_ms = 4, kind = "failure", mode = "RT1" },
            { during = "Planning", kind = "failure", mode = "RT1" },
            { t_ms = 6, kind = "failure", mode = "RT1" },
            { t_ms = 5, kind = "failure", mode = "RT1" },
            { x_mm = 7, kind = "failure", mode = "RT1" },
        ]"#;
    let faults = Faults::parse("faults.toml", text, &mission).unwrap();
    let said: Vec<_> = faults.of_robot.iter().map(|it| it.when).collect();
    let sub_objectives = &mission.robot().unwrap().robot().sub_objectives;
    let during = |name: &str, after| {
        Moment::During(sub_objectives.iter().position(|it| it.name == name).unwrap(), Millis(after))
    };
    assert_eq!(
        said,
        [
            Moment::Place(Millimetres(7)),
            Moment::At(Millis(5)),
            Moment::At(Millis(6)),
            during("Planning", 0),
            during("Planning", 4),
            during("Following", 2),
            during("Teleprogramming", 1),
            Moment::Waiting(Millis(8)),
        ]
    );
}

#[test]
fn a_moment_is_given_once_and_names_a_sub_objective_of_the_robot() {
    let mission = delivery_with(&[]).unwrap();
    let said = |event: &str| {
        let text = format!("format = \"panorama-faults/1\"\n[[event]]\n{event}\n");
        let text = format!("{text}kind = \"failure\"\nmode = \"RT1\"\n");
        Faults::parse("faults.toml", &text, &mission).unwrap_err().to_string()
    };
    assert_eq!(
        said("during = \"Folowing\""),
        "faults.toml:3:10: unknown sub-objective `Folowing`; did you mean `Following`?\n  \
         help: write `Following`"
    );
    let several = "faults.toml:2:1: one of `x_mm`, `t_ms` and `during` says when, not several\n  \
                   help: leave out all but one";
    assert_eq!(said("during = \"Planning\"\nt_ms = 3"), several);
    assert_eq!(said("x_mm = 3\nduring = \"Waits\""), several);
    assert_eq!(said("t_ms = 3\nx_mm = 3"), several);
    let until = several.replace(
        "`x_mm`, `t_ms` and `during`",
        "`until_x_mm`, `until_t_ms` and \
                                `until_during`",
    );
    assert_eq!(said("x_mm = 3\nuntil_x_mm = 3\nuntil_t_ms = 3"), until);
    // What is counted from a sub-objective needs one.
    let unknown = said("t_ms = 3\nafter_ms = 3");
    assert!(
        unknown.starts_with("faults.toml:4:1: unknown key `after_ms` in this `event`"),
        "{unknown}"
    );
}

#[test]
fn repairs_and_answers_happen_at_places_alone() {
    let mission = delivery_with(&[]).unwrap();
    let read = |event: &str| {
        let text = format!("format = \"panorama-faults/1\"\n[[event]]\n{event}\n");
        Faults::parse("faults.toml", &text, &mission).map_err(|it| it.to_string())
    };
    let refused = "faults.toml:2:1: this happens at a place\n  help: write `x_mm`";
    let kinds = [
        "kind = \"repair\"\nmode = \"RT1\"",
        "kind = \"operator\"\nanswers = [\"give_up\"]\ndelay_ms = 1",
    ];
    for kind in kinds {
        for when in ["t_ms = 1", "during = \"Following\"", "during = \"Waits\""] {
            assert_eq!(read(&format!("{when}\n{kind}")).unwrap_err(), refused, "{kind}");
        }
        assert!(read(&format!("x_mm = 1\n{kind}")).is_ok(), "{kind}");
    }
}

/// A limit that no plan keeps is no error of the file, as without supervisors: who plans says so.
#[test]
fn a_limit_that_no_plan_keeps_is_read() {
    for limit in [1, 1_000, 133_332, 133_333, 899_999] {
        let duration = format!("duration_ms = {limit}");
        assert!(delivery_with(&[("duration_ms = 900000", &duration)]).is_ok(), "{limit} ms");
    }
    for limit in [1, 1_000, 138_000, 1_029_330, 1_029_331] {
        let energy = format!("energy_mj = {limit}");
        assert!(delivery_with(&[("energy_mj = 7200000", &energy)]).is_ok(), "{limit} mJ");
    }
}

#[test]
fn all_units_of_a_hardware_may_fail_at_the_end_of_the_path_and_no_more_or_further() {
    let patrol = embedded::mission("patrol").unwrap();
    let mission = Mission::parse(patrol.name, patrol.text).unwrap();
    let read = |x_mm: u64, units: u64| {
        let event = format!(
            "{{ x_mm = {x_mm}, kind = \"fault\", hardware = \"laser\", units_lost = {units} }}"
        );
        let text = format!("format = \"panorama-faults/1\"\nevent = [{event}]");
        Faults::parse("faults.toml", &text, &mission).map_err(|it| it.to_string())
    };
    let kind = EventKind::Fault { hardware: 1, units: 2 };
    assert_eq!(read(187_000, 2).unwrap().events[0].kind, kind);
    let said = read(187_000, 3).unwrap_err();
    assert!(said.contains("`units_lost` is 3, but the robot has only 2 of `laser`"), "{said}");
    let said = read(187_001, 2).unwrap_err();
    assert!(said.contains("lies behind the end of the path, 187000 mm"), "{said}");
}

#[test]
fn raised_limits_are_ordered_by_the_larger_part_that_they_add() {
    let raise = |axis, from, to| RaiseLimit { axis, from, to };
    let both = |from, to| RaiseLimits { from, to };
    let ordered = [
        raise(1, 1_000, 1_099), // 9.9 %
        raise(0, 10, 11),       // 10 %
        raise(0, 1_000, 1_100),
        raise(1, 10, 11),
        raise(1, 1_000, 1_100),
        both([1_000, 10], [1_001, 11]),
        both([1_000, 10], [1_100, 11]),
        both([10, 1_000], [12, 1_001]), // 20 %
        both([1_000, 10], [1_001, 13]), // 30 %
        raise(0, 2, 3),                 // 50 %
        raise(0, 0, 1),                 // of nothing: more than any
        raise(1, 0, 1),
        raise(0, 0, 2),
    ];
    let mut mixed = ordered.to_vec();
    mixed.reverse();
    mixed.sort_by(Relaxation::by_size);
    assert_eq!(mixed, ordered);
    // Products of large numbers are compared, too.
    let half = u64::MAX / 2;
    assert!(raise(0, half, u64::MAX - 1).by_size(&raise(0, half, u64::MAX)).is_lt());
}
