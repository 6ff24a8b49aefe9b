//! The property language. What is said of broken texts is in `tests/golden/properties/errors.txt`;
//! `UPDATE_GOLDEN=1 cargo test -p cotama-verification --test engines properties` writes it again.

use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{PlaceId, TransitionId};
use cotama_verification::property::{Assumptions, Atom, Formula, Kind, Linear, Question, parse};
use cotama_verification::pt::Pt;
use std::fmt::Write as _;

pub(super) const P: PlaceId = PlaceId(0);
const Q: PlaceId = PlaceId(1);
const START: TransitionId = TransitionId(0);
const STOP: TransitionId = TransitionId(1);

/// Places `p`, `q`, `waiting`, `a b` and `E`; transitions `start` and `stop`.
pub(super) fn net() -> Pt {
    let mut net = OwnedNet::new("net", "");
    for name in ["p", "q", "waiting", "a b", "E"] {
        net.place(OwnedPlace::new(name, 0)).unwrap();
    }
    for name in ["start", "stop"] {
        net.transition(OwnedTransition::new(name).take(P, 1).give(Q, 1)).unwrap();
    }
    Pt::from(&net.view().net())
}

fn question(text: &str) -> Question {
    match parse(text, &net()) {
        Ok(property) => property.question,
        Err(error) => panic!("{text}: {error}"),
    }
}

pub(super) fn formula(text: &str) -> Formula {
    match question(text) {
        Question::Formula(formula) => formula,
        other => panic!("{text}: {other:?}"),
    }
}

pub(super) fn marked(place: PlaceId) -> Formula {
    Formula::Atom(Atom::AtMost(Linear::marked(place)))
}

fn at_most(constant: i64, weights: &[(PlaceId, i64)]) -> Formula {
    Formula::Atom(Atom::AtMost(Linear { constant, weights: weights.to_vec() }))
}

#[test]
fn every_question_can_be_asked() {
    assert_eq!(question("bounds(p + q)"), Question::Bound(vec![P, Q]));
    assert_eq!(question("bound(stop -> p)"), Question::Response { from: TransitionId(1), to: P });
    let assumed = Assumptions {
        weak: vec![START],
        strong: vec![STOP, START],
        often: vec![marked(P), marked(Q)],
    };
    let text = "AF q assuming weak(start), often(p), strong(stop), strong(start), often(q)";
    assert_eq!(question(text), Question::Fair(formula("AF q"), assumed));
    assert_eq!(question("live"), Question::Liveness);
    assert_eq!(question(" quasi_live "), Question::QuasiLiveness);
    assert_eq!(question("stable"), Question::StableMarking);
    assert_eq!(question("one_safe"), Question::OneSafe);
    assert_eq!(question("true"), Question::Formula(Formula::TRUE));
    assert_eq!(parse("  EF\n deadlock ", &net()).unwrap().name, "EF\n deadlock");
}

#[test]
fn comparisons_become_inequalities() {
    let (more, less) = (at_most(-3, &[(P, 1), (Q, 1)]), at_most(3, &[(P, -1), (Q, -1)]));
    assert_eq!(formula("p + q <= 3"), more);
    assert_eq!(formula("p + q >= 3"), less);
    assert_eq!(formula("3 >= q + p"), more);
    assert_eq!(formula("(p + q) < 4"), more);
    assert_eq!(formula("p + q > 2"), less);
    assert_eq!(formula("p + q = 3"), Formula::And(vec![more.clone(), less.clone()]));
    assert_eq!(formula("p + q == 3"), formula("p + q = 3"));
    assert_eq!(formula("p + q != 3"), Formula::Not(formula("p + q = 3").into()));
    assert_eq!(formula("2 * (p - q) + q <= p"), at_most(0, &[(P, 1), (Q, -1)]));
    assert_eq!(formula("p - p <= q * 3"), at_most(0, &[(Q, -3)]));
    assert_eq!(formula("p >= 1"), formula("p"));
}

#[test]
fn operators_bind_as_the_table_says() {
    let (p, q) = (marked(P), marked(Q));
    let not = |a: &Formula| Formula::Not(a.clone().into());
    assert_eq!(
        formula("p | q & p"),
        Formula::Or(vec![p.clone(), Formula::And(vec![q.clone(), p.clone()])])
    );
    assert_eq!(formula("p and q && p"), Formula::And(vec![p.clone(), q.clone(), p.clone()]));
    assert_eq!(
        formula("(p & q) & p"),
        Formula::And(vec![Formula::And(vec![p.clone(), q.clone()]), p.clone()])
    );
    assert_eq!(formula("!p & q"), Formula::And(vec![not(&p), q.clone()]));
    assert_eq!(formula("not p <= 3"), not(&at_most(-3, &[(P, 1)])));
    assert_eq!(formula("p -> q -> p"), formula("p -> (q -> p)"));
    assert_eq!(formula("p -> q"), Formula::Or(vec![not(&p), q.clone()]));
    assert_eq!(formula("p <-> q <-> p"), formula("(p <-> q) <-> p"));
    assert_eq!(formula("AG p & EF q"), formula("(AG p) & (EF q)"));
    assert_eq!(formula("AG p <= 3"), formula("AG (p <= 3)"));
    assert_eq!(formula("AG !p"), formula("A G (!(p))"));
    assert_eq!(formula("E[p U q U p]"), formula("E (p U (q U p))"));
    assert_eq!(formula("A[!p U q <= 1]"), formula("A ((!p) U (q <= 1))"));
    assert_eq!(formula("AF<=2s p"), Formula::All(Formula::Within(2000, p.clone().into()).into()));
    assert_eq!(formula("A (p -> F<=5 ms q)"), formula("A (!p | F<=5ms q)"));
}

/// A net whose places are called like words of the language, and two that are not.
fn letters() -> Pt {
    let mut net = OwnedNet::new("letters", "");
    for name in ["A", "E", "F", "G", "X", "U", "AF", "EF", "AG", "EG", "AX", "EX", "and", "not"] {
        let place = net.place(OwnedPlace::new(name, 0)).unwrap();
        net.transition(OwnedTransition::new(name).take(place, 1)).unwrap();
    }
    for name in ["p", "live", "fireable", "bounds", "deadlock", "true"] {
        net.place(OwnedPlace::new(name, 0)).unwrap();
    }
    Pt::from(&net.view().net())
}

#[test]
fn a_place_that_is_called_like_a_word_is_read_where_only_a_name_can_be_meant() {
    let net = letters();
    let read = |text: &str| parse(text, &net).map(|it| it.question);
    for (bare, in_quotes) in [
        ("EF E", "EF \"E\""),
        ("AG (A -> p)", "AG (\"A\" -> p)"),
        ("AG !E", "AG !\"E\""),
        ("AG (A & E | F)", "AG (\"A\" & \"E\" | \"F\")"),
        ("EF A > 0", "EF \"A\" > 0"),
        ("EF (A + E + F = G - X)", "EF (\"A\" + \"E\" + \"F\" = \"G\" - \"X\")"),
        ("EF EF", "EF \"EF\""),
        ("AF AF", "AF \"AF\""),
        ("A G G", "A G \"G\""),
        ("AG EF EG", "AG EF \"EG\""),
        ("E[A U E]", "E[\"A\" U \"E\"]"),
        ("E[p U U]", "E[p U \"U\"]"),
        ("EF U", "EF \"U\""),
        ("E", "\"E\""),
        ("AX AX", "AX \"AX\""),
        ("EF F <= 3", "EF \"F\" <= 3"),
        ("AF<=3ms F", "AF<=3ms \"F\""),
        ("EF (and & not)", "EF (\"and\" & \"not\")"),
        ("EF live", "EF \"live\""),
        ("EF fireable", "EF \"fireable\""),
        ("EF fireable(A, EG)", "EF fireable(\"A\", \"EG\")"),
        ("bounds(A + U + live)", "bounds(\"A\" + \"U\" + \"live\")"),
        ("bounds > 0", "\"bounds\" > 0"),
        ("bound(A -> E)", "bound(\"A\" -> \"E\")"),
        ("AF E assuming weak(G)", "AF \"E\" assuming weak(\"G\")"),
    ] {
        assert_eq!(read(bare).unwrap(), read(in_quotes).unwrap(), "{bare}");
    }
    // With an operand behind it, it is the word.
    assert_eq!(read("E (X p)").unwrap(), read("EX p").unwrap());
    assert_eq!(read("A (F E)").unwrap(), read("AF \"E\"").unwrap());
    for text in ["EF deadlock", "AG true", "live", "EF E p", "A E", "EF (A E)", "AG (X Y)"] {
        let Err(error) = read(text) else { continue };
        let said = error.to_string();
        let word = "is a word of the language, and a place";
        assert!(said.contains(word) && said.contains("in quotes"), "{text}: {said}");
    }
    for text in ["EF deadlock", "AG true", "live"] {
        assert!(read(text).is_err(), "{text}");
    }
}

#[test]
fn a_quantifier_shows_how_far_it_reaches_where_it_could_be_meant_otherwise() {
    let said = |text: &str| {
        let error = parse(text, &net()).map(|it| format!("{it:?}")).expect_err(text);
        assert!(error.message.ends_with("can be read in two ways"), "{text}: {error}");
        error.help.unwrap()
    };
    for (text, wide, narrow) in [
        ("AG p -> q", "AG (p -> q)", "(AG p) -> q"),
        ("AG p -> AF q", "AG (p -> AF q)", "(AG p) -> AF q"),
        ("EF p & q", "EF (p & q)", "(EF p) & q"),
        ("EF p | q", "EF (p | q)", "(EF p) | q"),
        ("AG p & q -> p", "AG (p & q -> p)", "(AG p) & q -> p"),
        ("AG p <-> q", "AG (p <-> q)", "(AG p) <-> q"),
        ("q & AG p -> q", "q & AG (p -> q)", "q & (AG p) -> q"),
        ("!AG p | q", "!AG (p | q)", "!(AG p) | q"),
        ("A G p -> q", "A (G p -> q)", "(A G p) -> q"),
        ("AG (p) -> q", "AG ((p) -> q)", "(AG (p)) -> q"),
        ("AG (p -> q) & q", "AG ((p -> q) & q)", "(AG (p -> q)) & q"),
        ("AG p <= 3 -> q", "AG (p <= 3 -> q)", "(AG p <= 3) -> q"),
        ("EX p and q", "EX (p and q)", "(EX p) and q"),
        ("E[p U AG q U p]", "E[p U AG (q U p)]", "E[p U (AG q) U p]"),
    ] {
        // Only what is in the brackets could be meant otherwise.
        let [wide, narrow] = [wide, narrow].map(|it| match it.strip_prefix("E[") {
            Some(inside) => inside.trim_end_matches(']').to_owned(),
            None => it.to_owned(),
        });
        assert_eq!(said(text), format!("write `{wide}`, or `{narrow}`"), "{text}");
    }
    // Clear are these: parentheses, or a quantifier in each part, or none in the way.
    for (text, same) in [
        ("AG (p -> q)", "A (G (p -> q))"),
        ("(AG p) -> q", "!(AG p) | q"),
        ("p -> AG q", "!p | AG q"),
        ("AG p & EF q & !AG q", "(AG p) & (EF q) & !(AG q)"),
        ("AG (p) -> AG (q)", "(AG p) -> (AG q)"),
        ("A (G F p -> G F q)", "A ((G F p) -> (G F q))"),
        ("AG EF p", "AG (EF p)"),
        ("E[p U q] & A[q U p]", "(E[p U q]) & (A[q U p])"),
    ] {
        assert_eq!(formula(text), formula(same), "{text}");
        let written = formula(text).display(&net()).to_string();
        assert_eq!(formula(&written), formula(text), "{written}");
    }
}

#[test]
fn names_stand_alone_or_in_quotes_or_in_braces() {
    assert_eq!(formula("\"a b\""), marked(PlaceId(3)));
    assert_eq!(formula("{a b} & p"), Formula::And(vec![marked(PlaceId(3)), marked(P)]));
    assert_eq!(formula("\"E\" & {E}"), Formula::And(vec![marked(PlaceId(4)), marked(PlaceId(4))]));
    assert_eq!(formula("\"\\u{70}\""), marked(P));
    assert_eq!(
        formula("fireable(start, \"stop\")"),
        Formula::Atom(Atom::Fireable(vec![TransitionId(0), TransitionId(1)]))
    );
}

#[test]
fn formulas_are_of_the_kind_that_their_operators_make_them() {
    for (text, kind) in [
        ("p & !deadlock", Kind::Initial),
        ("EF deadlock", Kind::Reachability),
        ("!AG (p -> q)", Kind::Reachability),
        ("AG EF p", Kind::Ctl),
        ("AX p & E[p U q]", Kind::Ctl),
        ("A (G F p -> G F q)", Kind::Ltl),
        ("AG F p", Kind::Ltl),
        ("E F G p", Kind::Other),
        ("AG AF<=200ms p", Kind::Timed),
    ] {
        assert_eq!(formula(text).kind(), kind, "{text}");
    }
}

#[test]
fn formulas_are_written_as_people_write_them() {
    for text in [
        "AG !(p & q)",
        "EF (p >= 2 | fireable(start, stop))",
        "A (G F p | !(q & p) | F G deadlock)",
        "E[p U (q & !p)]",
        "A ((p U q) | F<=200ms \"a b\")",
        "p = 3 & q != 2 & p + 2 * q <= \"E\" + 7",
        "!(p <= 3)",
        "true | false",
        "AG EF (p | q & !p)",
        "AG F X p",
        "0 <= 3",
        "bounds(p + \"a b\")",
        "bound(start -> q)",
        "quasi_live",
        "AG (p | AF !p) assuming weak(start, stop), often(p | q)",
        "AG EF p assuming strong(stop)",
    ] {
        let written = question(text).display(&net()).to_string();
        assert_eq!(written, text);
    }
}

#[test]
fn simplified_formulas_are_the_shortest_that_the_rules_find() {
    for (text, simple) in [
        ("p & true & p", "p"),
        ("p | !p", "true"),
        ("p & (q & !p)", "false"),
        ("!(2 * p + 4 * q <= 7)", "p + 2 * q >= 4"),
        ("0 - p <= 0", "true"),
        ("p + 1 <= 0", "false"),
        ("EF EF p", "EF p"),
        ("EF AF p", "EF p"),
        ("AF EF p", "EF p"),
        ("AG EG p", "AG p"),
        ("EF E[p U q]", "EF q"),
        ("A[p U AF q]", "AF q"),
        ("AF false", "false"),
        ("EX true", "!deadlock"),
        ("AX false", "deadlock"),
        ("A (F G F p)", "AG AF p"),
        ("A (G (p -> F q))", "AG (p <= 0 | AF q)"),
        ("A (p | G q)", "p | AG q"),
        ("A (G F p -> G F q)", "A (!G F p | G F q)"),
        ("A (X X true)", "true"),
        ("E X F true", "true"),
        ("A !X p", "!(deadlock & p | EX p)"),
    ] {
        let simplified = formula(text).simplified();
        assert_eq!(simplified.display(&net()).to_string(), simple, "{text}");
    }
}

#[test]
fn broken_texts_are_refused_with_position_and_remedy() {
    let broken = [
        "",
        " \n ",
        "EF",
        "EF onn",
        "EF waitin",
        "AG (p & q",
        "AG p)",
        "p q",
        "p &",
        "p & & q",
        "& p",
        "G p",
        "p U q",
        "EF (F p U q)",
        "A (p U q & p)",
        "A (p -> p U q)",
        "AG p + q",
        "AG 3",
        "p & 3",
        "(p & q) <= 3",
        "p + (p & q) <= 3",
        "1 <= p <= 3",
        "p * q <= 3",
        "p <= q <= 3",
        "start",
        "fireable(p)",
        "fireable()",
        "fireable(start stop)",
        "fireable",
        "firable(start)",
        "foo(start)",
        "bounds(p q)",
        "bounds(p + p)",
        "bounds()",
        "bounds(p) & p",
        "bound(p -> q)",
        "bound(start, q)",
        "AG live",
        "live p",
        "EF<=3 p",
        "AF<=p q",
        "AF<=99999999999999999999ms p",
        "AF<=18446744073709551615s p",
        "p <= 99999999999999999999",
        "18446744073709551615 * p <= 1",
        "9223372036854775807 * (9223372036854775807 * (9223372036854775807 * p)) <= 1",
        "p # q",
        "p\n  & \"a b",
        "{a b",
        "{a {b}",
        "\"a\\b\"",
        "\"\\u{110000}\"",
        "E p",
        "U",
        "p and or",
        "E[p U q",
        "E[p U q)",
        "A [p",
        "-p <= 3",
        "\u{202e}p",
        "bounds(F)",
        "EF E p",
        "AG p -> q",
        "AG p & q",
        "EF {}",
        "p <= deadlock",
        "true <= 3",
        "AF p assuming",
        "AF p assuming fair(start)",
        "AF p assuming weak(p)",
        "AF p assuming weak(start) strong(stop)",
        "AF p assuming weak(start),",
        "AF p assuming often(AF q)",
        "AF p assuming often(p",
        "p & A (G F p) assuming weak(start)",
        "AF<=5ms p assuming weak(start)",
        "live assuming weak(start)",
    ];
    let mut said = String::new();
    for text in broken {
        match parse(text, &net()) {
            Ok(property) => {
                writeln!(said, "{text:?}\n  is {}\n", property.question.display(&net()))
            }
            Err(error) => writeln!(said, "{text:?}\n{error}\n"),
        }
        .unwrap();
    }
    cotama_golden::compare("tests/golden/properties/errors.txt", &said);
}
