//! The claim that a run has to show, and the positions along the run at which it is true.

use super::Run;
use cotama_property::pt::Pt;
use cotama_property::schedule::Date;
use cotama_property::{Atom, Condition, Formula};
use std::collections::HashSet;

/// Returns the claim that a run shows when a formula has this verdict, with negations moved inwards
/// and without `E`: `F` of a forbidden condition for `AG` that does not hold. `A` that is left is
/// not shown by one run.
pub(super) fn claim(formula: &Formula, holds: bool) -> Formula {
    let of = |it: &Formula| Box::new(claim(it, holds));
    let all = |all: &[Formula]| all.iter().map(|it| claim(it, holds)).collect();
    match (formula, holds) {
        (Formula::Atom(_), true) => formula.clone(),
        (Formula::Atom(_), false) => Formula::Not(Box::new(formula.clone())).simplified(),
        (Formula::Not(inner), _) => claim(inner, !holds),
        (Formula::And(parts), true) | (Formula::Or(parts), false) => Formula::And(all(parts)),
        (Formula::Or(parts), true) | (Formula::And(parts), false) => Formula::Or(all(parts)),
        (Formula::Exists(path), true) | (Formula::All(path), false) => claim(path, holds),
        (Formula::Exists(path), false) | (Formula::All(path), true) => Formula::All(of(path)),
        (Formula::Next(a), _) => Formula::Next(of(a)),
        (Formula::Finally(a), true) | (Formula::Globally(a), false) => Formula::Finally(of(a)),
        (Formula::Globally(a), true) | (Formula::Finally(a), false) => Formula::Globally(of(a)),
        (Formula::Until(a, b), true) => Formula::Until(of(a), of(b)),
        (Formula::Within(limit, a), true) => Formula::Within(*limit, of(a)),
        (Formula::Until(..) | Formula::Within(..), false) => {
            Formula::Not(Box::new(claim(formula, true)))
        }
    }
}

/// A formula without `E` along a run: at each marking, from the first to the one after the last
/// firing.
pub(super) struct Along<'a> {
    pub(super) pt: &'a Pt,
    pub(super) run: &'a Run,
    /// The date of each firing, if dates are known.
    pub(super) dates: &'a [Date],
}

impl Along<'_> {
    /// The position that follows. After the last comes the second of the cycle, or the marking that
    /// lasts.
    fn next(&self, at: usize) -> usize {
        let last = self.run.len();
        if at < last { at + 1 } else { self.run.cycle_start().map_or(last, |start| start + 1) }
    }

    /// Returns the truth of a claim at each position.
    pub(super) fn truth(&self, formula: &Formula) -> Vec<bool> {
        let count = self.run.len() + 1;
        if let Some(condition) = Condition::new(formula, self.pt) {
            let mut truth = vec![false; count];
            // The walk cannot fail: sequences that are no runs were refused before.
            let _ = self.run.walk(self.pt, |at, marking| truth[at] = condition.holds(marking));
            return truth;
        }
        let fold = |parts: &[Formula], start: bool| {
            let mut truth = vec![start; count];
            for part in parts {
                let of = self.truth(part);
                truth
                    .iter_mut()
                    .zip(of)
                    .for_each(|(it, of)| *it = if start { *it && of } else { *it || of });
            }
            truth
        };
        match formula {
            Formula::And(parts) => fold(parts, true),
            Formula::Or(parts) => fold(parts, false),
            Formula::Not(inner) => self.truth(inner).into_iter().map(|it| !it).collect(),
            Formula::Next(a) => {
                let a = self.truth(a);
                (0..count).map(|at| a[self.next(at)]).collect()
            }
            Formula::Finally(b) => self.until(&vec![true; count], &self.truth(b)),
            Formula::Globally(a) => {
                let never: Vec<bool> = self.truth(a).into_iter().map(|it| !it).collect();
                self.until(&vec![true; count], &never).into_iter().map(|it| !it).collect()
            }
            Formula::Until(a, b) => self.until(&self.truth(a), &self.truth(b)),
            Formula::Within(limit, b) => self.within(*limit, &self.truth(b)),
            // One run cannot show it; where the run leads it is taken on trust.
            _ => (0..count).map(|at| at + 1 == count).collect(),
        }
    }

    fn until(&self, a: &[bool], b: &[bool]) -> Vec<bool> {
        let mut truth = vec![false; a.len()];
        // The second time with what the first one found at the beginning of the cycle.
        for _ in 0..2 {
            for at in (0..truth.len()).rev() {
                truth[at] = b[at] || (a[at] && truth[self.next(at)]);
            }
        }
        truth
    }

    /// Without dates any time is soon enough.
    fn within(&self, limit: u64, b: &[bool]) -> Vec<bool> {
        if self.dates.len() != self.run.len() {
            return self.until(&vec![true; b.len()], b);
        }
        let soon = |from: usize, to: usize| {
            self.elapsed(from, to)
                .is_none_or(|(parts, per_unit)| parts <= u128::from(limit) * per_unit)
        };
        (0..b.len())
            .map(|from| (from..b.len()).take_while(|to| soon(from, *to)).any(|to| b[to]))
            .collect()
    }

    /// The time between two markings, in parts and parts per millisecond. A marking begins when the
    /// firing before it happens.
    fn elapsed(&self, from: usize, to: usize) -> Option<(u128, u128)> {
        let date = |at: usize| match at.checked_sub(1) {
            None => Some((0, 1)),
            Some(firing) => {
                self.dates.get(firing).map(|it| (u128::from(it.parts), u128::from(it.per_unit)))
            }
        };
        let ((early, early_unit), (late, late_unit)) = (date(from)?, date(to)?);
        let unit = early_unit.max(late_unit);
        Some(((late * (unit / late_unit)).saturating_sub(early * (unit / early_unit)), unit))
    }
}

/// The different atoms of a formula, in their order.
pub(super) fn atoms(formula: &Formula) -> Vec<Atom> {
    let (mut found, mut met) = (Vec::new(), HashSet::new());
    collect(formula, &mut |atom| {
        if met.insert(atom.clone()) {
            found.push(atom.clone());
        }
    });
    found
}

fn collect(formula: &Formula, found: &mut dyn FnMut(&Atom)) {
    match formula {
        Formula::Atom(atom) => found(atom),
        Formula::And(all) | Formula::Or(all) => all.iter().for_each(|it| collect(it, found)),
        Formula::Until(a, b) => {
            collect(a, found);
            collect(b, found);
        }
        Formula::Not(a)
        | Formula::Exists(a)
        | Formula::All(a)
        | Formula::Next(a)
        | Formula::Finally(a)
        | Formula::Globally(a)
        | Formula::Within(_, a) => collect(a, found),
    }
}
