//! Reading a certificate: from its text to data that is in order and of limited size, with numbers
//! for names. Whether it is right is no matter here.

use super::sum::{Marking, ONE, Sum};
use super::verified::{Checked, at, each, ensure, error};
use super::{Certificate, Formula, Linear, Net, Question, SCHEMA, Transition};
use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet};
use std::iter::once;
use std::slice::from_ref;

/// The longest text of a certificate, in bytes.
pub const MAX_BYTES: usize = 1 << 26;

/// The most work: about so many arcs and terms are looked at.
pub const MAX_WORK: u64 = 1 << 33;

/// The most memory, in bytes, about.
pub const MAX_MEMORY: u64 = 1 << 30;

/// About the bytes that one of many markings of so many places takes while all are passed through.
pub(super) const fn marking_bytes(places: usize) -> usize {
    160 + 4 * places
}

/// About how many markings of so many places fit into [`MAX_MEMORY`], where a few follow each.
pub const fn most_markings(places: usize) -> u64 {
    MAX_MEMORY / (marking_bytes(places + 1) + 128) as u64
}

/// A formula, and whether it holds.
pub(super) type Claim<'a> = (&'a Formula, bool);

pub(super) fn certificate(text: &str) -> Checked<Certificate> {
    let long = format_args!("has {} bytes; at most {MAX_BYTES} are read", text.len());
    ensure(text.len() <= MAX_BYTES, long).map_err(at("certificate"))?;
    let read: Certificate = serde_json::from_str(text).map_err(error).map_err(at("certificate"))?;
    let other = format_args!("is `{}`, not `{SCHEMA}`", read.schema);
    ensure(read.schema == SCHEMA, other).map_err(at("schema"))?;
    let is_closed = match &read.question {
        Question::Formula(formula) => formula.is_about_markings(),
        _ => true,
    };
    ensure(is_closed, "speaks of a run, and no quantifier of which").map_err(at("question"))?;
    Ok(read)
}

/// A net with numbers.
pub(super) struct Numbered<'a> {
    pub(super) net: &'a Net,
    pub(super) initial: Marking,
    /// Tokens that each transition takes and gives.
    pub(super) arcs: Vec<[BTreeMap<usize, u32>; 2]>,
    /// Places that keep each transition from firing, and those that it empties.
    pub(super) special: Vec<(BTreeMap<usize, u32>, Vec<usize>)>,
    /// Whether no transition has such places, and all have one priority.
    pub(super) is_plain: bool,
    places: BTreeMap<&'a str, usize>,
    transitions: BTreeMap<&'a str, usize>,
    work: Cell<u64>,
    memory: Cell<u64>,
}

fn number(of: &BTreeMap<&str, usize>, name: &str) -> Checked<usize> {
    of.get(name).copied().ok_or_else(|| error(format_args!("there is no `{name}`")))
}

impl<'a> Numbered<'a> {
    pub(super) fn new(net: &'a Net) -> Checked<Self> {
        let places: BTreeMap<_, _> =
            net.places.iter().map(|it| it.0.as_str()).zip(ONE + 1..).collect();
        let transitions: BTreeMap<_, _> =
            net.transitions.iter().map(|it| it.name.as_str()).zip(0..).collect();
        let differ = places.len() == net.places.len() && transitions.len() == net.transitions.len();
        ensure(differ, "two places or two transitions have the same name")?;
        let initial = once(1).chain(net.places.iter().map(|it| it.1)).collect();
        let (work, memory) = (Cell::new(0), Cell::new(0));
        let first = net.transitions.first().map_or(0, |it| it.priority);
        let is_plain =
            |it: &Transition| it.inhibit.is_empty() && it.reset.is_empty() && it.priority == first;
        let is_plain = net.transitions.iter().all(is_plain);
        let (arcs, special) = (Vec::new(), Vec::new());
        let mut numbered =
            Self { net, initial, arcs, special, is_plain, places, transitions, work, memory };
        let arcs = each(&net.transitions, |it| {
            let arcs = [numbered.weights(&it.take)?, numbered.weights(&it.give)?];
            ensure(arcs.iter().flat_map(BTreeMap::values).all(|it| *it > 0), "an arc has weight 0")
                .map(|()| arcs)
        });
        numbered.arcs = arcs.map_err(at(".transitions"))?;
        let special = each(&net.transitions, |it| {
            let (inhibit, reset) = (numbered.weights(&it.inhibit)?, numbered.places(&it.reset)?);
            ensure(inhibit.values().all(|it| *it > 0), "an arc has weight 0")?;
            let differ = reset.iter().collect::<BTreeSet<_>>().len() == reset.len();
            ensure(differ, "a place is emptied twice").map(|()| (inhibit, reset))
        });
        numbered.special = special.map_err(at(".transitions"))?;
        Ok(numbered)
    }

    pub(super) fn place(&self, name: &str) -> Checked<usize> {
        number(&self.places, name)
    }

    pub(super) fn places(&self, names: &[String]) -> Checked<Vec<usize>> {
        names.iter().map(|it| self.place(it)).collect()
    }

    pub(super) fn transition(&self, name: &str) -> Checked<usize> {
        number(&self.transitions, name)
    }

    fn weights<W: Copy, N: From<W>>(&self, list: &[(String, W)]) -> Checked<BTreeMap<usize, N>> {
        let weights = list.iter().map(|it| Ok((self.place(&it.0)?, it.1.into())));
        let weights = weights.collect::<Checked<BTreeMap<_, _>>>()?;
        ensure(weights.len() == list.len(), "a place has two weights").map(|()| weights)
    }

    pub(super) fn linear(&self, linear: &Linear) -> Checked<Sum> {
        let weights = self.weights(&linear.weights)?;
        Ok(Sum(once((ONE, linear.constant.into())).chain(weights).collect()))
    }

    /// Returns the claim that a transition is enabled but for others that go before it:
    /// `weight - tokens <= 0` for
    /// each place that it takes from, and not so for each that inhibits it.
    fn ready(&self, transition: usize) -> Checked<Formula> {
        let Transition { take, inhibit, .. } = &self.net.transitions[transition];
        self.hold(256 * (1 + take.len() + inhibit.len()))?;
        let at_least = |it: &(String, u32)| Formula::at_least(it.1.into(), from_ref(&it.0));
        let enough = take.iter().map(at_least);
        let free = inhibit.iter().map(|it| Formula::Not(Box::new(at_least(it))));
        Ok(Formula::And(enough.chain(free).collect()))
    }

    /// The transitions that go before this one.
    pub(super) fn going_first(&self, transition: usize) -> impl Iterator<Item = usize> {
        let (all, own) = (&self.net.transitions, self.net.transitions[transition].priority);
        (0..all.len()).filter(move |it| !self.is_plain && all[*it].priority > own)
    }

    /// Returns the claim that a transition is enabled: `weight - tokens <= 0` for each place that
    /// it takes from.
    pub(super) fn enabling(&self, transition: usize) -> Checked<Formula> {
        let Formula::And(mut parts) = self.ready(transition)? else { return Ok(Formula::Deadlock) };
        for other in self.going_first(transition) {
            parts.push(Formula::Not(Box::new(self.ready(other)?)));
        }
        Ok(Formula::And(parts))
    }

    /// The formula with what is enabled written out as inequalities; all that it names is there.
    pub(super) fn written_out(&self, formula: &Formula) -> Checked<Formula> {
        let list = |all: &[Formula]| {
            all.iter().map(|it| self.written_out(it)).collect::<Checked<Vec<_>>>()
        };
        let boxed = |it: &Formula| self.written_out(it).map(Box::new);
        Ok(match formula {
            Formula::AtMost(linear) => self.linear(linear).map(|_| formula.clone())?,
            Formula::Fireable(names) => {
                let all = names.iter().map(|it| self.enabling(self.transition(it)?));
                Formula::Or(all.collect::<Checked<_>>()?)
            }
            Formula::Deadlock => {
                let all = (0..self.arcs.len()).map(|it| self.enabling(it));
                Formula::Not(Box::new(Formula::Or(all.collect::<Checked<_>>()?)))
            }
            Formula::Not(a) => Formula::Not(boxed(a)?),
            Formula::And(all) => Formula::And(list(all)?),
            Formula::Or(all) => Formula::Or(list(all)?),
            Formula::ExistsNext(a) => Formula::ExistsNext(boxed(a)?),
            Formula::AllNext(a) => Formula::AllNext(boxed(a)?),
            Formula::Exists(a) => Formula::Exists(boxed(a)?),
            Formula::All(a) => Formula::All(boxed(a)?),
            Formula::Next(a) => Formula::Next(boxed(a)?),
            Formula::Finally(a) => Formula::Finally(boxed(a)?),
            Formula::Globally(a) => Formula::Globally(boxed(a)?),
            Formula::Until(both) => {
                Formula::Until(Box::new((self.written_out(&both.0)?, self.written_out(&both.1)?)))
            }
        })
    }

    /// Counts memory, which is work too.
    pub(super) fn hold(&self, bytes: usize) -> Checked<()> {
        self.memory.set(self.memory.get().saturating_add(bytes as u64));
        ensure(self.memory.get() <= MAX_MEMORY, "takes too much memory to check")?;
        self.spend(bytes)
    }

    pub(super) fn spend(&self, work: usize) -> Checked<()> {
        self.work.set(self.work.get().saturating_add(work as u64));
        ensure(self.work.get() <= MAX_WORK, "is too much work to check")
    }

    #[cfg(test)]
    pub(super) fn counted(&self) -> (u64, u64) {
        (self.work.get(), self.memory.get())
    }
}

impl Formula {
    /// Whether each temporal operator stands inside of a quantifier.
    pub(super) fn is_about_markings(&self) -> bool {
        match self {
            Self::Not(a) | Self::ExistsNext(a) | Self::AllNext(a) => a.is_about_markings(),
            Self::And(all) | Self::Or(all) => all.iter().all(Self::is_about_markings),
            Self::Next(_) | Self::Finally(_) | Self::Globally(_) | Self::Until(_) => false,
            _ => true,
        }
    }
}
