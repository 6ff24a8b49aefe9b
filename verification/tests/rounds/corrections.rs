//! The decisional level with one rule of the papers taken back at a time: a requirement is broken,
//! and the shortest path there is named, one event from outside a round.

use crate::breaks::broken;
use crate::delivery::watched;
use crate::golden;
use crate::steps::in_one_marking;
use cotama_core::net::{Arc, Net, OutputId, Role, Transition};
use cotama_core::system::{Component, System};
use cotama_models::cotama::{REQUIREMENTS, delivery};
use cotama_verification::explicit::{Goal, Graph, Limits};
use cotama_verification::flat::rounds;
use cotama_verification::property::{Formula, Question, parse};
use cotama_verification::pt::Pt;

/// The events from outside on a shortest path to where a requirement is broken; none if it holds.
fn counterexample(system: &System<'_>, id: &str) -> Option<Vec<String>> {
    let asked = REQUIREMENTS.iter().find(|it| it.id == id).unwrap().asked.unwrap();
    let rounds = watched(&rounds(system).unwrap(), asked.watches).unwrap();
    let pt = Pt::from(&rounds.net().unwrap().view().net());
    let Question::Formula(formula) = parse(asked.text, &pt).unwrap().question else { panic!() };
    let Formula::All(path) = formula.simplified() else { panic!("{id}") };
    let Formula::Globally(law) = *path else { panic!("{id}") };
    let never = Formula::Not(in_one_marking(&law, &pt).unwrap().into());
    let graph = Graph::new(&pt, &Limits::default(), &|_| ()).unwrap();
    let way = rounds.path(&graph, Goal::new(&never).unwrap())?;
    let event = |it: Option<(Option<String>, String)>| match it {
        Some((Some(event), _)) => event.split('.').next_back().unwrap().to_owned(),
        _ => "idle".to_owned(),
    };
    Some(rounds.told(&way).into_iter().map(|it| event(it.outside)).collect())
}

/// The shipped system with one transition, `net.transition`, and its variants changed; test data,
/// which lives to the end.
fn with(
    name: &str,
    change: impl Fn(&'static Net<'static>, &mut Transition<'static>),
) -> System<'static> {
    let (net, transition) = name.split_once('.').unwrap();
    let mut components = delivery::SYSTEM.components.to_vec();
    let it = components.iter_mut().find(|it| it.name == net).unwrap();
    let mut transitions = it.net.transitions.to_vec();
    let named = transitions.iter_mut().filter(|it| it.name.split('.').next() == Some(transition));
    assert_ne!(named.map(|of| change(it.net, of)).count(), 0, "{name}");
    let net = Box::leak(Box::new(Net { transitions: transitions.leak(), ..*it.net }));
    *it = Component { name: it.name, net };
    System { components: components.leak(), ..delivery::SYSTEM }
}

/// Returns the system with a transition that emits nothing.
fn silent(name: &str) -> System<'static> {
    with(name, |_, it| it.emits = &[])
}

/// Returns the system with a transition that does not read this flag.
fn without(name: &str, flag: &str) -> System<'static> {
    with(name, |net, it| {
        let is_it = |arc: &Arc| {
            let place = &net.places[arc.place.0 as usize];
            let of = if let Role::Complement(of) = place.role { of } else { arc.place };
            net.places[of.0 as usize].name == flag
        };
        let kept: Vec<_> = it.read.iter().copied().filter(|arc| !is_it(arc)).collect();
        assert_ne!(kept.len(), it.read.len(), "{name} does not look at {flag}");
        it.read = kept.leak();
    })
}

/// Checks the counterexample to the requirement that a change breaks.
fn found(what: &str, system: &System<'_>, id: &str, way: &str) {
    let expected: Vec<_> = way.split(' ').map(str::to_owned).collect();
    assert_eq!(counterexample(system, id), Some(expected), "{what}: {id}");
}

/// The table as it was: an observer that stops observing is nobody's news.
#[test]
#[ignore = "a minute: CI runs it"]
fn a_watch_that_is_lost_in_silence_lets_the_operator_drive_blind() {
    let mutant = silent("faults.watch");
    let way = "mission_received drift lose_watch teleoperate idle idle";
    found("nobody is told", &mutant, "OB1", way);
    found("nobody is told", &mutant, "GM1", "lose_watch idle");
}

/// The operator is told, and may drive all the same.
#[test]
fn a_start_of_the_operator_that_does_not_ask_for_the_camera_is_found() {
    let mutant = without("ls.l7", "camera");
    let way = "mission_received drift lose_watch teleoperate idle idle";
    found("camera not asked for", &mutant, "OB1", way);
}

/// Returns the system with a transition that goes from a place to another one.
fn moved(name: &str, from: &str, to: &str) -> System<'static> {
    with(name, |net, it| {
        let arc = |name| {
            let place = net.places.iter().position(|it| it.name == name).unwrap();
            Arc { place: cotama_core::net::PlaceId(place as u32), weight: 1 }
        };
        (it.take, it.give) = (vec![arc(from)].leak(), vec![arc(to)].leak());
    })
}

/// Weak and medium failures as they were: recorded, and nothing changes.
#[test]
#[ignore = "a minute: CI runs it"]
fn a_minor_failure_that_changes_nothing_is_found() {
    found("not told", &silent("gom.minor"), "CS3", "fail_slightly idle");
    let way = "mission_received path_ready fail_slightly idle";
    found("recorded only", &silent("cs.minor1"), "CS1", way);
    let way = "mission_received drift idle teleoperate fail_slightly idle";
    found("recorded only, driven", &silent("cs.minor2"), "CS1", way);
    for name in ["pf.m1", "pf.m2", "pf.m3", "pf.m4", "pf.m5", "to.m1", "to.m2"] {
        let mutant = silent(name);
        let said = REQUIREMENTS.iter().find(|it| it.id == "AS5").unwrap().said;
        assert!(said.iter().any(|it| it.unsaid(&mutant).next().is_some()), "{name}");
    }
}

/// The bump in a degraded sub-objective as it was: nothing to be asked.
#[test]
fn a_collision_in_the_degraded_set_that_is_recorded_is_found() {
    let way = "mission_received path_ready lose_sonar bump idle";
    found("recorded", &silent("cs.collision3"), "CS1", way);
}

/// A crashed avoidance as it was, and what may go wrong with the other one.
#[test]
#[ignore = "a minute: CI runs it"]
fn a_wrong_use_of_the_other_avoidance_is_found() {
    let smz = "mission_received path_ready lose_smz";
    found("not told", &silent("gom.smz"), "CS3", "lose_smz idle");
    found("recorded only", &silent("cs.smz1"), "CS1", &format!("{smz} idle"));
    let mutant = moved("pf.a17", "Optimal", "Degraded");
    found("avoidance is lost with it", &mutant, "AS5", &format!("{smz} idle idle"));
    let mutant = without("pf.a17", "avoidance");
    let way = "mission_received path_ready lose_avoidance lose_smz idle idle idle idle";
    found("it is not asked for", &mutant, "AS2", way);
    let mutant = without("pf.a1", "smz");
    found("started with what is lost", &mutant, "AS7", "mission_received lose_smz idle");
    let mutant = silent("cs.avoidance2");
    let way = format!("{smz} lose_avoidance idle");
    found("its loss is recorded only", &mutant, "CS1", &way);
    let mutant = silent("cs.mcl3");
    let way = format!("{smz} lose_mcl idle");
    found("lost localisation is recorded only", &mutant, "CS1", &way);
    let mutant = moved("pf.a25", "Reactive", "Odometric");
    let way = format!("{smz} lose_avoidance idle idle");
    found("odometry in its place", &mutant, "AS3", &way);
}

/// Returns the system with a transition that emits this in place of its outputs.
fn says(name: &str, output: &str) -> System<'static> {
    with(name, |net, it| {
        let output = net.outputs.iter().position(|it| it.name == output).unwrap();
        it.emits = vec![OutputId(output as u32)].leak();
    })
}

/// The rest of the corrections taken back, and the requirement that each breaks.
#[test]
#[ignore = "a minute: CI runs it"]
fn each_of_these_mutants_breaks_a_requirement() {
    let mutants = [
        ("a crash of the avoidance raises no flag", silent("faults.smz")),
        ("the other avoidance is not used from the start", moved("pf.a14", "Off", "Degraded")),
        ("nor does it matter whether the sonars work", without("pf.a3", "sonar")),
        ("nor whether it works itself", without("pf.a14", "avoidance")),
        ("with fewer particles avoidance is lost", moved("pf.a18", "Reduced", "Degraded")),
        ("it is used though it is lost", moved("pf.a19", "Optimal", "Reactive")),
        ("it is, with fewer particles", moved("pf.a20", "Reduced", "Reactive")),
        ("it is, without localisation", moved("pf.a21", "Odometric", "Reactive")),
        ("lost localisation leaves the lost avoidance", moved("pf.a23", "Reactive", "Odometric")),
        ("lost sonars do", moved("pf.a24", "Reactive", "Odometric")),
        ("lost sonars change nothing", moved("pf.a24", "Reactive", "Reactive")),
        ("a bump does not slow it down", silent("pf.a26")),
        ("it goes on when its activity ends", moved("pf.as5", "Reactive", "Reactive")),
        ("late localisation is recorded only", silent("cs.slow4")),
        ("at the floor of particles, too", silent("cs.slow5")),
        ("a bump raises no report", silent("gom.bumper")),
        ("a bump is ambiguous", says("gom.bumper", "ambiguous")),
        ("a bump without avoidance is the adapter's", says("cs.collision3", "adapt_bump")),
        ("a bump ends the mission", says("cs.collision3", "global_event")),
        ("a minor failure asks the operator", says("cs.minor1", "local_event")),
    ];
    let lines = mutants.iter().map(|(what, mutant)| match broken(mutant) {
        Ok(Some(id)) => format!("{what}: breaks {id}\n"),
        Ok(None) => format!("{what}: survives\n"),
        Err(error) => format!("{what}: refused: {error}\n"),
    });
    let table: String = lines.collect();
    golden("corrections.txt", &table);
    assert!(table.lines().all(|it| it.contains(": breaks ")), "{table}");
}
