//! Proofs that no reachable marking is a goal.

use super::net::{Linear, Marking, Net, number};
use super::{Checked, at, ensure, fail};
use crate::certificate::claim::Claim::{self, And, AtMost, Not};
use crate::certificate::{Case, Fact, Refutation};

/// Inequalities that are known, and lists of claims of which one is false.
#[derive(Default)]
pub(in crate::certificate) struct Known<'a> {
    pub(in crate::certificate) linears: Vec<Linear>,
    pub(in crate::certificate) lists: Vec<&'a [Claim]>,
}

impl Net<'_> {
    /// That no marking reachable from this one is a goal.
    pub(super) fn refute(&self, from: &Marking, goal: &Claim, by: &Refutation) -> Checked<()> {
        let dead: Checked<Vec<_>> = by.dead.iter().map(|it| number(&self.names, &it.0)).collect();
        let dead = dead.map_err(at(".dead"))?;
        let facts = by
            .facts
            .iter()
            .enumerate()
            .map(|(n, fact)| self.fact(from, fact, &dead).map_err(at(format_args!(".facts[{n}]"))));
        let facts = facts.collect::<Checked<Vec<_>>>()?;
        for (n, (transition, (_, cases))) in dead.iter().zip(&by.dead).enumerate() {
            let enabled = self.enabling(*transition)?;
            self.close(&facts, &enabled, cases).map_err(at(format_args!(".dead[{n}]")))?;
        }
        self.close(&facts, goal, &by.cases).map_err(at(".cases"))
    }

    /// A fact, as an inequality. Dead transitions break nothing.
    fn fact(&self, from: &Marking, by: &Fact, dead: &[usize]) -> Checked<Linear> {
        let fact = match by {
            Fact::AtMost(linear) => self.linear(linear)?,
            Fact::Trap(names) => {
                let weights = names.iter().map(|it| Ok((number(&self.places, it)?, -1)));
                Linear { constant: 1, weights: weights.collect::<Checked<_>>()? }
            }
        };
        ensure(fact.value(from) <= 0, "does not hold at the start")?;
        for (id, it) in self.transitions.iter().enumerate() {
            self.spend(1 + it.take.len() + it.give.len() + dead.len())?;
            let (take, give) = (fact.weigh(&it.take), fact.weigh(&it.give));
            // The places of a trap have weight -1.
            let breaks = if let Fact::Trap(_) = by { take < 0 && give == 0 } else { give > take };
            ensure(!breaks || dead.contains(&id), format_args!("`{}` breaks it", it.name))?;
        }
        Ok(fact)
    }

    /// That the claim does not hold where the facts do.
    fn close(&self, facts: &[Linear], claim: &Claim, cases: &[Case]) -> Checked<()> {
        let cut = |it: &Case| if let Case::Cut(it) = it { self.linear(it) } else { Ok(Linear::default()) };
        let cuts = cases.iter().map(|it| cut(it).map(AtMost)).collect::<Checked<Vec<_>>>()?;
        let mut known = Known { linears: facts.to_vec(), lists: Vec::new() };
        // What is left to refute: how much is known there, and what else is assumed.
        let mut left = vec![(facts.len(), 0, claim, true)];
        for (n, case) in cases.iter().enumerate() {
            let at = || at(format!("[{n}]"));
            let Some((linears, lists, claim, truth)) = left.pop() else { return fail("there are too many") };
            known.linears.truncate(linears);
            known.lists.truncate(lists);
            self.assume(claim, truth, &mut known)?;
            let here = |claim, truth| (known.linears.len(), known.lists.len(), claim, truth);
            match case {
                Case::Contradiction(by) => self.contradiction(&known.linears, by).map_err(at())?,
                Case::Split(or) => {
                    let none = || fail(format_args!("there is no open `or` {or}")).map_err(at());
                    let parts = known.lists.get(*or).map_or_else(none, Ok)?;
                    left.extend(parts.iter().rev().map(|it| here(it, false)));
                }
                Case::Cut(_) => left.extend([here(&cuts[n], false), here(&cuts[n], true)]),
            }
            ensure(left.len() < cases.len() - n, "some are missing")?;
        }
        ensure(left.is_empty(), "there are none")
    }

    /// Puts this with what is known; of what is not about one marking, nothing.
    pub(in crate::certificate) fn assume<'a>(
        &self,
        claim: &'a Claim,
        truth: bool,
        known: &mut Known<'a>,
    ) -> Checked<()> {
        match (claim, truth) {
            (AtMost(linear), _) => {
                self.spend(64 * (1 + linear.weights.len()))?; // memory is work too
                let mut sum = Linear { constant: i128::from(!truth), ..Linear::default() };
                sum.add(if truth { 1 } else { -1 }, linear)?;
                known.linears.push(sum);
            }
            (Not(a), _) => self.assume(a, !truth, known)?,
            (And(all), true) => all.iter().try_for_each(|it| self.assume(it, true, known))?,
            (And(all), false) if all.len() == 1 => self.assume(&all[0], false, known)?,
            (And(all), false) => known.lists.push(all),
            _ => {}
        }
        Ok(())
    }

    /// That multiples of inequalities contradict that no number of tokens is negative.
    fn contradiction(&self, known: &[Linear], by: &[(usize, u64)]) -> Checked<()> {
        let mut sum = Linear::default();
        for (number, factor) in by {
            let none = || fail(format_args!("there is no inequality {number}"));
            let linear = known.get(*number).map_or_else(none, Ok)?;
            self.spend(1 + linear.weights.len())?;
            sum.add((*factor).into(), linear)?;
        }
        ensure(sum.weights.values().all(|it| *it >= 0), "no contradiction: a place has a negative weight")?;
        ensure(sum.constant > 0, "no contradiction: the constant is not above 0")
    }
}
