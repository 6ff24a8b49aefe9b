//! Which requirement a system breaks.

use crate::cells::differ;
use crate::delivery::watched;
use crate::steps::in_one_marking;
use cotama_core::net::TransitionId;
use cotama_core::system::System;
use cotama_models::cotama::{Asked, REQUIREMENTS, Requirement};
use cotama_verification::explicit::{Goal, Graph, Limits, Reached, reach};
use cotama_verification::flat::{FlatError, rounds};
use cotama_verification::property::{Condition, Ctl, Formula, Question, parse};
use cotama_verification::pt::Pt;
use cotama_verification::temporal::{Fairness, ctl};

/// A part of a requirement: its number and a formula.
type Law = (&'static str, Formula);

/// A requirement that a system breaks, found as cheaply as can be: in what transitions say and look
/// at, in the cells of decisions, then in the fewest firings of all that speak of a marking or of a
/// firing, then in the graph, then with what it takes to remember.
///
/// # Errors
/// When the system is refused.
pub(crate) fn broken(system: &System<'_>) -> Result<Option<&'static str>, FlatError> {
    let unsaid = |it: &&Requirement| it.said.iter().any(|it| it.unsaid(system).next().is_some());
    let unguarded =
        |it: &&Requirement| it.guarded.iter().any(|it| it.unguarded(system).next().is_some());
    if let Some(it) = REQUIREMENTS.iter().find(|it| unsaid(it) || unguarded(it)) {
        return Ok(Some(it.id));
    }
    if differ(system) {
        return Ok(Some("CS1"));
    }
    let rounds = rounds(system)?;
    let asked = || REQUIREMENTS.iter().filter_map(|it| Some((it.id, it.asked?)));
    let pt = Pt::from(&rounds.net().unwrap().view().net());
    let (mut always, mut others) = (Vec::new(), Vec::new());
    for (id, asked) in asked().filter(|it| it.1.watches.is_empty()) {
        split((id, formula(&asked, &pt)), &pt, &mut always, &mut others);
    }
    let in_the_graph = || {
        let graph = Graph::new(&pt, &Limits::default(), &|_| ()).unwrap();
        let holds = |it: &Formula| {
            ctl(&graph, &Ctl::new(it).unwrap(), &Fairness::default(), u64::MAX, 2).unwrap().verdict
        };
        others.iter().find(|it| !holds(&it.1)).map(|it| it.0)
    };
    let remembered = || {
        let mut watched_ones = asked().filter(|it| !it.1.watches.is_empty());
        watched_ones.find_map(|(id, asked)| {
            let pt =
                Pt::from(&watched(&rounds, asked.watches).unwrap().net().unwrap().view().net());
            let (mut always, mut others) = (Vec::new(), Vec::new());
            split((id, formula(&asked, &pt)), &pt, &mut always, &mut others);
            assert!(others.is_empty(), "{id}");
            nearest(&pt, &always)
        })
    };
    Ok(nearest(&pt, &always).or_else(in_the_graph).or_else(remembered))
}

fn formula(asked: &Asked, pt: &Pt) -> Formula {
    match parse(asked.text, pt).unwrap().question {
        Question::Formula(formula) => formula.simplified(),
        other => panic!("{other:?}"),
    }
}

/// Splits a law into parts: those that always hold, as formulas about one marking, and the rest.
fn split((id, formula): Law, pt: &Pt, always: &mut Vec<Law>, others: &mut Vec<Law>) {
    match &formula {
        Formula::And(parts) => {
            parts.iter().for_each(|it| split((id, it.clone()), pt, always, others));
        }
        Formula::All(path) => match &**path {
            Formula::Globally(law) => {
                let one = std::slice::from_ref(&**law);
                for part in if let Formula::And(parts) = &**law { parts } else { one } {
                    let whole = || Formula::All(Formula::Globally(part.clone().into()).into());
                    match in_one_marking(part, pt) {
                        Some(law) => always.push((id, law)),
                        None => others.push((id, whole())),
                    }
                }
            }
            _ => others.push((id, formula)),
        },
        _ => others.push((id, formula)),
    }
}

/// Returns the law about one marking that is broken in the fewest firings.
fn nearest(pt: &Pt, laws: &[Law]) -> Option<&'static str> {
    let goal = Formula::Or(laws.iter().map(|it| Formula::Not(it.1.clone().into())).collect());
    match reach(pt, Goal::new(&goal).unwrap(), &Limits::default(), 1, &|_| ()) {
        Reached::Never { .. } => None,
        Reached::Trace { transitions, .. } => {
            let fire = |marking: Vec<u32>, it: &TransitionId| pt.fire(&marking, it.0).unwrap();
            let end = transitions.iter().fold(pt.initial.clone(), fire);
            let fails = |it: &&Law| !Condition::new(&it.1, pt).unwrap().holds(end.as_slice());
            laws.iter().find(fails).map(|it| it.0)
        }
        unknown @ Reached::Unknown { .. } => panic!("{unknown:?}"),
    }
}
