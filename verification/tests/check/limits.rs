//! Every engine keeps the limits, and what is known is said.

use cotama_checker::explicit::{Explicit, Limit, Limits};
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_verification::check::{Answer, Choice, Model, Options, Verdict, check};
use cotama_verification::engines::{Budget, Engine, Extent, Found, Known, Reason, Task};
use cotama_verification::property;
use cotama_verification::pt::Pt;
use std::time::{Duration, Instant};

/// A net of these transitions: from a place to a place.
fn moves(places: usize, moves: impl Iterator<Item = (usize, usize)>) -> Pt {
    let mut net = OwnedNet::new("moves", "");
    let place = |it| OwnedPlace::new(&format!("p{it}"), u32::from(it == 0));
    let places: Vec<_> = (0..places).map(|it| net.place(place(it)).unwrap()).collect();
    for (number, (from, to)) in moves.enumerate() {
        let it = OwnedTransition::new(&format!("t{number}"));
        net.transition(it.take(places[from], 1).give(places[to], 1)).unwrap();
    }
    Pt::from(&net.view().net())
}

fn ring(places: usize) -> Model {
    moves(places, (0..places).map(|it| (it, (it + 1) % places))).into()
}

fn ask(model: &Model, text: &str, options: &Options<'_>) -> Answer {
    check(model, &property::parse(text, model.pt()).unwrap(), options)
}

fn verdict(model: &Model, text: &str) -> Verdict {
    ask(model, text, &Options::default()).verdict
}

#[test]
fn questions_to_a_ring_of_a_thousand_places_end_in_time() {
    let ring = ring(1_000);
    for text in ["EF deadlock", "AG !(p1 & p2)", "one_safe", "stable", "live", "quasi_live"] {
        let begun = Instant::now();
        let deadline = begun.checked_add(Duration::from_secs(1));
        let limits = Limits { deadline, bytes: 200 << 20, ..Limits::default() };
        ask(&ring, text, &Options { limits, ..Options::default() });
        // Some milliseconds more, on a machine that has nothing else to do.
        assert!(begun.elapsed() < Duration::from_secs(5), "{text}: {:?}", begun.elapsed());
    }
    // The optimised program took 18 s.
    let begun = Instant::now();
    assert_eq!(verdict(&ring, "EF deadlock"), Verdict::Holds(false));
    assert!(begun.elapsed() < Duration::from_secs(10), "{:?}", begun.elapsed());
}

#[test]
fn a_net_of_ten_thousand_places_is_searched_whole() {
    let ring = ring(10_000);
    let explicit = Options { engine: Choice::Explicit, ..Options::default() };
    let by_markings = |text| ask(&ring, text, &explicit);
    let answer = by_markings("EF p9999");
    assert_eq!((answer.verdict, answer.states), (Verdict::Holds(true), 10_000));
    assert_eq!(answer.run.unwrap().stem.len(), 9_999);
    let answer = by_markings("AG !(p1 & p2)");
    assert_eq!((answer.verdict, answer.states), (Verdict::Holds(true), 10_000));
    assert_eq!(by_markings("bounds(p0 + p1)").verdict, Verdict::Bound(Extent::Finite(1)));
    let known = [
        ("live", true),
        ("quasi_live", true),
        ("stable", false),
        ("AG EF p0", true),
        ("AG (p1 -> AF p9999)", true),
        ("A (G F p77)", true),
        ("AF AG p0", false),
    ];
    for (text, holds) in known {
        assert_eq!(verdict(&ring, text), Verdict::Holds(holds), "{text}");
    }
}

#[test]
fn the_most_of_a_sum_is_found_where_tokens_grow_without_end() {
    // This one never ended.
    let mut net = OwnedNet::new("source", "");
    let [p0, p1, p2] = ["p0", "p1", "p2"].map(|it| net.place(OwnedPlace::new(it, 0)).unwrap());
    net.transition(OwnedTransition::new("make").give(p0, 1)).unwrap();
    net.transition(OwnedTransition::new("move").take(p0, 1).give(p1, 1)).unwrap();
    net.transition(OwnedTransition::new("keep").read(p0, 1).take(p2, 1)).unwrap();
    let model = Model::from(&net.view().net());
    assert_eq!(verdict(&model, "bounds(p0 + p1)"), Verdict::Bound(Extent::Infinite));
    assert_eq!(verdict(&model, "bounds(p2)"), Verdict::Bound(Extent::Finite(0)));
    let explicit = Options { engine: Choice::Explicit, ..Options::default() };
    let answer = ask(&model, "bounds(p0 + p1)", &explicit);
    assert!(matches!(answer.verdict, Verdict::Unknown(_)), "{answer:?}");
}

#[test]
fn a_way_that_is_too_long_to_be_written_is_there_nevertheless() {
    let mut net = OwnedNet::new("doubling", "");
    let places: Vec<_> = (0..26)
        .map(|it| net.place(OwnedPlace::new(&format!("p{it}"), u32::from(it == 0))).unwrap())
        .collect();
    for (at, pair) in places.windows(2).enumerate() {
        let it = OwnedTransition::new(&format!("t{at}"));
        net.transition(it.take(pair[0], 1).give(pair[1], 2)).unwrap();
    }
    // The last firing waits for 33,554,431 others.
    let done = net.place(OwnedPlace::new("done", 0)).unwrap();
    net.transition(OwnedTransition::new("end").take(places[25], 1 << 25).give(done, 1)).unwrap();
    let model = Model::from(&net.view().net());
    let limits = Limits { states: 100_000, ..Limits::default() };
    let answer = ask(&model, "EF done", &Options { limits, ..Options::default() });
    assert_eq!(answer.verdict, Verdict::Holds(true));
    assert!(answer.run.is_none());
}

#[test]
fn an_automaton_that_is_too_large_is_the_reason() {
    let mut net = OwnedNet::new("heap", "");
    let heap = net.place(OwnedPlace::new("heap", 200)).unwrap();
    net.transition(OwnedTransition::new("take").take(heap, 1)).unwrap();
    let model = Model::from(&net.view().net());
    let parts: Vec<_> = (1..130).map(|it| format!("(F heap = {it})")).collect();
    let of = |parts: &[String]| verdict(&model, &format!("E ({})", parts.join(" & ")));
    assert_eq!(of(&parts), Verdict::Unknown(Reason::Automaton));
    assert_eq!(of(&parts[..128]), Verdict::Holds(true));
}

#[test]
fn markings_of_a_first_glance_are_counted() {
    let answer = ask(&ring(20), "AG !(p1 & p2)", &Options::default());
    assert_eq!((answer.verdict, answer.states), (Verdict::Holds(true), 20));
}

#[test]
fn a_kept_answer_depends_on_the_budget_of_its_question() {
    let pt = moves(4, (0..4).map(|it| (it, (it + 1) % 4)));
    let known = Known::new(&pt);
    let within = |limits| Budget { limits, jobs: 1, evidence: false, progress: &|_| () };
    let few = Limits { states: 3, ..Limits::default() };
    let live = |limits| Explicit.find(&known, Task::Live, &within(limits)).found;
    let is_cut = |it| matches!(it, Found::Nothing(Reason::Limit(Limit::States)));
    assert!(is_cut(live(few)));
    assert!(matches!(live(Limits::default()), Found::Holds(true, None, _)));
    assert!(is_cut(live(few)));
}
