mod broken;
mod settings;

use super::supervisors::{OwnedSystem, system, word};
use super::{Decision, EMBEDDED, Robot, Situation, Where, decide, embedded};
use crate::cotama::{self, Class, FailureMode, Loss, Losses, is_settled, judge};
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

/// A loss of the delivery as its supervisors tell losses apart, and the same of its file.
const SAME_LOSSES: [(Loss, &str); 6] = [
    (Loss::Avoidance, "DVZ"),
    (Loss::Smz, "SMZ"),
    (Loss::Mcl, "MCL"),
    (Loss::Sonar, "sonar_arrays"),
    (Loss::Camera, "camera"),
    (Loss::Wifi, "WiFi_card"),
];

/// The situation of the delivery's supervisors where a configuration of its file runs.
fn as_delivery(at: Where, robot: &Robot) -> cotama::Situation {
    use cotama::{local, path_following, teleoperation};
    let rest = cotama::Situation::AT_REST;
    let local = |local| cotama::Situation { local, ..rest };
    let following = |following| cotama::Situation { following, ..local(local::State::Following) };
    let driven = |it| cotama::Situation { teleoperation: it, ..local(local::State::Teleoperated) };
    let Where::Runs { configuration, .. } = at else {
        return if at == Where::Rests { rest } else { local(local::State::HandOver) };
    };
    match robot.configurations[configuration].name.as_str() {
        "PP" => local(local::State::Planning),
        "PF.OPT" => following(path_following::State::Optimal),
        "PF.DVZ" => following(path_following::State::Reactive),
        "PF.ODO" => following(path_following::State::Odometric),
        "PF.DEG" => following(path_following::State::Degraded),
        "TP" => local(local::State::Teleprogrammed),
        "TO.FULL" => driven(teleoperation::State::Full),
        "TO.DEG" => driven(teleoperation::State::Degraded),
        other => panic!("{other}"),
    }
}

/// The decision of the delivery's two rules on a failure, as a class, where every earlier loss is
/// answered; `None` elsewhere.
fn by_delivery(mode: FailureMode, situation: cotama::Situation) -> Option<Class> {
    let report = mode.rule().report?;
    let severity = mode.severity(situation.mode());
    is_settled(report, situation).then(|| judge(report, severity, situation).class())
}

#[test]
fn the_delivery_from_its_file_decides_as_its_rules_do() {
    let robot = Robot::shipped("p3dx-delivery").unwrap();
    let (mut same, mut settings, mut asked_already) = (0, 0, 0);
    for (number, report) in robot.losses.reports.iter().enumerate() {
        let id = &robot.failures[report.failures[0]].id;
        let mode = FailureMode::named(id.split('.').next().unwrap()).unwrap();
        let sets =
            places(&robot).into_iter().flat_map(|it| (0_u32..64).map(move |set| (it.0, set)));
        for (at, set) in sets {
            let known = SAME_LOSSES.iter().enumerate().filter(|it| set >> it.0 & 1 == 1);
            let known: Vec<_> = known.map(|it| it.1).collect();
            let losses = Losses::of(&known.iter().map(|it| it.0).collect::<Vec<_>>());
            let position = |name| robot.losses.losses.iter().position(|it| it.name == name);
            let lost = known.iter().fold(0, |all, it| all | 1 << position(it.1).unwrap());
            let situation = cotama::Situation { lost: losses, ..as_delivery(at, &robot) };
            let Some(rules) = by_delivery(mode, situation) else { continue };
            let own = match decide(&robot, number, Situation { at, lost }) {
                Decision::Record => Class::Record,
                Decision::Adapt => Class::Adapter,
                Decision::Ask => Class::Local,
                Decision::Stop => Class::Global,
            };
            match (rules, own, at) {
                _ if rules == own => same += 1,
                // A setting of a module changes there, and as much of the speed is left.
                (Class::Adapter, Class::Record, Where::Runs { sub_objective, .. }) => {
                    let set = report.sets.as_ref().unwrap_or_else(|| panic!("{id} {at:?}"));
                    let of = &robot.sub_objectives[sub_objective];
                    let holds = set.mode.is_none_or(|it| it == of.mode);
                    let rules = mode.rule().adjustment.map(|it| it.effect(situation.mode()).speed);
                    if of.moves {
                        assert_eq!(
                            if holds { set.speed } else { 1_000 },
                            rules.unwrap_or(1_000),
                            "{id} {at:?}"
                        );
                    }
                    settings += 1;
                }
                // The operator is asked once.
                (Class::Local, Class::Record, Where::Waits) => asked_already += 1,
                _ => panic!("{id} {at:?} {losses}: {own:?}, not {rules:?}"),
            }
        }
    }
    assert_eq!((same, settings, asked_already), (8_412, 976, 352));
}
