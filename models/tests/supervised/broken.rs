//! A thousand generated mission files, each accepted, and refused when it is broken, for the reason
//! for which it is.

use crate::file::{File, Objective, failure, operator};
use cotama_models::missions::{MAX_SUPERVISED_OBJECTIVES, Mission};
use std::fmt::Write;

/// A way to break a mission: its name, what the message about it says, and what it does.
type Breaking = (&'static str, &'static str, fn(&mut File));

const BREAKINGS: [Breaking; 38] = [
    ("nothing on board", "but no object is on board there", |file| {
        file.objectives.remove(file.first("receive"));
    }),
    ("a second object", "is still on board", |file| {
        let at = file.first("receive");
        let again = Objective { id: "again".into(), ..file.objectives[at].clone() };
        file.objectives.insert(at + 1, again);
    }),
    ("never delivered", "is never delivered", |file| {
        file.objectives.remove(file.last("deliver"));
    }),
    ("ends with waiting", "which waits for nothing", |file| {
        file.objectives.push(Objective::new("end", "wait", file.path_length, file.path_length));
    }),
    ("a drive to nowhere", "this drive leads nowhere", |file| {
        let at = file.first("drive");
        file.objectives[at].end = file.objectives[at].start;
    }),
    ("a drive back", "this drive leads back", |file| {
        let at = file.first("drive");
        file.objectives[at].start = file.objectives[at].end + 500;
    }),
    ("a gap", "a gap of 500 mm", |file| {
        let at = file.last("drive");
        file.objectives[at].start += 500;
    }),
    ("starts elsewhere", "but the robot is at", |file| {
        let at = file.last("drive");
        file.objectives[at].start -= 500;
    }),
    ("ends elsewhere", "but the path at", |file| file.path_length += 1),
    ("stands and travels", "only one that drives travels", |file| {
        let at = file.first("receive");
        file.objectives[at].end += 500;
    }),
    ("another task", "an objective that does `receive` needs `RCV`", |file| {
        let at = file.first("receive");
        file.objectives[at].task = "DLV".into();
    }),
    ("a drive that stands", "an objective that does `drive` needs `MOV`", |file| {
        let at = file.first("drive");
        file.objectives[at].task = "WAI".into();
    }),
    ("a reserved name", "has a place `Safe` of its own", |file| {
        file.objectives[0].id = "Safe".into();
    }),
    ("a name twice", "is defined twice", |file| {
        file.objectives[0].id = file.objectives[1].id.clone();
    }),
    ("an unknown kind", "unknown kind of objective `drvie`; did you mean `drive`?", |file| {
        let at = file.first("drive");
        file.objectives[at].does = Some("drvie".into());
    }),
    ("no kind", "missing key `does`", |file| file.objectives[0].does = None),
    ("too many objectives", "at most 250 objectives", |file| {
        file.lengthen(MAX_SUPERVISED_OBJECTIVES + 1);
    }),
    ("not supervised", "`does` is for missions that are supervised", |file| {
        file.supervision.clear();
    }),
    ("a failure of a plain mission", "events of the kind `failure` are for missions", |file| {
        file.supervision.clear();
        file.events = failure(0, "RT1");
    }),
    ("unknown supervision", "unknown supervision `cotema`; did you mean `cotama`?", |file| {
        file.supervision = "[supervision]\ndecides = \"cotema\"\n".into();
    }),
    ("no supervision named", "missing key `decides`", |file| {
        file.supervision = "[supervision]\n".into();
    }),
    ("recovery of no kind", "`recovery` must be `true` or `false`, not", |file| {
        file.supervision = "[supervision]\ndecides = \"cotama\"\nrecovery = 1\n".into();
    }),
    ("a repair of a plain mission", "events of the kind `repair` are for missions", |file| {
        file.supervision.clear();
        file.events = failure(0, "RT1").replace("failure", "repair");
    }),
    ("an unknown configuration", "unknown configuration `TO.DEG`", |file| {
        file.options[0].configuration = Some("TO.DEG".into());
    }),
    ("no configuration", "missing key `configuration`", |file| {
        file.options[0].configuration = None;
    }),
    ("a standing configuration", "unknown key `configuration`", |file| {
        file.options.last_mut().unwrap().configuration = Some("PF.OPT".into());
    }),
    (
        "a module that the robot lacks",
        "runs the module SMZ, which the robot does not have",
        |file| {
            file.without_module("SMZ");
        },
    ),
    ("a module that is not needed", "but the option does not need it", |file| {
        file.options[0].needs.retain(|it| it != "MCL");
    }),
    (
        "a drive that could block",
        "could block at 0 mm: without SIM or UST or MCL or SMZ none of its options is left",
        |file| {
            file.options.retain(|it| it.task != "MOV" || it.id == "PF.OPT");
            (file.events, file.zones) = (String::new(), String::new());
            file.without_module("CAM");
        },
    ),
    ("a zone that could block", " or UST or ", |file| {
        let end = file.path_length;
        file.zones = format!(
            "[[zone]]\nid = \"z\"\nx_start_mm = 0\nx_end_mm = {end}\nrequire_hardware = \"UST\"\n"
        );
        file.events.clear();
        file.without_module("LAN");
    }),
    ("a standing that could block", "without GUI none of its options is left (over)", |file| {
        let option = file.options.iter_mut().find(|it| it.id == "over").unwrap();
        option.needs.push("GUI".into());
    }),
    ("a zone without an option", "is left without alternatives", |file| {
        let end = file.path_length;
        file.zones = format!(
            "[[zone]]\nid = \"z\"\nx_start_mm = 0\nx_end_mm = {end}\nrequire_tio = \"in\"\n"
        );
    }),
    ("no option for a task", "no option implements the task `DLV`", |file| {
        file.options.retain(|it| it.task != "DLV");
    }),
    ("standing without a time", "missing key `duration_ms`", |file| {
        file.options.last_mut().unwrap().more = "power_mw = 1\n".into();
    }),
    ("an unknown failure", "unknown failure mode `RT9`", |file| file.events = failure(0, "RT9")),
    ("answers in the wrong order", "after a request the operator cannot answer `path`", |file| {
        file.events = operator(0, "\"path\"");
    }),
    ("answers without an end", "the robot would wait for ever", |file| {
        file.events = operator(0, "\"teleoperate\", \"teleprogram\"");
    }),
    (
        "an operator without a camera",
        "runs the module CAM, which the robot does not have",
        |file| {
            file.without_module("CAM");
            file.events = operator(0, "\"teleoperate\", \"goal\"");
        },
    ),
];

#[test]
fn a_thousand_missions_are_accepted_and_their_broken_twins_refused_for_their_reason() {
    let mut refused = [0; BREAKINGS.len()];
    for seed in 0..cotama_golden::figure::<u64>("supervised.missions") {
        let file = File::right(seed);
        let mission = Mission::parse("right.toml", &file.to_string())
            .unwrap_or_else(|errors| panic!("{seed}: {errors}"));
        assert_eq!(mission.supervisor().unwrap().places.len(), file.objectives.len() + 4);

        let number = seed as usize % BREAKINGS.len();
        let (name, reason, breaks) = BREAKINGS[number];
        let mut file = file;
        breaks(&mut file);
        let text = file.to_string();
        let errors = Mission::parse("broken.toml", &text).expect_err(name);
        assert!(errors.to_string().contains(reason), "{seed}, {name}: {errors}");
        refused[number] += 1;
    }
    assert!(refused.iter().all(|&count| count >= 26), "{refused:?}");
}

#[test]
fn each_way_to_break_a_mission_has_its_own_message() {
    let mut said = String::new();
    for (name, _, breaks) in BREAKINGS {
        let mut file = File::right(3);
        breaks(&mut file);
        let errors = Mission::parse("mission.toml", &file.to_string()).expect_err(name);
        for diagnostic in errors.diagnostics() {
            assert!(
                errors.text().get(diagnostic.span.clone()).is_some_and(|text| !text.is_empty()),
                "{name}"
            );
        }
        write!(said, "# {name}\n{errors}\n\n").unwrap();
    }
    cotama_golden::compare("tests/golden/supervised.txt", &said);
}
