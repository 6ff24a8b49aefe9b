//! Formulas that every transition keeps: what sums of places cannot tell.

use crate::certificates::stories::*;
use crate::certificates::{all_refused, shown};
use cotama_verification::certificate::*;
use serde_json::json;

fn leaf(list: &[(usize, u64)]) -> Case {
    Case::Contradiction(list.to_vec())
}

/// Two gloves are taken from a shelf at once, or hung up again: there is never one alone.
fn gloves() -> Certificate {
    let shelf = net(
        "shelf",
        &[("gloves", 2), ("worn", 0)],
        &[
            ("take", &[("gloves", 2)], &[("worn", 1)]),
            ("hang_up", &[("worn", 1)], &[("gloves", 2)]),
        ],
    );
    // No glove, or two at least.
    let holds = Formula::Or(vec![not(has("gloves", 1)), has("gloves", 2)]);
    // Assumptions: gloves + 2 worn <= 2; it can fire; one glove is left.
    let kept = vec![
        ("take".to_owned(), vec![leaf(&[(0, 1), (2, 1)])]),
        ("hang_up".to_owned(), vec![leaf(&[(3, 1)])]),
    ];
    let evidence = Evidence::Refutation(Refutation {
        dead: vec![],
        facts: vec![
            Fact::sum(&shelf, &[(0, 1), (1, 2)], &shelf.initial).unwrap(),
            Fact::Inductive(Inductive { holds, kept }),
        ],
        cases: vec![Case::Split(0), leaf(&[(1, 1), (3, 1)]), leaf(&[(2, 1), (3, 1)])],
    });
    let alone = Formula::And(vec![has("gloves", 1), not(has("gloves", 2))]);
    Certificate::of(&shelf, "pairs", Question::Formula(a(g(not(alone)))), true, evidence)
}

#[test]
fn there_is_never_one_glove_alone() {
    assert_eq!(
        shown(&gloves()),
        "net shelf (2 places, 2 transitions): A(G(!((1 <= gloves) & (!(2 <= gloves))))) is true\n  \
         by 1 inequality, 1 inductive formula and 0 traps that exclude 2 cases"
    );
}

#[test]
fn an_inequality_that_a_transition_breaks_is_no_fact() {
    let fact = "/evidence/refutation/facts/1/inductive";
    let at = |pointer: &str| format!("{fact}{pointer}");
    let here = "evidence.refutation.facts[1]";
    let none = |name: &str| format!("{here}, `{name}`: there are none");
    all_refused(
        &gloves(),
        vec![
            (
                &at("/kept/0/1/0/contradiction/0/1"),
                json!(2),
                &format!("{here}, `take`[0]: no contradiction: the constant is not above 0"),
            ),
            (
                "/net/places/0/1",
                json!(1),
                &format!("{here}: the opposite of what is claimed is so"),
            ),
            (&at("/kept/0/0"), json!("hang_up"), &none("take")),
            (&at("/kept"), json!([]), &none("take")),
            (
                &at("/holds"),
                json!("deadlock"),
                &format!("{here}: speaks of runs where one marking is to decide"),
            ),
        ],
    );
}

#[test]
fn a_transition_that_leaves_a_formula_as_it_is_needs_no_cases() {
    let turn = net(
        "turn",
        &[("p", 1), ("q", 0)],
        &[("go", &[("p", 1)], &[("q", 1)]), ("back", &[("q", 1)], &[("p", 1)])],
    );
    let one = |weight: i64| Formula::AtMost(linear(-weight, &[("p", weight), ("q", weight)]));
    let holds = Formula::And(vec![one(1), one(-1)]);
    let evidence = Evidence::Refutation(Refutation {
        dead: vec![],
        facts: vec![Fact::Inductive(Inductive { holds, kept: vec![] })],
        cases: vec![leaf(&[(0, 1), (2, 1)])],
    });
    let question = Question::Formula(a(g(not(has("p", 2)))));
    assert_eq!(
        shown(&Certificate::of(&turn, "one", question, true, evidence)),
        "net turn (2 places, 2 transitions): A(G(!(2 <= p))) is true\n  \
         by 0 inequalities, 1 inductive formula and 0 traps that exclude 1 case"
    );
}
