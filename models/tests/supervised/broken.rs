//! A thousand generated mission files, each accepted, and refused when it is broken, for the reason
//! for which it is.

use crate::file::{File, Objective, Option_, failure, operator};
use cotama_models::missions::Mission;
use cotama_models::robots::RobotFile;
use cotama_models::robots::supervisors::MAX_STEPS;
use std::fmt::Write;

/// A way to break a mission: its name, what the message about it says, and what it does.
type Breaking = (&'static str, &'static str, fn(&mut File));

const BREAKINGS: [Breaking; 42] = [
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
        file.objectives[at].task = Some("DLV");
    }),
    ("a drive that stands", "an objective that does `drive` needs `MOV`", |file| {
        let at = file.first("drive");
        file.objectives[at].task = Some("WAI");
    }),
    ("a reserved name", "has a place `Safe` of its own", |file| {
        file.objectives[0].id = "Safe".into();
    }),
    ("a name twice", "is defined twice", |file| {
        file.objectives[0].id = file.objectives[1].id.clone();
    }),
    ("names that are one place", "`to.A` and `to-A` are one place `to_A`", |file| {
        (file.objectives[0].id, file.objectives[1].id) = ("to.A".into(), "to-A".into());
    }),
    ("an unknown kind", "unknown kind of objective `drvie`; did you mean `drive`?", |file| {
        let at = file.first("drive");
        file.objectives[at].does = Some("drvie".into());
    }),
    ("no kind", "missing key `does`", |file| file.objectives[0].does = None),
    ("too many objectives", "at most 250 objectives", |file| file.lengthen(MAX_STEPS + 1)),
    ("not supervised", "`does` is for missions under the supervisors of a robot", |file| {
        file.without_robot();
    }),
    ("a failure without its name", "missing key `mode`", |file| {
        file.events = failure("x_mm = 0", "RT1").replace("mode = \"RT1\"", "");
    }),
    ("a failure that never happens", "nothing says when this happens", |file| {
        file.events = failure("", "RT1");
    }),
    ("a failure of a plain mission", PLAIN, |file| {
        file.plain();
        file.events = failure("x_mm = 0", "RT1");
    }),
    ("a repair of a plain mission", PLAIN, |file| {
        file.plain();
        file.events = failure("x_mm = 0", "RT1").replace("failure", "repair");
    }),
    ("an operator of a plain mission", PLAIN, |file| {
        file.plain();
        file.events = operator(0, "\"give_up\"");
    }),
    ("a section [supervision]", "supervisors are made of the file of a robot", |file| {
        file.plain();
        file.sections += "[supervision]\ndecides = \"cotama\"\n";
    }),
    ("[supervision] beside a robot", "unknown key `supervision`", |file| {
        file.sections += "[supervision]\ndecides = \"cotama\"\n";
    }),
    ("a body beside a robot", "unknown key `motion_power`", |file| {
        file.sections += "[motion_power]\nc0 = 4890\nc1 = 7400\nc2 = 0\n";
    }),
    ("an unknown robot", "unknown robot `p3dx-delivry`; did you mean `p3dx-delivery`?", |file| {
        file.robot = Some("p3dx-delivry");
    }),
    ("an option of moving", "`MOV` is done by the configurations of the robot", |file| {
        let slow = Option_ { id: "slow", task: "MOV", needs: None, more: "" };
        file.options.push(slow);
    }),
    ("an option like a configuration", "the option `PF.OPT` is defined twice", |file| {
        file.options[0].id = "PF.OPT";
    }),
    ("a zone without an option", "is left without alternatives", |file| {
        let end = file.path_length;
        file.zones = format!(
            "[[zone]]\nid = \"z\"\nx_start_mm = 0\nx_end_mm = {end}\nrequire_tio = \"in\"\n"
        );
    }),
    ("a zone of a module", "unknown hardware `MCL`", |file| {
        file.zones =
            "[[zone]]\nid = \"z\"\nx_start_mm = 0\nx_end_mm = 9\nrequire_hardware = \"MCL\"\n"
                .into();
    }),
    ("no option for a task", "no option implements the task `DLV`", |file| {
        file.options.retain(|it| it.task != "DLV");
    }),
    ("standing without a time", "missing key `duration_ms`", |file| {
        file.options[1].more = "power_mw = 1\n";
    }),
    ("an unknown failure", "unknown failure of the robot `RT9`", |file| {
        file.events = failure("x_mm = 0", "RT9");
    }),
    ("a failure behind the path", "lies behind the end of the path", |file| {
        file.events = failure(&format!("x_mm = {}", file.path_length + 1), "RT1");
    }),
    ("a failure of no time", "nothing says when this happens", |file| {
        file.events = failure("", "RT1");
    }),
    ("a failure of two times", "says when, not several", |file| {
        file.events = failure("x_mm = 0\nt_ms = 9", "RT1");
    }),
    ("an unknown sub-objective", "unknown sub-objective `Follow`", |file| {
        file.events = failure("during = \"Follow\"", "RT1");
    }),
    ("an unknown answer", "unknown answer `Following`", |file| {
        file.events = operator(0, "\"Following\", \"done\"");
    }),
    ("answers that begin with the end", "answers begin with what the operator chooses", |file| {
        file.events = operator(0, "\"done\"");
    }),
    ("answers without an end", "and end with `done` or `give_up`", |file| {
        file.events = operator(0, "\"Teleoperation\", \"Teleprogramming\"");
    }),
];
const PLAIN: &str = "this event is for missions under the supervisors of a robot";

#[test]
fn a_thousand_missions_are_accepted_and_their_broken_twins_refused_for_their_reason() {
    let mut refused = [0; BREAKINGS.len()];
    // A robot that every file names is read once.
    let robot = RobotFile::shipped("p3dx-delivery");
    let read = |source: &str, text: &str| {
        let named = Mission::robot_of(text);
        let is_this = named.is_some() && named.as_deref() == robot.as_ref().map(RobotFile::source);
        Mission::parse_under(source, text, robot.clone().filter(|_| is_this))
    };
    for seed in 0..cotama_golden::figure::<u64>("supervised.missions") {
        let file = File::right(seed);
        let mission = read("right.toml", &file.to_string())
            .unwrap_or_else(|errors| panic!("{seed}: {errors}"));
        let places: Vec<_> = mission.steps().iter().map(|it| it.name.clone()).collect();
        let ids: Vec<_> = file.objectives.iter().map(|it| it.id.clone()).collect();
        assert_eq!((mission.is_supervised(), places), (true, ids));

        let number = seed as usize % BREAKINGS.len();
        let (name, reason, breaks) = BREAKINGS[number];
        let mut file = file;
        breaks(&mut file);
        let errors = read("broken.toml", &file.to_string()).expect_err(name);
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
