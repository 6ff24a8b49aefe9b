//! All reachable markings.

use crate::certificates::stories::*;
use crate::certificates::{all_refused, shown};
use cotama_verification::certificate::*;
use cotama_verification::explicit;
use cotama_verification::pt::Pt;
use serde_json::json;

pub(crate) fn graph(pt: &Pt, question: Question, verdict: bool) -> Certificate {
    let graph = explicit::Graph::new(pt, &explicit::Limits::default(), &|_| ()).unwrap();
    Certificate::of(pt, "", question, verdict, Evidence::Graph(graph.states()))
}

/// Markings: full 2; 1 and 1; empty 2; broken.
fn breaks() -> Certificate {
    graph(&battery(), Question::Formula(e(f(has("broken", 1)))), true)
}

#[test]
fn the_battery_can_break() {
    assert_eq!(breaks().evidence, Evidence::Graph(4));
    assert_eq!(
        shown(&breaks()),
        "net battery (3 places, 3 transitions): E(F(1 <= broken)) is true\n  by passing through 4 \
         markings"
    );
}

#[test]
fn another_net_another_question_or_another_number_is_refused() {
    let opposite = "evidence.graph: the opposite of what is claimed is so";
    all_refused(
        &breaks(),
        vec![
            ("/verdict", json!(false), opposite),
            ("/evidence/graph", json!(3), "evidence.graph: there are more markings"),
            ("/evidence/graph", json!(5), "evidence.graph: there are fewer markings"),
            // Before any is passed through: nobody waits until memory is full.
            (
                "/evidence/graph",
                json!(1_u64 << 31),
                "evidence.graph: takes too much memory to check",
            ),
            ("/net/places/0/1", json!(3), "evidence.graph: there are more markings"),
            ("/net/places/0/1", json!(1), "evidence.graph: there are fewer markings"),
            ("/net/transitions/0/give/0/1", json!(2), "evidence.graph: there are more markings"),
            ("/net/transitions/2/take/0/1", json!(1), "evidence.graph: there are more markings"),
            ("/net/transitions/2/take/0/1", json!(3), "evidence.graph: there are fewer markings"),
            (
                "/net/transitions/2/take/0/0",
                json!("fuel"),
                "net.transitions[2]: there is no `fuel`",
            ),
            (
                "/question",
                json!({"formula":
                    {"A": {"F": {"at_most": {"constant": 1, "weights": [["broken", -1]]}}}}
                }),
                opposite,
            ),
            (
                "/question",
                json!({"formula": {"A": {"F": {"G": "deadlock"}}}}),
                "evidence.graph: speaks of runs where one marking is to decide",
            ),
            (
                "/question",
                json!({"unbounded": {"places": ["full"]}}),
                "question: only growth can show it",
            ),
        ],
    );
}

#[test]
fn every_operator_is_shown_true_and_false() {
    let battery = battery();
    let (full, dead) = (|| has("full", 1), || Formula::Deadlock);
    let expected = [
        (ex(has("empty", 1)), true),
        (ex(dead()), false),
        (ax(has("empty", 1)), true),
        (ax(dead()), false),
        (e(f(dead())), true),
        (a(f(dead())), false),
        (e(not(f(dead()))), true),
        (a(not(f(dead()))), false),
        (e(g(not(dead()))), true),
        (a(g(not(dead()))), false),
        (e(u(full(), has("empty", 2))), true),
        (a(u(full(), has("empty", 2))), false),
        (a(g(Formula::Or(vec![dead(), ex(full()), e(f(dead()))]))), true),
        (a(g(e(f(full())))), false),
        (e(f(a(g(dead())))), true),
        (a(f(has("empty", 1))), true),
        (a(u(has("full", 2), has("empty", 1))), true),
        (e(u(has("full", 2), has("empty", 2))), false),
        (a(g(e(f(ax(Formula::Or(vec![])))))), true),
    ];
    for (formula, verdict) in expected {
        let words = formula.to_string();
        let mut certificate = graph(&battery, Question::Formula(formula), verdict);
        shown(&certificate);
        certificate.verdict = !verdict;
        let error = verify(&certificate.text()).unwrap_err().to_string();
        assert!(
            error == "evidence.graph: the opposite of what is claimed is so",
            "{words}: {error}"
        );
    }
}

#[test]
fn the_questions_about_the_whole_net_have_answers() {
    let answers = |pt: &Pt, answers: [bool; 4]| {
        let questions = [Question::Live, Question::QuasiLive, Question::Stable, Question::OneSafe];
        for (question, verdict) in questions.into_iter().zip(answers) {
            shown(&graph(pt, question.clone(), verdict));
            assert!(verify(&graph(pt, question, !verdict).text()).is_err());
        }
    };
    answers(&track(), [true, true, false, true]);
    answers(&tools(), [false, true, false, true]);
    answers(&battery(), [false, true, false, false]);
    let bound = |most, verdict| {
        let question = Question::Bound { places: vec!["full".into(), "broken".into()], most };
        graph(&battery(), question, verdict)
    };
    for (most, verdict) in [(1, false), (2, true), (3, false)] {
        shown(&bound(most, verdict));
        assert!(verify(&bound(most, !verdict).text()).is_err());
    }
    assert_eq!(
        shown(&bound(2, true)),
        "net battery (3 places, 3 transitions): bounds(full + broken) = 2 is true\n  by passing \
         through 4 markings"
    );
}
