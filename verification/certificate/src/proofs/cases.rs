//! Refutations by several cases: the parts of an `or`, and the two sides of an inequality.

use super::{Small, accepts, few, pt};
use crate::{Case, Evidence, Fact, Formula, Linear, Question, Refutation};

fn linear(constant: i64, a: i64, b: i64) -> Linear {
    Linear { constant, weights: vec![("a".into(), a), ("b".into(), b)] }
}

/// Whether a refutation of `EF` of this goal, from these facts, by these cases, is accepted.
fn refuted(small: &Small, goal: Formula, facts: Vec<Fact>, cases: Vec<Case>) -> bool {
    let evidence = Evidence::Refutation(Refutation { dead: Vec::new(), facts, cases });
    accepts(&pt(small), Question::Formula(Formula::reached(goal)), false, evidence)
}

/// Whether a marking like this is reached, of the first few.
fn reached(small: &Small, goal: impl Fn([u32; 2]) -> bool) -> bool {
    let (mut all, mut next) = (vec![small.initial], 0);
    while let Some(&marking) = all.get(next) {
        next += 1;
        if goal(marking) {
            return true;
        }
        for after in [0, 1].into_iter().filter_map(|it| small.fire(marking, it)) {
            if all.len() < 12 && !all.contains(&after) {
                all.push(after);
            }
        }
    }
    false
}

/// A refutation by the parts of an `or` is true when it is accepted: none of the parts is left out,
/// and none is refuted by what another one assumes.
#[kani::proof]
#[kani::unwind(14)]
pub fn a_refutation_by_a_split_is_true() {
    let small = Small::any();
    kani::assume(small.take[1] == [0, 1] && small.initial == [1, 0]);
    let most = i64::from(few::<1>()) + 1;
    let least = [0; 2].map(|_: i64| i64::from(few::<1>()) + 1);
    let parts = ["a", "b"].into_iter().zip(least);
    let parts = parts.map(|(place, least)| Formula::at_least(least, &[place.to_string()]));
    let facts = vec![Fact::AtMost(linear(-most, i64::from(few::<1>()), 1))];
    // The fact, and the assumption.
    let leaf = |assumed| Case::Contradiction(vec![(0, u64::from(few::<1>())), (assumed, 1)]);
    let mut cases = vec![Case::Split(0), leaf(1), leaf(1 + usize::from(few::<1>()))];
    cases.truncate(2 + usize::from(few::<1>()));
    let count = cases.len();
    let said = refuted(&small, Formula::Or(parts.collect()), facts, cases);
    let is_goal = |it: [u32; 2]| (0..2).any(|at| i64::from(it[at]) >= least[at]);
    assert!(!(said && reached(&small, is_goal)));
    kani::cover!(said, "neither is reached");
    kani::cover!(!said && count == 3 && !reached(&small, is_goal), "another reason");
    kani::cover!(!said && !is_goal(small.initial) && reached(&small, is_goal), "reached later");
}

/// A refutation by the two sides of an inequality is true when it is accepted: tokens are whole, so
/// each side is refuted, and no marking lies between them.
#[kani::proof]
#[kani::unwind(14)]
pub fn a_refutation_by_a_cut_is_true() {
    let small = Small::any();
    kani::assume(small.take == [[1, 0], [0, 1]] && small.initial[0] == 1);
    // The goal: twice the tokens of `b` are just so many.
    let (just, at) = (i64::from(few::<2>()), i64::from(few::<1>()));
    let goal = [linear(-just, 0, 2), linear(just, 0, -2)];
    let leaf = || {
        let factors = [few::<1>(), few::<1>(), 1 + few::<1>()].map(u64::from);
        Case::Contradiction((0..).zip(factors).collect())
    };
    let mut cases = vec![Case::Cut(linear(-at, 0, 1)), leaf(), leaf()];
    cases.truncate(2 + usize::from(few::<1>()));
    let goal = Formula::And(goal.map(Formula::AtMost).into());
    let said = refuted(&small, goal, Vec::new(), cases);
    let is_goal = |it: [u32; 2]| 2 * i64::from(it[1]) == just;
    assert!(!(said && reached(&small, is_goal)));
    assert!(!said || just == 2 * at + 1);
    kani::cover!(said, "odd, so never");
    kani::cover!(!said && reached(&small, is_goal), "reached");
}
