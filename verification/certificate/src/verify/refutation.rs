//! Proofs that no reachable marking is a goal.

use super::{Checked, Claim, Marking, Numbered, at, each, ensure, error};
use crate::Formula::{self, And, AtMost, Not, Or};
use crate::sum::{ONE, Sum};
use crate::{Case, Fact, Inductive, Linear, Refutation};

/// The knowledge of a marking: sums that are at most 0, and lists with a part of this truth.
#[derive(Clone, Default)]
pub(crate) struct Known<'a> {
    pub(crate) sums: Vec<Sum>,
    pub(crate) lists: Vec<(&'a [Formula], bool)>,
}

impl Numbered<'_> {
    /// Checks that no marking reachable from this one is a goal: one at which the claim is true.
    pub(super) fn refute(&self, from: &Marking, goal: Claim<'_>, by: &Refutation) -> Checked<()> {
        ensure(self.is_plain, "inhibitor arcs, reset arcs and priorities are not in inequalities")?;
        let dead = each(&by.dead, |it| self.transition(&it.0)).map_err(at(".dead"))?;
        let mut facts = Known::default();
        each(&by.facts, |it| self.learn(from, it, &dead, &mut facts)).map_err(at(".facts"))?;
        let never = |(it, by): (&usize, &(String, Vec<_>))| {
            self.close(&facts, (&self.enabling(*it)?, true), &by.1)
        };
        each(dead.iter().zip(&by.dead), never).map_err(at(".dead"))?;
        self.close(&facts, goal, &by.cases).map_err(at(".cases"))
    }

    /// Puts a fact with what is known. Dead transitions break nothing.
    fn learn<'a>(
        &self,
        from: &Marking,
        by: &'a Fact,
        dead: &[usize],
        known: &mut Known<'a>,
    ) -> Checked<()> {
        let (fact, trap) = match by {
            Fact::AtMost(linear) => (self.linear(linear)?, false),
            Fact::Trap(places) => (self.linear(&Linear::trap(places))?, true),
            Fact::Inductive(by) => {
                self.holds(from, (&by.holds, true))?;
                self.is_kept(by, dead, known)?;
                return self.assume((&by.holds, true), known);
            }
        };
        ensure(fact.value(from) <= 0, "does not hold at the start")?;
        for (id, [take, give]) in self.arcs.iter().enumerate() {
            self.spend(1 + take.len() + give.len() + dead.len())?;
            let (take, give) = (fact.weigh(take), fact.weigh(give));
            let breaks = if trap { take < 0 && give == 0 } else { give > take };
            let name = &self.net.transitions[id].name;
            ensure(!breaks || dead.contains(&id), format_args!("`{name}` breaks it"))?;
        }
        known.sums.push(fact);
        Ok(())
    }

    /// Checks that no transition makes a formula false that held before, given the known facts.
    fn is_kept(&self, by: &Inductive, dead: &[usize], known: &Known<'_>) -> Checked<()> {
        for (id, transition) in self.net.transitions.iter().enumerate() {
            let before = self.before(&by.holds, id)?;
            if before == by.holds || dead.contains(&id) {
                continue;
            }
            let cases = by.kept.iter().find(|it| it.0 == transition.name);
            let breaks = [by.holds.clone(), self.enabling(id)?, Not(Box::new(before))];
            self.close(known, (&And(breaks.into()), true), cases.map_or(&[], |it| &it.1))
                .map_err(at(format_args!(", `{}`", transition.name)))?;
        }
        Ok(())
    }

    /// Returns the condition that holds before a firing exactly when this one holds after it.
    fn before(&self, after: &Formula, id: usize) -> Checked<Formula> {
        let list = |all: &[Formula]| each(all, |it| self.before(it, id));
        Ok(match after {
            AtMost(linear) => {
                self.spend(64 * (1 + linear.weights.len()))?;
                let ([take, give], sum) = (&self.arcs[id], self.linear(linear)?);
                let constant = i128::from(linear.constant) + sum.weigh(give) - sum.weigh(take);
                let constant = constant.try_into().map_err(|_| error("numbers get too large"))?;
                AtMost(Linear { constant, ..linear.clone() })
            }
            Not(a) => Not(Box::new(self.before(a, id)?)),
            And(all) => And(list(all)?),
            Or(all) => Or(list(all)?),
            _ => return Err(error("is no formula of inequalities")),
        })
    }

    /// Checks that the goal contradicts the facts.
    fn close(&self, facts: &Known<'_>, goal: Claim<'_>, cases: &[Case]) -> Checked<()> {
        let cut = |it: &Case| if let Case::Cut(it) = it { it.clone() } else { Linear::trap(&[]) };
        let cuts: Vec<Formula> = cases.iter().map(|it| AtMost(cut(it))).collect();
        let mut known = facts.clone();
        // The cases left to refute: how much is known there, and the further assumptions.
        let mut left = vec![(known.sums.len(), known.lists.len(), goal)];
        for (n, case) in cases.iter().enumerate() {
            let (sums, lists, claim) = left.pop().ok_or_else(|| error("there are too many"))?;
            known.sums.truncate(sums);
            known.lists.truncate(lists);
            self.assume(claim, &mut known)?;
            let here = |it, truth| (known.sums.len(), known.lists.len(), (it, truth));
            let here_at = |it| at(format_args!("[{n}]"))(it);
            match case {
                Case::Contradiction(by) => self.contradiction(&known.sums, by).map_err(here_at)?,
                Case::Split(or) => {
                    let none = || here_at(error(format_args!("there is no open `or` {or}")));
                    let (parts, truth) = *known.lists.get(*or).ok_or_else(none)?;
                    left.extend(parts.iter().rev().map(|it| here(it, truth)));
                }
                Case::Cut(_) => left.extend([here(&cuts[n], false), here(&cuts[n], true)]),
            }
            ensure(left.len() < cases.len() - n, "some are missing")?;
        }
        ensure(left.is_empty(), "there are none")
    }

    /// Puts this with what is known; of what is not about one marking, nothing.
    pub(crate) fn assume<'a>(&self, (it, truth): Claim<'a>, known: &mut Known<'a>) -> Checked<()> {
        match it {
            AtMost(linear) => {
                self.hold(64 * (1 + linear.weights.len()))?;
                let sum = self.linear(linear)?;
                known.sums.push(if truth { sum } else { sum.opposite()? });
            }
            Not(a) => self.assume((a, !truth), known)?,
            And(parts) | Or(parts) if truth == matches!(it, And(_)) || parts.len() == 1 => {
                parts.iter().try_for_each(|it| self.assume((it, truth), known))?;
            }
            And(parts) | Or(parts) => known.lists.push((parts, truth)),
            _ => {}
        }
        Ok(())
    }

    /// Checks that multiples of sums contradict that no number of tokens is negative.
    fn contradiction(&self, known: &[Sum], by: &[(usize, u64)]) -> Checked<()> {
        let mut all = Sum::default();
        for (number, factor) in by {
            let none = || error(format_args!("there is no inequality {number}"));
            let sum = known.get(*number).ok_or_else(none)?;
            self.spend(1 + sum.0.len())?;
            all.add((*factor).into(), sum)?;
        }
        let above = all.0.remove(&ONE) > Some(0);
        let negative = "no contradiction: a place has a negative weight";
        ensure(all.0.values().all(|it| *it >= 0), negative)?;
        ensure(above, "no contradiction: the constant is not above 0")
    }
}
