//! Certificates that claim too much by just one step: each would be believed if one check of the
//! checker were missing.

use cotama_verification::certificate::{
    Case, Certificate, Evidence, Fact, Formula, Growth, Linear, Net, Question, Refutation, SCHEMA,
    Trace, Transition, verify,
};

/// A net of one place, or two, with one transition.
fn net(places: &[(&str, u32)], take: &[(&str, u32)], give: &[(&str, u32)]) -> Net {
    let arcs =
        |list: &[(&str, u32)]| list.iter().map(|it| (it.0.to_owned(), it.1)).collect::<Vec<_>>();
    let fire = Transition { name: "fire".to_owned(), take: arcs(take), give: arcs(give) };
    Net { name: "net".to_owned(), places: arcs(places), transitions: vec![fire] }
}

/// What is wrong with a certificate.
fn refusal(net: Net, question: Question, verdict: bool, evidence: Evidence) -> String {
    let (schema, property) = (SCHEMA.to_owned(), "forged".to_owned());
    let certificate = Certificate { schema, net, property, question, verdict, evidence };
    verify(&certificate.text()).map_or_else(|it| it.message, |it| panic!("believed: {it}"))
}

/// `constant + weight * tokens of p <= 0`
fn at_most(constant: i64, weight: i64) -> Linear {
    Linear { constant, weights: vec![("p".to_owned(), weight)] }
}

/// `EF goal`
fn reached(goal: Formula) -> Question {
    Question::Formula(Formula::Exists(Box::new(Formula::Finally(Box::new(goal)))))
}

fn refuted(facts: Vec<Fact>, by: Vec<(usize, u64)>) -> Evidence {
    Evidence::Refutation(Refutation {
        dead: Vec::new(),
        facts,
        cases: vec![Case::Contradiction(by)],
    })
}

#[test]
fn a_pump_that_uses_up_its_tokens_is_no_pump() {
    let once = net(&[("fuel", 1), ("p", 0)], &[("fuel", 1)], &[("p", 1)]);
    let growth = Growth { stem: Vec::new(), pump: vec!["fire".to_owned()] };
    let question = Question::Unbounded { places: vec!["p".to_owned()] };
    let message = refusal(once, question, true, Evidence::Growth(growth));
    assert_eq!(message, "takes tokens away, or adds none where asked");
}

#[test]
fn a_full_place_does_not_start_from_zero_again() {
    let full = net(&[("p", u32::MAX)], &[], &[("p", 1)]);
    let way = Trace { fire: vec!["fire".to_owned()], then: Box::new(Evidence::State) };
    let empty = reached(Formula::AtMost(at_most(0, 1)));
    assert_eq!(refusal(full, empty, true, Evidence::Trace(way)), "numbers get too large");
}

#[test]
fn a_sum_beyond_128_bits_is_no_contradiction() {
    // One token is there; 2 * (2^64 - 1) times `1 - 2^63 * tokens <= 0` has a weight that wraps
    // around to 2^64.
    let marked = net(&[("p", 1)], &[("p", 1)], &[("p", 1)]);
    let goal = reached(Formula::AtMost(at_most(1, i64::MIN)));
    let twice = refuted(Vec::new(), vec![(0, u64::MAX), (0, u64::MAX)]);
    assert_eq!(refusal(marked, goal, false, twice), "numbers get too large");
}

#[test]
fn more_than_none_is_one_and_not_two() {
    // `tokens <= 1` always holds, and so does `tokens > 0`.
    let marked = net(&[("p", 1)], &[("p", 1)], &[("p", 1)]);
    let goal = reached(Formula::Not(Box::new(Formula::AtMost(at_most(0, 1)))));
    let evidence = refuted(vec![Fact::AtMost(at_most(-1, 1))], vec![(0, 1), (1, 1)]);
    assert_eq!(
        refusal(marked, goal, false, evidence),
        "no contradiction: the constant is not above 0"
    );
}
