//! Claims about one marking, a run, or all reachable markings.

use super::net::{Marking, Net};
use super::{Checked, at, ensure, fail};
use crate::certificate::Lasso;
use crate::certificate::claim::Claim::{self, And, AtMost, Exists, Next, Not, Successor, Until};
use std::collections::BTreeMap;

#[derive(PartialEq)]
enum Kind {
    Marking,
    Run,
    Graph,
}

pub(super) struct Space<'a> {
    net: &'a Net<'a>,
    kind: Kind,
    markings: Vec<Marking>,
    /// For each marking those that lead to it, and how often it leads to another one.
    before: Vec<Vec<usize>>,
    leads: Vec<usize>,
}

impl<'a> Net<'a> {
    /// Nothing but a marking.
    pub(super) fn marking(&'a self, marking: &Marking) -> Space<'a> {
        let (markings, before, leads) = (vec![marking.clone()], vec![Vec::new()], vec![0]);
        Space { net: self, kind: Kind::Marking, markings, before, leads }
    }

    /// The run: the last marking leads back to the end of the stem, where it stays when that is a deadlock.
    pub(super) fn run(&'a self, from: &Marking, lasso: &Lasso) -> Checked<Space<'a>> {
        let mut markings = self.way(from, &lasso.stem).map_err(at(".stem"))?;
        let back = lasso.stem.len();
        let cycle = self.way(&markings[back], &lasso.cycle).map_err(at(".loop"))?;
        let enabled = |it| self.fire(&cycle[0], it).map(|it| it.is_some());
        let dead = (0..self.transitions.len()).try_fold(true, |dead, it| Ok(dead && !enabled(it)?))?;
        let lasts = cycle.last() == cycle.first() && (cycle.len() > 1 || dead);
        ensure(lasts, "does not lead back, or is empty where there is no deadlock").map_err(at(".loop"))?;
        markings.extend(cycle.into_iter().take(lasso.cycle.len()).skip(1));
        let mut before: Vec<Vec<usize>> =
            (0..markings.len()).map(|it| it.checked_sub(1).into_iter().collect()).collect();
        before[back].push(markings.len() - 1);
        let leads = vec![1; markings.len()];
        Ok(Space { net: self, kind: Kind::Run, markings, before, leads })
    }

    /// All markings that are reachable from here, which is the first one.
    pub(super) fn graph(&'a self, from: &Marking, count: usize) -> Checked<Space<'a>> {
        let mut numbers = BTreeMap::from([(from.clone(), 0)]);
        let (mut markings, mut before, mut leads) = (vec![from.clone()], vec![Vec::new()], Vec::new());
        while let Some(marking) = markings.get(leads.len()).cloned() {
            let mut led = 0;
            for transition in 0..self.transitions.len() {
                let Some(after) = self.fire(&marking, transition)? else { continue };
                let fresh = markings.len();
                let number = *numbers.entry(after).or_insert_with_key(|it| {
                    markings.push(it.clone());
                    before.push(Vec::new());
                    fresh
                });
                before[number].push(leads.len());
                led += 1;
            }
            self.spend(16 * (marking.len() + led))?; // memory is work too
            ensure(markings.len() <= count, "there are more markings")?;
            leads.push(led);
        }
        ensure(markings.len() == count, "there are fewer markings")?;
        Ok(Space { net: self, kind: Kind::Graph, markings, before, leads })
    }
}

impl Space<'_> {
    /// That a claim has this truth at the first marking, or of the run from there.
    pub(super) fn shows(&self, claim: &Claim, truth: bool) -> Checked<()> {
        ensure(self.label(claim)?[0] == truth, "the opposite of what is claimed is so")
    }

    /// Where a claim holds.
    fn label(&self, claim: &Claim) -> Checked<Vec<bool>> {
        self.net.spend(1 + self.markings.len())?;
        let always = vec![true; self.markings.len()];
        match claim {
            AtMost(sum) => {
                self.net.spend(self.markings.len() * sum.weights.len())?;
                Ok(self.markings.iter().map(|it| sum.value(it) <= 0).collect())
            }
            Not(a) => Ok(self.label(a)?.iter().map(|it| !it).collect()),
            And(all) => all.iter().try_fold(always, |so_far, it| {
                Ok(so_far.iter().zip(self.label(it)?).map(|(&a, b)| a && b).collect())
            }),
            Next(a) if self.kind == Kind::Run => self.next(a),
            Successor(a) if self.kind == Kind::Graph => self.next(a),
            Until(both) if self.kind == Kind::Run => self.until(both, false),
            Exists(path) if self.kind == Kind::Graph => {
                let (every, path) = if let Not(path) = &**path { (true, path) } else { (false, path) };
                let Until(both) = &**path else { return fail("is not of CTL") };
                Ok(self.until(both, every)?.iter().map(|it| *it != every).collect())
            }
            _ => fail("speaks of runs where one marking is to decide"),
        }
    }

    /// Where a claim holds of some next marking.
    fn next(&self, claim: &Claim) -> Checked<Vec<bool>> {
        let mut next = vec![false; self.markings.len()];
        for (to, _) in self.label(claim)?.iter().enumerate().filter(|it| *it.1) {
            self.before[to].iter().for_each(|from| next[*from] = true);
        }
        Ok(next)
    }

    /// Where the first holds until the second does, which comes, on every run or on some run: backwards from where it does.
    fn until(&self, both: &(Claim, Claim), every: bool) -> Checked<Vec<bool>> {
        let (first, mut until) = (self.label(&both.0)?, self.label(&both.1)?);
        // Of how many next markings it is still to be found out, until it is known of a marking.
        let mut missing = if every { self.leads.clone() } else { vec![1; first.len()] };
        let mut open: Vec<usize> = (0..first.len()).filter(|it| until[*it]).collect();
        while let Some(to) = open.pop() {
            self.net.spend(self.before[to].len())?;
            for &from in &self.before[to] {
                missing[from] = missing[from].saturating_sub(1);
                if missing[from] == 0 && first[from] && !until[from] {
                    until[from] = true;
                    open.push(from);
                }
            }
        }
        Ok(until)
    }
}
