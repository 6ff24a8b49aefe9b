//! Evidence from what engines return, on nets known in the literature.

use crate::certificates::random::Dice;
use crate::certificates::stories::{a, at_most, e, f, g, has, not};
use crate::certificates::{mutated, shown};
use cotama_checker::structural::certificate::DeadTransitions;
use cotama_checker::structural::{Answer, Limits, Structure};
use cotama_checker::stubborn;
use cotama_core::net::owned::OwnedNet;
use cotama_core::net::{PlaceId, TransitionId};
use cotama_models::nets::families::{fms, kanban, philosophers, swimming_pool, token_ring};
use cotama_verification::certificate::{Certificate, Evidence, Formula, Question, verify};
use cotama_verification::coverability::{self, Bounded};
use cotama_verification::property::{self, Linear};
use cotama_verification::pt::Pt;
use cotama_verification::{explicit, temporal};

fn pt(net: &OwnedNet) -> Pt {
    Pt::from(&net.view().net())
}

fn families() -> Vec<Pt> {
    [philosophers(4), kanban(3), fms(3), token_ring(4), swimming_pool(2)]
        .map(|it| pt(&it.unwrap()))
        .into()
}

fn ids(trace: &[TransitionId]) -> Vec<u32> {
    trace.iter().map(|it| it.0).collect()
}

fn never_dead() -> Question {
    Question::Formula(a(g(not(Formula::Deadlock))))
}

/// Verifies a certificate and refuses ten changes of it.
fn is_shown(certificate: &Certificate) -> String {
    assert_eq!(mutated(certificate, &mut Dice(9), 10), 10);
    shown(certificate)
}

/// Returns the proofs of the structure of a net, as certificates: whether it stops, is safe, and
/// the most tokens of each place.
fn structural(pt: &Pt) -> Vec<Certificate> {
    let mut structure = Structure::new(pt, &Limits::default());
    let mut found = Vec::new();
    match structure.deadlock() {
        Answer::Impossible(proof) => {
            let evidence = Evidence::deadlock_free(pt, structure.dead(), &proof).unwrap();
            found.push(Certificate::of(pt, "", never_dead(), true, evidence));
        }
        Answer::Reachable(way) => {
            found.push(Certificate::of(
                pt,
                "",
                never_dead(),
                false,
                Evidence::trace(pt, &ids(&way)),
            ));
        }
        Answer::Unknown(_) => {}
    }
    match structure.one_safe() {
        Answer::Impossible(bounds) => {
            let evidence = Evidence::one_safe(pt, structure.dead(), &bounds).unwrap();
            found.push(Certificate::of(pt, "", Question::OneSafe, true, evidence));
        }
        Answer::Reachable(way) => {
            let evidence = Evidence::trace(pt, &ids(&way));
            found.push(Certificate::of(pt, "", Question::OneSafe, false, evidence));
        }
        Answer::Unknown(_) => {}
    }
    for place in 0..pt.places.len() as u32 {
        let Some(bound) = structure.upper_bound(&[(PlaceId(place), 1)]) else { continue };
        let never_more = Evidence::bounded(pt, structure.dead(), &bound).unwrap();
        let name = &pt.places[place as usize];
        let (most, full) = (
            bound.at_most,
            Linear { constant: bound.at_most, weights: vec![(PlaceId(place), -1)] },
        );
        let question = Question::Formula(a(g(at_most(name, most))));
        found.push(Certificate::of(pt, "", question, true, never_more.clone()));
        if let Answer::Reachable(way) = structure.reach(&[full]) {
            let question = Question::Bound { places: vec![name.clone()], most };
            found.push(Certificate::of(
                pt,
                "",
                question,
                true,
                Evidence::most(never_more, pt, &ids(&way)),
            ));
        }
    }
    found
}

#[test]
fn the_structure_of_well_known_nets_gives_valid_certificates() {
    let mut kinds = Vec::new();
    for pt in families() {
        let found = structural(&pt);
        kinds.push((pt.name.clone(), found.len()));
        for certificate in found {
            is_shown(&certificate);
        }
    }
    assert_eq!(
        kinds,
        [
            ("philosophers_4".to_owned(), 42),
            ("kanban_3".to_owned(), 31),
            ("fms_3".to_owned(), 44),
            ("token_ring_4".to_owned(), 32),
            ("swimming_pool_2".to_owned(), 18),
        ]
    );
}

#[test]
fn neighbours_never_eat_at_the_same_time() {
    let pt = pt(&philosophers(5).unwrap());
    let eats: Vec<_> = (0..pt.places.len()).filter(|it| pt.places[*it].contains("eat")).collect();
    assert_eq!(eats.len(), 5);
    let both = |one: usize, other: usize| {
        [one, other].map(|it| Linear { constant: 1, weights: vec![(PlaceId(it as u32), -1)] })
    };
    let structure = Structure::new(&pt, &Limits::default());
    let pairs: Vec<_> = (0..5).map(|it| both(eats[it], eats[(it + 1) % 5]).to_vec()).collect();
    let proofs: Vec<_> = pairs
        .iter()
        .map(|goal| match structure.reach(goal) {
            Answer::Impossible(proof) => (goal.clone(), proof),
            other => panic!("{other:?}"),
        })
        .collect();
    let atom = |it: &Linear| property::Formula::Atom(property::Atom::AtMost(it.clone()));
    let goal = property::Formula::Or(
        pairs.iter().map(|it| property::Formula::And(it.iter().map(atom).collect())).collect(),
    );
    let evidence = Evidence::never(&pt, structure.dead(), &goal, &proofs).unwrap();
    let question = Question::Formula(e(f(Formula::new(&pt, &goal).unwrap())));
    let certificate = Certificate::of(&pt, "", question, false, evidence);
    assert!(is_shown(&certificate).ends_with("that exclude 5 cases"));
    assert_eq!(Evidence::never(&pt, structure.dead(), &goal, &proofs[1..]), None);
}

#[test]
fn two_thousand_cards_never_stop_and_two_hundred_philosophers_do() {
    let kanban = pt(&kanban(2_000).unwrap());
    let mut structure = Structure::new(&kanban, &Limits::default());
    let Answer::Impossible(proof) = structure.deadlock() else { panic!("not proved") };
    let evidence = Evidence::deadlock_free(&kanban, structure.dead(), &proof).unwrap();
    let certificate = Certificate::of(&kanban, "", never_dead(), true, evidence);
    is_shown(&certificate);
    assert!(certificate.text().len() < 10_000, "{}", certificate.text().len());

    let table = pt(&philosophers(200).unwrap());
    let found = stubborn::deadlock(&table, &explicit::Limits::default(), &|_| ());
    let explicit::Reached::Trace { transitions: trace, .. } = found else { panic!("not found") };
    let certificate =
        Certificate::of(&table, "", never_dead(), false, Evidence::trace(&table, &ids(&trace)));
    is_shown(&certificate);
}

#[test]
#[ignore = "a minute: CI runs it"]
fn all_markings_of_well_known_nets_are_passed_through_again() {
    pass_through_again(0..2);
}

#[test]
#[ignore = "a minute: CI runs it"]
fn all_markings_of_larger_nets_are_passed_through_again() {
    // The pool has too many for a test.
    pass_through_again(2..4);
}

fn pass_through_again(numbers: std::ops::Range<usize>) {
    for pt in &families()[numbers] {
        let graph = explicit::Graph::new(pt, &explicit::Limits::default(), &|_| ()).unwrap();
        let live = graph.liveness().is_live();
        let certificate =
            Certificate::of(pt, "", Question::Live, live, Evidence::Graph(graph.states()));
        is_shown(&certificate);
        let other = Certificate { verdict: !live, ..certificate };
        assert_eq!(
            verify(&other.text()).unwrap_err().to_string(),
            "evidence.graph: the opposite of what is claimed is so"
        );
    }
}

#[test]
fn a_counter_counts_without_end() {
    let counter = crate::certificates::stories::net(
        "counter",
        &[("off", 1), ("on", 0), ("count", 0)],
        &[
            ("press", &[("off", 1)], &[("on", 1), ("count", 2)]),
            ("release", &[("on", 1), ("count", 1)], &[("off", 1)]),
        ],
    );
    let Bounded::No(growth) = coverability::bounded(&counter, &coverability::Limits::default())
    else {
        panic!("it counts on")
    };
    let evidence = growth.evidence(&counter).unwrap();
    let unbounded = |places: &[&str]| {
        let places = places.iter().map(|it| (*it).to_owned()).collect();
        Certificate::of(&counter, "", Question::Unbounded { places }, true, evidence.clone())
    };
    let all = unbounded(&["off", "on", "count"]);
    assert_eq!(
        is_shown(&all),
        "net counter (3 places, 2 transitions): unbounded(off + on + count) is true\n  \
         by 2 firings that can be repeated after 0 firings"
    );
    shown(&unbounded(&["count"]));
    let error = |it: &Certificate| verify(&it.text()).unwrap_err().to_string();
    let none = "evidence.growth.pump: takes tokens away, or adds none where asked";
    assert_eq!(error(&unbounded(&["off", "on"])), none);
    assert_eq!(error(&Certificate { verdict: false, ..all }), "question: only growth can show it");
}

#[test]
fn a_run_that_a_search_finds_is_shown() {
    let track = crate::certificates::stories::track();
    let path = property::parse("A (G F on1)", &track).unwrap();
    let property::Question::Formula(property::Formula::All(inner)) = &path.question else {
        panic!("not of that form")
    };
    let temporal::Verdict::Known { holds: false, run: Some(run), .. } =
        temporal::all_runs(&track, inner, &explicit::Limits::default(), &|_| ())
    else {
        panic!("no run is found")
    };
    let evidence = Evidence::run(&track, &run).unwrap();
    let question = Question::Formula(a(g(f(has("on1", 1)))));
    is_shown(&Certificate::of(&track, "", question, false, evidence));
}

#[test]
fn the_structure_of_random_nets_gives_valid_certificates() {
    let (mut dice, mut count) = (Dice(11), 0);
    for _ in 0..300 {
        let pt = crate::certificates::random::any_net(&mut dice);
        for certificate in structural(&pt) {
            shown(&certificate);
            count += 1;
        }
    }
    assert!(count > 600, "{count}");
}

#[test]
fn a_part_without_a_proof_is_no_evidence() {
    let track = crate::certificates::stories::track();
    let structure = Structure::new(&track, &Limits::default());
    assert!(Evidence::never(&track, structure.dead(), &property::Formula::FALSE, &[]).is_some());
    assert_eq!(Evidence::never(&track, structure.dead(), &property::Formula::TRUE, &[]), None);
    assert_eq!(Evidence::one_safe(&track, &DeadTransitions::default(), &[]), None);
    assert_eq!(
        Evidence::run(&track, &temporal::Run { stem: Vec::new(), rest: temporal::Rest::Any }),
        None
    );
}
