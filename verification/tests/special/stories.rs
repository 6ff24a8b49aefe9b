//! Small nets whose answers can be seen.

use super::own::{Move, Own};
use cotama_verification::certificate::{Certificate, Evidence, Question as Asked, verify};
use cotama_verification::check::{Model, Options, Verdict, check};
use cotama_verification::explicit::{Limit, Limits, statespace};
use cotama_verification::property::parse;
use cotama_verification::pt::Pt;

fn arc(name: &str, take: &[(usize, u32)], give: &[(usize, u32)]) -> Move {
    Move { name: name.to_owned(), take: take.to_vec(), give: give.to_vec(), ..Move::default() }
}

fn own(places: &[(&str, u32)], moves: Vec<Move>) -> Own {
    Own { places: places.iter().map(|it| (it.0.to_owned(), it.1)).collect(), moves }
}

/// A robot drives only while nobody is in its room.
fn gate(guarded: bool) -> Pt {
    let mut drive = arc("drive", &[(0, 1)], &[(1, 1)]);
    if guarded {
        drive.inhibit = vec![(2, 1)];
    }
    let stop = arc("stop", &[(1, 1)], &[(0, 1)]);
    let mut enter = arc("enter", &[], &[(2, 1)]);
    enter.inhibit = vec![(2, 2), (1, 1)];
    let leave = arc("leave", &[(2, 1)], &[]);
    own(&[("idle", 1), ("moving", 0), ("human", 0)], vec![drive, stop, enter, leave]).pt()
}

fn holds(pt: &Pt, text: &str) -> bool {
    let model = Model::from(pt.clone());
    let asked = parse(text, pt).unwrap();
    let answer = check(&model, &asked, &Options { evidence: true, ..Options::default() });
    let certificate = answer.certificate(pt, &asked).unwrap();
    verify(&certificate.text()).unwrap();
    answer.verdict == Verdict::Holds(true)
}

#[test]
fn an_inhibitor_arc_keeps_the_robot_from_driving() {
    assert!(holds(&gate(true), "AG !(moving & human >= 1)"));
    assert!(!holds(&gate(false), "AG !(moving & human >= 1)"));
    assert!(holds(&gate(true), "EF moving"));
    assert!(holds(
        &gate(true),
        "AG (human >= 1 -> !is-fireable(drive))".replace("is-fireable", "fireable").as_str()
    ));
    assert!(holds(&gate(true), "deadlock_free"));
}

#[test]
fn tokens_below_the_weight_inhibit_nothing() {
    let pt = gate(true);
    // Two can come in, each while fewer than two are there.
    assert!(holds(&pt, "EF human = 2"));
    assert!(holds(&pt, "AG human <= 2"));
}

#[test]
fn firing_takes_then_empties_then_gives() {
    let mut swap = arc("swap", &[(0, 2)], &[(0, 1), (1, 1)]);
    swap.reset = vec![0];
    let net = own(&[("heap", 5), ("done", 0)], vec![swap]);
    let pt = net.pt();
    assert_eq!(pt.fire(&pt.initial, 0), Some(vec![1, 1]));
    assert_eq!(net.fire(&pt.initial, 0), Some(vec![1, 1]));
    assert!(holds(&pt, "AF (heap = 1 & done = 1 & deadlock)"));
}

#[test]
fn a_reset_of_an_empty_place_needs_no_token() {
    let mut clear = arc("clear", &[(1, 1)], &[]);
    clear.reset = vec![0];
    let pt = own(&[("heap", 0), ("go", 1)], vec![clear]).pt();
    assert!(holds(&pt, "EF (go = 0 & heap = 0)"));
}

#[test]
fn a_place_that_is_read_and_emptied_is_asked_before() {
    let mut it = arc("it", &[], &[(1, 1)]);
    (it.read, it.reset) = (vec![(0, 1)], vec![0]);
    let pt = own(&[("heap", 3), ("done", 0)], vec![it]).pt();
    assert!(holds(&pt, "AG done <= 1"));
    assert!(holds(&pt, "AF deadlock"));
}

#[test]
fn the_transition_of_the_higher_priority_goes_first() {
    let dock = Move { priority: 2, ..arc("dock", &[(0, 1)], &[(1, 1)]) };
    let go_on = Move { priority: 1, ..arc("go_on", &[(0, 1)], &[(2, 1)]) };
    let pt = own(&[("low", 1), ("charging", 0), ("flat", 0)], vec![dock, go_on]).pt();
    assert!(holds(&pt, "AG flat = 0"));
    assert!(!holds(&pt, "EF fireable(go_on)"));
}

#[test]
fn a_place_that_grows_is_seen_where_it_inhibits_nothing() {
    let mut make = arc("make", &[], &[(0, 1)]);
    make.inhibit = vec![(1, 1)];
    let pt = own(&[("heap", 0), ("full", 0)], vec![make.clone()]).pt();
    let space = statespace(&pt, &Limits::default(), 1, &|_| ());
    assert_eq!((space.bounded, space.limit), (Some(false), Some(Limit::Unbounded)));
    // The transition is stopped by its own tokens.
    make.inhibit = vec![(0, 7)];
    let pt = own(&[("heap", 0), ("full", 0)], vec![make]).pt();
    let space = statespace(&pt, &Limits::default(), 1, &|_| ());
    assert_eq!((space.bounded, space.states, space.max_place), (Some(true), 8, 7));
}

#[test]
fn a_certificate_says_what_inhibits_and_empties() {
    let mut it = Move { priority: 3, ..arc("it", &[(0, 1)], &[]) };
    (it.inhibit, it.reset) = (vec![(1, 2)], vec![1]);
    let pt = own(&[("a", 1), ("b", 0)], vec![it, arc("other", &[(1, 1)], &[])]).pt();
    let text = Certificate::of(&pt, "", Asked::Live, false, Evidence::Graph(2)).text();
    let said = r#""take":[["a",1]],"give":[],"inhibit":[["b",2]],"reset":["b"],"priority":3}"#;
    assert!(text.contains(said), "{text}");
    assert!(!verify(&text).unwrap().verdict);
    // A proof from sums alone says nothing of such a net.
    let refuted = text.replace(r#"{"graph":2}"#, r#"{"refutation":{"facts":[],"cases":[]}}"#);
    let refuted = refuted.replace(
        r#""question":"live""#,
        r#""question":{"formula":{"E":{"F":{"at_most":{"constant":2,"weights":[["a",-1]]}}}}}"#,
    );
    let error = verify(&refuted).unwrap_err();
    assert_eq!(error.message, "inhibitor arcs, reset arcs and priorities are not in inequalities");
}
