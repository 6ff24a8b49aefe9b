//! Certificates that claim too much by just one step: each would be believed if one check of the
//! checker were missing.

use cotama_verification::certificate::{
    Case, Certificate, Evidence, Fact, Formula, Growth, Linear, Net, One, Question, Refutation,
    SCHEMA, Trace, Transition, verify,
};

/// A net of one place, or two, with one transition.
fn net(places: &[(&str, u32)], take: &[(&str, u32)], give: &[(&str, u32)]) -> Net {
    let arcs =
        |list: &[(&str, u32)]| list.iter().map(|it| (it.0.to_owned(), it.1)).collect::<Vec<_>>();
    let fire = Transition {
        name: "fire".to_owned(),
        take: arcs(take),
        give: arcs(give),
        inhibit: vec![],
        reset: vec![],
        priority: 0,
    };
    Net { name: "net".to_owned(), places: arcs(places), transitions: vec![fire] }
}

/// Returns the defect of a certificate.
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

#[test]
fn a_temporal_operator_without_a_quantifier_is_refused() {
    let idle = || net(&[("p", 1)], &[("p", 1)], &[("p", 1)]);
    let yes = || Box::new(Formula::AtMost(at_most(1, -1)));
    let and = |it: Formula| Formula::And(vec![it]);
    for formula in [
        Formula::Next(yes()),
        Formula::Finally(yes()),
        Formula::Globally(yes()),
        Formula::Until(Box::new((*yes(), *yes()))),
        Formula::Not(Box::new(Formula::Next(yes()))),
        and(Formula::Next(yes())),
        Formula::ExistsNext(Box::new(Formula::Finally(yes()))),
    ] {
        for evidence in [Evidence::State, Evidence::Graph(1), Evidence::Each(vec![Evidence::State])]
        {
            let message = refusal(idle(), Question::Formula(formula.clone()), true, evidence);
            assert_eq!(message, "speaks of a run, and no quantifier of which", "{formula}");
        }
    }
}

#[test]
fn a_place_that_is_not_there_does_not_grow() {
    let source = net(&[("p", 0)], &[], &[("p", 1)]);
    let growth = Growth { stem: Vec::new(), pump: vec!["fire".to_owned()] };
    let places = ["p", "q"].map(str::to_owned).into();
    let question = Question::Unbounded { places };
    let message = refusal(source, question, true, Evidence::Growth(growth));
    assert!(message.contains("`q`") || message.contains("\"q\""), "{message}");
}

#[test]
fn a_next_marking_and_the_next_one_of_a_run_have_texts_of_their_own() {
    let yes = || Box::new(Formula::And(Vec::new()));
    let next = Formula::Exists(Box::new(Formula::Next(yes())));
    // `E(X(true))` is `EX true` in the language of properties, and this is not.
    assert_eq!(next.to_string(), "!(A(!(X(true))))");
    assert_eq!(Formula::All(Box::new(Formula::Next(yes()))).to_string(), "!(E(!(X(true))))");
    assert_eq!(Formula::ExistsNext(yes()).to_string(), "EX (true)");
    assert_eq!(Formula::AllNext(yes()).to_string(), "AX (true)");
}

#[test]
fn a_certificate_is_about_its_net_and_its_question() {
    use cotama_verification::check::{Model, Options, check};
    use cotama_verification::{property, tina};
    let read = |text: &str| tina::read("it.net", text.as_bytes()).unwrap().untimed();
    let model = Model::from(read("pl p (1)  tr go p -> q  tr back q -> p"));
    let ask = |text| property::parse(text, model.pt()).unwrap();
    let options = Options { evidence: true, ..Options::default() };
    for text in ["AG !(p & q)", "live", "bounds(p + q)", "AG EF p", "EF q"] {
        let asked = ask(text);
        let shown = check(&model, &asked, &options).certificate(model.pt(), &asked).unwrap();
        let shown = Certificate::read(&shown.text()).unwrap();
        assert_eq!(shown.is_about(model.pt(), &asked), Ok(()), "{text}");
        let at = |pt, text| shown.is_about(pt, &ask(text)).unwrap_err().at;
        assert_eq!(at(model.pt(), "AG !(p & q) & EF p"), "question");
        let tokens = read("pl p (2)  tr go p -> q  tr back q -> p");
        let arcs = read("pl p (1)  tr go p -> q  tr back q -> q");
        assert_eq!([at(&tokens, text), at(&arcs, text)], ["net", "net"]);
    }
}

#[test]
fn one_part_that_holds_is_not_all_of_them() {
    let marked = || net(&[("p", 1)], &[("p", 1)], &[("p", 1)]);
    let parts = vec![Formula::AtMost(at_most(-1, 1)), Formula::AtMost(at_most(0, 1))];
    let one = || Evidence::One(One { part: 0, by: Box::new(Evidence::State) });
    let misfit = "this kind of evidence does not fit the claim";
    // `p <= 1` holds and `p <= 0` does not.
    let all = Question::Formula(Formula::And(parts.clone()));
    assert_eq!(refusal(marked(), all, true, one()), misfit);
    let second = Evidence::One(One { part: 1, by: Box::new(Evidence::State) });
    let some = Question::Formula(Formula::Or(parts));
    assert_eq!(refusal(marked(), some, false, second), misfit);
}

#[test]
fn a_refutation_speaks_of_all_runs_and_not_of_one() {
    // `G p <= 1` of every run, by `p <= 1` which nothing breaks.
    let marked = || net(&[("p", 1)], &[("p", 1)], &[("p", 1)]);
    let kept = Box::new(Formula::Globally(Box::new(Formula::AtMost(at_most(-1, 1)))));
    let by = || refuted(vec![Fact::AtMost(at_most(-1, 1))], vec![(0, 1), (1, 1)]);
    let every = Certificate {
        schema: SCHEMA.to_owned(),
        net: marked(),
        property: "kept".to_owned(),
        question: Question::Formula(Formula::All(kept.clone())),
        verdict: true,
        evidence: by(),
    };
    assert!(verify(&every.text()).unwrap().verdict);
    let some = Question::Formula(Formula::Exists(kept));
    let misfit = "this kind of evidence does not fit the claim";
    assert_eq!(refusal(marked(), some, true, by()), misfit);
}
