//! Proofs without markings: inequalities, traps, cases.

use crate::certificates::stories::*;
use crate::certificates::{all_refused, shown};
use cotama_verification::certificate::*;
use serde_json::json;

fn leaf(list: &[(usize, u64)]) -> Case {
    Case::Contradiction(list.to_vec())
}

fn exclusive() -> Certificate {
    let track = track();
    let both = Formula::And(vec![has("on1", 1), has("on2", 1)]);
    let evidence = Evidence::Refutation(Refutation {
        dead: vec![],
        facts: vec![Fact::sum(&track, &[(0, 1), (2, 1), (4, 1)], &track.initial).unwrap()],
        cases: vec![leaf(&[(0, 1), (1, 1), (2, 1)])],
    });
    Certificate::of(&track, "exclusive", Question::Formula(a(g(not(both)))), true, evidence)
}

#[test]
fn never_two_robots_on_the_track() {
    assert_eq!(
        shown(&exclusive()),
        "net track (5 places, 4 transitions): A(G(!((1 <= on1) & (1 <= on2)))) is true\n  \
         by 1 inequality and 0 traps that exclude 1 case"
    );
}

#[test]
fn an_inequality_that_does_not_exclude_it_is_refused() {
    let case = |words: &str| format!("evidence.refutation.cases[0]: no contradiction: {words}");
    let (constant, on1) =
        (case("the constant is not above 0"), case("a place has a negative weight"));
    let leaf = "/evidence/refutation/cases/0/contradiction";
    let sum = "/evidence/refutation/facts/0/at_most";
    let at = |pointer: &str| format!("{sum}{pointer}");
    all_refused(
        &exclusive(),
        vec![
            ("/verdict", json!(false), "evidence: this kind of evidence does not fit the claim"),
            (
                &at("/constant"),
                json!(0),
                "evidence.refutation.facts[0]: does not hold at the start",
            ),
            (&at("/constant"), json!(-2), &constant),
            (&at("/weights/1/1"), json!(2), "evidence.refutation.facts[0]: `enter1` breaks it"),
            (&at("/weights/1/1"), json!(0), "evidence.refutation.facts[0]: `leave1` breaks it"),
            (
                &at("/weights/0/0"),
                json!("wait1"),
                "evidence.refutation.facts[0]: `enter2` breaks it",
            ),
            (
                &at("/weights/0/1"),
                json!(i64::MIN),
                "evidence.refutation.facts[0]: `enter1` breaks it",
            ),
            (leaf, json!([[1, 1], [2, 1]]), &on1),
            (leaf, json!([[0, 1], [1, 1]]), &constant),
            (leaf, json!([[0, 1], [1, 1], [2, 2]]), &on1),
            (
                leaf,
                json!([[0, 1], [1, 1], [3, 1]]),
                "evidence.refutation.cases[0]: there is no inequality 3",
            ),
            (leaf, json!([[1, 1], [1, 1], [2, 1]]), &on1),
            ("/evidence/refutation/cases", json!([]), "evidence.refutation.cases: there are none"),
            (
                "/evidence/refutation/cases/0",
                json!({"split": 0}),
                "evidence.refutation.cases[0]: there is no open `or` 0",
            ),
            (
                "/evidence/refutation/facts",
                json!([]),
                "evidence.refutation.cases[0]: there is no inequality 2",
            ),
            (
                "/net/transitions/0/give/0/1",
                json!(2),
                "evidence.refutation.facts[0]: `enter1` breaks it",
            ),
            (
                "/net/places/4/1",
                json!(1),
                "evidence.refutation.facts[0]: does not hold at the start",
            ),
            (
                "/question",
                json!("one_safe"),
                "evidence.refutation.cases[0]: there is no inequality 1",
            ),
            (
                "/question/formula",
                json!({"A": {"G": {"E": {"F": "deadlock"}}}}),
                "evidence.refutation.cases[0]: there is no inequality 1",
            ),
        ],
    );
}

/// The track is never in deadlock: the goal assumes that nobody is on it (`leave1`, `leave2`), so
/// it is free; then both robots would have to be away.
fn no_deadlock() -> Certificate {
    let track = track();
    let sum = |weights| Fact::sum(&track, weights, &track.initial).unwrap();
    // At least one token in these places.
    let evidence = Evidence::Refutation(Refutation {
        dead: vec![],
        facts: vec![sum(&[(0, -1), (2, -1), (4, -1)]), Fact::trap(&track, &[1, 2])],
        cases: vec![
            Case::Split(0),
            // free <= 0
            leaf(&[(0, 1), (2, 1), (3, 1), (4, 1)]),
            // wait1 <= 0
            leaf(&[(1, 1), (2, 1), (4, 1)]),
        ],
    });
    Certificate::of(&track, "", Question::Formula(a(g(not(Formula::Deadlock)))), true, evidence)
}

#[test]
fn the_track_is_never_stuck() {
    assert_eq!(
        shown(&no_deadlock()),
        "net track (5 places, 4 transitions): A(G(!(deadlock))) is true\n  \
         by 1 inequality and 1 trap that exclude 2 cases"
    );
}

#[test]
fn cases_that_do_not_close_are_refused() {
    let cases = "/evidence/refutation/cases";
    let at = |pointer: &str| format!("{cases}{pointer}");
    let trap = "/evidence/refutation/facts/1/trap";
    let no_trap = "evidence.refutation.facts[1]: `enter1` breaks it";
    let leaf = json!({"contradiction": [[1, 1], [2, 1], [4, 1]]});
    all_refused(
        &no_deadlock(),
        vec![
            (trap, json!(["wait1"]), no_trap),
            (trap, json!(["wait1", "on2"]), no_trap),
            (
                trap,
                json!(["on1", "on2"]),
                "evidence.refutation.facts[1]: does not hold at the start",
            ),
            (
                trap,
                json!(["wait1", "on1", "hall"]),
                "evidence.refutation.facts[1]: there is no `hall`",
            ),
            (trap, json!([]), "evidence.refutation.facts[1]: does not hold at the start"),
            (
                &at("/0"),
                json!({"split": 2}),
                "evidence.refutation.cases[0]: there is no open `or` 2",
            ),
            (&at("/0"), leaf.clone(), "evidence.refutation.cases[0]: there is no inequality 4"),
            (
                &at("/1"),
                leaf.clone(),
                "evidence.refutation.cases[1]: no contradiction: a place has a negative weight",
            ),
            (&at("/1"), json!({"split": 1}), "evidence.refutation.cases: some are missing"),
            (&at(""), json!([{"split": 0}, leaf]), "evidence.refutation.cases: some are missing"),
            (
                &at("/0/split"),
                json!(1),
                "evidence.refutation.cases[2]: no contradiction: a place has a negative weight",
            ),
            (
                &at("/2/contradiction/1/1"),
                json!(0),
                "evidence.refutation.cases[2]: no contradiction: a place has a negative weight",
            ),
            (
                "/net/transitions/3/give",
                json!([["wait2", 1]]),
                "evidence.refutation.facts[0]: `leave2` breaks it",
            ),
            (
                "/net/transitions/3/take/0/1",
                json!(2),
                "evidence.refutation.facts[0]: `leave2` breaks it",
            ),
        ],
    );
    let mut too_many = no_deadlock();
    let Evidence::Refutation(refutation) = &mut too_many.evidence else { panic!("no refutation") };
    refutation.cases.push(Case::Split(0));
    assert_eq!(
        verify(&too_many.text()).unwrap_err().to_string(),
        "evidence.refutation.cases: there are too many"
    );
}

#[test]
fn a_transition_that_never_fires_breaks_nothing() {
    // `cheat` would put a second robot on the track, but needs two free ones.
    let track = net(
        "track",
        &[("free", 1), ("on", 0)],
        &[
            ("enter", &[("free", 1)], &[("on", 1)]),
            ("leave", &[("on", 1)], &[("free", 1)]),
            ("cheat", &[("free", 2)], &[("on", 3)]),
        ],
    );
    let certificate = |dead| {
        let facts = vec![Fact::AtMost(linear(-1, &[("free", 1), ("on", 1)]))];
        let evidence =
            Evidence::Refutation(Refutation { dead, facts, cases: vec![leaf(&[(0, 1), (1, 1)])] });
        Certificate::of(&track, "", Question::Formula(e(f(has("on", 2)))), false, evidence)
    };
    let error = verify(&certificate(vec![]).text()).unwrap_err().to_string();
    assert_eq!(error, "evidence.refutation.facts[0]: `cheat` breaks it");
    // The first one to fire would fire in a marking in which the fact still holds.
    let dead = certificate(vec![("cheat".into(), vec![leaf(&[(0, 1), (1, 1)])])]);
    assert!(shown(&dead).ends_with("by 1 inequality and 0 traps that exclude 1 case"));
    let at = "/evidence/refutation/dead/0";
    let no = |place: &str| format!("evidence.refutation.{place}");
    let weight = "no contradiction: a place has a negative weight";
    all_refused(
        &dead,
        vec![
            (&format!("{at}/0"), json!("enter"), &no("facts[0]: `cheat` breaks it")),
            (&format!("{at}/0"), json!("fly"), &no("dead[0]: there is no `fly`")),
            (&format!("{at}/1"), json!([]), &no("dead[0]: there are none")),
            (
                &format!("{at}/1/0/contradiction"),
                json!([[1, 1]]),
                &no(&format!("dead[0][0]: {weight}")),
            ),
            (
                &format!("{at}/1/0/contradiction/1/1"),
                json!(2),
                &no(&format!("dead[0][0]: {weight}")),
            ),
            (
                &format!("{at}/1/0/contradiction/0/1"),
                json!(2),
                &no("dead[0][0]: no contradiction: the constant is not above 0"),
            ),
            (
                &format!("{at}/1/0/contradiction/1/0"),
                json!(2),
                &no("dead[0][0]: there is no inequality 2"),
            ),
            (
                "/net/transitions/2/take/0/1",
                json!(1),
                &no("dead[0][0]: no contradiction: the constant is not above 0"),
            ),
            ("/net/places/1/1", json!(1), &no("facts[0]: does not hold at the start")),
        ],
    );
}

#[test]
fn a_cut_excludes_fractions() {
    // 2 a + 2 b = 2 c + 1 has no solution in whole numbers: a sum of the state equation would allow
    // a = 1/2.
    let parity = net("parity", &[("odd", 1), ("two", 0)], &[("more", &[], &[("two", 2)])]);
    let goal = Formula::And(vec![at_most("odd", 0), Formula::AtMost(linear(1, &[("two", -1)]))]);
    let cut = linear(0, &[("two", 1)]);
    let evidence = Evidence::Refutation(Refutation {
        dead: vec![],
        facts: vec![Fact::AtMost(linear(1, &[("odd", -1)]))],
        cases: vec![Case::Cut(cut), leaf(&[(2, 1), (3, 1)]), leaf(&[(0, 1), (1, 1)])],
    });
    let certificate = Certificate::of(&parity, "", Question::Formula(e(f(goal))), false, evidence);
    assert!(shown(&certificate).ends_with("by 1 inequality and 0 traps that exclude 2 cases"));
    all_refused(
        &certificate,
        vec![(
            "/evidence/refutation/cases/0/cut/constant",
            json!(-1),
            "evidence.refutation.cases[1]: no contradiction: the constant is not above 0",
        )],
    );
}

#[test]
fn an_assumption_of_one_case_is_not_known_in_another() {
    let track = track();
    let waits = Formula::Or(vec![has("wait1", 1), has("wait2", 1)]);
    let both = Formula::And(vec![has("on1", 1), has("on2", 1), waits]);
    let goal = Formula::Or(vec![both, Formula::And(vec![has("free", 1), has("on1", 1)])]);
    let excluded = || leaf(&[(0, 1), (1, 1), (2, 1)]);
    let evidence = Evidence::Refutation(Refutation {
        dead: vec![],
        facts: vec![Fact::sum(&track, &[(0, 1), (2, 1), (4, 1)], &track.initial).unwrap()],
        cases: vec![Case::Split(0), Case::Split(1), excluded(), excluded(), excluded()],
    });
    let certificate = Certificate::of(&track, "", Question::Formula(e(f(goal))), false, evidence);
    assert!(shown(&certificate).ends_with("by 1 inequality and 0 traps that exclude 3 cases"));
    all_refused(
        &certificate,
        vec![
            (
                "/evidence/refutation/cases/4",
                json!({"split": 1}),
                "evidence.refutation.cases[4]: there is no open `or` 1",
            ),
            (
                "/evidence/refutation/cases/4/contradiction",
                json!([[0, 1], [1, 1], [3, 1]]),
                "evidence.refutation.cases[4]: there is no inequality 3",
            ),
        ],
    );
}
