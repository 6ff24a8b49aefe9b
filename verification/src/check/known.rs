//! A net with what was found of it.

use super::Budget;
use crate::explicit::{Graph, Limit, Limits, StateSpace, Unfinished, statespace};
use crate::pt::Pt;
use crate::structural::{self, Structure};
use std::cell::{OnceCell, RefCell, RefMut};
use std::rc::Rc;

/// A net, and what engines found of it, kept for the next question.
#[derive(Debug)]
pub struct Known<'n> {
    pt: &'n Pt,
    structure: OnceCell<RefCell<Structure<'n>>>,
    graph: RefCell<Option<(Limits, Result<Graph, Unfinished>)>>,
    space: RefCell<Option<(Limits, Rc<StateSpace>)>>,
}

impl<'n> Known<'n> {
    /// Nothing is known yet.
    pub fn new(pt: &'n Pt) -> Self {
        Self { pt, structure: OnceCell::new(), graph: RefCell::new(None), space: RefCell::new(None) }
    }

    /// The net.
    pub fn pt(&self) -> &'n Pt {
        self.pt
    }

    /// What its structure says.
    pub(super) fn structure(&self) -> RefMut<'_, Structure<'n>> {
        let made = || RefCell::new(Structure::new(self.pt, structural::Limits::default()));
        self.structure.get_or_init(made).borrow_mut()
    }

    /// Does something with the graph of its markings, or with the limit that keeps it from being made.
    pub(super) fn with_graph<R>(
        &self,
        budget: &Budget<'_>,
        with: impl FnOnce(Result<&Graph, Unfinished>) -> R,
    ) -> R {
        let mut kept = self.graph.borrow_mut();
        let is_cut =
            |limits: &Limits, limit: Option<Limit>| limit.is_some_and(|it| budget.has_more(limits, it));
        if kept.as_ref().is_none_or(|(limits, graph)| is_cut(limits, graph.as_ref().err().map(|it| it.limit)))
        {
            *kept = Some((budget.limits, Graph::new(self.pt, &budget.limits, budget.progress)));
        }
        let graph = kept.as_ref().map(|it| it.1.as_ref().map_err(|&it| it));
        with(graph.unwrap_or(Err(Unfinished { limit: Limit::Bytes, states: 0 })))
    }

    /// What is counted of its markings.
    pub(super) fn space(&self, budget: &Budget<'_>) -> Rc<StateSpace> {
        let mut kept = self.space.borrow_mut();
        if let Some((limits, space)) = &*kept
            && !space.limit.is_some_and(|it| budget.has_more(limits, it))
        {
            return Rc::clone(space);
        }
        let space = Rc::new(statespace(self.pt, &budget.limits, budget.jobs, budget.progress));
        *kept = Some((budget.limits, Rc::clone(&space)));
        space
    }
}
