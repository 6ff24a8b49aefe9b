//! Every net that comes with the crate, and every system, part by part; supervisors of missions
//! that are checked with a part changed.

use crate::draw::Draw;
use crate::efforts::Effort;
use crate::{below, chance, pick};
use cotama_core::net::owned::OwnedNet;
use cotama_core::net::{Arc, EventId, OutputId, PlaceId};
use cotama_models::missions::mission_net::{check, global_supervisor};
use cotama_models::missions::{Mission, embedded};
use cotama_models::nets::{Model, all, find};
use cotama_models::team::protocol;
use cotama_models::team::protocol::{Defect, Team};

#[test]
fn each_net_has_the_same_parts_and_each_wrong_name_the_same_advice() {
    let mut effort = Effort::new(1);
    for entry in all() {
        effort.note(&(entry.name, entry.description));
        match entry.model {
            Model::Defined { net, known } => {
                effort.note(&(net, known, known.settle(), known.bounded()));
                effort.count("transitions", net.transitions.len() as u64);
            }
            Model::Family(family) => {
                for n in (0..8).chain([family.least, family.most, family.most + 1]) {
                    let net = family.net(n).map_err(|it| (it, it.to_string()));
                    let net = net.map(|it| if n < 8 { it } else { OwnedNet::default() });
                    effort.count(
                        "transitions",
                        net.as_ref().map_or(0, |it| it.transitions.len()) as u64,
                    );
                    effort.note(&net);
                }
            }
        }
        effort.next();
    }
    let mut draw = Draw::new(111);
    for _ in 0..300 {
        let mut name: String = pick(&mut draw, all()).name.to_owned();
        if chance(&mut draw, 70) {
            name.remove(below(&mut draw, name.len()));
        }
        if chance(&mut draw, 50) {
            name += ":";
            name += *pick(&mut draw, &["5", "-1", "x", "", "0", "4294967296", "99999", "2"]);
        }
        let found = find(&name).map(|it| it.name);
        effort.note(&(found.clone().map_err(|it| it.to_string()), found));
    }
    effort.next();
    effort.compare("tests/golden/changed_nets.txt");
}

#[test]
fn teams_that_bid_have_the_same_nets_and_requirements() {
    let mut effort = Effort::new(1);
    let mut note = |team: &Team| {
        let net = protocol::net(team);
        effort.count("places", net.places.len() as u64);
        effort.count("transitions", net.transitions.len() as u64);
        effort.note(&(team, team.robots(), team.defects(), &net));
        effort.note(&protocol::requirements(team, &net));
        effort.note(&protocol::supervised(team));
        effort.note(&protocol::supervised_requirements(team));
        effort.next();
    };
    for robots in 0..=7 {
        for failures in 0..=2 {
            note(&Team::new(robots, failures));
        }
        note(&Team::new(robots, 1).without_old_messages());
    }
    note(&Team::rivals());
    for robots in [2, 3] {
        for &defect in Defect::ALL {
            note(&Team::new(robots, 1).with(&[defect]));
        }
        note(&Team::new(robots, 1).with(protocol::TEXT));
        note(&Team::rivals().with(protocol::TEXT).without_old_messages());
    }
    effort.compare("tests/golden/changed_teams.txt");
}

/// One part of a supervisor is changed.
fn change(draw: &mut Draw, net: &mut OwnedNet) {
    let place = PlaceId(below(draw, net.places.len()) as u32);
    let transition = below(draw, net.transitions.len());
    let (events, outputs) = (net.events.len(), net.outputs.len());
    let it = &mut net.transitions[transition];
    match draw.between(0, 9) {
        0 => it.take = vec![Arc { place, weight: 1 }],
        1 => it.give = vec![Arc { place, weight: 1 }],
        2 => it.on = Some(EventId(below(draw, events) as u32)),
        3 => it.on = None,
        4 if outputs > 0 => it.emits = vec![OutputId(below(draw, outputs) as u32)],
        5 => it.emits.clear(),
        6 => it.read.push(Arc { place, weight: 1 }),
        7 => drop(net.transitions.remove(transition)),
        8 => {
            let it = &mut net.places[place.0 as usize];
            it.initial = 1 - it.initial.min(1);
        }
        _ => {
            if !net.ignored.is_empty() {
                net.ignored.remove(below(draw, net.ignored.len()));
            }
        }
    }
}

#[test]
fn changed_supervisors_have_the_same_faults() {
    let (mut draw, mut effort) = (Draw::new(112), Effort::new(50));
    let delivery = embedded::mission("delivery").unwrap();
    let delivery = Mission::parse(delivery.name, delivery.text).unwrap();
    for _ in 0..1_000 {
        let mut objectives = delivery.objectives.clone();
        for _ in 0..draw.between(0, 3) {
            let (at, copied) = (below(&mut draw, objectives.len()), pick(&mut draw, &objectives));
            let copied = copied.clone();
            match draw.between(0, 2) {
                0 => objectives.insert(at, copied),
                1 if objectives.len() > 1 => drop(objectives.remove(at)),
                _ => objectives[at] = copied,
            }
        }
        let made = global_supervisor(&objectives);
        effort.note(&made.as_ref().map_err(ToString::to_string));
        if let Ok(mut net) = made {
            for _ in 0..draw.between(0, 2) {
                change(&mut draw, &mut net);
            }
            let view = net.view();
            if view.net().defect().is_none() {
                let found = check(&view.net(), &objectives);
                effort.count("sound", u64::from(found.is_ok()));
                effort.count("faulty", u64::from(found.is_err()));
                let said = found
                    .as_ref()
                    .map_err(|it| it.iter().map(ToString::to_string).collect::<Vec<_>>());
                effort.note(&(&said, &found));
            }
        }
        effort.next();
    }
    effort.compare("tests/golden/changed_supervisors.txt");
}
