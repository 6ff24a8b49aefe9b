//! Runs that go on for ever.

use crate::certificates::stories::*;
use crate::certificates::{all_refused, shown};
use cotama_verification::certificate::{Certificate, Evidence, Formula, Question};
use serde_json::json;

fn starved() -> Certificate {
    let track = track();
    let fair = f(has("on1", 1));
    Certificate::of(
        &track,
        "",
        Question::Formula(a(g(fair))),
        false,
        Evidence::lasso(&track, &[0, 1], &[2, 3]),
    )
}

#[test]
fn the_second_robot_may_have_the_track_for_ever() {
    assert_eq!(
        shown(&starved()),
        "net track (5 places, 4 transitions): A(G(F(1 <= on1))) is false\n  \
         by a run of 2 firings and a loop of 2 firings"
    );
}

#[test]
fn a_run_that_does_not_show_it_is_refused() {
    let (no_loop, not_so) = (
        "evidence.lasso.loop: does not lead back, or is empty where there is no deadlock",
        "evidence.lasso: the opposite of what is claimed is so",
    );
    all_refused(
        &starved(),
        vec![
            ("/evidence/lasso/loop", json!(["enter2"]), no_loop),
            ("/evidence/lasso/loop", json!([]), no_loop),
            ("/evidence/lasso/loop", json!(["enter1", "leave1"]), not_so),
            ("/evidence/lasso/loop", json!(["enter2", "leave2", "enter1", "leave1"]), not_so),
            (
                "/evidence/lasso/loop/1",
                json!("leave1"),
                "evidence.lasso.loop[1]: `leave1` is not enabled",
            ),
            (
                "/evidence/lasso/stem",
                json!(["enter1"]),
                "evidence.lasso.loop[0]: `enter2` is not enabled",
            ),
            (
                "/evidence/lasso/stem/0",
                json!("leave1"),
                "evidence.lasso.stem[0]: `leave1` is not enabled",
            ),
            ("/verdict", json!(true), "evidence: this kind of evidence does not fit the claim"),
            ("/question/formula/A/G/F/at_most/constant", json!(0), not_so),
            ("/question/formula/A/G/F/at_most/weights/0/0", json!("on2"), not_so),
            ("/net/transitions/3/give/0/1", json!(2), no_loop),
            ("/net/places/0/1", json!(0), "evidence.lasso.stem[0]: `enter1` is not enabled"),
            (
                "/question/formula/A/G",
                json!({"E": {"F": "deadlock"}}),
                "evidence.lasso: speaks of runs where one marking is to decide",
            ),
        ],
    );
}

#[test]
fn a_deadlock_lasts_for_ever() {
    let tools = tools();
    let never_idle = Question::Formula(a(g(f(has("idle1", 1)))));
    let certificate =
        Certificate::of(&tools, "", never_idle, false, Evidence::lasso(&tools, &[0, 2], &[]));
    assert_eq!(
        shown(&certificate),
        "net tools (6 places, 4 transitions): A(G(F(1 <= idle1))) is false\n  \
         by a run of 2 firings and a loop of 0 firings"
    );
    // And `X` inside of a run speaks of the marking that lasts.
    let lasts = Question::Formula(a(f(Formula::And(vec![
        Formula::Deadlock,
        x(x(not(Formula::Deadlock))),
    ]))));
    let lasts = Certificate::of(&tools, "", lasts, false, Evidence::lasso(&tools, &[0, 2], &[]));
    assert!(shown(&lasts).ends_with("by a run of 2 firings and a loop of 0 firings"));
}

#[test]
fn a_deadlock_has_no_successor() {
    let stuck = net("stuck", &[("here", 1)], &[("go", &[("here", 2)], &[])]);
    let next = |question, verdict, evidence| {
        let certificate =
            Certificate::of(&stuck, "", Question::Formula(question), verdict, evidence);
        cotama_verification::certificate::verify(&certificate.text()).map_err(|it| it.to_string())
    };
    let lasts = || Evidence::lasso(&stuck, &[], &[]);
    // EX true and AX false are wrong here, whatever the marking that lasts is like.
    let wrong = "evidence: this kind of evidence does not fit the claim";
    assert_eq!(next(ex(has("here", 1)), true, lasts()).unwrap_err(), wrong);
    assert_eq!(next(ax(has("here", 2)), false, lasts()).unwrap_err(), wrong);
    for (formula, truth) in [(ex(has("here", 1)), false), (ax(has("here", 2)), true)] {
        assert!(next(formula.clone(), truth, Evidence::Graph(1)).is_ok());
        let error = next(formula, !truth, Evidence::Graph(1)).unwrap_err();
        assert_eq!(error, "evidence.graph: the opposite of what is claimed is so");
    }
    // With a run in its operand, `X` speaks of the run.
    assert!(next(e(x(g(has("here", 1)))), true, lasts()).is_ok());
    assert!(next(a(not(x(has("here", 1)))), false, lasts()).is_ok());
}
