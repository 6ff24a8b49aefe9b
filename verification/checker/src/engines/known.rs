//! A net with what was found of it.

use super::budget::Budget;
use crate::explicit::{Graph, Limit, Limits, StateSpace, Unfinished, Watching, statespace};
use crate::structural::Structure;
use crate::temporal::Successors;
use crate::tpn::{self, ClassGraph, Classes, TimeNet};
use cotama_property::pt::Pt;
use std::cell::{Cell, OnceCell, RefCell, RefMut};
use std::rc::Rc;
use std::sync::Arc;

/// The most markings of a graph that is made because evidence asks for it.
pub(crate) const STORED: u64 = 2_000_000;

/// Largest part of the memory limit that a kept graph takes: one in so many.
const KEPT: u64 = 4;

/// A graph, or why there is none.
pub type Made = Result<Arc<Graph>, Unfinished>;

/// A net, and what engines found of it, kept for the next question.
#[derive(Debug)]
pub struct Known<'n> {
    pt: &'n Pt,
    time: Option<&'n TimeNet>,
    /// Whether it is what is asked about, and not a smaller net in its place.
    is_whole: bool,
    is_unbounded: Cell<bool>,
    structure: RefCell<Option<Structure<'n>>>,
    graph: RefCell<Option<(Limits, Made)>>,
    space: RefCell<Option<(Limits, Rc<StateSpace>)>>,
    classes: OnceCell<Rc<Classes>>,
    atomic: OnceCell<Rc<ClassGraph>>,
    /// For a net with watches: the graph of the net without, and how it follows from it.
    watched: Option<(Arc<Graph>, Watching)>,
}

impl<'n> Known<'n> {
    /// Nothing is known yet.
    pub fn new(pt: &'n Pt) -> Self {
        Self {
            pt,
            time: None,
            is_whole: true,
            is_unbounded: Cell::new(false),
            structure: RefCell::new(None),
            graph: RefCell::new(None),
            space: RefCell::new(None),
            classes: OnceCell::new(),
            atomic: OnceCell::new(),
            watched: None,
        }
    }

    /// Makes the knowledge of a net with watches from the graph of the net without.
    pub(crate) fn watched(pt: &'n Pt, graph: Arc<Graph>, watching: Watching) -> Self {
        Self { watched: Some((graph, watching)), ..Self::new(pt) }
    }

    /// Whether its graph follows from another one.
    pub(crate) fn is_watched(&self) -> bool {
        self.watched.is_some()
    }

    /// The same of a net whose transitions fire within intervals.
    pub(crate) fn timed(pt: &'n Pt, net: &'n TimeNet) -> Self {
        Self { time: Some(net), ..Self::new(pt) }
    }

    /// The same of a smaller net in the place of another one.
    pub(crate) fn reduced(pt: &'n Pt) -> Self {
        Self { is_whole: false, ..Self::new(pt) }
    }

    /// The net, without time.
    pub fn pt(&self) -> &'n Pt {
        self.pt
    }

    /// The net with its intervals of time, if it has some.
    pub fn time(&self) -> Option<&'n TimeNet> {
        self.time
    }

    /// Whether it is the net that is asked about, and not a smaller one in its place.
    pub fn is_whole(&self) -> bool {
        self.is_whole
    }

    /// Whether an engine found that it has infinitely many markings.
    pub fn is_unbounded(&self) -> bool {
        self.is_unbounded.get()
    }

    /// Records that the net has infinitely many markings.
    pub(crate) fn grows(&self) {
        self.is_unbounded.set(true);
    }

    /// About how many bytes the net and what is known of its structure take: in the forms in which
    /// it was read, and in which it is checked.
    pub(crate) fn bytes(&self) -> u64 {
        let kept = self.structure.try_borrow().is_ok_and(|it| it.is_some());
        self.size() + if kept { self.size() / 2 } else { 0 }
    }

    /// About how many bytes the net takes; and its structure takes as many while it is made.
    fn size(&self) -> u64 {
        let nodes = (self.pt.places.len() + self.pt.transitions.len()) as u64;
        300 * nodes + 60 * self.pt.arcs as u64
    }

    /// Returns the structure of the net, within this budget; `None` where the budget is too small.
    pub fn structure(&self, budget: &Budget<'_>) -> Option<RefMut<'_, Structure<'n>>> {
        let mut kept = self.structure.borrow_mut();
        let known = kept.take().and_then(|it| it.within(&budget.limits));
        if known.is_none() && (self.size() > budget.limits.bytes || budget.limits.is_over()) {
            return None;
        }
        *kept = Some(known.unwrap_or_else(|| Structure::new(self.pt, &budget.limits)));
        RefMut::filter_map(kept, Option::as_mut).ok()
    }

    /// The graph of its markings.
    ///
    /// # Errors
    /// The limit that keeps it from being made.
    pub fn graph(&self, budget: &Budget<'_>) -> Made {
        let mut kept = self.graph.borrow_mut();
        match &*kept {
            Some((_, Ok(graph))) => {
                let (states, limit) = (graph.states() as u64, Limit::States);
                let most = budget.limits.states;
                return if states <= most {
                    Ok(Arc::clone(graph))
                } else {
                    Err(Unfinished { limit, states: most })
                };
            }
            Some((limits, Err(it))) if !budget.has_more(limits, it.limit) => return Err(*it),
            _ => {}
        }
        let (limits, progress) = (&budget.limits, budget.progress);
        let watched = self.watched.as_ref().and_then(|(graph, watching)| {
            Graph::watched(graph, (self.pt, watching), limits, progress)
        });
        let alone = || Graph::on(self.pt, limits, budget.jobs, progress);
        let graph = watched.unwrap_or_else(alone).map(Arc::new);
        // A kept graph takes room that the next engine may need.
        let is_small = |it: &Arc<Graph>| it.bytes() <= budget.limits.bytes / KEPT;
        if graph.as_ref().map_or(true, is_small) {
            *kept = Some((budget.limits, graph.clone()));
        }
        graph
    }

    /// The graph of its markings if it is there already.
    pub fn made(&self) -> Option<Arc<Graph>> {
        match &*self.graph.borrow() {
            Some((_, Ok(graph))) => Some(Arc::clone(graph)),
            _ => None,
        }
    }

    /// The linear state classes of the net with its intervals, or why they are not all known and
    /// how many were met.
    pub(crate) fn classes(
        &self,
        net: &TimeNet,
        limits: &Limits,
    ) -> Result<Rc<Classes>, (Limit, usize)> {
        if let Some(classes) = self.classes.get().filter(|it| it.classes() as u64 <= limits.states)
        {
            return Ok(Rc::clone(classes));
        }
        let classes = Rc::new(tpn::classes(net, limits));
        match classes.stopped() {
            None => Ok(Rc::clone(self.classes.get_or_init(|| classes))),
            Some(stop) => Err((stop, classes.classes())),
        }
    }

    /// The atomic ones.
    pub(crate) fn atomic(
        &self,
        net: &TimeNet,
        limits: &Limits,
    ) -> Result<Rc<ClassGraph>, (Limit, usize)> {
        if let Some(classes) = self.atomic.get().filter(|it| it.states() as u64 <= limits.states) {
            return Ok(Rc::clone(classes));
        }
        // The atomic classes have no end if the linear ones have none.
        self.classes(net, limits)?;
        let classes = Rc::new(tpn::atomic(net, limits)?);
        Ok(Rc::clone(self.atomic.get_or_init(|| classes)))
    }

    /// Returns the figures of its state space.
    pub fn space(&self, budget: &Budget<'_>) -> Rc<StateSpace> {
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
