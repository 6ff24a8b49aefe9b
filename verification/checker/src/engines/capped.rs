//! Unbounded nets with inhibitor arcs or reset arcs: markings in which large numbers of tokens are
//! not told apart.
//!
//! Every place has a cap that no weight of the net and no number of the question passes, so that
//! `at least the cap` is all that has to be known of more tokens. What is taken from so many may
//! leave any number from what is certain to the cap. So more is reachable than in the net, and what
//! is never reached here is never reached there. What is reached here may be so or not.

use super::bounds::bounds_within;
use super::{Bid, Budget, Engine, Finding, Found, Known, Task};
use cotama_certificate::Evidence;
use cotama_core::net::PlaceId;
use cotama_property::pt::Pt;
use cotama_property::{Atom, Formula, Linear};
use std::collections::HashSet;

/// The most markings that are looked at.
const MARKINGS: usize = 50_000;

/// The largest bound of a place whose tokens are all told apart.
const EXACT: u32 = 1_000;

/// Passes through markings with caps.
#[derive(Clone, Copy, Debug)]
pub struct Capped;

impl Engine for Capped {
    fn name(&self) -> &'static str {
        "capped"
    }

    fn suits(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Option<Bid> {
        let does = matches!(task, Task::Reach(_)) && !net.pt().is_plain() && net.time().is_none();
        does.then(|| Bid::half(Bid::STRUCTURE, budget))
    }

    fn knows_special(&self) -> bool {
        true
    }

    fn find(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Finding {
        let Task::Reach(goal) = task else { return Finding::unsuited() };
        let Some(search) = Search::new(net.pt(), goal, budget) else { return Finding::unsuited() };
        search.run(goal, budget)
    }
}

struct Search<'n> {
    pt: &'n Pt,
    /// For each place the number from which on tokens are not counted.
    caps: Vec<u32>,
}

impl<'n> Search<'n> {
    /// Returns the search; `None` for a bounded net, which other engines know better.
    fn new(pt: &'n Pt, goal: &Formula, budget: &Budget<'_>) -> Option<Self> {
        let bounds = bounds_within(pt, &budget.limits).ok()?;
        if bounds.iter().all(Option::is_some) {
            return None;
        }
        let mut caps = vec![1; pt.places.len()];
        let mut tell = |place: u32, tokens: u32| {
            caps[place as usize] = tokens.max(caps[place as usize]);
        };
        for transition in 0..pt.transitions.len() as u32 {
            let arcs = pt.needs.of(transition).iter().chain(pt.inhibits(transition));
            arcs.for_each(|&(place, tokens)| tell(place, tokens));
        }
        goal.with_atoms(&mut |atom| {
            if let Atom::AtMost(Linear { constant, weights }) = atom {
                for &(PlaceId(place), weight) in weights {
                    let number = constant.unsigned_abs() / weight.unsigned_abs().max(1) + 1;
                    tell(place, u32::try_from(number).unwrap_or(u32::MAX - 1).min(u32::MAX - 1));
                }
            }
            Some(Formula::TRUE)
        });
        for (cap, bound) in caps.iter_mut().zip(bounds) {
            if let Some(bound) = bound.filter(|it| *it <= EXACT) {
                *cap = bound + 1;
            }
        }
        Some(Self { pt, caps })
    }

    fn run(&self, goal: &Formula, budget: &Budget<'_>) -> Finding {
        let first: Vec<u32> =
            self.pt.initial.iter().zip(&self.caps).map(|(it, cap)| *it.min(cap)).collect();
        let mut met = HashSet::from([first.clone()]);
        let mut open = vec![first];
        while let Some(marking) = open.pop() {
            if self.may(goal, &marking).0 || budget.limits.is_over() {
                return Finding::undecided(met.len() as u64);
            }
            for transition in 0..self.pt.transitions.len() as u32 {
                if self.pt.enabled(&marking, transition) {
                    let Some(after) = self.fire(&marking, transition) else {
                        return Finding::undecided(met.len() as u64);
                    };
                    open.extend(after.into_iter().filter(|it| met.insert(it.clone())));
                }
            }
            if met.len() > MARKINGS {
                return Finding::undecided(met.len() as u64);
            }
        }
        Finding { found: Found::Never(Evidence::None), states: met.len() as u64 }
    }

    /// The markings that may come after a firing; `None` when these are too many.
    fn fire(&self, from: &[u32], transition: u32) -> Option<Vec<Vec<u32>>> {
        const MOST: usize = 256;
        let mut all = vec![from.to_vec()];
        for &(place, change) in self.pt.effects.of(transition) {
            let (at, cap) = (place as usize, self.caps[place as usize]);
            let after = i64::from(from[at]) + change;
            // A place at its cap may keep so many less, or any more.
            let least = u32::try_from(after.min(cap.into())).ok()?;
            let most = if from[at] == cap { cap } else { least };
            if all.len() * (most - least + 1) as usize > MOST {
                return None;
            }
            let one = |tokens: u32| {
                all.iter().map(move |it| {
                    let mut after = it.clone();
                    after[at] = tokens;
                    after
                })
            };
            all = (least..=most).flat_map(one).collect();
        }
        for &(place, left) in self.pt.resets(transition) {
            let at = place as usize;
            all.iter_mut().for_each(|it| it[at] = left.min(self.caps[at]));
        }
        Some(all)
    }

    /// Whether a formula may hold in a marking that this one stands for, and whether it holds in
    /// all of them.
    fn may(&self, formula: &Formula, marking: &[u32]) -> (bool, bool) {
        let exactly = |holds| (holds, holds);
        let enabled = |it: u32| self.pt.enabled(marking, it);
        match formula {
            Formula::Not(inner) => {
                let (may, must) = self.may(inner, marking);
                (!must, !may)
            }
            Formula::And(all) => all.iter().fold((true, true), |(may, must), it| {
                let it = self.may(it, marking);
                (may && it.0, must && it.1)
            }),
            Formula::Or(all) => all.iter().fold((false, false), |(may, must), it| {
                let it = self.may(it, marking);
                (may || it.0, must || it.1)
            }),
            Formula::Atom(Atom::AtMost(linear)) => self.at_most(linear, marking),
            Formula::Atom(Atom::Fireable(all)) => exactly(all.iter().any(|it| enabled(it.0))),
            Formula::Atom(Atom::Deadlock) => {
                exactly(!(0..self.pt.transitions.len() as u32).any(enabled))
            }
            // No other formula speaks of one marking.
            _ => (true, false),
        }
    }

    fn at_most(&self, linear: &Linear, marking: &[u32]) -> (bool, bool) {
        let mut least = i128::from(linear.constant);
        let [mut falls, mut grows] = [false; 2];
        for &(PlaceId(place), weight) in &linear.weights {
            let at = place as usize;
            least += i128::from(weight) * i128::from(marking[at]);
            if marking[at] == self.caps[at] {
                falls |= weight < 0;
                grows |= weight > 0;
            }
        }
        (falls || least <= 0, !grows && least <= 0)
    }
}
