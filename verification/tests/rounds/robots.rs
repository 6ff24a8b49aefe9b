//! The supervisors that files of robots make keep the requirements that the files make; a file that
//! is refused is refused for what another reading of it finds too.

use crate::conformance::Draw;
use crate::delivery::explored;
use crate::drawn::Drawn;
use crate::mutations::mutants;
use cotama_models::missions::{Mission, embedded};
use cotama_models::robots::requirements::{self, Requirement, Watch};
use cotama_models::robots::supervisors::{OwnedSystem, of_mission, system, to_rust};
use cotama_models::robots::{Mode, Robot};
use cotama_models::severity::Severity;
use cotama_verification::check::{Checker, Model, Options, Verdict};
use cotama_verification::explicit::{Graph, Limits};
use cotama_verification::flat::{Looks, Rounds, Size, rounds};
use cotama_verification::property;
use cotama_verification::pt::Pt;
use std::collections::BTreeSet;

fn holds(rounds: &Rounds, it: &Requirement) -> bool {
    let mut rounds = rounds.clone();
    for it in &it.watches {
        let looks = if it.at_end { Looks::AtEnd } else { Looks::BeforeOutside };
        rounds.watch(&it.name, looks, (&it.begins, &it.ends), it.most).unwrap();
    }
    let net = rounds.net().unwrap();
    let model = Model::from(&net.view().net());
    answered(&Checker::new(&model), &model, it)
}

fn answered(checker: &Checker<'_>, model: &Model, it: &Requirement) -> bool {
    let property = property::parse(&it.text, model.pt()).unwrap();
    match checker.answer(&property, &Options::default()).verdict {
        Verdict::Holds(it) => it,
        other => panic!("{}: {other:?}", it.id),
    }
}

/// The requirements that do not hold.
fn broken(robot: &Robot, system: &OwnedSystem) -> Vec<String> {
    let rounds = system.with(|it| rounds(it).unwrap());
    let net = rounds.net().unwrap();
    let model = Model::from(&net.view().net());
    // Those that watch nothing are asked of one net, of which is known what was found before.
    let checker = Checker::new(&model);
    let (watching, plain): (Vec<_>, Vec<_>) =
        requirements::of(robot).into_iter().partition(|it| !it.watches.is_empty());
    let plain = plain.into_iter().filter(|it| !answered(&checker, &model, it));
    let watching = watching.into_iter().filter(|it| !holds(&rounds, it));
    plain.chain(watching).map(|it| it.id).collect()
}

#[test]
#[ignore = "two minutes: CI runs it"]
fn every_requirement_of_the_transport_robot_holds() {
    let robot = Robot::shipped("transport").unwrap();
    assert_eq!(requirements::of(&robot).len(), 30);
    assert_eq!(broken(&robot, &system(&robot)), Vec::<String>::new());
}

#[test]
#[ignore = "seconds: CI runs it"]
fn the_supervisors_of_the_delivery_have_661680_states_between_rounds() {
    let delivery = embedded::mission("delivery").unwrap();
    let mission = Mission::parse(delivery.name, delivery.text).unwrap();
    let system = of_mission(mission.robot().unwrap().robot(), &mission.steps());
    let rounds = system.with(|it| rounds(it).unwrap());
    let (_, graph) = explored(&rounds);
    assert_eq!(rounds.size(&graph).states, cotama_golden::figure::<u64>("supervised.states"));
}

/// Every tenth way to break one line, link or shared place of the supervisors of a small robot.
/// Most of those that break no requirement are in lines for losses that have ended the mission.
#[test]
#[ignore = "minutes: CI runs it"]
fn mutants_of_a_robots_supervisors_break_a_requirement() {
    let text = SCOUT.replace("\"stuck\"] }", "\"stuck\", \"no link\", \"base silent\"] }");
    let text = text + MORE_FAILS;
    let robot = Robot::parse("scout.toml", &text).unwrap_or_else(|it| panic!("{it}"));
    let made = system(&robot).leak();
    let own = made.components.iter().take_while(|it| it.name != "faults").count() as u16;
    let (mut all, mut kept) = (0, Vec::new());
    for it in mutants(made, own).into_iter().step_by(10) {
        let Ok(rounds) = rounds(&it.system) else { continue };
        all += 1;
        if requirements::of(&robot).iter().all(|it| holds(&rounds, it)) {
            kept.push(format!("{}: {}", it.kind, it.name));
        }
    }
    assert_eq!((all, all - kept.len()), (41, 18), "{}", kept.join("\n"));
}

/// Changes the lines of a net that begin so.
fn change(
    system: &mut OwnedSystem,
    net: &str,
    line: &str,
    by: impl Fn(&mut cotama_core::net::owned::OwnedTransition),
) {
    let net = &mut system.nets.iter_mut().find(|it| it.0 == net).unwrap().1;
    let mut lines = net.transitions.iter_mut().filter(|it| it.name.starts_with(line)).peekable();
    assert!(lines.peek().is_some(), "{line}");
    lines.for_each(by);
}

#[test]
fn each_mistake_in_the_supervisors_breaks_the_requirement_that_forbids_it() {
    let robot = Robot::shipped("transport").unwrap();
    let mistakes: [(&dyn Fn(&mut OwnedSystem), &str); 5] = [
        // What is fatal is recorded only.
        (&|it| change(it, "cs", "DRV1", |it| it.emits.clear()), "CS1"),
        // What is hard is recorded only.
        (&|it| change(it, "cs", "WHL1_Follow", |it| it.emits.clear()), "CS2"),
        // The adapter keeps what runs.
        (
            &|it| change(it, "follow", "Follow_Full_adapts", |it| it.give = it.take.clone()),
            "AS4.Follow_Full",
        ),
        // The permit is left with who waits.
        (&|it| change(it, "ls", "ask_Follow", |it| _ = it.emits.remove(0)), "LS2"),
        // Halted, a drive goes on.
        (&|it| change(it, "ls", "abort_Follow", |it| it.give = it.take.clone()), "GS2"),
    ];
    for (mistake, expected) in mistakes {
        let mut system = system(&robot);
        mistake(&mut system);
        let rounds = system.with(|it| rounds(it).unwrap());
        let requirement = requirements::of(&robot).into_iter().find(|it| it.id == expected);
        assert!(!holds(&rounds, &requirement.unwrap()), "{expected} holds");
    }
}

/// The most rounds in which the reaction to a report that is told at once is not done yet, as the
/// checker finds it: up to four.
fn most_rounds(robot: &Robot, rounds: &Rounds, report: usize) -> u64 {
    let of = &robot.losses.reports[report];
    let told = format!("gom.flag_{}.waiting", of.name);
    let own = robot.sub_objectives.iter().filter(|it| it.mode == Mode::Autonomous);
    let own: Vec<_> = own.map(|it| format!("ls.{}", it.name)).collect();
    let done = match (of.autonomous, of.loss) {
        (Severity::Fatal, _) => "gs.Security | gs.Safe".to_owned(),
        (Severity::Hard, _) => format!("!({})", own.join(" | ")),
        (_, None) => format!("!({told})"),
        (_, Some(loss)) => {
            // Nothing runs without what it needs.
            let all = requirements::of(robot).into_iter().filter(|it| it.id.starts_with("AS4"));
            let without: Vec<_> = all.map(|it| it.watches[0].begins.clone()).collect();
            let lost = &robot.losses.losses[loss].name;
            format!("gom.lost_{lost} & !({})", without.join(" | "))
        }
    };
    let begins = format!("{told} & ({})", own.join(" | "));
    let within = |most: &u64| {
        let (begins, ends) = (begins.clone(), done.clone());
        let watch = Watch { name: "late".into(), at_end: true, begins, ends, most: 5 };
        let (id, text) = (of.name.clone(), format!("AG late <= {most}"));
        holds(rounds, &Requirement { id, sentence: String::new(), watches: vec![watch], text })
    };
    (0..4).find(within).unwrap_or(4)
}

#[test]
fn the_checker_finds_the_rounds_of_each_reaction_and_no_more() {
    let text = SCOUT.replace("restart = { module = \"scan\", times = 2 }", "");
    let text = text + MORE_FAILS;
    let text = text.replace("\"stuck\"] }", "\"stuck\", \"no link\", \"base silent\"] }");
    let robot = Robot::parse("scout.toml", &text).unwrap_or_else(|it| panic!("{it}"));
    let rounds = system(&robot).with(|it| rounds(it).unwrap());
    let found: Vec<_> = ["LID1", "CAM1", "STK1", "BAS1"]
        .into_iter()
        .map(|id| {
            let report = robot.losses.reports.iter().position(|it| it.name == id).unwrap();
            (most_rounds(&robot, &rounds, report), robot.reacts_in(robot.failure(id).unwrap()))
        })
        .collect();
    assert_eq!(found, [(3, Some(3)), (3, Some(3)), (2, Some(2)), (2, Some(2))]);
}

#[test]
fn nothing_runs_for_long_that_a_lost_observer_alone_watches() {
    let eye = "eye = { needs = [\"watch\"], unwatched = \"lost\", flags = [\"scan late\"] }\n\
        wire = { flags = [\"depth late\", \"stuck\"] }";
    let text = SCOUT.replace("eye = { flags = [\"scan late\", \"depth late\", \"stuck\"] }", eye);
    let link = "link = { hardware = [\"radio\"] }";
    let text = text.replace(link, &format!("{link}\nwatch = {{ hardware = [\"camera\"] }}"));
    let text = text.replace("required = [\"avoid\"]", "required = [\"avoid\", \"scan\"]");
    let robot = Robot::parse("scout.toml", &text).unwrap_or_else(|it| panic!("{it}"));
    let mut made = system(&robot);
    assert_eq!(broken(&robot, &made), Vec::<String>::new());
    // The scanner works, but nobody watches it: what was told of its observer is recorded only.
    change(&mut made, "cs", "CAM1", |it| it.emits.clear());
    assert_eq!(broken(&robot, &made), ["OB1.eye", "AS4.Careful"]);
}

#[test]
fn a_row_that_asks_first_does_so_and_then_goes_on() {
    let row = "flags = [\"depth late\"]\n";
    let more = "ask = { times = 1 }\nmask = { flags = [\"depth late\"], on = \"order\" }\n";
    let text = SCOUT.replace(row, &format!("{row}{more}"));
    let robot = Robot::parse("scout.toml", &text).unwrap_or_else(|it| panic!("{it}"));
    let mut made = system(&robot);
    assert_eq!(broken(&robot, &made), Vec::<String>::new());
    change(&mut made, "cs", "ask_CAM1_Follow", |it| it.emits.clear());
    // What runs goes on without its camera, too.
    assert_eq!(broken(&robot, &made), ["CS5.CAM1", "AS4.Careful"]);
}

/// Draws robots; each loads and keeps its requirements, or is refused for its faults. Returns how
/// many load.
fn robots(seed: u64, count: usize) -> usize {
    let mut draw = Draw(seed);
    let mut loaded = 0;
    for number in 0..count {
        let drawn = Drawn::new(&mut |most| draw.below(most) as usize);
        let (text, faults) = (drawn.text(), drawn.faults());
        match Robot::parse("drawn.toml", &text) {
            Ok(robot) => {
                assert_eq!(faults, BTreeSet::new(), "{number}:\n{text}");
                let broken = broken(&robot, &system(&robot));
                assert_eq!(broken, Vec::<String>::new(), "{number}:\n{text}");
                loaded += 1;
            }
            Err(errors) => {
                let said = errors.to_string();
                let known = [
                    "stands on no hardware",
                    "never runs",
                    "starts",
                    "nobody to ask",
                    "nobody orders",
                ];
                let found: BTreeSet<_> = known.into_iter().filter(|it| said.contains(it)).collect();
                // That nothing leads to a configuration follows from severities, which `faults`
                // does not look at.
                let by_severity = said.contains("nothing leads there while it can run");
                let more = if by_severity { vec!["never runs"] } else { vec![] };
                let faults: BTreeSet<_> = faults.into_iter().chain(more).collect();
                assert_eq!(faults, found, "{number}: {said}\n{text}");
                assert!(!faults.is_empty(), "{number}: {said}\n{text}");
            }
        }
    }
    loaded
}

#[test]
fn drawn_robots_keep_their_requirements_or_are_refused_for_their_faults() {
    let loaded = robots(1, 12);
    assert!(loaded >= 2, "{loaded}");
}

#[test]
#[ignore = "two hundred robots: minutes"]
fn two_hundred_drawn_robots_keep_their_requirements() {
    println!("{} of 200 load", robots(2, 200));
}

/// Failures after which the operator is out of reach, and nothing goes on.
const MORE_FAILS: &str = r#"
[[failure]]
id = "COM1"
mode = "no link"
severity = { autonomous = "weak", operator = "fatal" }
flags = ["no link"]
loses = ["link"]
[[failure]]
id = "BAS1"
mode = "no answer of the base"
severity = { autonomous = "fatal" }
flags = ["base silent"]
loses = ["base"]
"#;

/// A robot with a restart, two ways to see, and an operator.
const SCOUT: &str = r#"
format = "cotama-robot/1"
name = "scout"
hardware = { base = {}, lidar = {}, camera = {}, radio = {} }
[module]
drive = { hardware = ["base"] }
scan = { hardware = ["lidar"] }
depth = { hardware = ["camera"] }
avoid = { needs = ["drive"], one_of = ["scan", "depth"] }
link = { hardware = ["radio"] }
[observer]
eye = { flags = ["scan late", "depth late", "stuck"] }
[operator]
needs = ["link"]
[[configuration]]
name = "Careful"
sub_objective = "Follow"
mode = "autonomous"
required = ["avoid"]
speed_mm_s = 500
[[configuration]]
name = "Blind"
sub_objective = "Follow"
mode = "autonomous"
required = ["drive"]
speed_mm_s = 100
[[configuration]]
name = "ByHand"
sub_objective = "Manual"
mode = "operator"
required = ["drive", "link"]
speed_mm_s = 200
[[failure]]
id = "LID1"
mode = "no scan"
severity = { autonomous = "medium", operator = "weak" }
flags = ["scan late"]
loses = ["lidar"]
restart = { module = "scan", times = 2 }
[[failure]]
id = "CAM1"
mode = "no image"
severity = { autonomous = "medium", operator = "weak" }
flags = ["depth late"]
loses = ["camera"]
[[failure]]
id = "STK1"
mode = "stuck"
severity = { autonomous = "hard", operator = "weak" }
flags = ["stuck"]
"#;

#[test]
fn the_printed_supervisors_of_a_robot_compile_to_the_same_rounds() {
    let robot = Robot::parse("scout.toml", SCOUT).unwrap_or_else(|it| panic!("{it}"));
    let system = system(&robot);
    let stored = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/rounds/printed_robot.rs");
    cotama_golden::compare(stored, &to_rust(&system));
    let size = |rounds: Rounds| {
        let pt = Pt::from(&rounds.net().unwrap().view().net());
        rounds.size(&Graph::new(&pt, &Limits::default(), &|_| ()).unwrap())
    };
    let made = size(system.with(|it| rounds(it).unwrap()));
    assert_eq!(made, Size { states: 373, edges: 1_927 });
    assert_eq!(size(rounds(&crate::printed_robot::net_scout::SYSTEM).unwrap()), made);
}
