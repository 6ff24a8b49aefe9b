//! Simpler formulas and normal forms say what the formula said, in every reachable marking of
//! random nets.

use crate::properties::oracle::{self, Space};
use crate::properties::random::{Random, branching, net, path, quantified, state};
use cotama_core::net::PlaceId;
use cotama_verification::property::{
    Atom, Condition, Ctl, CtlNode, Formula, Kind, Linear, Ltl, LtlNode, Reachability,
};

fn temporal_parts(formula: &Formula) -> usize {
    let own = usize::from(matches!(
        formula,
        Formula::Next(_) | Formula::Finally(_) | Formula::Globally(_) | Formula::Until(..)
    ));
    own + match formula {
        Formula::And(all) | Formula::Or(all) => all.iter().map(temporal_parts).sum(),
        Formula::Until(a, b) => temporal_parts(a) + temporal_parts(b),
        Formula::Not(a)
        | Formula::Next(a)
        | Formula::Finally(a)
        | Formula::Globally(a)
        | Formula::Exists(a)
        | Formula::All(a) => temporal_parts(a),
        _ => 0,
    }
}

#[test]
fn a_simplified_formula_holds_where_the_formula_holds() {
    let mut random = Random(2);
    let mut shorter = 0;
    let mut compared = 0;
    while compared < 6_000 {
        let net = net(&mut random);
        let space = Space::new(&net);
        let formula = match compared % 3 {
            0 => branching(&mut random, &net, 4),
            1 => {
                let path = path(&mut random, &net, 3, false);
                quantified(&mut random, path)
            }
            _ => {
                let path = path(&mut random, &net, 3, true);
                quantified(&mut random, path)
            }
        };
        if temporal_parts(&formula) > 5 || space.markings.len() > 12 {
            continue;
        }
        compared += 1;
        let simplified = formula.simplified();
        let shown =
            || format!("{} as {} on {net:?}", formula.display(&net), simplified.display(&net));
        assert_eq!(space.satisfying(&simplified), space.satisfying(&formula), "{}", shown());
        assert!(!simplified.needs_run());
        shorter += u32::from(simplified != formula);
    }
    assert!(shorter > 1_000, "{shorter}");
}

#[test]
fn a_simplified_formula_stays_as_it_is_when_it_is_simplified_again() {
    let mut random = Random(3);
    for _ in 0..3_000 {
        let net = net(&mut random);
        let formula = state(&mut random, &net, 4).simplified();
        assert_eq!(formula.simplified(), formula, "{}", formula.display(&net));
    }
}

/// Returns the markings in which each node holds, by the book.
fn evaluated(space: &Space<'_>, ctl: &Ctl) -> Vec<bool> {
    let mut all: Vec<Vec<bool>> = Vec::new();
    for node in ctl.nodes() {
        let of = |at: &u32| &all[*at as usize];
        let markings = 0..space.markings.len();
        let some = |set: &[bool], at: usize| space.successors[at].iter().any(|&it| set[it]);
        let holds = match node {
            CtlNode::State(formula) => space.satisfying(formula),
            CtlNode::Not(a) => of(a).iter().map(|it| !it).collect(),
            CtlNode::And(parts) => markings.map(|at| parts.iter().all(|it| of(it)[at])).collect(),
            CtlNode::Or(parts) => markings.map(|at| parts.iter().any(|it| of(it)[at])).collect(),
            CtlNode::Next(a) => markings.map(|at| some(of(a), at)).collect(),
            CtlNode::Until(a, b) => {
                let mut set = of(b).clone();
                while let Some(at) =
                    markings.clone().find(|&at| !set[at] && of(a)[at] && some(&set, at))
                {
                    set[at] = true;
                }
                set
            }
            CtlNode::Globally(a) => {
                let mut set = of(a).clone();
                let ends = |at: usize| space.successors[at].is_empty();
                while let Some(at) =
                    markings.clone().find(|&at| set[at] && !ends(at) && !some(&set, at))
                {
                    set[at] = false;
                }
                set
            }
        };
        all.push(holds);
    }
    all[ctl.root() as usize].clone()
}

#[test]
fn the_normal_form_of_ctl_holds_where_the_formula_holds() {
    let mut random = Random(4);
    for _ in 0..4_000 {
        let net = net(&mut random);
        let space = Space::new(&net);
        let formula = branching(&mut random, &net, 4);
        let shown = format!("{} on {net:?}", formula.display(&net));
        let expected = space.satisfying(&formula);
        for formula in [formula.clone(), formula.simplified()] {
            let ctl = Ctl::new(&formula).unwrap();
            assert_eq!(evaluated(&space, &ctl), expected, "{shown}");
        }
    }
}

fn formula_of(ltl: &Ltl, at: u32) -> Formula {
    let of = |at: &u32| formula_of(ltl, *at);
    let not = |at: &u32| Box::new(Formula::Not(of(at).into()));
    match &ltl.nodes()[at as usize] {
        LtlNode::State(formula) => formula.clone(),
        LtlNode::Fires(_) => unreachable!("nothing is assumed"),
        LtlNode::And(all) => Formula::And(all.iter().map(of).collect()),
        LtlNode::Or(all) => Formula::Or(all.iter().map(of).collect()),
        LtlNode::Next(a) => Formula::Next(of(a).into()),
        LtlNode::Until(a, b) => Formula::Until(of(a).into(), of(b).into()),
        LtlNode::Release(a, b) => Formula::Not(Formula::Until(not(a), not(b)).into()),
    }
}

#[test]
fn the_normal_form_of_ltl_and_of_its_negation_are_true_of_the_right_runs() {
    let mut random = Random(5);
    let mut compared = 0;
    while compared < 2_000 {
        let net = net(&mut random);
        let space = Space::new(&net);
        let path = path(&mut random, &net, 3, false);
        if temporal_parts(&path) > 4
            || space.markings.len() > 10
            || matches!(path, Formula::Next(_))
        {
            continue;
        }
        compared += 1;
        let shown = || format!("{} on {net:?}", Formula::Exists(path.clone().into()).display(&net));
        // In a conjunction a next marking is that of the run, not a successor.
        let some = |path: Formula| {
            space.satisfying(&Formula::Exists(Formula::And(vec![path, Formula::TRUE]).into()))
        };
        let [positive, negative] = [Ltl::new(&path).unwrap(), Ltl::negation_of(&path).unwrap()];
        assert_eq!(some(formula_of(&positive, positive.root())), some(path.clone()), "{}", shown());
        let not = Formula::Not(path.clone().into());
        assert_eq!(some(formula_of(&negative, negative.root())), some(not), "not {}", shown());
    }
}

#[test]
fn a_question_of_reachability_is_answered_by_its_goal() {
    let mut random = Random(6);
    for round in 0..2_000 {
        let net = net(&mut random);
        let goal = Box::new(state(&mut random, &net, 3));
        let formula = match round % 3 {
            0 => Formula::Exists(Formula::Finally(goal).into()),
            1 => Formula::All(Formula::Globally(goal).into()),
            _ => Formula::Not(Formula::All(Formula::Globally(goal).into()).into()),
        };
        assert_eq!(formula.kind(), Kind::Reachability);
        let reachability = Reachability::new(&formula).unwrap();
        let space = Space::new(&net);
        let found = space.satisfying(&reachability.goal).contains(&true);
        assert_eq!(found == reachability.expected, oracle::holds(&net, &formula));
    }
}

#[test]
fn a_condition_holds_in_the_markings_in_which_its_formula_holds() {
    let mut random = Random(7);
    for _ in 0..5_000 {
        let net = net(&mut random);
        let formula = state(&mut random, &net, 4);
        let space = Space::new(&net);
        let expected = space.satisfying(&formula);
        let condition = Condition::new(&formula, &net).unwrap();
        for (marking, expected) in space.markings.iter().zip(expected) {
            let shown = || format!("{} in {marking:?}", formula.display(&net));
            assert_eq!(condition.holds(marking.as_slice()), expected, "{}", shown());
            let wide: Vec<u64> = marking.iter().copied().map(u64::from).collect();
            assert_eq!(condition.holds(wide.as_slice()), expected, "{}", shown());
        }
    }
}

#[test]
fn conditions_count_without_overflow() {
    let net = net(&mut Random(8));
    let linear = |constant, weights: &[i64]| {
        let weights = (0..).map(PlaceId).zip(weights.iter().copied()).collect();
        let formula = Formula::Atom(Atom::AtMost(Linear { constant, weights }));
        Condition::new(&formula, &net).unwrap().holds([u64::MAX, u64::MAX].as_slice())
    };
    assert!(!linear(i64::MIN, &[i64::MAX]));
    assert!(!linear(i64::MAX, &[i64::MAX, i64::MAX]));
    assert!(linear(i64::MAX, &[i64::MIN, i64::MIN]));
    assert!(linear(i64::MAX, &[i64::MIN]));
    assert!(linear(0, &[i64::MAX, -i64::MAX]));
    assert!(!linear(1, &[i64::MAX, -i64::MAX]));
    assert!(linear(1, &[-1]));
    assert!(!linear(1, &[]) && linear(0, &[]));
}

#[test]
fn a_formula_with_operators_of_time_has_no_normal_form() {
    let within = Formula::All(Formula::Within(5, Formula::Atom(Atom::Deadlock).into()).into());
    assert_eq!(within.kind(), Kind::Timed);
    assert_eq!(
        (Ctl::new(&within), Ltl::new(&within), Reachability::new(&within)),
        (None, None, None)
    );
}

#[test]
fn long_rows_of_operators_are_simplified_in_proportion() {
    let path = (0..200).fold(Formula::Atom(Atom::Deadlock), |path, _| {
        Formula::All(Formula::Not(Formula::Next(path.into()).into()).into())
    });
    let next = (0..200).fold(Formula::Atom(Atom::Deadlock), |path, _| Formula::Next(path.into()));
    for formula in [path, Formula::All(next.into())] {
        let mut parts = 0_usize;
        let simplified = formula.simplified();
        let mut stack = vec![&simplified];
        while let Some(formula) = stack.pop() {
            parts += 1;
            match formula {
                Formula::And(all) | Formula::Or(all) => stack.extend(all),
                Formula::Not(a) | Formula::Next(a) | Formula::Exists(a) | Formula::All(a) => {
                    stack.push(a);
                }
                _ => {}
            }
        }
        assert!(parts < 1_500, "{parts}");
    }
}
