//! The condition after the next firing, as a formula about the marking before it.

use crate::delivery::explored;
use crate::reconstruction::reconstruction;
use cotama_core::net::TransitionId;
use cotama_verification::flat::rounds;
use cotama_verification::property::{Atom, Ctl, Formula, Linear, Question, parse};
use cotama_verification::pt::Pt;
use cotama_verification::temporal::{Fairness, ctl};
use std::collections::BTreeSet;

/// The same formula without `AX` and `EX`, so that it can be looked at while markings are met;
/// `None` where other operators remain.
pub(crate) fn in_one_marking(formula: &Formula, pt: &Pt) -> Option<Formula> {
    let list = |all: &[Formula]| all.iter().map(|it| in_one_marking(it, pt)).collect::<Option<_>>();
    let not = |it: Formula| Formula::Not(it.into());
    Some(match formula {
        Formula::Atom(_) => formula.clone(),
        Formula::Not(inner) => not(in_one_marking(inner, pt)?),
        Formula::And(all) => Formula::And(list(all)?),
        Formula::Or(all) => Formula::Or(list(all)?),
        Formula::All(path) => match &**path {
            Formula::Next(then) => after_each(then, pt)?,
            _ => return None,
        },
        Formula::Exists(path) => match &**path {
            Formula::Next(then) => not(after_each(&not((**then).clone()), pt)?),
            _ => return None,
        },
        _ => return None,
    })
}

/// Returns the condition that the formula holds after each enabled transition: Dijkstra's weakest
/// precondition. A firing adds the same to a sum of tokens wherever it happens.
fn after_each(then: &Formula, pt: &Pt) -> Option<Formula> {
    if !then.is_state() {
        return None;
    }
    let mut changers = BTreeSet::new();
    then.with_atoms(&mut |atom| {
        let Atom::AtMost(sum) = atom else { return None };
        changers.extend(sum.weights.iter().flat_map(|it| pt.changers.of(it.0.0)).map(|it| it.0));
        Some(Formula::TRUE)
    })?;
    let unless = |enabled: Vec<u32>, then: Formula| {
        let enabled =
            Formula::Atom(Atom::Fireable(enabled.into_iter().map(TransitionId).collect()));
        Formula::Or(vec![then, Formula::Not(enabled.into())])
    };
    let others = (0..pt.transitions.len() as u32).filter(|it| !changers.contains(it));
    let mut all = vec![unless(others.collect(), then.clone())];
    for &changer in &changers {
        let change =
            |place| pt.effects.of(changer).iter().find(|it| it.0 == place).map_or(0, |it| it.1);
        let after = |atom: &Atom| {
            let Atom::AtMost(sum) = atom else { return None };
            let added: i64 =
                sum.weights.iter().map(|&(place, weight)| weight * change(place.0)).sum();
            let after = Linear { constant: sum.constant + added, weights: sum.weights.clone() };
            Some(Formula::Atom(Atom::AtMost(after)))
        };
        all.push(unless(vec![changer], then.with_atoms(&mut { after })?));
    }
    Some(Formula::And(all))
}

#[test]
fn the_condition_after_the_next_firing_is_a_formula_before_it() {
    let (pt, graph) = explored(&rounds(&reconstruction::SYSTEM).unwrap());
    let asked = |formula: Formula| {
        ctl(&graph, &Ctl::new(&formula).unwrap(), &Fairness::default(), u64::MAX, 2)
            .unwrap()
            .verdict
    };
    let not = |it: &Formula| Formula::Not(it.clone().into());
    let some = |it: Formula| Formula::Exists(Formula::Finally(it.into()).into());
    for text in [
        "ls.Planning -> AX ls.Planning",
        "EX (pf.Reduced & pf.level <= 1)",
        "AX (ls.Idle + pf.Off = 2)",
    ] {
        let Question::Formula(formula) = parse(text, &pt).unwrap().question else {
            panic!("{text}")
        };
        let told = in_one_marking(&formula, &pt).unwrap();
        assert!(told.is_state() && asked(some(told.clone())) && asked(some(not(&told))), "{text}");
        let differ = [[not(&formula), told.clone()], [formula, not(&told)]]
            .map(|it| Formula::And(it.into()));
        assert!(!asked(some(Formula::Or(differ.into()))), "{text}");
    }
}
