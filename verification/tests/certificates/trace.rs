//! Ways to a marking.

use crate::certificates::stories::*;
use crate::certificates::{all_refused, shown};
use cotama_verification::certificate::{Certificate, Evidence, Formula, Question};
use serde_json::json;

fn jammed() -> Certificate {
    let tools = tools();
    let evidence = Evidence::trace(&tools, &[0, 2]);
    Certificate::of(&tools, "jam", Question::Formula(e(f(Formula::Deadlock))), true, evidence)
}

#[test]
fn two_robots_with_one_tool_each_are_stuck() {
    assert_eq!(
        shown(&jammed()),
        "net tools (6 places, 4 transitions): E(F(deadlock)) is true\n  by a trace of 2 firings"
    );
}

#[test]
fn a_trace_that_does_not_lead_there_is_refused() {
    let misfit = "evidence: this kind of evidence does not fit the claim";
    let not_enabled = "evidence.trace.fire[1]: `drill2` is not enabled";
    all_refused(
        &jammed(),
        vec![
            (
                "/schema",
                json!("cotama-certificate/2"),
                "schema: is `cotama-certificate/2`, not `cotama-certificate/1`",
            ),
            ("/verdict", json!(false), "evidence: this kind of evidence does not fit the claim"),
            ("/evidence", json!("none"), "evidence: there is no evidence"),
            (
                "/evidence",
                json!("state"),
                "evidence: speaks of runs where one marking is to decide",
            ),
            (
                "/evidence/trace/fire",
                json!(["saw1"]),
                "evidence.trace.then: the opposite of what is claimed is so",
            ),
            (
                "/evidence/trace/fire",
                json!([]),
                "evidence.trace.then: the opposite of what is claimed is so",
            ),
            (
                "/evidence/trace/fire",
                json!(["saw1", "saw1"]),
                "evidence.trace.fire[1]: `saw1` is not enabled",
            ),
            (
                "/evidence/trace/fire/0",
                json!("paint"),
                "evidence.trace.fire[0]: there is no `paint`",
            ),
            (
                "/evidence/trace/fire/0",
                json!("saw2"),
                "evidence.trace.fire[0]: `saw2` is not enabled",
            ),
            ("/evidence/trace/then", json!("none"), "evidence.trace.then: there is no evidence"),
            ("/net/places/1/1", json!(0), not_enabled),
            ("/net/transitions/2/take/0/1", json!(2), not_enabled),
            ("/net/transitions/2/take/0/1", json!(0), "net.transitions[2]: an arc has weight 0"),
            (
                "/net/places/0/1",
                json!(2),
                "evidence.trace.then: the opposite of what is claimed is so",
            ),
            (
                "/net/places/0/0",
                json!("drill"),
                "net: two places or two transitions have the same name",
            ),
            (
                "/question",
                json!({"formula": {"A": {"F": "deadlock"}}}),
                "evidence: this kind of evidence does not fit the claim",
            ),
            ("/question", json!({"formula": {"EX": "deadlock"}}), misfit),
            ("/question", json!("live"), "evidence: this kind of evidence does not fit the claim"),
            (
                "/question",
                json!({"formula": {"E": {"F": {"fireable": ["fly"]}}}}),
                "question: there is no `fly`",
            ),
        ],
    );
}

#[test]
fn a_successor_is_one_step_away() {
    let battery = battery();
    let misfit = "evidence: this kind of evidence does not fit the claim";
    let question = Question::Formula(ax(has("full", 2)));
    let certificate =
        Certificate::of(&battery, "", question.clone(), false, Evidence::trace(&battery, &[0]));
    assert_eq!(
        shown(&certificate),
        "net battery (3 places, 3 transitions): AX (2 <= full) is false\n  by a trace of 1 firing"
    );
    all_refused(
        &certificate,
        vec![
            ("/evidence/trace/fire", json!([]), misfit),
            ("/evidence/trace/fire", json!(["work", "work"]), misfit),
            ("/verdict", json!(true), "evidence: this kind of evidence does not fit the claim"),
        ],
    );
}

#[test]
fn until_is_watched_on_the_way() {
    let battery = battery();
    let question = Question::Formula(e(u(has("full", 1), has("empty", 2))));
    let certificate =
        Certificate::of(&battery, "", question, true, Evidence::trace(&battery, &[0, 0]));
    assert_eq!(
        shown(&certificate),
        "net battery (3 places, 3 transitions): E((1 <= full) U (2 <= empty)) is true\n  by a \
         trace of 2 firings"
    );
    all_refused(
        &certificate,
        vec![(
            "/question/formula/E/U/0/at_most/constant",
            json!(2),
            "evidence.trace.fire[1]: the opposite of what is claimed is so",
        )],
    );
}

#[test]
fn a_broken_battery_ends_the_hope_that_it_works_again() {
    // Not live: after the break, no set of markings but that one is needed to see that `work` is
    // gone.
    let battery = battery();
    let question = Question::Formula(a(g(e(f(fireable("work"))))));
    let evidence = Evidence::trace_then(&battery, &[0, 0, 2], Evidence::Graph(1));
    assert_eq!(
        shown(&Certificate::of(&battery, "", question, false, evidence)),
        "net battery (3 places, 3 transitions): A(G(E(F(fireable(work))))) is false\n  \
         by a trace of 3 firings, and there passing through 1 marking"
    );
}

#[test]
fn a_negation_turns_around_the_claim_of_a_path() {
    let battery = battery();
    let way = |formula: Formula, verdict| {
        let evidence = Evidence::trace(&battery, &[0, 0]);
        shown(&Certificate::of(&battery, "", Question::Formula(formula), verdict, evidence))
    };
    let head = "net battery (3 places, 3 transitions): ";
    assert_eq!(
        way(e(not(g(has("full", 1)))), true),
        format!("{head}E(!(G(1 <= full))) is true\n  by a trace of 2 firings")
    );
    assert_eq!(
        way(not(e(f(has("empty", 2)))), false),
        format!("{head}!(E(F(2 <= empty))) is false\n  by a trace of 2 firings")
    );
}
