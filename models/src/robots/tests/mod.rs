mod broken;
mod powered;
mod reactions;
mod settings;
mod signals;

use super::supervisors::{OwnedSystem, system, word};
use super::{Decision, EMBEDDED, Robot, Situation, Where, decide, embedded};
use cotama_core::net::owned::OwnedNet;
use std::collections::BTreeSet;

fn net<'s>(system: &'s OwnedSystem, name: &str) -> &'s OwnedNet {
    &system.nets.iter().find(|it| it.0 == name).unwrap().1
}

/// The outputs of the transition that an event fires where these places are marked; none where it
/// fires none.
fn fires<'n>(net: &'n OwnedNet, event: &str, marked: &BTreeSet<String>) -> Option<Vec<&'n str>> {
    let is_marked = |place: &str| match place.strip_prefix('!') {
        Some(flag) => !marked.contains(flag),
        None => place == "Ready" || marked.contains(place),
    };
    let enabled = net.transitions.iter().filter(|it| {
        let on = it.on.map(|on| net.events[on.0 as usize].name.as_str());
        let places = it.take.iter().chain(&it.read).map(|it| &net.places[it.place.0 as usize].name);
        on == Some(event) && places.into_iter().all(|it| is_marked(it))
    });
    let all: Vec<_> = enabled.collect();
    assert!(all.len() <= 1, "{event} has several answers where {marked:?}");
    let outputs = |it: &&cotama_core::net::owned::OwnedTransition| {
        it.emits.iter().map(|it| net.outputs[it.0 as usize].name.as_str()).collect()
    };
    all.first().map(outputs)
}

fn places(robot: &Robot) -> Vec<(Where, BTreeSet<String>)> {
    let mut all =
        vec![(Where::Rests, BTreeSet::new()), (Where::Waits, BTreeSet::from(["waits".to_owned()]))];
    for (sub_objective, it) in robot.sub_objectives.iter().enumerate() {
        for &configuration in &it.configurations {
            let name = word(&robot.configurations[configuration].name);
            let marked = [format!("in_{}", word(&it.name)), format!("runs_{name}")];
            all.push((Where::Runs { sub_objective, configuration }, BTreeSet::from(marked)));
        }
    }
    all
}

#[test]
fn the_contextual_net_decides_as_the_function_in_every_situation() {
    let mut compared = 0;
    for it in EMBEDDED {
        let robot = Robot::parse(it.name, it.text).unwrap();
        let system = system(&robot);
        let net = net(&system, "cs");
        for (at, marked) in places(&robot) {
            for (number, report) in robot.losses.reports.iter().enumerate() {
                let own = report.loss.map_or(0, |it| 1 << it);
                for lost in (0..=robot.losses.all()).filter(|it| it & own == own) {
                    let mut marked = marked.clone();
                    let losses = robot.losses.losses.iter().enumerate();
                    let lost_now = losses.filter(|it| lost >> it.0 & 1 == 1);
                    marked.extend(lost_now.map(|it| format!("lost_{}", word(&it.1.name))));
                    let told = &robot.losses.reports[robot.losses.told_as(number)];
                    let said = fires(net, &word(&told.name), &marked).map(|it| it.concat());
                    let expected = match (decide(&robot, number, Situation { at, lost }), at) {
                        (Decision::Record, _) => None,
                        (Decision::Ask, _) => Some("local_event".to_owned()),
                        (Decision::Stop, _) => Some("global_event".to_owned()),
                        (Decision::Adapt, Where::Runs { sub_objective, .. }) => {
                            let name = &robot.sub_objectives[sub_objective].name;
                            Some(format!("adapt_{}", word(name)))
                        }
                        (Decision::Adapt, _) => panic!("nothing runs that could be adapted"),
                    };
                    assert_eq!(said, expected, "{} {at:?} {lost:b}", report.name);
                    compared += 1;
                }
            }
        }
    }
    assert_eq!(compared, 128_080);
}

/// A robot whose scanner is watched by a module that can be lost itself.
const WATCHED: &str = r#"format = "cotama-robot/1"
name = "watched"
hardware = { base = {}, lidar = {}, board = {} }
[module]
drive = { hardware = ["base"] }
scan = { hardware = ["lidar"] }
watch = { hardware = ["board"] }
[observer.eye]
needs = ["watch"]
unwatched = "lost"
flags = ["late"]
[observer.wire]
flags = ["board silent", "base silent"]
[[configuration]]
name = "Careful"
sub_objective = "Follow"
mode = "autonomous"
required = ["scan", "drive"]
speed_mm_s = 500
[[configuration]]
name = "Blind"
sub_objective = "Follow"
mode = "autonomous"
required = ["drive"]
speed_mm_s = 100
[[failure]]
id = "LID1"
mode = "no scan"
severity = { autonomous = "medium" }
flags = ["late"]
loses = ["lidar"]
[[failure]]
id = "WAT1"
mode = "no watch"
severity = { autonomous = "weak" }
flags = ["board silent"]
loses = ["board"]
[[failure]]
id = "BAS1"
mode = "no answer"
severity = { autonomous = "fatal" }
flags = ["base silent"]
loses = ["base"]
"#;

#[test]
fn a_module_that_nobody_watches_any_more_counts_as_lost_where_the_file_says_so() {
    let at = Where::Runs { sub_objective: 0, configuration: 0 };
    let decided = |text: &str| {
        let robot = Robot::parse("watched.toml", text).unwrap_or_else(|it| panic!("{it}"));
        let watch = robot.failure("WAT1").unwrap();
        let report = robot.losses.reports.iter().position(|it| it.failures.contains(&watch));
        let decided = decide(&robot, report.unwrap(), Situation { at, lost: 0 });
        (decided, robot.losses.losses.len(), robot.failures[watch].reaction(&robot))
    };
    let kept = WATCHED.replace("unwatched = \"lost\"\n", "");
    assert_eq!(decided(&kept), (Decision::Record, 2, "record".to_owned()));
    assert_eq!(decided(WATCHED), (Decision::Adapt, 3, "another configuration".to_owned()));
    // The scanner is watched by somebody else too.
    let also =
        WATCHED.replace("flags = [\"late\"]\nloses", "flags = [\"late\", \"base silent\"]\nloses");
    assert_eq!(decided(&also).0, Decision::Record);
    let wrong = WATCHED.replace("needs = [\"watch\"]", "needs = [\"board\"]");
    let errors = Robot::parse("watched.toml", &wrong).unwrap_err().to_string();
    assert!(errors.starts_with("watched.toml:10:13: `eye` is never blind"), "{errors}");
}

#[test]
fn the_nets_of_a_shipped_robot_fit_together() {
    for it in EMBEDDED {
        let robot = Robot::parse(it.name, it.text).unwrap();
        system(&robot).with(|system| assert_eq!(system.defect(), None));
    }
}

#[test]
fn losses_that_begin_with_the_same_part_have_names_of_their_own() {
    let shifts = "flags = [\"load_shift\"]\n";
    let takes = format!("{shifts}loses = [\"drives\", \"lift\"]\n");
    let text = embedded("transport").unwrap().text.replace(shifts, &takes);
    let robot = Robot::parse("transport", &text).unwrap();
    let names: Vec<_> = robot.losses.losses.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names[4..7], ["drives", "lift", "drives_LOD1"]);
    system(&robot).with(|system| assert_eq!(system.defect(), None));
}
