//! Which engine is asked what, in which order.

use super::reduced::Smaller;
use super::{Choice, Options};
use crate::engines::{self, Bid, Budget, Engine, Finding, Found, Known, Reason, Task};
use crate::explicit::{Explicit, Limit, Limits};
use crate::structural::Structural;
use crate::stubborn::Stubborn;
use crate::temporal::{Branching, Rest, Run, Runs};
use crate::tpn::StateClasses;
use cotama_certificate::Evidence;
use cotama_core::net::TransitionId;
use cotama_property::{Condition, Formula, Reachability};
use std::ops::Range;

/// Markings of a net that is looked at once more for a run.
const SHOWN: u64 = 20_000;

impl Choice {
    /// The engines that are asked. What speaks of runs or of time has one engine each.
    fn engines(self) -> &'static [&'static dyn Engine] {
        match self {
            Self::Auto => engines::ALL,
            Self::Structural => &[&Structural, &Runs, &Branching, &StateClasses],
            Self::Stubborn => &[&Stubborn, &Runs, &Branching, &StateClasses],
            Self::Explicit => &[&Explicit, &Runs, &Branching, &StateClasses],
        }
    }
}

/// Whether some transitions that never fire are enough to know the answer.
type Enough<'e> = &'e dyn Fn(&[TransitionId]) -> bool;

/// A question that is being answered, and who has been asked.
pub(super) struct Strategy<'a, 'n> {
    pub(super) net: &'a Known<'n>,
    pub(super) budget: Budget<'a>,
    choice: Choice,
    own: &'a [&'a dyn Engine],
    /// The techniques that led to findings, in order.
    pub(super) techniques: Vec<&'static str>,
    /// Engines that were asked, also in vain.
    pub(super) tried: Vec<&'static str>,
    /// The most markings that one of them met.
    pub(super) states: u64,
}

impl<'a, 'n> Strategy<'a, 'n> {
    pub(super) fn new(net: &'a Known<'n>, options: &Options<'a>) -> Self {
        let (budget, choice, own) = (Budget::from(options), options.engine, options.engines);
        let (techniques, tried) = (Vec::new(), Vec::new());
        Self { net, budget, choice, own, techniques, tried, states: 0 }
    }

    /// Asks about the whole net what costs less than a search, and then searches; a smaller net if
    /// reductions make one.
    pub(super) fn solve(&mut self, task: Task<'_>) -> Finding {
        self.solve_until(task, &|_| false)
    }

    /// The same, content with some of the transitions that never fire where they are enough.
    pub(super) fn solve_until(&mut self, task: Task<'_>, some: Enough<'_>) -> Finding {
        let first = self.among(self.net, task, 0..Bid::SEARCH, some);
        if is_enough(task, &first) {
            return first;
        }
        if self.budget.limits.is_over() {
            return better(first, Finding::stopped(Limit::Time, 0));
        }
        let may_reduce = self.net.pt().is_plain() && self.net.time().is_none();
        let smaller = (self.choice == Choice::Auto && may_reduce)
            .then(|| Smaller::new(self.net.pt(), task, &self.budget.limits))
            .flatten();
        let then = match smaller {
            None => self.among(self.net, task, Bid::SEARCH..u32::MAX, some),
            Some(smaller) => {
                self.used("reductions");
                let found = self.of_smaller(task, &smaller, some);
                self.lifted(task, &smaller, found)
            }
        };
        better(first, then)
    }

    /// Asks of the smaller net. What is said of it may come to be about one marking.
    fn of_smaller(&mut self, task: Task<'_>, smaller: &Smaller, some: Enough<'_>) -> Finding {
        let known = Known::reduced(&smaller.reduced.net);
        let all = 0..u32::MAX;
        if !matches!(task, Task::Holds(..)) {
            return self.among(&known, smaller.task(task), all, some);
        }
        if let Some(condition) = Condition::new(&smaller.goal, known.pt()) {
            let holds = condition.holds(known.pt().initial.as_slice());
            return Finding { found: Found::Holds(holds, None, Evidence::None), states: 1 };
        }
        let Some(asked) = Reachability::new(&smaller.goal) else {
            return self.among(&known, smaller.task(task), all, some);
        };
        let Finding { found, states } = self.among(&known, Task::Reach(&asked.goal), all, some);
        let holds = |found: bool, run| Found::Holds(found == asked.expected, run, Evidence::None);
        let found = match found {
            Found::Path(stem) => holds(true, Some(Run { stem, rest: Rest::Any })),
            Found::Reached => holds(true, None),
            Found::Never(_) => holds(false, None),
            found => found,
        };
        Finding { found, states }
    }

    /// Asks those that suit, the cheapest first, until one finds enough.
    fn among(
        &mut self,
        net: &Known<'_>,
        task: Task<'_>,
        costs: Range<u32>,
        some: Enough<'_>,
    ) -> Finding {
        let mut left: Vec<&dyn Engine> =
            self.own.iter().chain(self.choice.engines()).copied().collect();
        let mut best = Finding::unsuited();
        loop {
            let knows = |it: &&dyn Engine| net.pt().is_plain() || it.knows_special();
            let bids = left.iter().enumerate().filter(|it| knows(it.1)).filter_map(|(at, it)| {
                let bid = it.suits(net, task, &self.budget)?;
                costs.contains(&bid.cost).then_some((at, bid))
            });
            let mut bids: Vec<(usize, Bid)> = bids.collect();
            bids.sort_by_key(|it| it.1.cost);
            let Some(&(at, bid)) = bids.first() else { return best };
            let engine = left.remove(at);
            let is_last = bids.len() == 1 && bid.cost >= Bid::LONG;
            let bid = if is_last { Bid::new(bid.cost, &self.budget) } else { bid };
            let mut found = self.ask(engine, net, task, bid);
            if let Found::SomeDead(dead) = &found.found {
                if some(dead) {
                    self.used(engine.name());
                    return found;
                }
                found = Finding::undecided(found.states);
            }
            best = better(best, found);
            if is_enough(task, &best) {
                return best;
            }
        }
    }

    fn ask(&mut self, engine: &dyn Engine, net: &Known<'_>, task: Task<'_>, bid: Bid) -> Finding {
        if bid.limits.is_over() {
            return Finding::stopped(Limit::Time, 0);
        }
        // Stored results take their part of the memory.
        let bytes = bid.limits.bytes.saturating_sub(self.net.bytes());
        let budget = self.budget.with(Limits { bytes, ..bid.limits });
        let found = engine.find(net, task, &budget);
        self.states = self.states.max(found.states);
        match found.found {
            Found::Nothing(Reason::Unsuited) | Found::SomeDead(_) => {}
            Found::Nothing(reason) => {
                if bid.cost >= Bid::STRUCTURE && !self.tried.contains(&engine.name()) {
                    self.tried.push(engine.name());
                }
                if reason == Reason::Limit(Limit::Unbounded) {
                    net.grows();
                }
            }
            _ => self.used(engine.name()),
        }
        found
    }

    /// Returns the finding of a smaller net for the whole one. Evidence about the smaller net is
    /// dropped: it would prove nothing without the reductions.
    fn lifted(&self, task: Task<'_>, smaller: &Smaller, found: Finding) -> Finding {
        let (pt, trail) = (self.net.pt(), &smaller.reduced.trail);
        let states = found.states;
        let found = match found.found {
            Found::Path(path) => smaller.path(pt, &path),
            Found::Never(_) => Found::Never(Evidence::None),
            Found::Most(most, path, _) => {
                Found::Most(most, path.and_then(|it| trail.lift(pt, &it).ok()), Evidence::None)
            }
            Found::Holds(holds, run, _) => {
                let run = run.and_then(|it| smaller.lifted(pt, it));
                Found::Holds(holds, run.or_else(|| self.shown_in_full(task, holds)), Evidence::None)
            }
            found => found,
        };
        Finding { found, states }
    }

    /// A run of the whole net for a verdict that was found on a smaller one, if that can have a run
    /// and the net is small.
    fn shown_in_full(&self, task: Task<'_>, holds: bool) -> Option<Run> {
        let Task::Holds(formula, _) = task else { return None };
        if !is_shown_by_a_run(formula, holds) {
            return None;
        }
        let few = Bid::few(Bid::ALL, &self.budget, SHOWN);
        let engine: &dyn Engine =
            if Runs.suits(self.net, task, &self.budget).is_some() { &Runs } else { &Branching };
        match engine.find(self.net, task, &self.budget.with(few.limits)).found {
            Found::Holds(again, run, _) if again == holds => run,
            _ => None,
        }
    }

    /// Whether some of the engines that are asked by choice look for single markings.
    pub(super) fn asks_for_ways(&self) -> bool {
        self.net.time().is_none() && matches!(self.choice, Choice::Auto | Choice::Stubborn)
    }

    pub(super) fn used(&mut self, technique: &'static str) {
        self.techniques.retain(|&it| it != technique);
        self.techniques.push(technique);
    }
}

/// Whether one run can show a verdict: one that exists, or a counterexample to what is said of all.
fn is_shown_by_a_run(formula: &Formula, holds: bool) -> bool {
    holds == matches!(formula, Formula::Exists(_))
}

/// Whether nobody else needs to be asked. Where a run may show a verdict and there is none, others
/// are: on a smaller net one run may suffice.
fn is_enough(task: Task<'_>, found: &Finding) -> bool {
    match (&found.found, task) {
        (Found::Nothing(_), _) => false,
        (Found::Holds(holds, None, _), Task::Holds(formula, assumed)) => {
            !assumed.is_empty() || !is_shown_by_a_run(formula, *holds)
        }
        _ => true,
    }
}

/// Returns the finding that says more; of two that say nothing, the later one that reached a limit.
fn better(before: Finding, after: Finding) -> Finding {
    let is_later = match (&before.found, &after.found) {
        (Found::Nothing(Reason::Limit(_)), Found::Nothing(reason)) => {
            matches!(reason, Reason::Limit(_) | Reason::Automaton)
        }
        (Found::Nothing(_), after) => !matches!(after, Found::Nothing(Reason::Unsuited)),
        (Found::Holds(_, run, _), Found::Holds(_, better, _)) => run.is_none() && better.is_some(),
        _ => false,
    };
    if is_later { after } else { before }
}
