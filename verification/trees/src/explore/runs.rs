//! Runs through the graph: shortest ones, as steps that a machine repeats.

use super::Space;
use super::graph::{End, What};
use crate::machine::{Event, Reply};

/// One tick of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// Replies, in the order of the questions.
    pub replies: Vec<Reply>,
    /// Everything that happened.
    pub events: Vec<Event>,
    /// How the tick ended the run; `None` where the root answers RUNNING.
    pub end: Option<End>,
    /// Whether the tick is over: the last one may stop at a question.
    pub whole: bool,
}

/// Ticks from a fresh tree on.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Run {
    /// Ticks in their order.
    pub steps: Vec<Step>,
    /// The step from which on the run repeats for ever, if it does.
    pub again_from: Option<usize>,
    /// Time between two ticks in ms, where timers count.
    pub period: Option<u32>,
}

impl Space<'_> {
    /// Returns a run with the fewest ticks that ends with an edge.
    pub(crate) fn run_to(&self, node: usize, edge: usize) -> Run {
        let mut path = vec![edge];
        let mut at = node;
        while let Some((before, edge)) = self.via(at) {
            path.push(edge);
            at = before;
        }
        path.reverse();
        self.run_along(&path)
    }

    /// Returns a run with the fewest ticks to a point.
    pub(crate) fn run_at(&self, point: usize) -> Run {
        match self.via(point) {
            Some((node, edge)) => self.run_to(node, edge),
            None => self.run_along(&[]),
        }
    }

    /// Returns the run along edges, the first of which begins at a state.
    pub(crate) fn run_along(&self, path: &[usize]) -> Run {
        let mut run = Run { period: self.assumptions.period, ..Run::default() };
        let mut step: Option<Step> = None;
        for &edge in path {
            let it = step.get_or_insert_with(|| Step {
                replies: Vec::new(),
                events: Vec::new(),
                end: None,
                whole: false,
            });
            it.replies.extend(self.edges[edge].reply());
            it.events.extend(self.events(edge));
            match self.what(self.edges[edge].target as usize) {
                What::Asks(_) => continue,
                What::State => it.whole = true,
                What::End(end) => {
                    it.whole = true;
                    it.end = Some(end);
                }
            }
            run.steps.extend(step.take());
        }
        run.steps.extend(step);
        run
    }
}
