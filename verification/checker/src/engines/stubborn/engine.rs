//! The engine that fires only some transitions.

use super::{deadlock, reach_reduced};
use crate::engines::{Bid, Budget, Engine, Finding, Found, Known, Task};
use crate::explicit::reached;
use cotama_property::{Atom, Formula};

/// Meets markings best first, firing only some of the transitions in each.
#[derive(Clone, Copy, Debug)]
pub struct Stubborn;

/// The same for a moment: it may find a path. That there is none is shown better by others.
#[derive(Clone, Copy, Debug)]
pub struct Glance;

/// Markings of a first look.
const GLANCE: u64 = 1_000;

/// The most transitions of a net on which half of the budget is asked for.
const WIDE: usize = 10_000;
/// Markings of a wide net, where others are asked afterwards.
const TRIED: u64 = 5_000;

const NAME: &str = "stubborn";

impl Engine for Stubborn {
    fn name(&self) -> &'static str {
        NAME
    }

    fn suits(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Option<Bid> {
        let does = matches!(task, Task::Reach(_)) && net.time().is_none();
        // On a wide net a marking takes milliseconds here, where all of its successors take less.
        let is_wide = net.pt().transitions.len() > WIDE;
        let half = || Bid::half(Bid::LONG, budget);
        does.then(|| if is_wide { Bid::few(Bid::LONG, budget, TRIED) } else { half() })
    }

    fn find(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Finding {
        let Task::Reach(goal) = task else { return Finding::unsuited() };
        let found = match goal {
            Formula::Atom(Atom::Deadlock) => {
                Some(deadlock(net.pt(), &budget.limits, budget.progress))
            }
            _ => reach_reduced(net.pt(), goal, &budget.limits, budget.progress),
        };
        found.map_or(Finding::unsuited(), reached)
    }
}

impl Engine for Glance {
    fn name(&self) -> &'static str {
        NAME
    }

    fn suits(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Option<Bid> {
        let is_new = net.is_whole() && net.made().is_none() && net.time().is_none();
        let does = is_new && matches!(task, Task::Reach(_));
        does.then(|| Bid::few(Bid::GLANCE, budget, GLANCE))
    }

    fn find(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Finding {
        let found = Stubborn.find(net, task, budget);
        if let Found::Never(_) = found.found { Finding::undecided(found.states) } else { found }
    }
}
