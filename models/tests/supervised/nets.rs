//! Global supervisors that are made from the objectives of a mission.

use crate::file::File;
use cotama_core::net::owned::{OwnedNet, OwnedTransition};
use cotama_models::missions::{Mission, embedded};
use cotama_models::robots::Robot;
use cotama_models::robots::supervisors::{MAX_STEPS, RESERVED, Step, of_mission};
use std::collections::BTreeSet;

/// A transition that moves the token: from where, on what, to where, and what it emits.
type Move<'n> = (&'n str, &'n str, &'n str, Vec<&'n str>);

fn read(text: &str) -> Mission {
    Mission::parse("mission.toml", text).unwrap_or_else(|errors| panic!("{errors}"))
}

fn global(mission: &Mission) -> OwnedNet {
    made(mission.robot().unwrap().robot(), &mission.steps())
}

fn made(robot: &Robot, steps: &[Step]) -> OwnedNet {
    let system = of_mission(robot, steps);
    let found = system.nets.into_iter().find(|it| it.0 == "gs");
    found.unwrap().1
}

pub(crate) fn move_of<'n>(net: &'n OwnedNet, it: &'n OwnedTransition) -> Move<'n> {
    let place = |at: &cotama_core::net::Arc| net.places[at.place.0 as usize].name.as_str();
    let ([take], [give]) = (&it.take[..], &it.give[..]) else {
        panic!("`{}` does not just move the token", it.name)
    };
    assert!((take.weight, give.weight) == (1, 1) && it.read.is_empty(), "{}", it.name);
    let on = it.on.unwrap_or_else(|| panic!("`{}` waits for no event", it.name));
    let emits = it.emits.iter().map(|it| net.outputs[it.0 as usize].name.as_str());
    (place(take), &net.events[on.0 as usize].name, place(give), emits.collect())
}

fn moves(net: &OwnedNet) -> Vec<Move<'_>> {
    net.transitions.iter().map(|it| move_of(net, it)).collect()
}

/// The moves that a mission must have: one objective after another, and from each to security.
fn expected(mission: &Mission) -> BTreeSet<(String, String, String, String)> {
    let mut all = BTreeSet::new();
    let mut add = |from: &str, on: &str, to: &str, emits: &str| {
        all.insert((from.to_owned(), on.to_owned(), to.to_owned(), emits.to_owned()))
    };
    let (mut from, mut on) = ("Wait".to_owned(), "mission_received".to_owned());
    for it in &mission.objectives {
        let does = it.does.as_ref().unwrap().value.name();
        let (ends, emits) = match does.as_str() {
            "drive" => ("drive_done", "start_drive"),
            "receive" => ("object_received", ""),
            "deliver" => ("object_delivered", ""),
            "wait" => ("wait_over", ""),
            _ => ("grasp_over", ""),
        };
        let place = it.id.replace('-', "_");
        add(&from, &on, &place, emits);
        (from, on) = (place, ends.to_owned());
    }
    add(&from, &on, "Done", "");
    let places: Vec<_> = mission.objectives.iter().map(|it| it.id.replace('-', "_")).collect();
    for place in places.iter().map(String::as_str).chain(["Wait", "Done"]) {
        add(place, "global_event", "Security", "gs_abort halt");
        add(place, "no_way", "Security", "gs_abort halt");
    }
    add("Security", "stopped", "Safe", "alarm");
    all
}

/// Checks the supervisor of a mission whole: its places, its one token, and every move.
fn check(mission: &Mission, net: &OwnedNet) {
    let names: Vec<_> = net.places.iter().map(|it| it.name.as_str()).collect();
    let own: Vec<_> = mission.objectives.iter().map(|it| it.id.replace('-', "_")).collect();
    let own = own.iter().map(String::as_str);
    let places: Vec<_> =
        ["Wait"].into_iter().chain(own).chain(["Done", "Security", "Safe"]).collect();
    assert_eq!(names, places);
    let tokens: Vec<_> = net.places.iter().map(|it| it.initial).collect();
    assert!(tokens[0] == 1 && tokens[1..].iter().all(|it| *it == 0), "{tokens:?}");
    assert!(net.places.iter().all(|it| it.bound == 1));
    let all = moves(net);
    let found: BTreeSet<_> = all
        .iter()
        .map(|it| (it.0.to_owned(), it.1.to_owned(), it.2.to_owned(), it.3.join(" ")))
        .collect();
    assert_eq!(found.len(), all.len(), "no move is there twice");
    assert_eq!(found, expected(mission));
    assert_eq!(net.view().net().defect(), None);
}

#[test]
fn the_supervisor_of_a_shipped_mission_has_its_objectives_in_their_order() {
    for it in ["delivery", "shift"] {
        let mission = read(embedded::mission(it).unwrap().text);
        check(&mission, &global(&mission));
    }
}

#[test]
fn supervisors_of_generated_missions_have_their_objectives_in_their_order() {
    for seed in 0..10 {
        let mission = read(&File::right(seed).to_string());
        check(&mission, &global(&mission));
    }
}

/// Tokens neither appear nor vanish: each move takes one and gives one.
#[test]
fn the_token_of_a_mission_passes_every_place_once_and_ends_in_done() {
    let mission = read(embedded::mission("delivery").unwrap().text);
    let net = global(&mission);
    let all = moves(&net);
    let (mut at, mut passed) = ("Wait", vec!["Wait"]);
    let events =
        ["mission_received", "drive_done", "object_received", "drive_done", "object_delivered"];
    for event in events {
        let next: Vec<_> = all.iter().filter(|it| it.0 == at && it.1 == event).collect();
        assert_eq!(next.len(), 1, "{event} in {at}");
        at = next[0].2;
        passed.push(at);
    }
    assert_eq!(passed, ["Wait", "DriveA", "Receive", "DriveB", "Deliver", "Done"]);
    // Another event than the one that it waits for leaves it where it is, or stops it.
    let other = all.iter().filter(|it| it.0 == "Receive" && it.1 != "object_received");
    assert!(other.clone().count() == 2 && other.clone().all(|it| it.2 == "Security"));
}

#[test]
fn a_robot_without_a_mission_drives_whenever_a_drive_is_wanted() {
    let robot = Robot::shipped("p3dx-delivery").unwrap();
    let net = made(&robot, &[]);
    let names: Vec<_> = net.places.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names, ["Wait", "Drive", "Security", "Safe"]);
    let all = moves(&net);
    assert!(all.contains(&("Wait", "drive_wanted", "Drive", vec!["start_drive"])));
    assert!(all.contains(&("Drive", "drive_done", "Wait", vec![])));
}

/// The delivery with an objective of another name.
fn renamed(to: &str) -> Result<Mission, String> {
    let text = embedded::mission("delivery").unwrap().text;
    let text = text.replace("id = \"DriveB\"", &format!("id = \"{to}\""));
    Mission::parse("mission.toml", &text).map_err(|errors| errors.to_string())
}

#[test]
fn a_name_of_an_objective_that_the_supervisor_has_itself_is_refused() {
    assert_eq!(RESERVED, ["Wait", "Done", "Security", "Safe"]);
    for name in RESERVED {
        let said = renamed(name).unwrap_err();
        let expected = format!("the supervisor of every mission has a place `{name}` of its own");
        assert!(said.contains(&expected) && said.ends_with("help: rename the objective"), "{said}");
    }
    // Places of the other supervisors are none of its own.
    for name in ["Drive", "wait", "Waits", "Idle", "Granted"] {
        assert!(renamed(name).is_ok(), "{name}");
    }
}

#[test]
fn two_names_of_objectives_that_are_one_place_are_refused() {
    let said = renamed("DriveA").unwrap_err();
    assert!(said.contains("the objective `DriveA` is defined twice"), "{said}");
    for (other, place) in [("Drive.A", "Drive_A"), ("Drive-A", "Drive_A"), ("Drive_A", "Drive_A")] {
        let text = embedded::mission("delivery").unwrap().text;
        let text = text.replace("id = \"DriveA\"", &format!("id = \"{place}\""));
        let text = text.replace("id = \"DriveB\"", &format!("id = \"{other}\""));
        let said = Mission::parse("mission.toml", &text).unwrap_err().to_string();
        let expected = if other == place {
            "the objective `Drive_A` is defined twice".to_owned()
        } else {
            format!("`{place}` and `{other}` are one place `{place}` of the supervisor")
        };
        assert!(said.contains(&expected), "{said}");
    }
}

#[test]
fn the_largest_mission_has_a_supervisor_and_one_objective_more_is_refused() {
    assert_eq!(MAX_STEPS, 250);
    let mut file = File::right(0);
    file.lengthen(MAX_STEPS);
    let mission = read(&file.to_string());
    assert_eq!(mission.objectives.len(), MAX_STEPS);
    let net = global(&mission);
    check(&mission, &net);
    assert_eq!((net.places.len(), net.transitions.len()), (254, 251 + 2 * 252 + 1));

    file.lengthen(MAX_STEPS + 1);
    let errors = Mission::parse("mission.toml", &file.to_string()).unwrap_err();
    let said = "a mission under supervisors has at most 250 objectives";
    let first = &errors.diagnostics()[0];
    assert_eq!((errors.diagnostics().len(), first.message.as_str()), (1, said));
}

#[test]
fn a_plain_mission_may_have_any_names_and_any_number_of_objectives() {
    let mut file = File::right(0);
    file.lengthen(MAX_STEPS + 1);
    file.objectives[0].id = "Safe".into();
    (file.objectives[1].id, file.objectives[2].id) = ("to.A".into(), "to-A".into());
    file.plain();
    let mission = read(&file.to_string());
    assert_eq!((mission.is_supervised(), mission.objectives.len()), (false, MAX_STEPS + 1));
}
