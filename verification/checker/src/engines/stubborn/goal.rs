//! Necessary transitions of a path to a goal.

use super::Closure;
use super::visible::{change, changers};
use crate::explicit::Look;
use cotama_core::net::PlaceId;
use cotama_property::pt::Pt;
use cotama_property::{Atom, Formula, Linear, Marking};

/// A formula about one marking, with negations in its atoms only.
#[derive(Debug)]
pub(super) enum Goal {
    /// The sum is at most 0: transitions that lower it.
    AtMost(Linear, Vec<u32>),
    /// The sum is at least 1: transitions that raise it.
    AtLeast(Linear, Vec<u32>),
    /// Some of these is enabled.
    Enabled(Vec<u32>),
    /// All of these are disabled.
    Disabled(Vec<u32>),
    /// Some transition is enabled, which cannot come about in a deadlock.
    Alive,
    All(Vec<Goal>),
    Any(Vec<Goal>),
}

impl Goal {
    /// Returns the goal; `None` when the formula has temporal operators.
    pub(super) fn new(pt: &Pt, formula: &Formula, positive: bool) -> Option<Self> {
        let transitions = || 0..pt.transitions.len() as u32;
        Some(match formula {
            Formula::Atom(Atom::AtMost(linear)) => {
                let sign = if positive { -1 } else { 1 };
                let changers = changers(pt, linear).into_iter();
                let moves =
                    changers.filter(|it| change(pt, linear, *it).signum() == sign).collect();
                if positive {
                    Self::AtMost(linear.clone(), moves)
                } else {
                    Self::AtLeast(linear.clone(), moves)
                }
            }
            Formula::Atom(Atom::Fireable(some)) => {
                let some =
                    some.iter().map(|it| it.0).filter(|it| transitions().contains(it)).collect();
                if positive { Self::Enabled(some) } else { Self::Disabled(some) }
            }
            Formula::Atom(Atom::Deadlock) if positive => Self::Disabled(transitions().collect()),
            Formula::Atom(Atom::Deadlock) => Self::Alive,
            Formula::Not(inner) => Self::new(pt, inner, !positive)?,
            Formula::And(all) | Formula::Or(all) => {
                let parts =
                    all.iter().map(|it| Self::new(pt, it, positive)).collect::<Option<_>>()?;
                if matches!(formula, Formula::And(_)) == positive {
                    Self::All(parts)
                } else {
                    Self::Any(parts)
                }
            }
            _ => return None,
        })
    }

    /// 0 exactly when it holds; otherwise the larger the more seems to be missing.
    pub(super) fn distance(&self, pt: &Pt, look: Look<'_>) -> u64 {
        let positive = |it: i128| u64::try_from(it.max(0)).unwrap_or(u64::MAX);
        match self {
            Self::AtMost(linear, _) => positive(linear.value(&look)),
            Self::AtLeast(linear, _) => positive(1_i128.saturating_sub(linear.value(&look))),
            Self::Enabled(some) => {
                let missing = |it: &u32| {
                    let needs = pt.needs.of(*it).iter();
                    needs.map(|it| u64::from(it.1).saturating_sub(look.tokens(PlaceId(it.0)))).sum()
                };
                some.iter().map(missing).min().unwrap_or(u64::MAX)
            }
            Self::Disabled(some) => some.iter().filter(|it| look.enables(**it)).count() as u64,
            Self::Alive => u64::from(look.transitions().next().is_none()),
            Self::All(all) => {
                all.iter().map(|it| it.distance(pt, look)).fold(0, u64::saturating_add)
            }
            Self::Any(all) => all.iter().map(|it| it.distance(pt, look)).min().unwrap_or(u64::MAX),
        }
    }

    /// Sets of transitions each of which has a member on every path from here to a marking in which
    /// it holds; it does not hold here.
    pub(super) fn needed(&self, closure: &Closure<'_>, pt: &Pt, look: Look<'_>) -> Vec<Vec<u32>> {
        match self {
            Self::All(all) => {
                let open = all.iter().filter(|it| it.distance(pt, look) > 0);
                open.flat_map(|it| it.needed(closure, pt, look)).take(CHOICES).collect()
            }
            Self::Any(all) => {
                let least =
                    |it: &Self| it.needed(closure, pt, look).into_iter().min_by_key(Vec::len);
                vec![all.iter().filter_map(least).flatten().collect()]
            }
            Self::AtMost(_, moves) | Self::AtLeast(_, moves) => vec![moves.clone()],
            Self::Enabled(some) => {
                let missed = some.iter().filter_map(|it| closure.missed(look, *it));
                vec![missed.flat_map(|it| closure.producers(it)).copied().collect()]
            }
            Self::Disabled(some) => {
                let enabled = some.iter().filter(|it| look.enables(**it)).take(CHOICES);
                let consumers = |it: &u32| {
                    pt.needs.of(*it).iter().flat_map(|it| closure.consumers(it.0)).copied()
                };
                enabled.map(|it| consumers(it).collect()).collect()
            }
            Self::Alive => vec![Vec::new()],
        }
    }
}

/// How many sets are compared.
const CHOICES: usize = 8;
