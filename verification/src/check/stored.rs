//! Questions to the stored graph of a net: one exploration answers all of them.

use super::Choice;
use super::auto::{Asked, CERTIFIED};
use super::budget::Budget;
use super::clauses::clauses;
use super::engine::{Engine, Finding, Found, Task};
use super::engines::{Explicit, Temporal};
use super::known::Known;
use super::{Checker, Model, Options};
use crate::certificate::{Evidence, most_markings};
use crate::explicit::{Goal, Graph, Limits, Watching};
use crate::property::{Ctl, Formula};
use std::sync::Arc;

/// The most markings of a graph that is made because evidence asks for it.
const STORED: u64 = 2_000_000;

/// The same of a net with watches, where that of the net without is there: its markings are pairs
/// of numbers, and take little time.
const WATCHED: u64 = 20_000_000;

/// The most clauses that the structure is asked of where there is a graph.
const CLAUSES: usize = 8;

impl Checker<'_> {
    /// A checker of the same net with watches. Where evidence asks for graphs, that of the net with
    /// watches is made of that of the net without, so that what the net does is explored once.
    pub fn watched<'w>(
        &self,
        model: &'w Model,
        watching: Watching,
        options: &Options<'_>,
    ) -> Checker<'w> {
        let budget = Budget::from(options);
        let limits = Limits { states: budget.limits.states.min(STORED), ..budget.limits };
        let budget = Budget { limits, ..budget };
        if options.engine == Choice::Auto && options.evidence {
            let _ = self.known.graph(&budget);
        }
        let known = match self.known.made().filter(|_| options.engine == Choice::Auto) {
            Some(graph) => Known::watched(model.pt(), graph, watching),
            None => Known::new(model.pt()),
        };
        if known.is_watched() {
            let limits = Limits { states: options.limits.states.min(WATCHED), ..budget.limits };
            let _ = known.graph(&Budget { limits, ..budget });
        }
        Checker { model, known }
    }
}

impl Asked<'_, '_> {
    /// The graph of the whole net: if it is there already, or if evidence asks for it.
    pub(super) fn graph(&self) -> Option<Arc<Graph>> {
        let limits = self.budget.limits;
        if self.engine != Choice::Auto {
            return None;
        }
        if self.budget.evidence && self.net.made().is_none() {
            let limits = Limits { states: limits.states.min(STORED), ..limits };
            // One that is not kept would be made for each question anew.
            let _ = self.net.graph(&Budget { limits, ..self.budget });
        }
        self.net.made().filter(|it| it.states() as u64 <= limits.states)
    }

    /// Whether there is a graph, and more is asked than the structure shows in a moment. Of a net
    /// with watches the structure is not known yet.
    pub(super) fn is_seen_sooner(&self, goal: &Formula) -> bool {
        let many = || clauses(goal, self.net.pt()).is_none_or(|it| it.len() > CLAUSES);
        self.net.made().is_some() && (self.net.is_watched() || many())
    }

    /// What the graph says of a formula about runs, if there is one for it. Where a run may show
    /// the verdict and none was found, others are asked: on a smaller net one run may suffice.
    pub(super) fn on_graph(&mut self, formula: &Formula) -> Option<Finding> {
        let is_linear = Ctl::new(formula).is_none();
        if is_linear { self.net.made() } else { self.graph() }?;
        let found = self.ask(&Temporal, self.net, Task::Temporal(formula), self.budget.limits);
        let Found::Holds(holds, None, _) = found.found else { return Some(found) };
        (holds != matches!(formula, Formula::Exists(_))).then_some(found)
    }

    /// Looks for a marking in the graph.
    pub(super) fn reach_in(&mut self, graph: &Graph, goal: &Formula) -> Finding {
        let states = graph.states() as u64;
        self.met(Explicit.name(), states);
        let found = match Goal::new(goal).and_then(|it| graph.first(it)) {
            Some(state) => Found::Way(graph.way(state)),
            None => Found::Never(self.shown_by(graph)),
        };
        Finding { found, states }
    }

    /// The graph as evidence, if it is small enough for the small checker.
    pub(super) fn shown_by(&self, graph: &Graph) -> Evidence {
        let few = CERTIFIED.min(most_markings(self.net.pt().places.len()));
        if graph.states() as u64 <= few { Evidence::graph(graph) } else { Evidence::None }
    }
}
