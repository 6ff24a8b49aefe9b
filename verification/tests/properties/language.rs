//! The property language. What is said of broken texts is in `tests/golden/properties/errors.txt`;
//! `UPDATE_GOLDEN=1 cargo test -p cotama-verification --test engines properties` writes it again.

use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{PlaceId, TransitionId};
use cotama_verification::property::{
    Assumptions, Atom, Formula, Kind, Linear, MAX_DEPTH, MAX_TEXT, Question, parse,
};
use cotama_verification::pt::Pt;
use std::fmt::Write as _;

const P: PlaceId = PlaceId(0);
const Q: PlaceId = PlaceId(1);
const START: TransitionId = TransitionId(0);
const STOP: TransitionId = TransitionId(1);

/// Places `p`, `q`, `waiting`, `a b` and `E`; transitions `start` and `stop`.
fn net() -> Pt {
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

fn formula(text: &str) -> Formula {
    match question(text) {
        Question::Formula(formula) => formula,
        other => panic!("{text}: {other:?}"),
    }
}

fn marked(place: PlaceId) -> Formula {
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
    assert_eq!(formula("AG p & q"), formula("(AG p) & q"));
    assert_eq!(formula("AG p <= 3"), formula("AG (p <= 3)"));
    assert_eq!(formula("AG !p"), formula("A G (!(p))"));
    assert_eq!(formula("E[p U q U p]"), formula("E (p U (q U p))"));
    assert_eq!(formula("A[!p U q <= 1]"), formula("A ((!p) U (q <= 1))"));
    assert_eq!(formula("AF<=2s p"), Formula::All(Formula::Within(2000, p.clone().into()).into()));
    assert_eq!(formula("A (p -> F<=5 ms q)"), formula("A (!p | F<=5ms q)"));
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
fn broken_texts_are_refused_with_their_place_and_what_to_do() {
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
        "E",
        "E p",
        "U",
        "p and or",
        "E[p U q",
        "E[p U q)",
        "A [p",
        "-p <= 3",
        "\u{202e}p",
        "bounds(E)",
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

/// What a text of this depth becomes, on a stack of 1 MiB.
fn nested(text: String) -> Result<usize, String> {
    let read = move || {
        let property = parse(&text, &net()).map_err(|error| error.to_string())?;
        let Question::Formula(formula) = &property.question else { panic!("not a formula") };
        Ok(formula.simplified().display(&net()).to_string().len()
            + formula.clone().display(&net()).to_string().len())
    };
    std::thread::Builder::new().stack_size(1 << 20).spawn(read).unwrap().join().unwrap()
}

#[test]
fn texts_may_be_nested_so_deep_and_no_deeper_on_a_small_stack() {
    type Text = fn(usize) -> String;
    // With how many bytes a level takes.
    let texts: [(Text, usize); 5] = [
        (|depth| format!("{}p{}", "(".repeat(depth), ")".repeat(depth)), 2),
        (|depth| format!("{}p", "!".repeat(depth)), 1),
        (|depth| format!("A {}p", "X ".repeat(depth - 1)), 2),
        (|depth| format!("{}p", "p -> ".repeat(depth)), 5),
        (|depth| format!("A[{}p]", "p U ".repeat(depth - 1)), 4),
    ];
    for (text, bytes) in texts {
        assert!(nested(text(MAX_DEPTH)).is_ok());
        for depth in [MAX_DEPTH + 1, MAX_TEXT / bytes - 16] {
            let said = nested(text(depth)).unwrap_err();
            assert!(said.contains("operators are nested more than 128 deep"), "{said}");
        }
    }
    let mixed = |depth: usize| format!("EF {}p{}", "(p & EF ".repeat(depth), ")".repeat(depth));
    assert!(nested(mixed((MAX_DEPTH - 1) / 2)).is_ok());
    assert!(nested(mixed(MAX_DEPTH / 2)).is_err());
}

#[test]
fn a_text_may_be_long_and_no_longer() {
    let text = "p & ".repeat(MAX_TEXT / 4 - 1) + "p";
    assert_eq!(formula(&text).simplified(), marked(P));
    let error = parse(&"p".repeat(MAX_TEXT + 1), &net()).unwrap_err();
    assert_eq!(
        error.to_string(),
        "property:1:1: the text has 1048577 bytes, more than 1048576\n  help: ask for its parts \
         one by one"
    );
}

#[test]
fn equivalences_may_not_double_a_formula_for_ever() {
    assert!(parse(&("p <-> ".repeat(12) + "p"), &net()).is_ok());
    for text in
        ["p <-> ".repeat(40) + "p", format!("({}p) & ", "p <-> ".repeat(12)).repeat(1_000) + "p"]
    {
        let error = parse(&text, &net()).unwrap_err();
        assert_eq!(error.message, "the formula is too long when its equivalences are written out");
    }
}
