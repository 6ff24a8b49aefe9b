//! Six ways to break the decisional level, each found in as few rounds as there can be.

use crate::asked::{ASKED, shortest};
use crate::reconstruction::reconstruction;
use cotama_core::net::{Net, Role, Transition};
use cotama_core::system::{Component, System};
use cotama_verification::explicit::{Graph, Limits};
use cotama_verification::flat::{Size, rounds};
use cotama_verification::pt::Pt;

/// Changes transitions of nets; test data, which lives to the end.
fn with(change: impl Fn(&Component<'static>, &mut Transition<'static>)) -> System<'static> {
    let components = reconstruction::SYSTEM.components.iter().map(|it| {
        let mut transitions = it.net.transitions.to_vec();
        transitions.iter_mut().for_each(|transition| change(it, transition));
        let net: &'static Net<'static> =
            Box::leak(Box::new(Net { transitions: transitions.leak(), ..*it.net }));
        Component { name: it.name, net }
    });
    System { components: components.collect::<Vec<_>>().leak(), ..reconstruction::SYSTEM }
}

/// Without these guards of these transitions, `net.transition` and whatever follows it.
fn unguarded(from: &[&str], guards: &[&str]) -> System<'static> {
    with(|it, transition| {
        let name = format!("{}.{}", it.name, transition.name);
        if from.contains(&name.as_str()) {
            let places = it.net.places;
            let kept = transition.read.iter().copied().filter(|arc| {
                let place = &places[arc.place.0 as usize];
                let of = if let Role::Complement(of) = place.role {
                    &places[of.0 as usize]
                } else {
                    place
                };
                !guards.contains(&of.name)
            });
            let before = transition.read.len();
            transition.read = kept.collect::<Vec<_>>().leak();
            assert_eq!(
                before - transition.read.len(),
                guards
                    .iter()
                    .filter(|guard| it.net.places.iter().any(|place| place.name == **guard))
                    .count(),
                "{name}"
            );
        }
    })
}

/// Checks the violated laws, the number of rounds, and the events from outside in them.
fn found(system: &System<'_>, size: (u64, u64), violated: &[(&str, &str)]) {
    let plain = rounds(system).unwrap();
    let net = plain.net().unwrap();
    let graph = Graph::new(&Pt::from(&net.view().net()), &Limits::default(), &|_| ()).unwrap();
    assert_eq!(plain.size(&graph), Size { states: size.0, edges: size.1 });
    let found = ASKED.iter().filter_map(|asked| {
        let (rounds, pt, property) = asked.of(system);
        Some((asked.name, shortest(&rounds, &pt, &property)?.join(" ")))
    });
    let found: Vec<_> = found.collect();
    let found: Vec<_> = found.iter().map(|(name, events)| (*name, events.as_str())).collect();
    assert_eq!(found, violated);
}

const GOALS: [&str; 4] = ["ls.l3", "ls.l11", "gom.goal", "gom.operator_goal"];

#[test]
#[ignore = "seconds: CI runs it"]
fn as_written_nothing_is_violated() {
    found(
        &reconstruction::SYSTEM,
        (
            cotama_golden::figure("reconstruction.states"),
            cotama_golden::figure("reconstruction.steps"),
        ),
        &[],
    );
}

#[test]
#[ignore = "a minute: CI runs it"]
fn without_the_guard_of_completion_a_goal_is_reached_while_a_report_waits() {
    found(
        &unguarded(&GOALS, &["local_pending", "global_pending"]),
        (4_206, 23_226),
        &[
            ("LS3", "mission_received path_ready ambiguous goal_reached idle"),
            ("LS5", "mission_received path_ready ambiguous goal_reached"),
        ],
    );
}

#[test]
#[ignore = "a minute: CI runs it"]
fn a_guard_that_forgets_the_global_event_is_found() {
    found(
        &unguarded(&GOALS, &["global_pending"]),
        (4_190, 23_042),
        &[("LS5", "mission_received path_ready lose_wifi ambiguous goal_reached")],
    );
}

#[test]
#[ignore = "a minute: CI runs it"]
fn a_start_that_ignores_the_module_status_is_found() {
    found(
        &unguarded(&["pf.a1"], &["sonar", "mcl"]),
        (6_822, 38_088),
        &[
            ("AS2", "mission_received lose_mcl path_ready idle idle"),
            ("AS7", "mission_received lose_sonar path_ready"),
        ],
    );
}

#[test]
#[ignore = "a minute: CI runs it"]
fn a_local_event_without_an_operator_is_found() {
    let local = |net: &Net<'_>| net.outputs.iter().position(|it| it.name == "local_event");
    let mutant = with(|it, transition| {
        let escalated =
            ["ambiguous2", "ambiguous4", "collision2", "collision4", "planner2", "camera2"];
        if it.name == "cs" && escalated.contains(&transition.name) {
            let local = local(it.net).unwrap() as u32;
            transition.emits = vec![cotama_core::net::OutputId(local)].leak();
        }
    });
    found(&mutant, (4_294, 23_290), &[("CS5", "mission_received lose_wifi ambiguous idle")]);
}

#[test]
#[ignore = "a minute: CI runs it"]
fn teleoperation_without_a_camera_is_found() {
    let mutant = unguarded(&["ls.l7"], &["camera", "wifi"]);
    let both = System {
        components: mutant
            .components
            .iter()
            .zip(unguarded(&["gom.teleoperate"], &["camera"]).components)
            .map(|(one, other)| if one.name == "gom" { *other } else { *one })
            .collect::<Vec<_>>()
            .leak(),
        ..mutant
    };
    found(
        &both,
        (4_408, 24_344),
        &[
            ("AS2", "mission_received ambiguous lose_camera op_teleoperate idle idle"),
            ("CS4", "mission_received ambiguous lose_camera op_teleoperate lose_sonar idle"),
        ],
    );
}

#[test]
#[ignore = "a minute: CI runs it"]
fn an_abort_that_keeps_a_pending_start_is_found() {
    let clears = reconstruction::SYSTEM.clears;
    let events = reconstruction::SYSTEM.components[1].net.events;
    let kept =
        clears.iter().copied().filter(|it| events[it.mailbox.0 as usize].name != "start_drive");
    let mutant = System { clears: kept.collect::<Vec<_>>().leak(), ..reconstruction::SYSTEM };
    found(
        &mutant,
        (6_644, 37_565),
        &[
            ("GS2", "lose_vital mission_received idle"),
            ("GS4", "lose_vital mission_received idle"),
            ("AS2", "lose_vital mission_received idle idle idle"),
            ("CS4", "lose_vital mission_received path_ready too_slow idle"),
            ("CS5", "lose_vital mission_received ambiguous idle lose_wifi idle idle"),
        ],
    );
}
