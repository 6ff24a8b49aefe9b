//! Shorter formulas that say the same of every net.

use super::{Atom, Formula, Linear};
use crate::integer::gcd;
use std::collections::HashSet;

impl Formula {
    /// A formula that holds in the same markings (on the same runs) of every net, with constants
    /// folded, nested operators merged where one of them suffices, and as one of CTL where that is
    /// known to be possible.
    #[must_use]
    pub fn simplified(&self) -> Self {
        match self {
            Self::Atom(Atom::AtMost(linear)) => linear.simplified(),
            Self::Atom(Atom::Fireable(transitions)) => {
                let mut transitions = transitions.clone();
                transitions.sort_unstable();
                transitions.dedup();
                if transitions.is_empty() {
                    Self::FALSE
                } else {
                    Self::Atom(Atom::Fireable(transitions))
                }
            }
            Self::Atom(Atom::Deadlock) => self.clone(),
            Self::Not(inner) => inner.simplified().negated(),
            Self::And(all) => joined(all.iter().map(Self::simplified), true),
            Self::Or(all) => joined(all.iter().map(Self::simplified), false),
            Self::Exists(path) => on_runs(true, path),
            Self::All(path) => on_runs(false, path),
            Self::Next(inner) => temporal(inner.simplified(), Self::Next),
            Self::Finally(inner) => finally(inner.simplified()),
            Self::Globally(inner) => match inner.simplified() {
                inner @ Self::Globally(_) => inner,
                Self::Finally(inner) if matches!(*inner, Self::Globally(_)) => Self::Finally(inner),
                inner => temporal(inner, Self::Globally),
            },
            Self::Until(a, b) => until(a.simplified(), b.simplified()),
            Self::Within(limit, inner) => {
                temporal(inner.simplified(), |inner| Self::Within(*limit, inner))
            }
        }
    }

    /// The negation of a simple formula.
    pub(super) fn negated(self) -> Self {
        match self {
            Self::Not(inner) => *inner,
            Self::And(all) if all.is_empty() => Self::FALSE,
            Self::Or(all) if all.is_empty() => Self::TRUE,
            Self::Atom(Atom::AtMost(linear)) => match linear.negated() {
                Some(negated) => Self::Atom(Atom::AtMost(negated)),
                None => Self::Not(Self::Atom(Atom::AtMost(linear)).into()),
            },
            other => Self::Not(other.into()),
        }
    }

    fn is_constant(&self) -> bool {
        matches!(self, Self::And(all) | Self::Or(all) if all.is_empty())
    }
}

/// A formula that is always true stays true at another time of a run, and so does one that is
/// always false.
fn temporal(inner: Formula, operator: impl FnOnce(Box<Formula>) -> Formula) -> Formula {
    if inner.is_constant() { inner } else { operator(inner.into()) }
}

fn finally(inner: Formula) -> Formula {
    match inner {
        Formula::Finally(_) => inner,
        Formula::Globally(goal) if matches!(*goal, Formula::Finally(_)) => Formula::Globally(goal),
        Formula::Until(_, goal) => finally(*goal),
        inner => temporal(inner, Formula::Finally),
    }
}

fn until(a: Formula, b: Formula) -> Formula {
    let at_once = match &b {
        Formula::Finally(_) => true,
        Formula::Until(c, _) => **c == a,
        _ => b.is_constant() || a == b || a == Formula::FALSE,
    };
    if at_once {
        b
    } else if a == Formula::TRUE {
        finally(b)
    } else {
        Formula::Until(a.into(), b.into())
    }
}

/// A conjunction or disjunction of simple formulas.
fn joined(parts: impl Iterator<Item = Formula>, conjunction: bool) -> Formula {
    let (neutral, absorbing) =
        if conjunction { (Formula::TRUE, Formula::FALSE) } else { (Formula::FALSE, Formula::TRUE) };
    let (mut kept, mut seen) = (Vec::new(), HashSet::new());
    for part in parts {
        let inner = match part {
            Formula::And(inner) if conjunction => inner,
            Formula::Or(inner) if !conjunction => inner,
            part if part == neutral => Vec::new(),
            part => vec![part],
        };
        for part in inner {
            if part == absorbing || seen.contains(&part.clone().negated()) {
                return absorbing;
            }
            if seen.insert(part.clone()) {
                kept.push(part);
            }
        }
    }
    match kept.len() {
        1 => kept.swap_remove(0),
        _ if conjunction => Formula::And(kept),
        _ => Formula::Or(kept),
    }
}

/// A path under a quantifier.
fn on_runs(exists: bool, path: &Formula) -> Formula {
    // Right after a quantifier, a next marking is a successor.
    if let Formula::Next(inner) = path
        && !inner.needs_run()
    {
        return successor(exists, inner.simplified());
    }
    quantified(exists, path.simplified())
}

/// A quantifier before an operator.
fn after(exists: bool, path: Formula) -> Formula {
    if exists { Formula::Exists(path.into()) } else { Formula::All(path.into()) }
}

/// In some or in every successor.
fn successor(exists: bool, inner: Formula) -> Formula {
    let deadlock = Formula::Atom(Atom::Deadlock);
    match (exists, &inner) {
        (true, Formula::And(all)) if all.is_empty() => deadlock.negated(),
        (false, Formula::Or(all)) if all.is_empty() => deadlock,
        _ if inner.is_constant() => inner,
        _ => after(exists, Formula::Next(inner.into())),
    }
}

/// A simple path under a quantifier; its next markings are those of a run, which a last marking
/// follows itself.
fn quantified(exists: bool, path: Formula) -> Formula {
    if !path.needs_run() {
        return path;
    }
    match path {
        Formula::Next(inner) if !inner.needs_run() => next_of_a_run(exists, *inner),
        Formula::Finally(inner) if !inner.needs_run() => finally_on_runs(exists, *inner),
        Formula::Globally(inner) if !inner.needs_run() => globally_on_runs(exists, *inner),
        Formula::Until(a, b) if !a.needs_run() && !b.needs_run() => until_on_runs(exists, a, b),
        path => {
            let branching = branching(exists, &path);
            branching.filter(Formula::is_ctl).unwrap_or_else(|| after(exists, path))
        }
    }
}

fn next_of_a_run(exists: bool, inner: Formula) -> Formula {
    if !inner.is_state() {
        // Here it would stand twice, and in others like it four times. Right after a quantifier it
        // would mean successors.
        let never = Formula::Not(Formula::Next(inner.into()).into());
        return Formula::Not(after(!exists, never).into());
    }
    let deadlock = Formula::Atom(Atom::Deadlock);
    if exists {
        let here = joined([deadlock, inner.clone()].into_iter(), true);
        joined([here, successor(true, inner)].into_iter(), false)
    } else {
        let here = joined([deadlock.negated(), inner.clone()].into_iter(), false);
        joined([here, successor(false, inner)].into_iter(), true)
    }
}

fn finally_on_runs(exists: bool, inner: Formula) -> Formula {
    match inner {
        // Whoever waits for `EF a` has it already.
        Formula::Exists(path) if matches!(*path, Formula::Finally(_)) => Formula::Exists(path),
        Formula::All(path) if !exists && matches!(*path, Formula::Finally(_)) => Formula::All(path),
        Formula::All(path) if exists => match *path {
            Formula::Finally(goal) | Formula::Until(_, goal) if !goal.needs_run() => {
                finally_on_runs(true, *goal)
            }
            path => after(exists, Formula::Finally(Formula::All(path.into()).into())),
        },
        Formula::Exists(path) if exists => match *path {
            Formula::Until(_, goal) => finally_on_runs(true, *goal),
            path => after(exists, Formula::Finally(Formula::Exists(path.into()).into())),
        },
        inner => after(exists, Formula::Finally(inner.into())),
    }
}

fn globally_on_runs(exists: bool, inner: Formula) -> Formula {
    match inner {
        Formula::All(path) if matches!(*path, Formula::Globally(_)) => Formula::All(path),
        Formula::Exists(path) if matches!(&*path, Formula::Globally(law) if !law.needs_run()) => {
            after(exists, *path)
        }
        inner => after(exists, Formula::Globally(inner.into())),
    }
}

fn until_on_runs(exists: bool, a: Box<Formula>, b: Box<Formula>) -> Formula {
    let at_once = match &*b {
        Formula::Exists(path) => match &**path {
            Formula::Finally(_) => true,
            Formula::Until(c, _) => exists && *c == a,
            _ => false,
        },
        Formula::All(path) => match &**path {
            Formula::Finally(_) => !exists,
            Formula::Until(c, _) => !exists && *c == a,
            _ => false,
        },
        _ => false,
    };
    if at_once { *b } else { after(exists, Formula::Until(a, b)) }
}

/// The same with a quantifier before every temporal operator, if these rules find it.
fn branching(exists: bool, path: &Formula) -> Option<Formula> {
    let inner = |inner: &Formula| quantified(exists, inner.clone());
    Some(match (path, exists) {
        (Formula::Not(path), _) => quantified(!exists, (**path).clone()).negated(),
        (Formula::Finally(path), true) => finally_on_runs(true, inner(path)),
        (Formula::Globally(path), false) => globally_on_runs(false, inner(path)),
        (Formula::Or(all), true) => joined(all.iter().map(inner), false),
        (Formula::And(all), false) => joined(all.iter().map(inner), true),
        // One part at most may speak of the run: the same run has to serve all of them.
        (Formula::And(all), true) if all.iter().filter(|it| it.needs_run()).count() == 1 => {
            joined(all.iter().map(inner), true)
        }
        (Formula::Or(all), false) if all.iter().filter(|it| it.needs_run()).count() == 1 => {
            joined(all.iter().map(inner), false)
        }
        _ => return None,
    })
}

impl Linear {
    /// The shortest inequality for numbers of tokens, which are whole and not negative.
    fn simplified(&self) -> Formula {
        let weights =
            || self.weights.iter().map(|&(_, weight)| weight).filter(|&weight| weight != 0);
        if self.constant > 0 && weights().all(|weight| weight > 0) {
            return Formula::FALSE;
        }
        if self.constant <= 0 && weights().all(|weight| weight < 0) {
            return Formula::TRUE;
        }
        let divisor = i128::from(
            weights().fold(0, |divisor, weight| gcd(divisor, weight.unsigned_abs())).max(1),
        );
        // A quotient is no larger than what is divided.
        let constant = -(-i128::from(self.constant)).div_euclid(divisor);
        let weights = self.weights.iter().filter(|&&(_, weight)| weight != 0);
        Formula::Atom(Atom::AtMost(Self {
            constant: constant as i64,
            weights: weights
                .map(|&(place, weight)| (place, (i128::from(weight) / divisor) as i64))
                .collect(),
        }))
    }
}
