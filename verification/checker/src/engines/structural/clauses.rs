//! A formula about one marking as an `or` of `and`s of inequalities.

use cotama_core::net::PlaceId;
use cotama_property::pt::Pt;
use cotama_property::{Atom, Formula, Linear};

/// The most inequalities of all clauses together.
const MOST: usize = 20_000;

/// The inequalities of each clause; `None` when there are too many, or numbers too large. Without a
/// clause it is false.
pub(crate) fn clauses(formula: &Formula, pt: &Pt) -> Option<Vec<Vec<Linear>>> {
    walk(formula, pt, true)
}

fn walk(formula: &Formula, pt: &Pt, positive: bool) -> Option<Vec<Vec<Linear>>> {
    match formula {
        Formula::Not(inner) => walk(inner, pt, !positive),
        Formula::And(parts) | Formula::Or(parts) => {
            let all = parts.iter().map(|it| walk(it, pt, positive)).collect::<Option<Vec<_>>>()?;
            if matches!(formula, Formula::And(_)) == positive { product(all) } else { sum(all) }
        }
        Formula::Atom(Atom::AtMost(linear)) if positive => Some(vec![vec![linear.clone()]]),
        Formula::Atom(Atom::AtMost(linear)) => Some(vec![vec![linear.negated()?]]),
        Formula::Atom(Atom::Fireable(transitions)) => {
            let each = transitions.iter().map(|it| enabled(pt, it.0, positive)).collect();
            if positive { sum(each) } else { product(each) }
        }
        Formula::Atom(Atom::Deadlock) => {
            let each =
                (0..pt.transitions.len() as u32).map(|it| enabled(pt, it, !positive)).collect();
            if positive { product(each) } else { sum(each) }
        }
        _ => None,
    }
}

fn enabled(pt: &Pt, transition: u32, positive: bool) -> Vec<Vec<Linear>> {
    let needs = pt.needs.of(transition).iter().map(|&(place, need)| {
        let (constant, weight) =
            if positive { (i64::from(need), -1) } else { (1 - i64::from(need), 1) };
        Linear { constant, weights: vec![(PlaceId(place), weight)] }
    });
    if positive { vec![needs.collect()] } else { needs.map(|it| vec![it]).collect() }
}

fn sum(all: Vec<Vec<Vec<Linear>>>) -> Option<Vec<Vec<Linear>>> {
    let clauses: Vec<_> = all.into_iter().flatten().collect();
    (clauses.iter().map(Vec::len).sum::<usize>() <= MOST).then_some(clauses)
}

fn product(all: Vec<Vec<Vec<Linear>>>) -> Option<Vec<Vec<Linear>>> {
    let mut clauses = vec![Vec::new()];
    for choices in all {
        let mut next = Vec::new();
        let mut size = 0;
        for clause in &clauses {
            for choice in &choices {
                let both: Vec<Linear> = clause.iter().chain(choice).cloned().collect();
                size += both.len() + 1;
                if size > MOST {
                    return None;
                }
                next.push(both);
            }
        }
        clauses = next;
    }
    Some(clauses)
}
