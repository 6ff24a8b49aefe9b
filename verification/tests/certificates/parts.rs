//! Questions about the whole net, from parts.

use crate::certificates::stories::*;
use crate::certificates::{all_refused, shown};
use cotama_core::net::{PlaceId, TransitionId};
use cotama_verification::certificate::*;
use cotama_verification::property::{self, Atom, Property};
use serde_json::json;

#[test]
fn every_transition_fires_once() {
    let track = track();
    let ways: [&[u32]; 4] = [&[], &[0], &[], &[2]];
    let each = Evidence::Each(ways.iter().map(|it| Evidence::trace(&track, it)).collect());
    let certificate = Certificate::of(&track, "", Question::QuasiLive, true, each);
    assert_eq!(
        shown(&certificate),
        "net track (5 places, 4 transitions): quasi_live is true\n  by 4 parts, the first by a \
         trace of 0 firings"
    );
    let trace = |fire: &[&str]| json!({"trace": {"fire": fire, "then": "state"}});
    all_refused(
        &certificate,
        vec![
            ("/evidence/each", json!([]), "evidence: there are 0 parts of evidence for 4 claims"),
            (
                "/evidence/each/1",
                trace(&[]),
                "evidence.each[1].trace.then: the opposite of what is claimed is so",
            ),
            (
                "/evidence/each/3",
                trace(&["enter1"]),
                "evidence.each[3].trace.then: the opposite of what is claimed is so",
            ),
            ("/verdict", json!(false), "evidence: this kind of evidence does not fit the claim"),
            (
                "/question",
                json!("live"),
                "evidence.each[0]: this kind of evidence does not fit the claim",
            ),
            (
                "/question",
                json!("stable"),
                "evidence: this kind of evidence does not fit the claim",
            ),
        ],
    );
}

#[test]
fn a_number_of_tokens_is_attained_and_never_exceeded() {
    let battery = battery();
    let never_more = Evidence::Refutation(Refutation {
        dead: vec![],
        facts: vec![Fact::sum(&battery, &[(0, 1), (1, 1), (2, 2)], &battery.initial).unwrap()],
        cases: vec![Case::Contradiction(vec![(0, 1), (1, 1)])],
    });
    let evidence = Evidence::Each(vec![never_more, Evidence::trace(&battery, &[0, 0])]);
    let property =
        Property { name: "charges".into(), question: property::Question::Bound(vec![PlaceId(1)]) };
    let certificate = Certificate::new(&battery, &property, Answer::Bound(2), evidence).unwrap();
    assert_eq!(
        shown(&certificate),
        "net battery (3 places, 3 transitions): bounds(empty) = 2 is true\n  \
         by 2 parts, the first by 1 inequality and 0 traps that exclude 1 case"
    );
    all_refused(
        &certificate,
        vec![
            (
                "/question/bound/most",
                json!(3),
                "evidence.each[1].trace.then: the opposite of what is claimed is so",
            ),
            (
                "/question/bound/most",
                json!(1),
                "evidence.each[0].refutation.cases[0]: no contradiction: the constant is not above \
                 0",
            ),
            (
                "/question/bound/places",
                json!(["empty", "broken", "broken", "broken"]),
                "evidence.each[0].refutation.cases[0]: no contradiction: a place has a negative \
                 weight",
            ),
            ("/question/bound/places/0", json!("lost"), "question: there is no `lost`"),
        ],
    );
}

#[test]
fn one_place_never_changes_or_each_place_does() {
    let pump = net(
        "pump",
        &[("power", 1), ("on", 0)],
        &[("start", &[("power", 1)], &[("power", 1), ("on", 1)])],
    );
    let leaf = |fact| Case::Contradiction(vec![(fact, 1), (2, 1)]);
    let constant = Evidence::Refutation(Refutation {
        dead: vec![],
        facts: vec![
            Fact::sum(&pump, &[(0, -1)], &pump.initial).unwrap(),
            Fact::sum(&pump, &[(0, 1)], &pump.initial).unwrap(),
        ],
        cases: vec![Case::Split(0), leaf(0), leaf(1)],
    });
    let one = Evidence::One(One { part: 0, by: Box::new(constant) });
    let certificate = Certificate::of(&pump, "", Question::Stable, true, one);
    assert!(
        shown(&certificate)
            .starts_with("net pump (2 places, 1 transition): stable is true\n  by part 0: 2 ineq")
    );
    all_refused(
        &certificate,
        vec![
            ("/evidence/one/part", json!(2), "evidence.one.part: there are 2 parts"),
            (
                "/evidence/one/part",
                json!(1),
                "evidence.one.by.refutation.cases[1]: no contradiction: a place has a negative \
                 weight",
            ),
            (
                "/net/transitions/0/give/0/1",
                json!(2),
                "evidence.one.by.refutation.facts[1]: `start` breaks it",
            ),
        ],
    );
    let track = track();
    let ways: [&[u32]; 5] = [&[0], &[0], &[0], &[2], &[2]];
    let each = Evidence::Each(ways.iter().map(|it| Evidence::trace(&track, it)).collect());
    let certificate = Certificate::of(&track, "", Question::Stable, false, each);
    assert!(shown(&certificate).contains("stable is false"));
}

#[test]
fn a_formula_of_the_property_language_is_carried_over() {
    use property::Formula as F;
    let track = track();
    let both = property::Linear { constant: 2, weights: vec![(PlaceId(2), -1), (PlaceId(4), -1)] };
    let formula = F::All(Box::new(F::Globally(Box::new(F::Or(vec![
        F::Not(Box::new(F::Atom(Atom::AtMost(both)))),
        F::Atom(Atom::Deadlock),
        F::Atom(Atom::Fireable(vec![TransitionId(0)])),
    ])))));
    let property = |question| Property { name: "p".into(), question };
    let asked = property(property::Question::Formula(formula.clone()));
    let certificate =
        Certificate::new(&track, &asked, Answer::Holds(true), Evidence::None).unwrap();
    let Question::Formula(carried) = &certificate.question else { panic!("not a formula") };
    assert_eq!(carried.to_string(), "A(G((!(2 <= on1 + on2)) | (deadlock) | (fireable(enter1))))");
    assert_eq!(
        verify(&certificate.text()).unwrap_err().to_string(),
        "evidence: there is no evidence"
    );
    let refused = |question, answer| {
        Certificate::new(&track, &property(question), answer, Evidence::None).unwrap_err()
    };
    assert_eq!(refused(property::Question::Liveness, Answer::Bound(1)), Uncertifiable::Answer);
    assert_eq!(
        refused(property::Question::Bound(vec![]), Answer::Holds(true)),
        Uncertifiable::Answer
    );
    let timed = F::All(Box::new(F::Within(5, Box::new(F::TRUE))));
    assert_eq!(
        refused(property::Question::Formula(timed), Answer::Holds(true)),
        Uncertifiable::Time
    );
}

#[test]
fn a_text_that_is_no_certificate_is_refused_by_line_and_column() {
    let error = |text: &str| verify(text).unwrap_err().to_string();
    assert_eq!(error(""), "certificate: EOF while parsing a value at line 1 column 0");
    assert_eq!(
        error("{\n  \"shema\": 1}"),
        "certificate: unknown field `shema`, expected one of `schema`, `net`, `property`, \
         `question`, `verdict`, `evidence` at line 2 column 9"
    );
    let deep = format!("{{\"question\": {{\"formula\": {}", "{\"not\": ".repeat(10_000));
    assert_eq!(error(&deep), "certificate: recursion limit exceeded at line 1 column 1026");
    let long = " ".repeat(verify::MAX_BYTES + 1);
    assert_eq!(error(&long), "certificate: has 67108865 bytes; at most 67108864 are read");
}
