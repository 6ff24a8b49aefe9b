//! Every law of 20,000 random nets, judged and played.

use crate::by_the_player::{CLOCKS, Explored, Fired, Program, Trouble, start};
use crate::draw::Draw;
use crate::random::{Random, net, with_others};
use cotama_core::net::{
    Culprit, Graph, Known, Law, Net, Step, Transition, TransitionId, Violation, judge,
};
use cotama_core::player::{Kind, Packed, Program as _};
use cotama_core::system::{Component, System};
use cotama_core::units::Millis;
use std::collections::BTreeMap;

const NETS: usize = 20_000;

fn name(law: &Law<'_>) -> &'static str {
    match law {
        Law::Invariant { .. } => "invariant",
        Law::NeverBoth(..) => "never_both",
        Law::Reachable(_) => "reachable",
        Law::AlwaysCan(_) => "always_can",
        Law::HandlesAll => "handles(all)",
        Law::Settles => "settles",
        Law::DeadlockFree { end: None } => "deadlock_free",
        Law::DeadlockFree { end: Some(_) } => "deadlock_free_except",
        Law::Deterministic => "deterministic",
    }
}

/// Walks the way of a violation with a player of the net with others: it fires what it says.
fn walk<'n>(net: &Net<'_>, both: &Net<'n>, program: &Program<'n>, violation: &Violation<'_, 1>) {
    let mut log = vec![];
    let mut player = start(program, |id| log.push(id));
    let mut expected = vec![];
    let mut now = 0;
    let mut marking: Vec<u32> = net.places.iter().map(|it| it.initial).collect();
    let steps = match violation.culprit {
        Culprit::Bound { .. } => violation.way.steps().len() - 1,
        Culprit::Forever { repeats } => violation.way.steps().len() - repeats,
        _ => violation.way.steps().len(),
    };
    for step in &violation.way.steps()[..steps] {
        let mut observer = |it: &Fired<'_, 'n>| log.push(it.id.id);
        assert!(expected.len() <= SHORT);
        let _ = player.advance_with(Millis(now), &mut observer);
        let id = match *step {
            Step::Passes(time) => {
                now += time;
                continue;
            }
            Step::Fires(id) => id,
            Step::Raised(place) | Step::Lowered(place) => {
                let up = matches!(step, Step::Raised(_));
                let other = |it: &&Transition<'_>| {
                    it.name == "other" && (if up { it.give } else { it.take })[0].place == place
                };
                TransitionId(both.transitions.iter().position(|it| other(&it)).unwrap() as u32)
            }
        };
        let it = &both.transitions[id.0 as usize];
        expected.push(id);
        if let Some(event) = it.on {
            assert!(
                player.offer_with(Millis(now), &event.id(), &mut observer).fired(),
                "{violation:?}"
            );
        }
        it.take.iter().for_each(|arc| marking[arc.place.0 as usize] -= arc.weight);
        it.give.iter().for_each(|arc| marking[arc.place.0 as usize] += arc.weight);
    }
    let mut observer = |it: &Fired<'_, 'n>| log.push(it.id.id);
    let _ = player.advance_with(Millis(now), &mut observer);
    assert_eq!(expected, log[..expected.len()]);
    let shown: Vec<u32> =
        program.code().fields.iter().map(|it| it.of(&violation.marking)).collect();
    assert_eq!(marking, shown);
}

/// Longer than any way of a small net.
const SHORT: usize = 200;

#[test]
fn laws_of_random_nets_agree_with_the_player() {
    let mut random = Random(Draw::new(14));
    // How often each verdict was no and yes.
    let mut verdicts: BTreeMap<&str, [usize; 2]> = BTreeMap::new();
    // Counts of `handles(all)` where an `ignore` has a guard.
    let mut guarded = [0; 2];
    for number in 0..NETS {
        let owned = net(&mut random);
        let both = with_others(&owned);
        let (view, both_view) = (owned.view(), both.view());
        let (net, both) = (view.net(), both_view.net());
        assert_eq!(both.defect(), None);
        let packed = Packed::<1, CLOCKS>::alone(&net).unwrap();
        let both_packed = Packed::<1, CLOCKS>::alone(&both).unwrap();
        let alone = [Component::alone(&both)];
        let (code, program) = (packed.code(), &both_packed.load(&System::alone(&alone)));
        let graph = Graph::of(&net, &code);
        let settles = graph.settles(&net, &code);
        if let Err(violation) = &settles
            && !matches!(violation.culprit, Culprit::TooLarge(_))
        {
            walk(&net, &both, program, violation);
        }
        let mut count = |law: &'static str, holds: bool| {
            verdicts.entry(law).or_default()[usize::from(holds)] += 1;
        };
        let explored = Explored::of(&both, program, 30_000);
        let explored = match (explored, settles) {
            (Err(Trouble::TooMany), _) => {
                count("small", false);
                continue;
            }
            (explored, Err(Violation { culprit, .. })) => {
                match culprit {
                    Culprit::TooLarge(_) => count("explored", false),
                    Culprit::Bound { .. } => {
                        count("bounds", false);
                        assert_eq!(explored.err(), Some(Trouble::Bound), "{number}: {net:#?}");
                    }
                    _ => {
                        count("settles", false);
                        assert_eq!(explored.err(), Some(Trouble::Forever), "{number}: {net:#?}");
                    }
                }
                continue;
            }
            (Err(trouble), Ok(_)) => panic!("{number}: {trouble:?} {net:#?}"),
            (Ok(explored), Ok(settle)) => {
                assert_eq!(explored.settle, settle, "{number}: {net:#?}");
                explored
            }
        };
        for law in ["small", "explored", "bounds", "settles"] {
            count(law, true);
        }
        let mut any = false;
        for law in net.laws {
            let violation = graph.breaks(&net, &code, law);
            if let Some(violation) = &violation {
                if matches!(violation.culprit, Culprit::TooLarge(_)) {
                    count("decided", false);
                    any = true;
                    continue;
                }
                if !matches!(law, Law::Reachable(_)) {
                    walk(&net, &both, program, violation);
                }
            }
            count("decided", true);
            count(name(law), violation.is_none());
            if matches!(law, Law::HandlesAll) && net.ignored.iter().any(|it| !it.guard.is_empty()) {
                guarded[usize::from(violation.is_none())] += 1;
            }
            any |= violation.is_some();
            let holds = explored.holds(&net, law);
            assert_eq!(violation.is_none(), holds, "{number}: {law:?} of {net:#?}");
        }
        match judge(&net, &code) {
            Err(_) => assert!(any),
            Ok(known) => {
                assert!(!any);
                let firings = explored.firings.len();
                let markings = explored.markings.len();
                let settle = explored.settle;
                assert_eq!(known, Known::Explored { markings, firings, settle }, "{net:#?}");
            }
        }
    }
    // Neither verdict is rare, and nothing is left out.
    assert!(guarded.iter().all(|&it| it >= 500), "{guarded:?}");
    for (law, [no, yes]) in verdicts {
        let (least, most) = match law {
            "small" | "explored" | "decided" => (0, 0),
            _ => (1_000, usize::MAX),
        };
        assert!((least..=most).contains(&no) && yes >= 1_000, "{law}: {no} no, {yes} yes");
    }
}
