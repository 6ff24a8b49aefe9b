//! The checker of certificates accepts what is true, of all small nets, whatever evidence it is
//! given.

mod cases;
mod parts;
mod runs;

pub use cases::*;
pub use parts::*;
pub use runs::*;

use super::{Case, Certificate, Evidence, Fact, Formula, Linear, Question, Refutation, verify};
use cotama_core::proofs::few;
use cotama_property::pt::Pt;
use cotama_property::small::Small;

/// Returns whether the checker accepts a certificate.
fn accepts(pt: &Pt, question: Question, verdict: bool, evidence: Evidence) -> bool {
    let text = Certificate::of(pt, "", question, verdict, evidence).text();
    verify(&text).is_ok_and(|it| it.verdict == verdict)
}

fn pt(small: &Small) -> Pt {
    Pt::from(&small.net().view().net())
}

/// A verdict that is accepted for the number of reachable markings is true of them all, and the
/// number is right.
#[kani::proof]
#[kani::unwind(14)]
pub fn a_verdict_by_all_markings_is_true() {
    let (mut small, verdict) = (Small::any(), kani::any());
    kani::assume(small.initial[0] == 1 && small.give[1][0] == 0);
    small.initial[1] += 1;
    let (question, count) = (few::<2>(), usize::from(few::<2>()));
    let reachable = small.reachable();
    let fires = |transition| {
        let mut all = reachable.iter().flatten();
        all.any(|it| small.fire(*it, transition).is_some())
    };
    let stays = |at: usize| reachable.iter().flatten().all(|it| it[at] == small.initial[at]);
    let (asked, truth) = match question {
        0 => (Question::QuasiLive, fires(0) && fires(1)),
        1 => (Question::OneSafe, reachable.iter().flatten().all(|it| it[0] <= 1 && it[1] <= 1)),
        2 => (Question::Stable, stays(0) || stays(1)),
        _ => {
            let places = vec!["b".to_string()];
            let most = reachable.iter().flatten().map(|it| it[1]).max();
            (Question::Bound { places, most: 2 }, most == Some(2))
        }
    };
    let said = accepts(&pt(&small), asked, verdict, Evidence::Graph(count + 1));
    let right = reachable.as_ref().is_some_and(|it| it.len() == count + 1);
    assert!(!said || right && truth == verdict);
    // A bound that is not the most is no verdict that evidence of this kind is for.
    assert!(said || !right || truth != verdict || question == 3);
    kani::cover!(said && verdict && count > 1, "true, by several markings");
    kani::cover!(said && !verdict, "false");
}

/// A trace is accepted exactly when its transitions can fire one after the other and lead to what
/// is looked for.
#[kani::proof]
#[kani::unwind(5)]
pub fn a_trace_shows_its_last_marking() {
    let small = Small::any();
    let length = usize::from(few::<1>()) + 1;
    let fire: Vec<u32> = (0..length).map(|_| u32::from(few::<1>())).collect();
    let least = u32::from(few::<1>()) + 2;
    let end = fire.iter().try_fold(small.initial, |it, at| small.fire(it, *at as usize));
    let pt = pt(&small);
    let goal = Formula::reached(Formula::at_least(least.into(), &["b".to_string()]));
    let evidence = Evidence::trace(&pt, &fire);
    let said = accepts(&pt, Question::Formula(goal), true, evidence);
    assert!(said == end.is_some_and(|it| it[1] >= least));
    kani::cover!(said && length == 2, "two firings");
    kani::cover!(!said && end.is_some(), "they lead elsewhere");
}

/// A refutation that is accepted is true: when an inequality that no transition breaks, and sums of
/// it, are said to keep a place empty of so many tokens, it never holds them.
#[kani::proof]
#[kani::unwind(14)]
pub fn a_refutation_by_an_inequality_is_true() {
    let small = Small::any();
    kani::assume(small.take[1][1] == 1 && small.initial[0] == 1);
    let weight = |it: u8| i64::from(it) - 1;
    let (a, b) = (weight(few::<1>()), weight(few::<1>() + 1));
    let least = 2 + i64::from(few::<1>());
    let linear = Linear {
        constant: -i64::from(few::<2>()),
        weights: vec![("a".into(), a), ("b".into(), b)],
    };
    let facts = vec![Fact::AtMost(linear)];
    let cases = vec![Case::Contradiction(vec![(0, u64::from(few::<1>())), (1, 1)])];
    let goal = Formula::reached(Formula::at_least(least, &["b".to_string()]));
    let evidence = Evidence::Refutation(Refutation { dead: Vec::new(), facts, cases });
    let said = accepts(&pt(&small), Question::Formula(goal), false, evidence);
    if said {
        let mut marking = small.initial;
        // Enough of any run: with the first transition as often as it can, then with both.
        for step in 0..12 {
            assert!(i64::from(marking[1]) < least);
            let after = small.fire(marking, step % 2);
            marking = after.or_else(|| small.fire(marking, 1 - step % 2)).unwrap_or(marking);
        }
        let reached = small.reachable().unwrap_or_default();
        assert!(reached.iter().all(|it| i64::from(it[1]) < least));
    }
    kani::cover!(said && a == 0, "b alone never grows");
    kani::cover!(said && small.give[1][0] == 1, "the sum of both never grows");
}

/// A trap that is accepted stays marked, so what would empty it is never reached.
#[kani::proof]
#[kani::unwind(14)]
pub fn a_refutation_by_a_trap_is_true() {
    let small = Small::any();
    let places: Vec<String> = match few::<1>() {
        0 => vec!["b".into()],
        _ => vec!["a".into(), "b".into()],
    };
    let goal = Formula::reached(Formula::at_most(0, &places));
    let facts = vec![Fact::Trap(places.clone())];
    let cases = vec![Case::Contradiction(vec![(0, 1), (1, u64::from(few::<1>()))])];
    let evidence = Evidence::Refutation(Refutation { dead: Vec::new(), facts, cases });
    let said = accepts(&pt(&small), Question::Formula(goal), false, evidence);
    let is_empty = |it: &[u32; 2]| it[1] == 0 && (places.len() == 1 || it[0] == 0);
    let emptied = small.reachable().is_some_and(|it| it.iter().any(is_empty));
    assert!(!(said && emptied));
    kani::cover!(said && places.len() == 1, "one place");
    kani::cover!(emptied && !is_empty(&small.initial), "emptied later");
}
