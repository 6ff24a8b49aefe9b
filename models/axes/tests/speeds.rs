//! Reasons of the patrol's speeds: constraints and inducers that bind, and how far each number may
//! move until Table 5 changes.

use super::patrol::SPEEDS;
use super::small::WALK;
use super::{lifted, table};
use cotama_axes::raise::raises;
use cotama_axes::why::why;
use cotama_axes::{Activity, Case, Lifted, PATROL, Steps, label, speed_alone};
use std::collections::BTreeSet;

/// The speed of an activity with M5 and another option, the constraints that bind, and what each
/// printed core constraint allows alone, in mm/s: 3000 stands for all.
fn speed(activity: usize, with: &str) -> (i64, Vec<&'static str>, [i64; 3]) {
    let names = ["harmless", "avoidance", "frames"];
    let case = Case::parse(PATROL).unwrap();
    let mission = &case.mission;
    let table = table(&case, lifted(&case, &["cpu", "error"]));
    let activity = &table.activities[activity - 1];
    let wanted = format!("M5 {with}");
    let mut all = activity.candidates.iter();
    let it = all.find(|it| label(mission, &it.options) == wanted).unwrap();
    let number = |name: &str| mission.constraint(name).unwrap();
    let binding = names.iter().copied().filter(|name| it.bounded_by.contains(&number(name)));
    let alone = names.map(|name| {
        let steps = &mut Steps::default();
        speed_alone(mission, activity, &it.options, number(name), 3_000, steps).unwrap().unwrap()
    });
    (it.speed_mm_s, binding.collect(), alone)
}

#[test]
fn a_speed_has_a_constraint_that_binds() {
    assert_eq!(speed(1, "L1"), (410, vec!["avoidance"], [565, 411, 3_000]));
    assert_eq!(speed(1, "L2"), (410, vec!["avoidance", "frames"], [565, 411, 419]));
    assert_eq!(speed(2, "L2"), (330, vec!["avoidance"], [565, 337, 419]));
    assert_eq!(speed(9, "L1"), (560, vec!["harmless"], [565, 574, 3_000]));
    assert_eq!(speed(9, "L2"), (410, vec!["frames"], [565, 574, 419]));
    assert_eq!(speed(10, "L2"), (410, vec!["frames"], [565, 574, 419]));
}

#[test]
fn inducers_that_bind_are_named_with_their_source() {
    let case = Case::parse(PATROL).unwrap();
    let table = table(&case, lifted(&case, &["cpu", "error"]));
    let said = |activity: usize, options: &str| {
        let activity = &table.activities[activity - 1];
        let mut all = activity.candidates.iter();
        let it = all.find(|it| label(&case.mission, &it.options) == options).unwrap();
        let bindings = why(&case.mission, activity, it).unwrap();
        let cause = |it: &cotama_axes::why::Cause| format!("{} {} {}", it.name, it.value, it.of);
        let causes = bindings.iter().flat_map(|it| it.inducers.iter().map(cause));
        let values = bindings.iter().map(|it| (it.value, it.value_next, it.goal));
        (values.collect::<Vec<_>>(), causes.collect::<Vec<_>>())
    };
    let (values, causes) = said(9, "M5 L1");
    assert_eq!(values, [(3_920, 4_062, 4_000)]);
    assert_eq!(causes, ["speed_mm_s 570 ", "robot.mass_g 25000 "]);
    let (values, causes) = said(9, "M5 L2");
    assert_eq!(values, [(13_667, 14_000, 14_000)]);
    assert_eq!(causes, ["speed_mm_s 420 ", "option(frames) 1 L2"]);
    // In the glass the sonar's period counts, and the width, not the sensor's range.
    let (values, causes) = said(2, "M5 L1");
    assert_eq!(values, [(11_900, -4_467, 0)]);
    assert_eq!(
        causes,
        [
            "speed_mm_s 340 ",
            "robot.body_radius_mm 250 ",
            "robot.braking_mm_s2 300 ",
            "robot.cycle_ms 100 ",
            "robot.wall_clearance_mm 235 ",
            "zone_min(width_mm) 1700 H1-out",
            "detector(detect_ms) 420 sonar",
        ]
    );
    assert_eq!(said(4, "T1 L1"), (vec![], vec![]));
}

/// Changes of one number after which a constraint allows an activity's candidate the next speed:
/// the number that is needed, and the speed with it.
fn changes(case: &Case, activity: usize, options: &str, constraint: &str) -> Vec<String> {
    let table = table(case, Lifted::default());
    let activity = &table.activities[activity - 1];
    let mut all = activity.candidates.iter();
    let it = all.find(|it| label(&case.mission, &it.options) == options).unwrap();
    let constraint = case.mission.constraint(constraint).unwrap();
    let raises = raises(&case.mission, activity, it, constraint, &mut Steps::default()).unwrap();
    let said = |it: &cotama_axes::raise::Raise| {
        format!("{} {} -> {}: {}", it.name, it.now, it.needed, it.speed_mm_s)
    };
    raises.iter().map(said).collect()
}

#[test]
fn changes_that_raise_a_speed_are_the_nearest() {
    let case = Case::parse(PATROL).unwrap();
    assert_eq!(
        changes(&case, 9, "M3 L1", "harmless"),
        ["robot.mass_g 25000 -> 24616: 570", "goal 4000 -> 4063: 570"]
    );
    assert_eq!(
        changes(&case, 9, "M5 L2", "frames"),
        ["L2.frames 1 -> 0: 560", "goal 14000 -> 14001: 420"]
    );
    // Behind the glass the sonar counts, and the width of the hall.
    assert_eq!(
        changes(&case, 2, "M1 L1", "avoidance"),
        [
            "robot.body_radius_mm 250 -> 245: 340",
            "robot.braking_mm_s2 300 -> 308: 340",
            "robot.cycle_ms 100 -> 86: 340",
            "robot.wall_clearance_mm 235 -> 230: 340",
            "H1-out.width_mm 1700 -> 1710: 340",
            "sonar.detect_ms 420 -> 406: 340",
            "goal 0 -> -4468: 340",
        ]
    );
}

/// The patrol with a number of a part of it changed.
fn with_number(name: &str, constraint: &str, value: i64) -> String {
    let (owner, key) = name.split_once('.').unwrap_or((constraint, name));
    let begins = |part: &str| PATROL.find(part).map(|it| it + part.len());
    let places = [format!("\n[{owner}]\n"), format!("\n[hardware.{owner}]\n")];
    let places = places.into_iter().chain([format!("\nid = \"{owner}\"\n")]);
    let from = places.filter_map(|it| begins(&it)).min().unwrap();
    let number = format!("{key} = ");
    let from = from + PATROL[from..].find(&number).unwrap() + number.len();
    let digits = PATROL[from..].find(|it: char| !it.is_ascii_digit()).unwrap();
    format!("{}{value}{}", &PATROL[..from], &PATROL[from + digits..])
}

/// Each change, written into the file, gives the speed that is said, and a number one nearer to
/// today's does not lift the constraint.
#[test]
fn a_change_written_into_the_file_gives_the_speed_that_is_said() {
    let case = Case::parse(PATROL).unwrap();
    let mission = &case.mission;
    let before = table(&case, Lifted::default());
    let mut tried = BTreeSet::new();
    for (place, activity) in before.activities.iter().enumerate().filter(|it| it.1.travels()) {
        for it in &activity.candidates {
            for &constraint in &it.bounded_by {
                let name = &mission.constraints[constraint].id;
                let raises =
                    raises(mission, activity, it, constraint, &mut Steps::default()).unwrap();
                for raise in raises {
                    let kind = (place, it.speed_mm_s, name.clone(), raise.name.clone());
                    if !tried.insert(kind) {
                        continue;
                    }
                    let after = |value: i64| {
                        let text = with_number(&raise.name, name, value);
                        let case = Case::parse(&text).unwrap();
                        let all = table(&case, Lifted::default()).activities;
                        let mut all = all[place].candidates.clone().into_iter();
                        all.find(|after| after.options == it.options).unwrap()
                    };
                    assert_eq!(after(raise.needed).speed_mm_s, raise.speed_mm_s, "{raise:?}");
                    let nearer = raise.needed + (raise.now - raise.needed).signum();
                    let held = after(nearer);
                    assert!(held.bounded_by.contains(&constraint), "{raise:?}");
                    assert_eq!(held.speed_mm_s, it.speed_mm_s);
                }
            }
        }
    }
    assert_eq!(tried.len(), 74);
}

/// A change may be refused by another constraint, which then removes the candidate.
#[test]
fn a_change_that_another_constraint_removes_gives_no_speed() {
    let more = "[[axis]]\nid = \"warning\"\n[[axis.indicator]]\nid = \"heard\"\nunit = \"dB\"\n\
                combine = \"each\"\ntravel = \"option(noise)\"\n\
                [[constraint]]\nid = \"heard\"\nindicator = \"warning.heard\"\nkind = \"core\"\n\
                op = \">=\"\ngoal = 4\n[[constraint]]\nid = \"quiet\"\n\
                indicator = \"noise.level\"\nkind = \"core\"\nop = \"<=\"\ngoal = 8\n";
    let case = Case::parse(&format!("{WALK}{more}")).unwrap_or_else(|wrongs| panic!("{wrongs}"));
    assert_eq!(changes(&case, 1, "M1", "quiet"), ["M1.noise 4 -> 2: 0", "goal 8 -> 12: 300"]);
}

#[test]
fn two_constraints_that_bind_at_once_must_both_give_way() {
    let case = Case::parse(PATROL).unwrap();
    let frames = changes(&case, 1, "M3 L2", "frames");
    assert_eq!(frames, ["L2.frames 1 -> 0: 410", "goal 14000 -> 14001: 410"]);
    let avoidance = changes(&case, 1, "M3 L2", "avoidance");
    assert!(!avoidance.is_empty() && avoidance.iter().all(|it| it.ends_with(": 410")));
}

/// The patrol of a robot that knows the four printed speeds, with the printed 0.45 m/s of pictures.
fn with_levels() -> String {
    let step = "# inferred: printed speeds have two decimals; limits are rounded down to this\n\
                speed_step_mm_s = 10\n";
    assert!(PATROL.contains(step));
    PATROL
        .replace(step, "speed_levels_mm_s = [330, 410, 560, 760]\n")
        .replace("goal = 14000\n", "goal = 15000\n")
}

/// Whether Table 5's speeds stay when one number of a patrol is another one.
fn stays(patrol: &str, key: &str, now: i64, value: i64) -> bool {
    let now = format!("{key} = {now}");
    let changed = patrol.replace(&format!("{now} "), &format!("{key} = {value} "));
    let changed = changed.replace(&format!("{now}\n"), &format!("{key} = {value}\n"));
    assert!(changed != patrol || now == format!("{key} = {value}"), "{now}");
    let case = Case::parse(&changed).unwrap();
    let table = table(&case, lifted(&case, &["cpu", "error"]));
    let speeds: Vec<_> = table.activities.iter().map(Activity::speed_max_mm_s).collect();
    speeds == SPEEDS
}

/// A number of the patrol: its key, its value, and the least and the most with which Table 5 stays.
type Interval = (&'static str, i64, Option<i64>, Option<i64>);

/// Asserts that one number changed at a time keeps Table 5 from one end to the other, and no
/// further.
fn holds_within(patrol: &str, intervals: &[Interval]) {
    for &(key, now, least, most) in intervals {
        let ends = [(least, -1), (most, 1)];
        for (end, beyond) in ends.into_iter().filter_map(|it| Some((it.0?, it.1))) {
            assert!(end == now || stays(patrol, key, now, end), "{key} {end}");
            assert!(!stays(patrol, key, now, end + beyond), "{key} {}", end + beyond);
        }
        assert!(least.is_some() || stays(patrol, key, now, 1), "{key}");
        assert!(most.is_some() || stays(patrol, key, now, 10 * now), "{key}");
    }
}

#[test]
fn each_number_has_an_interval_in_which_table_5_stays() {
    holds_within(
        PATROL,
        &[
            ("mass_g", 25_000, Some(24_617), Some(25_503)),
            ("speed_max_mm_s", 760, Some(560), None),
            ("braking_mm_s2", 300, Some(297), Some(307)),
            ("body_radius_mm", 250, Some(246), Some(252)),
            ("wall_clearance_mm", 235, Some(231), Some(237)),
            ("cycle_ms", 100, Some(87), Some(106)),
            ("detect_ms", 420, Some(407), Some(456)),
            ("detect_ms", 100, Some(70), Some(106)),
            ("range_mm", 5_000, Some(604), None),
            ("range_mm", 4_000, Some(885), None),
            ("width_mm", 1_700, Some(1_696), Some(1_709)),
            ("width_mm", 2_300, Some(2_240), None),
            ("goal", 4_000, Some(3_921), Some(4_062)),
            ("goal", 14_000, Some(13_668), Some(14_000)),
        ],
    );
}

/// With four levels the printed 0.45 m/s gives Table 5 as well, and every interval is wide.
#[test]
fn four_levels_give_table_5_within_wide_intervals() {
    let patrol = with_levels();
    assert!(stays(&patrol, "mass_g", 25_000, 25_000));
    holds_within(
        &patrol,
        &[
            ("mass_g", 25_000, None, Some(25_503)),
            ("speed_max_mm_s", 760, Some(560), None),
            ("braking_mm_s2", 300, Some(297), Some(553)),
            ("body_radius_mm", 250, Some(122), Some(252)),
            ("wall_clearance_mm", 235, Some(107), Some(237)),
            ("cycle_ms", 100, None, Some(106)),
            ("detect_ms", 420, Some(107), Some(456)),
            ("detect_ms", 100, None, Some(106)),
            ("range_mm", 5_000, Some(604), None),
            ("range_mm", 4_000, Some(885), None),
            ("width_mm", 1_700, Some(1_696), Some(1_957)),
            ("width_mm", 2_300, Some(2_240), None),
            ("goal", 4_000, Some(3_921), None),
            ("goal", 15_000, Some(13_668), Some(18_667)),
        ],
    );
}
