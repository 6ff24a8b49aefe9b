//! The engines of temporal logic.

use super::answer::{branching, is_of_runs};
use super::fairness::Fairness;
use super::ltl::{all_runs, fair_runs, some_runs, stored_runs};
use super::verdict::Verdict;
use crate::engines::{Bid, Budget, Engine, Finding, Found, Known, STORED, Task};
use crate::explicit::Limits;
use cotama_certificate::Evidence;
use cotama_property::{Ctl, Formula};

/// Formulas of LTL, while markings are met.
#[derive(Clone, Copy, Debug)]
pub struct Runs;

/// Formulas of CTL, on all markings.
#[derive(Clone, Copy, Debug)]
pub struct Branching;

/// The same on markings that are stored; stores them where evidence asks for it.
#[derive(Clone, Copy, Debug)]
pub struct StoredBranching;

const NAME: &str = "temporal";

/// Returns the formula behind the quantifier of a formula about single runs, and whether all runs
/// are meant.
pub(crate) fn of_runs(formula: &Formula) -> Option<(&Formula, bool)> {
    match formula {
        Formula::All(path) if is_of_runs(path) => Some((path, true)),
        Formula::Exists(path) if is_of_runs(path) => Some((path, false)),
        _ => None,
    }
}

impl Engine for Runs {
    fn name(&self) -> &'static str {
        NAME
    }

    fn suits(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Option<Bid> {
        let Task::Holds(formula, assumed) = task else { return None };
        of_runs(formula).filter(|_| net.time().is_none())?;
        let is_stored = net.made().is_some();
        // CTL on fair runs needs no automaton.
        let cost = if assumed.is_empty() && is_stored { Bid::STORED + 1 } else { Bid::SEARCH };
        Some(Bid::new(cost, budget))
    }

    fn knows_special(&self) -> bool {
        true
    }

    fn find(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Finding {
        let Task::Holds(formula, assumed) = task else { return Finding::unsuited() };
        let Some((path, all)) = of_runs(formula) else { return Finding::unsuited() };
        let (asked, limits, progress) = ((path, assumed), budget.limits, budget.progress);
        verdict(match net.made() {
            Some(graph) if assumed.is_empty() => {
                let bytes = limits.bytes.saturating_sub(graph.bytes());
                let limits = Limits { bytes, ..limits };
                stored_runs(&*graph, asked, all, (&limits, budget.jobs), progress)
            }
            _ if !assumed.is_empty() => fair_runs(net.pt(), asked, all, &limits, progress),
            _ if all => all_runs(net.pt(), path, &limits, progress),
            _ => some_runs(net.pt(), path, &limits, progress),
        })
    }
}

impl Engine for Branching {
    fn name(&self) -> &'static str {
        NAME
    }

    fn suits(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Option<Bid> {
        let Task::Holds(formula, assumed) = task else { return None };
        Ctl::new(formula).filter(|_| net.time().is_none())?;
        let cost = if assumed.is_empty() { Bid::LONG } else { Bid::STORED };
        Some(Bid::new(cost, budget))
    }

    fn knows_special(&self) -> bool {
        true
    }

    fn find(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Finding {
        let Task::Holds(formula, assumed) = task else { return Finding::unsuited() };
        let Some(fairness) = Fairness::of(assumed) else { return Finding::unsuited() };
        match net.graph(budget) {
            Ok(graph) => {
                let bytes = budget.limits.bytes.saturating_sub(graph.bytes());
                verdict(branching(&*graph, formula, &fairness, bytes, budget.jobs))
            }
            Err(it) => Finding::stopped(it.limit, it.states),
        }
    }
}

impl Engine for StoredBranching {
    fn name(&self) -> &'static str {
        NAME
    }

    fn suits(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Option<Bid> {
        let made = net.made();
        let most = made.as_ref().map_or(STORED, |_| u64::MAX);
        let is_worth = budget.evidence || made.is_some();
        let bid = Branching.suits(net, task, budget).filter(|_| net.is_whole() && is_worth)?;
        Some(Bid::few(bid.cost.min(Bid::STORED), budget, most))
    }

    fn knows_special(&self) -> bool {
        true
    }

    fn find(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Finding {
        if let Err(it) = net.graph(budget) {
            return Finding::stopped(it.limit, it.states);
        }
        // One that is too large to be kept would be made for each question anew.
        if net.made().is_some() { Branching.find(net, task, budget) } else { Finding::undecided(0) }
    }
}

pub(crate) fn verdict(verdict: Verdict) -> Finding {
    match verdict {
        Verdict::Known { holds, run, states } => {
            Finding { found: Found::Holds(holds, run, Evidence::None), states }
        }
        Verdict::Unknown { reason, states } => Finding::nothing(reason.into(), states),
    }
}
