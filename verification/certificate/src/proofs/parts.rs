//! Evidence for all parts of a formula, and for one of them.

use super::{Small, accepts, few, pt};
use crate::{Evidence, Formula, One, Question};

/// Evidence for each part, or for one, is accepted only where the whole is so as claimed: all parts
/// of an `and` hold, or one of an `or`, and the other way round where the verdict is no.
#[kani::proof]
#[kani::unwind(14)]
pub fn each_or_one_of_several_parts_is_so() {
    let (small, verdict, and): (_, bool, bool) = (Small::any(), kani::any(), kani::any());
    kani::assume(small.give[1] == [0, 0] && small.take[0][1] == 0);
    let Some(reachable) = small.reachable() else {
        kani::assume(false);
        return;
    };
    let named = |place: &str| [place.to_string()];
    // The first place holds two now; the second one comes to hold one.
    let parts = vec![
        Formula::at_least(2, &named("a")),
        Formula::reached(Formula::at_least(1, &named("b"))),
    ];
    let truths = [small.initial[0] >= 2, reachable.iter().any(|it| it[1] >= 1)];
    let formula = if and { Formula::And(parts) } else { Formula::Or(parts) };
    let truth = if and { truths[0] && truths[1] } else { truths[0] || truths[1] };
    let (pt, count) = (pt(&small), 1 + usize::from(few::<1>()));
    let any_evidence = || match few::<2>() {
        0 => Evidence::State,
        1 => Evidence::trace(&pt, &[]),
        2 => Evidence::trace(&pt, &[0]),
        _ => Evidence::Graph(count),
    };
    let each: bool = kani::any();
    let evidence = if each {
        let count = 1 + few::<1>();
        Evidence::Each((0..count).map(|_| any_evidence()).collect())
    } else {
        Evidence::One(One { part: few::<2>().into(), by: Box::new(any_evidence()) })
    };
    let said = accepts(&pt, Question::Formula(formula), verdict, evidence);
    assert!(!said || truth == verdict);
    kani::cover!(said && each && verdict, "all hold");
    kani::cover!(said && each && !verdict, "none holds");
    kani::cover!(said && !each && verdict, "one holds");
    kani::cover!(said && !each && !verdict && truths[0], "the other one does not hold");
    kani::cover!(!said && truth == verdict && reachable.len() == count, "too little is shown");
}
