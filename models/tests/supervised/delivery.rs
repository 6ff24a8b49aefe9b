//! The embedded delivery: a mission like any other, under the supervisors that are made from the
//! file of its robot.

use crate::nets::move_of;
use cotama_core::net::owned::OwnedNet;
use cotama_models::missions::{Does, Mission, embedded};
use cotama_models::nets::by_hand::global;
use cotama_models::robots::supervisors::of_mission;
use cotama_models::robots::{Answer, IncidentKind, Mode, Moment, Parts, Robot};

fn delivery() -> Mission {
    let delivery = embedded::mission("delivery").unwrap();
    Mission::parse(delivery.name, delivery.text).unwrap()
}

fn robot(mission: &Mission) -> &Robot {
    mission.robot().unwrap().robot()
}

#[test]
fn it_is_two_drives_with_the_options_of_the_adapter() {
    let mission = delivery();
    assert_eq!(mission.robot().map(|it| it.robot().name.as_str()), Some("p3dx-delivery"));
    let does: Vec<_> =
        mission.objectives.iter().map(|it| it.does.as_ref().unwrap().value).collect();
    assert_eq!(does, [Does::Drive, Does::Receive, Does::Drive, Does::Deliver]);
    let labels: Vec<_> =
        mission.scenario().activities.iter().map(|it| it.labels.join(" ")).collect();
    let drive = "PF.OPT PF.DVZ PF.ODO PF.DEG";
    assert_eq!(labels, [drive, "hand-in", drive, "hand-over"]);
    // They are the configurations of the autonomous sub-objective that moves, the best one first.
    let robot = robot(&mission);
    let moves = robot.sub_objectives.iter().find(|it| it.moves && it.mode == Mode::Autonomous);
    let under = mission.under.as_ref().unwrap();
    assert_eq!(under.configurations, moves.unwrap().configurations);
    let names: Vec<_> =
        under.configurations.iter().map(|it| robot.configurations[*it].name.as_str()).collect();
    assert_eq!(names.join(" "), drive);
}

#[test]
fn a_lost_module_removes_the_options_that_need_it() {
    let mission = delivery();
    let left = |module: &str| {
        let module = robot(&mission).modules.iter().position(|it| it.name == module).unwrap();
        let lost = Parts { modules: 1 << module, ..Parts::NONE };
        let available = mission.under.as_ref().unwrap().units(&mission, lost);
        let drive = &mission.scenario().activities[2];
        let kept = drive
            .alternatives
            .iter()
            .zip(&drive.labels)
            .filter(|(it, _)| available.covers(it.needs));
        kept.map(|(_, label)| label.as_str()).collect::<Vec<_>>().join(" ")
    };
    assert_eq!(left("MCL"), "PF.ODO PF.DEG");
    assert_eq!(left("UST"), "PF.DEG");
    assert_eq!(left("GUI"), "PF.OPT PF.ODO");
    assert_eq!(left("LAN"), "PF.OPT PF.DVZ PF.ODO PF.DEG");
    assert_eq!(left("SMZ"), "PF.DVZ PF.DEG");
    assert_eq!(left("P3D"), "");
}

#[test]
fn its_script_is_the_timeline_of_the_seven_points() {
    let mission = delivery();
    let robot = robot(&mission);
    let faults = &mission.run.faults;
    assert!(faults.events.is_empty() && faults.random.is_empty());
    let id = |failure: usize| robot.failures[failure].id.as_str();
    let answer = |it: &Answer| match it {
        Answer::Chooses(it) => robot.sub_objectives[*it].name.as_str(),
        Answer::Done => "done",
        Answer::GivesUp => "give_up",
    };
    let told: Vec<_> = faults
        .of_robot
        .iter()
        .map(|it| {
            let Moment::Place(x) = it.when else { panic!("{it:?}") };
            match &it.kind {
                IncidentKind::Failure { failure, until: None } => {
                    format!("{} {}", x.0, id(*failure))
                }
                IncidentKind::Failure { until: Some(_), .. } | IncidentKind::Door { .. } => {
                    panic!("{it:?}")
                }
                IncidentKind::Repair(failure) => format!("{} {} ends", x.0, id(*failure)),
                IncidentKind::Operator { answers, .. } => {
                    let answers: Vec<_> = answers.iter().map(answer).collect();
                    format!("{} {}", x.0, answers.join(" "))
                }
            }
        })
        .collect();
    let timeline = [
        "43000 RT1",
        "52000 LOC2",
        "52000 Teleoperation Teleprogramming done",
        "66000 SON1",
        "74000 LOC3",
        "74000 Teleoperation done",
    ];
    assert_eq!(told, timeline);
}

/// What an operator answers are the ways through the local supervisor from the place where it asks
/// him.
#[test]
fn answers_follow_each_other_as_in_the_local_supervisor() {
    let mission = delivery();
    let robot = robot(&mission);
    let system = of_mission(robot, &mission.steps());
    let (_, local) = system.nets.iter().find(|it| it.0 == "ls").unwrap();
    let leads = |from: &str, event: &str| {
        local.transitions.iter().any(|it| {
            it.on.is_some_and(|on| local.events[on.0 as usize].name == event)
                && it.take.iter().any(|arc| local.places[arc.place.0 as usize].name == from)
        })
    };
    let operator: Vec<_> =
        robot.sub_objectives.iter().filter(|it| it.mode == Mode::Operator).collect();
    assert_eq!(operator.len(), 2);
    for to in &operator {
        let chosen = format!("op_{}", to.name);
        for from in operator.iter().map(|it| it.name.as_str()).chain(["Waits"]) {
            assert_eq!(leads(from, &chosen), from != to.name, "{from} {chosen}");
        }
        // He is done with what he chose, and not before he has chosen it.
        let done = format!("{}_done", to.name);
        assert!(leads(&to.name, &done) && !leads("Waits", &done), "{done}");
    }
    // What the robot does by itself is nothing that he answers.
    let own = robot.sub_objectives.iter().filter(|it| it.mode == Mode::Autonomous);
    assert!(own.into_iter().all(|it| !leads("Waits", &format!("op_{}", it.name))));
}

/// The one written by hand warns of a lost link as well, and is never told that no way is left,
/// which the one that is made answers as every global event.
#[test]
fn its_global_supervisor_moves_as_the_one_written_by_hand() {
    let mission = delivery();
    let system = of_mission(robot(&mission), &mission.steps());
    let (_, made) = system.nets.iter().find(|it| it.0 == "gs").unwrap();
    let by_hand = OwnedNet::from(&global::NET);
    let places = |net: &OwnedNet| -> Vec<_> {
        net.places.iter().map(|it| (it.name.clone(), it.initial, it.role)).collect()
    };
    assert_eq!(places(made), places(&by_hand));
    let moves = |net: &OwnedNet, on: &dyn Fn(&str) -> bool| -> Vec<_> {
        let all = net.transitions.iter().map(|it| move_of(net, it)).filter(|it| on(it.1));
        let plain = all.map(|(from, event, to, emits)| {
            let emits: Vec<_> = emits.into_iter().filter(|it| *it != "wifi_warning").collect();
            (from.to_owned(), event.to_owned(), to.to_owned(), emits.join(" "))
        });
        let mut plain: Vec<_> = plain.collect();
        plain.sort_unstable();
        plain
    };
    let any = |_: &str| true;
    assert_eq!(moves(made, &|on| on != "no_way"), moves(&by_hand, &any));
    let as_global = moves(made, &|on| on == "no_way").into_iter();
    let as_global: Vec<_> = as_global
        .map(|(from, _, to, emits)| (from, "global_event".to_owned(), to, emits))
        .collect();
    assert_eq!(as_global, moves(made, &|on| on == "global_event"));
}

#[test]
fn no_objective_is_dropped_that_leaves_an_object_on_board() {
    let mission = delivery();
    assert!((0..4).all(|objective| mission.without_objective(objective).is_none()));
}
