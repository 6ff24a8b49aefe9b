//! The embedded delivery: a mission like any other, and its supervisor is the one written by hand.

use cotama_core::net::owned::OwnedIgnored;
use cotama_core::net::{Net, Transition};
use cotama_models::cotama::global;
use cotama_models::missions::faults::{Answer, IncidentKind, Moment};
use cotama_models::missions::mission_net;
use cotama_models::missions::{Does, Mission, Supervision, embedded};

fn delivery() -> Mission {
    let delivery = embedded::mission("delivery").unwrap();
    Mission::parse(delivery.name, delivery.text).unwrap()
}

#[test]
fn it_is_two_drives_with_the_options_of_the_adapter() {
    let mission = delivery();
    assert_eq!(mission.supervision, Some(Supervision::Cotama));
    let does: Vec<_> =
        mission.objectives.iter().map(|it| it.does.as_ref().unwrap().value).collect();
    assert_eq!(does, [Does::Drive, Does::Receive, Does::Drive, Does::Deliver]);
    let labels: Vec<_> =
        mission.scenario().activities.iter().map(|it| it.labels.join(" ")).collect();
    let drive = "PF.OPT PF.OPTR PF.DVZ PF.ODO PF.DEG";
    assert_eq!(labels, [drive, "hand-in", drive, "hand-over"]);
    let configured: Vec<_> = mission.tios.iter().filter_map(|tio| tio.configuration).collect();
    assert!(
        configured
            .iter()
            .zip(&mission.tios)
            .all(|(configuration, tio)| configuration.name() == tio.id)
    );
}

#[test]
fn a_lost_module_removes_the_options_that_need_it() {
    let mission = delivery();
    let left = |module: &str| {
        let kind = mission.hardware.iter().position(|it| it.name == module).unwrap();
        let available = mission.available().without(kind, 1);
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
    assert_eq!(left("GUI"), "PF.OPT PF.OPTR PF.ODO");
    assert_eq!(left("LAN"), "PF.OPT PF.OPTR PF.DVZ PF.ODO PF.DEG");
    assert_eq!(left("SMZ"), "PF.DVZ PF.DEG");
    assert_eq!(left("P3D"), "");
}

#[test]
fn its_script_is_the_timeline_of_the_seven_points() {
    let mission = delivery();
    let faults = &mission.run.faults;
    assert!(faults.events.is_empty() && faults.random.is_empty());
    let told: Vec<_> = faults
        .incidents
        .iter()
        .map(|it| {
            let Moment::Place(x) = it.when else { panic!("{it:?}") };
            match &it.kind {
                IncidentKind::Failure { mode, .. } => format!("{} {}", x.0, mode.name()),
                IncidentKind::Repair(mode) => format!("{} {} ends", x.0, mode.name()),
                IncidentKind::Operator { answers, .. } => {
                    let answers: Vec<_> = answers.iter().map(|answer| answer.name()).collect();
                    format!("{} {}", x.0, answers.join(" "))
                }
            }
        })
        .collect();
    let timeline = [
        "43000 RT1",
        "51000 RT1 ends",
        "52000 LOC2",
        "52000 teleoperate teleprogram path",
        "66000 SON1",
        "74000 LOC3",
        "74000 teleoperate goal",
    ];
    assert_eq!(told, timeline);
}

/// The answers of an operator are the ways through the local supervisor from the place where it
/// asks him.
#[test]
fn answers_follow_each_other_as_in_the_local_supervisor() {
    use cotama_models::cotama::local::NET;
    let place = |name: &str| NET.places.iter().position(|it| it.name == name).unwrap();
    let event = |answer: Answer| match answer {
        Answer::Teleoperate => "op_teleoperate",
        Answer::Teleprogram => "op_teleprogram",
        Answer::Waypoints => "op_waypoints",
        Answer::Path => "op_path",
        Answer::Goal => "op_goal_reached",
        Answer::GiveUp => "",
    };
    let leads = |from: &str, answer: Answer| {
        NET.transitions.iter().any(|it| {
            it.on.is_some_and(|on| NET.events[on.0 as usize].name == event(answer))
                && it.take.iter().any(|arc| arc.place.0 as usize == place(from))
        })
    };
    let all =
        [Answer::Teleoperate, Answer::Teleprogram, Answer::Waypoints, Answer::Path, Answer::Goal];
    let places = [
        ("HandOver", Answer::FIRST),
        ("Teleoperated", Answer::Teleoperate.next()),
        ("Teleprogrammed", Answer::Teleprogram.next()),
    ];
    for (from, possible) in places {
        for answer in all {
            assert_eq!(possible.contains(&answer), leads(from, answer), "{from} {answer:?}");
        }
        assert!(possible.contains(&Answer::GiveUp));
    }
}

/// Returns the shape of a net, whatever its places and transitions are called.
fn shape(net: &Net<'_>) -> impl PartialEq + std::fmt::Debug {
    let transition = |it: &Transition<'_>| {
        let arcs = (it.take.to_vec(), it.read.to_vec(), it.give.to_vec());
        (it.on, arcs, it.emits.to_vec(), it.within, it.priority)
    };
    let names = |signals: &[cotama_core::net::Signal<'_>]| {
        signals.iter().map(|it| it.name.to_owned()).collect::<Vec<_>>()
    };
    let places: Vec<_> = net.places.iter().map(|it| (it.initial, it.bound, it.role)).collect();
    let transitions: Vec<_> = net.transitions.iter().map(transition).collect();
    let ignored: Vec<_> = net.ignored.iter().map(OwnedIgnored::from).collect();
    (places, names(net.events), names(net.outputs), transitions, ignored)
}

#[test]
fn its_supervisor_is_the_one_written_by_hand() {
    let mission = delivery();
    let net = mission.supervisor().unwrap();
    assert_eq!(shape(&net.view().net()), shape(&global::NET));
    // And the one written by hand passes the check, once its places have the names of the
    // objectives.
    let mut by_hand = cotama_core::net::owned::OwnedNet::from(&global::NET);
    for (place, named) in by_hand.places.iter_mut().zip(&net.places) {
        place.name.clone_from(&named.name);
    }
    let explored = mission_net::check(&by_hand.view().net(), &mission.objectives).unwrap();
    assert_eq!((explored.markings, explored.firings), (8, 12));
}

#[test]
fn no_objective_is_dropped_that_leaves_an_object_on_board() {
    let mission = delivery();
    assert!((0..4).all(|objective| mission.without_objective(objective).is_none()));
}
