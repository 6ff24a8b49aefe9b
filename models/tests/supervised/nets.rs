//! Mutants of generated supervisors: each is found by the check on load.

use crate::file::File;
use cotama_core::net::owned::{OwnedNet, OwnedTransition};
use cotama_core::net::{Arc, EventId, OutputId, PlaceId};
use cotama_models::missions::mission_net::{
    MAX_OBJECTIVES, MissionNetError, check, global_supervisor,
};
use cotama_models::missions::{Mission, embedded};

/// Every net that differs from this one in one arc, event, output or token.
fn mutants(net: &OwnedNet) -> Vec<(String, OwnedNet)> {
    let mut mutants = Vec::new();
    let mut add = |what: String, change: &dyn Fn(&mut OwnedNet)| {
        let mut mutant = net.clone();
        change(&mut mutant);
        mutants.push((what, mutant));
    };
    let ids = |count: usize| 0..count as u32;
    for (number, transition) in net.transitions.iter().enumerate() {
        let name = &transition.name;
        add(format!("{name} takes nothing"), &|it| it.transitions[number].take.clear());
        add(format!("{name} gives nothing"), &|it| it.transitions[number].give.clear());
        add(format!("{name} has no event"), &|it| it.transitions[number].on = None);
        add(format!("no {name}"), &|it| drop(it.transitions.remove(number)));
        for place in ids(net.places.len()).map(PlaceId) {
            if transition.take[0].place != place {
                add(format!("{name} takes from {place:?}"), &|it| {
                    it.transitions[number].take[0].place = place;
                });
            }
            if transition.give[0].place != place {
                add(format!("{name} gives to {place:?}"), &|it| {
                    it.transitions[number].give[0].place = place;
                });
            }
        }
        for event in
            ids(net.events.len()).map(EventId).filter(|&event| transition.on != Some(event))
        {
            add(format!("{name} on {event:?}"), &|it| it.transitions[number].on = Some(event));
        }
        for output in ids(net.outputs.len()).map(OutputId) {
            add(format!("{name} and {output:?}"), &|it| {
                let emits = &mut it.transitions[number].emits;
                match emits.iter().position(|&other| other == output) {
                    Some(at) => drop(emits.remove(at)),
                    None => emits.push(output),
                }
            });
        }
    }
    for place in 0..net.places.len() {
        add(format!("a token more or less in {place}"), &|it| {
            let place = &mut it.places[place];
            place.initial = 1 - place.initial;
        });
        if net.places[place].initial == 0 {
            add(format!("starts in {place}"), &|it| {
                for (at, it) in it.places.iter_mut().enumerate() {
                    it.initial = u32::from(at == place);
                }
            });
        }
    }
    for ignored in 0..net.ignored.len() {
        add(format!("ignores {ignored} less"), &|it| it.ignored.truncate(ignored));
    }
    mutants
}

fn found(text: &str) -> usize {
    let mission = Mission::parse("mission", text).unwrap();
    let net = mission.supervisor().unwrap();
    let mutants = mutants(net);
    for (what, mutant) in &mutants {
        let faults = check(&mutant.view().net(), &mission.objectives);
        assert!(faults.is_err_and(|faults| !faults.is_empty()), "not found: {what}");
    }
    mutants.len()
}

#[test]
fn every_mutant_of_the_delivery_is_found() {
    assert_eq!(
        found(embedded::mission("delivery").unwrap().text),
        cotama_golden::figure::<usize>("supervised.mutants")
    );
}

#[test]
fn every_mutant_of_generated_missions_is_found() {
    let counts: Vec<_> = (0..10).map(|seed| found(&File::right(seed).to_string())).collect();
    assert_eq!(counts, [1773, 2133, 1293, 549, 989, 2325, 1949, 549, 1445, 1149]);
}

#[test]
fn an_event_ignored_only_under_a_guard_is_found() {
    let mission = embedded::mission("delivery").unwrap();
    let mission = Mission::parse(mission.name, mission.text).unwrap();
    for ignored in 0..2 {
        let mut net = mission.supervisor().unwrap().clone();
        net.ignored[ignored] = net.ignored[ignored].clone().guard(PlaceId(0), 1);
        let faults = check(&net.view().net(), &mission.objectives).unwrap_err();
        assert_eq!(faults.len(), 1, "{ignored}: {faults:?}");
    }
}

#[test]
fn a_transition_that_does_more_than_move_the_token_is_named() {
    let mission = embedded::mission("delivery").unwrap();
    let mission = Mission::parse(mission.name, mission.text).unwrap();
    let told = |change: &dyn Fn(&mut OwnedTransition)| {
        let mut net = mission.supervisor().unwrap().clone();
        change(&mut net.transitions[0]);
        let name = net.transitions[0].name.clone();
        let faults = check(&net.view().net(), &mission.objectives).unwrap_err();
        let plain = format!("`{name}` does not just wait for an event and move the token");
        faults.iter().any(|it| it.to_string() == plain)
    };
    assert!(told(&|it| it.read.push(Arc { place: PlaceId(1), weight: 1 })));
    assert!(told(&|it| it.on = None));
    assert!(!told(&|it| it.emits.clear()));
}

#[test]
fn the_objective_that_could_block_is_named() {
    let delivery = embedded::mission("delivery").unwrap();
    let mission = Mission::parse(delivery.name, delivery.text).unwrap();
    let mut net = global_supervisor(&mission.objectives).unwrap();
    net.transitions.remove(2); // the object is received, and nothing happens
    let faults = check(&net.view().net(), &mission.objectives).unwrap_err();
    let told: Vec<_> = faults.iter().map(ToString::to_string).collect();
    let expected = [
        "`Receive` could block: from there `Done` is out of reach",
        "`DriveB` is never reached",
        "`Deliver` is never reached",
        "`Done` is never reached",
        "in `Receive` the event `object_received` leads nowhere, not to `DriveB`",
    ];
    assert_eq!(told, expected);
}

#[test]
fn objectives_that_no_supervisor_can_have_are_refused() {
    let delivery = embedded::mission("delivery").unwrap();
    let mission = Mission::parse(delivery.name, delivery.text).unwrap();
    assert_eq!(global_supervisor(&[]), Err(MissionNetError::Empty));
    let twice: Vec<_> = mission.objectives.iter().chain(&mission.objectives).cloned().collect();
    assert_eq!(global_supervisor(&twice), Err(MissionNetError::Name { objective: 4 }));
    let objectives = MAX_OBJECTIVES + 1;
    let many = vec![mission.objectives[0].clone(); objectives];
    assert_eq!(global_supervisor(&many), Err(MissionNetError::TooMany { objectives }));
    let patrol = embedded::mission("patrol").unwrap();
    let plain = Mission::parse(patrol.name, patrol.text).unwrap();
    assert_eq!(plain.supervisor(), None);
    assert_eq!(
        global_supervisor(&plain.objectives),
        Err(MissionNetError::NotSupervised { objective: 0 })
    );
}

#[test]
fn the_largest_mission_has_a_supervisor() {
    let mut file = File::right(0);
    file.lengthen(MAX_OBJECTIVES);
    let mission = Mission::parse("largest", &file.to_string()).unwrap();
    assert_eq!(mission.objectives.len(), MAX_OBJECTIVES);
    let net = mission.supervisor().unwrap();
    let explored = check(&net.view().net(), &mission.objectives).unwrap();
    assert_eq!((explored.markings, explored.firings), (254, 504));
}
