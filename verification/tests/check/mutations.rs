//! Certificates with something changed: refused, unless what they then claim is so.

use crate::properties::random::Random;
use crate::special::own::Own;
use cotama_core::net::{PlaceId, TransitionId};
use cotama_verification::certificate::{self, Certificate, verify};
use cotama_verification::property::{Atom, Formula, Linear, Question};
use cotama_verification::pt::Pt;
use serde_json::{Value, json};

/// The outcomes of changed certificates.
#[derive(Debug, Default)]
pub(crate) struct Changed {
    pub(crate) refused: usize,
    /// Believed, and what is claimed is so.
    pub(crate) true_again: usize,
    /// Believed, of a net that is too large for the oracle.
    pub(crate) open: usize,
}

/// Changes a certificate in so many ways; the opposite verdict is the first.
pub(crate) fn change(
    certificate: &Certificate,
    ways: usize,
    random: &mut Random,
    counts: &mut Changed,
) {
    let json: Value = serde_json::from_str(&certificate.text()).unwrap();
    let opposite = Certificate { verdict: !certificate.verdict, ..certificate.clone() };
    assert!(verify(&opposite.text()).is_err(), "believed: {}", opposite.text());
    counts.refused += 1;
    let mut way = 1;
    while way < ways {
        let mut other = json.clone();
        one(&mut other, way, random);
        if other == json {
            continue;
        }
        way += 1;
        let text = other.to_string();
        if verify(&text).is_err() {
            counts.refused += 1;
            continue;
        }
        let believed: Certificate = serde_json::from_str(&text).unwrap();
        match truth(&believed) {
            Some(truth) => {
                assert_eq!(truth, believed.verdict, "believed: {text}");
                counts.true_again += 1;
            }
            None => counts.open += 1,
        }
    }
}

/// One change: in the evidence, in the question, in the net, anywhere.
fn one(json: &mut Value, way: usize, random: &mut Random) {
    let inside = ["/evidence", "/question", "/net/transitions", "/net/places", ""][way % 5];
    let mut all = Vec::new();
    pointers(json.pointer(inside).unwrap(), inside.to_owned(), &mut all);
    let at = random.choose(&all).clone();
    let other = json.pointer(&all[random.below(all.len())]).unwrap().clone();
    let here = json.pointer_mut(&at).unwrap();
    match here {
        Value::Number(number) => {
            let number = number.as_i64().unwrap();
            *here = json!(*random.choose(&[
                number + 1,
                number - 1,
                -number,
                0,
                2 * number,
                number + 7
            ]));
        }
        Value::Bool(truth) => *truth = !*truth,
        Value::Array(list) if !list.is_empty() => {
            let (a, b) = (random.below(list.len()), random.below(list.len()));
            match random.below(3) {
                0 => list.swap(a, b),
                1 => list.insert(a, list[b].clone()),
                _ => drop(list.remove(a)),
            }
        }
        Value::Object(fields) if fields.len() == 1 => {
            let kinds =
                ["not", "E", "A", "X", "F", "G", "U", "and", "or", "trace", "lasso", "one", "each"];
            let inner = fields.values().next().unwrap().clone();
            *here =
                if random.below(3) == 0 { inner } else { json!({ *random.choose(&kinds): inner }) };
        }
        here if random.below(2) == 0 => *here = json!({ "not": here.clone() }),
        here => *here = other,
    }
}

fn pointers(value: &Value, at: String, found: &mut Vec<String>) {
    match value {
        Value::Array(list) => {
            list.iter()
                .enumerate()
                .for_each(|(number, it)| pointers(it, format!("{at}/{number}"), found));
        }
        Value::Object(fields) => {
            fields.iter().for_each(|(name, it)| pointers(it, format!("{at}/{name}"), found));
        }
        _ => {}
    }
    found.push(at);
}

/// The answer to the question of a certificate, by the book; `None` when that would take long.
fn truth(certificate: &Certificate) -> Option<bool> {
    let net = Own::from(&certificate.net);
    let pt = net.pt();
    let space = net.space(&pt, 200)?;
    let all = &space.markings;
    let place = |it: &String| pt.place(it).unwrap();
    Some(match &certificate.question {
        certificate::Question::Formula(formula) => {
            let formula = formula_of(formula, &pt);
            let operators = formula.display(&pt).to_string().matches(['X', 'F', 'G', 'U']).count();
            // A part that speaks of a run outside of quantifiers has no meaning; another part may
            // decide.
            if all.len() << operators.min(20) > 20_000 || formula.needs_run() {
                return None;
            }
            space.satisfying(&formula)[0]
        }
        certificate::Question::Bound { places, most } => {
            let sum = |it: &Vec<u32>| {
                places.iter().map(|at| i64::from(it[place(at).0 as usize])).sum::<i64>()
            };
            all.iter().map(sum).max() == Some(*most)
        }
        certificate::Question::Unbounded { .. } => false,
        certificate::Question::Live => space.verdict(&Question::Liveness)?,
        certificate::Question::QuasiLive => space.verdict(&Question::QuasiLiveness)?,
        certificate::Question::Stable => space.verdict(&Question::StableMarking)?,
        certificate::Question::OneSafe => space.verdict(&Question::OneSafe)?,
    })
}

fn formula_of(formula: &certificate::Formula, pt: &Pt) -> Formula {
    use certificate::Formula as Said;
    let boxed = |it: &Said| Box::new(formula_of(it, pt));
    let list = |all: &[Said]| all.iter().map(|it| formula_of(it, pt)).collect();
    match formula {
        Said::AtMost(linear) => {
            let mut weights: Vec<(PlaceId, i64)> =
                linear.weights.iter().map(|it| (pt.place(&it.0).unwrap(), it.1)).collect();
            weights.sort_unstable();
            Formula::Atom(Atom::AtMost(Linear { constant: linear.constant, weights }))
        }
        Said::Fireable(all) => {
            let ids: Vec<TransitionId> = all.iter().map(|it| pt.transition(it).unwrap()).collect();
            Formula::Atom(Atom::Fireable(ids))
        }
        Said::Deadlock => Formula::Atom(Atom::Deadlock),
        Said::Not(it) => Formula::Not(boxed(it)),
        Said::And(all) => Formula::And(list(all)),
        Said::Or(all) => Formula::Or(list(all)),
        // `X` of a certificate speaks of a run, in which a deadlock is repeated for ever; after `E`
        // and `A` that of the property language asks for a marking that follows.
        Said::Exists(it) => match &**it {
            Said::Next(a) if !speaks_of_runs(a) => {
                let a = formula_of(a, pt);
                let repeated = Formula::And(vec![Formula::Atom(Atom::Deadlock), a.clone()]);
                Formula::Or(vec![Formula::Exists(Box::new(Formula::Next(Box::new(a)))), repeated])
            }
            _ => Formula::Exists(boxed(it)),
        },
        Said::All(it) => match &**it {
            Said::Next(a) if !speaks_of_runs(a) => {
                let a = formula_of(a, pt);
                let goes_on = Formula::Not(Box::new(Formula::Atom(Atom::Deadlock)));
                let repeated = Formula::Or(vec![goes_on, a.clone()]);
                Formula::And(vec![Formula::All(Box::new(Formula::Next(Box::new(a)))), repeated])
            }
            _ => Formula::All(boxed(it)),
        },
        Said::ExistsNext(it) => Formula::Exists(Box::new(Formula::Next(boxed(it)))),
        Said::AllNext(it) => Formula::All(Box::new(Formula::Next(boxed(it)))),
        Said::Next(it) => Formula::Next(boxed(it)),
        Said::Finally(it) => Formula::Finally(boxed(it)),
        Said::Globally(it) => Formula::Globally(boxed(it)),
        Said::Until(both) => Formula::Until(boxed(&both.0), boxed(&both.1)),
    }
}

/// Whether a formula needs a run to be true of.
fn speaks_of_runs(formula: &certificate::Formula) -> bool {
    use certificate::Formula as Said;
    match formula {
        Said::AtMost(_)
        | Said::Fireable(_)
        | Said::Deadlock
        | Said::Exists(_)
        | Said::All(_)
        | Said::ExistsNext(_)
        | Said::AllNext(_) => false,
        Said::Not(it) => speaks_of_runs(it),
        Said::And(all) | Said::Or(all) => all.iter().any(speaks_of_runs),
        Said::Next(_) | Said::Finally(_) | Said::Globally(_) | Said::Until(_) => true,
    }
}
