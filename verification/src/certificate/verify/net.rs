//! The firing rule, and weighted sums of tokens.

use super::{Checked, MAX_WORK, at, ensure, fail};
use crate::certificate;
use std::cell::Cell;
use std::collections::BTreeMap;

/// The tokens of each place.
pub(in crate::certificate) type Marking = Vec<u32>;

pub(in crate::certificate) struct Net<'a> {
    pub(in crate::certificate) initial: Marking,
    pub(in crate::certificate) transitions: Vec<Transition<'a>>,
    /// Numbers by name.
    pub(in crate::certificate) places: BTreeMap<&'a str, usize>,
    pub(in crate::certificate) names: BTreeMap<&'a str, usize>,
    work: Cell<u64>,
}

pub(in crate::certificate) struct Transition<'a> {
    pub(in crate::certificate) name: &'a str,
    pub(in crate::certificate) take: BTreeMap<usize, u32>,
    pub(in crate::certificate) give: BTreeMap<usize, u32>,
}

/// `constant + sum of weight * tokens`. The weights that are read have 64 bits: with 32 bits for tokens, none of their
/// sums passes 127.
#[derive(Clone, Default, PartialEq)]
pub(in crate::certificate) struct Linear {
    pub(in crate::certificate) constant: i128,
    pub(in crate::certificate) weights: BTreeMap<usize, i128>,
}

impl Linear {
    pub(in crate::certificate) fn value(&self, marking: &Marking) -> i128 {
        self.constant
            + self.weights.iter().map(|(place, weight)| weight * i128::from(marking[*place])).sum::<i128>()
    }

    /// The sum of the weights of arcs.
    pub(in crate::certificate) fn weigh(&self, arcs: &BTreeMap<usize, u32>) -> i128 {
        arcs.iter().map(|(place, weight)| self.weights.get(place).unwrap_or(&0) * i128::from(*weight)).sum()
    }

    /// Adds a multiple of another one.
    pub(in crate::certificate) fn add(&mut self, factor: i128, other: &Self) -> Checked<()> {
        let plus = |sum: &mut i128, it: i128| {
            let more = factor.checked_mul(it).and_then(|it| sum.checked_add(it));
            *sum = more.map_or_else(|| fail("numbers get too large"), Ok)?;
            Ok(())
        };
        plus(&mut self.constant, other.constant)?;
        other.weights.iter().try_for_each(|it| plus(self.weights.entry(*it.0).or_default(), *it.1))
    }
}

/// The number of what has this name.
pub(in crate::certificate) fn number(of: &BTreeMap<&str, usize>, name: &str) -> Checked<usize> {
    of.get(name).map_or_else(|| fail(format_args!("there is no `{name}`")), |it| Ok(*it))
}

impl<'a> Net<'a> {
    pub(in crate::certificate) fn read(net: &'a certificate::Net) -> Checked<Self> {
        let places: BTreeMap<_, _> = net.places.iter().map(|it| it.0.as_str()).zip(0..).collect();
        let names: BTreeMap<_, _> = net.transitions.iter().map(|it| it.name.as_str()).zip(0..).collect();
        let differ = places.len() == net.places.len() && names.len() == net.transitions.len();
        ensure(differ, "two places or two transitions have the same name")?;
        let initial = net.places.iter().map(|it| it.1).collect();
        let mut read = Self { initial, transitions: Vec::new(), places, names, work: Cell::new(0) };
        for (n, it) in net.transitions.iter().enumerate() {
            let at = || at(format!(".transitions[{n}]"));
            let take = read.weights(&it.take).map_err(at())?;
            let give = read.weights(&it.give).map_err(at())?;
            ensure(take.values().chain(give.values()).all(|it| *it > 0), "an arc has weight 0")
                .map_err(at())?;
            read.transitions.push(Transition { name: &it.name, take, give });
        }
        Ok(read)
    }

    fn weights<W: Copy, N: From<W>>(&self, list: &[(String, W)]) -> Checked<BTreeMap<usize, N>> {
        let weights = list.iter().map(|it| Ok((number(&self.places, &it.0)?, it.1.into())));
        let weights = weights.collect::<Checked<BTreeMap<_, _>>>()?;
        ensure(weights.len() == list.len(), "a place has two weights").map(|()| weights)
    }

    pub(in crate::certificate) fn linear(&self, linear: &certificate::Linear) -> Checked<Linear> {
        Ok(Linear { constant: linear.constant.into(), weights: self.weights(&linear.weights)? })
    }

    /// The marking after a transition, if that is enabled.
    pub(in crate::certificate) fn fire(
        &self,
        marking: &Marking,
        transition: usize,
    ) -> Checked<Option<Marking>> {
        let Transition { take, give, .. } = &self.transitions[transition];
        self.spend(1 + take.len())?;
        if take.iter().any(|(place, weight)| marking[*place] < *weight) {
            return Ok(None);
        }
        self.spend(give.len() + marking.len())?;
        let mut after = marking.clone();
        for (place, weight) in take {
            after[*place] -= weight;
        }
        for (place, weight) in give {
            let sum = after[*place].checked_add(*weight);
            after[*place] = sum.map_or_else(|| fail("numbers get too large"), Ok)?;
        }
        Ok(Some(after))
    }

    /// The markings on a way: one more than there are transitions.
    pub(in crate::certificate) fn way(&self, from: &Marking, names: &[String]) -> Checked<Vec<Marking>> {
        let mut way = vec![from.clone()];
        for (n, name) in names.iter().enumerate() {
            self.spend(4 * from.len())?; // memory is work too
            let after = number(&self.names, name).and_then(|it| self.fire(&way[n], it));
            let enabled =
                after.and_then(|it| it.map_or_else(|| fail(format_args!("`{name}` is not enabled")), Ok));
            way.push(enabled.map_err(at(format_args!("[{n}]")))?);
        }
        Ok(way)
    }

    pub(in crate::certificate) fn spend(&self, work: usize) -> Checked<()> {
        self.work.set(self.work.get().saturating_add(work as u64));
        ensure(self.work.get() <= MAX_WORK, "is too much work to check")
    }
}
