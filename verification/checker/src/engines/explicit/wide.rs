//! Searches through the markings of nets that are too wide to be packed: breadth first, on one
//! thread.

use super::figures::StateSpace;
use super::goal::Goal;
use super::look::Look;
use super::memory::Memory;
use super::reached::Reached;
use super::sparse::{Cursor, Sparse};
use super::{Limit, Limits, Progress, Unfinished};
use cotama_core::net::TransitionId;
use cotama_property::pt::Pt;

/// Firings between two looks at the clock.
const TICK: u64 = 256;

/// Markings as they are met.
struct Search<'s> {
    limits: &'s Limits,
    memory: Memory,
    markings: Sparse,
    cursor: Cursor,
    /// For each marking that from which it was met first, and by which transition.
    from: Vec<(u32, u32)>,
    depth: u64,
}

/// A visitor of markings.
trait Visitor {
    /// Looks at a marking; `true` ends the search.
    fn look(&mut self, look: &Look<'_>) -> bool;

    /// An arc leads from the marking that was looked at to one of this number.
    fn arc(&mut self, _: u32, _: &mut Memory) -> Result<(), Limit> {
        Ok(())
    }
}

impl<'s> Search<'s> {
    fn new(pt: &Pt, limits: &'s Limits) -> Result<Self, Limit> {
        let mut memory = Memory::new(limits.bytes);
        let (markings, cursor) = Sparse::new(pt, &mut memory)?;
        Ok(Self { limits, memory, markings, cursor, from: vec![(0, 0)], depth: 0 })
    }

    /// Passes through the markings; the one that ends it.
    fn run(
        &mut self,
        visitor: &mut impl Visitor,
        progress: &dyn Fn(Progress),
    ) -> Result<Option<u32>, Limit> {
        let (mut marking, mut level, mut fired) = (0, 1, 0_u64);
        let mut enabled = Vec::new();
        while marking < self.markings.len() {
            let look = self.markings.look(&mut self.cursor, marking as u32);
            if visitor.look(&look) {
                return Ok(Some(marking as u32));
            }
            enabled.clear();
            enabled.extend(look.transitions());
            for &transition in &enabled {
                if fired.is_multiple_of(TICK) && self.limits.is_over() {
                    return Err(Limit::Time);
                }
                fired += 1;
                let (from, memory) = (marking as u32, &mut self.memory);
                let after = self.markings.fire(from, transition, self.limits, memory)?;
                if after as usize == self.from.len() {
                    memory.room(&mut self.from, 1)?;
                    self.from.push((from, transition));
                }
                visitor.arc(after, memory)?;
            }
            marking += 1;
            if marking == level {
                let states = self.markings.len() as u64;
                progress(Progress { states, depth: self.depth, waiting: states - marking as u64 });
                if self.markings.len() > level {
                    self.depth += 1;
                }
                level = self.markings.len();
            }
        }
        Ok(None)
    }

    fn path(&self, mut marking: u32) -> Vec<TransitionId> {
        let mut path = Vec::new();
        while marking != 0 {
            let (from, transition) = self.from[marking as usize];
            path.push(TransitionId(transition));
            marking = from;
        }
        path.reverse();
        path
    }
}

/// Looks for a goal.
struct Find<'g>(Goal<'g>);

impl Visitor for Find<'_> {
    fn look(&mut self, look: &Look<'_>) -> bool {
        self.0.holds(look)
    }
}

pub(super) fn reach(
    pt: &Pt,
    goal: Goal<'_>,
    limits: &Limits,
    progress: &dyn Fn(Progress),
) -> Result<Reached, Limit> {
    let mut search = Search::new(pt, limits)?;
    let found = search.run(&mut Find(goal), progress);
    let states = search.markings.len() as u64;
    Ok(match found {
        Ok(Some(marking)) => Reached::Trace { transitions: search.path(marking), states },
        Ok(None) => Reached::Never { states },
        Err(limit) => Reached::Unknown { limit, states },
    })
}

/// Counts.
#[derive(Default)]
struct Count {
    arcs: u64,
    dead: u64,
    sum: u64,
    enabled: Vec<u64>,
}

impl Visitor for Count {
    fn look(&mut self, look: &Look<'_>) -> bool {
        let mut count = 0;
        for (ever, now) in self.enabled.iter_mut().zip(&*look.view.enabled) {
            *ever |= now;
            count += u64::from(now.count_ones());
        }
        self.arcs += count;
        self.dead += u64::from(count == 0);
        self.sum = self.sum.max(look.view.sum);
        false
    }
}

/// Returns the figures of the state space; those of an incomplete search cover the markings that
/// were met.
pub(super) fn statespace(
    pt: &Pt,
    limits: &Limits,
    progress: &dyn Fn(Progress),
) -> Result<StateSpace, Limit> {
    let mut search = Search::new(pt, limits)?;
    let mut count =
        Count { enabled: vec![0; pt.transitions.len().div_ceil(64)], ..Count::default() };
    let limit = search.run(&mut count, progress).err();
    let markings = &search.markings;
    let mut bounds: Vec<u64> = pt.initial.iter().map(|&it| it.into()).collect();
    for (place, tokens) in (0..markings.len() as u32).flat_map(|it| markings.changes(it)) {
        let most = &mut bounds[place as usize];
        *most = (*most).max(tokens.into());
    }
    let dead = (0..pt.transitions.len() as u32)
        .filter(|it| count.enabled[*it as usize / 64] >> (it % 64) & 1 == 0);
    let bytes = search.memory.used();
    Ok(StateSpace {
        states: markings.len() as u64,
        arcs: count.arcs,
        max_place: bounds.iter().copied().max().unwrap_or(0),
        max_sum: count.sum,
        bounds,
        dead_markings: count.dead,
        dead_transitions: dead.map(TransitionId).collect(),
        depth: search.depth,
        limit,
        bounded: None,
        growth: None,
        bytes,
        peak: bytes,
    })
}

/// The arcs of a graph as they are met.
#[derive(Default)]
pub(super) struct Arcs {
    pub(super) starts: Vec<usize>,
    pub(super) successors: Vec<u32>,
    pub(super) fired: Vec<u64>,
}

impl Visitor for Arcs {
    fn look(&mut self, look: &Look<'_>) -> bool {
        self.fired.iter_mut().zip(&*look.view.enabled).for_each(|(ever, now)| *ever |= now);
        self.starts.push(self.successors.len());
        false
    }

    fn arc(&mut self, to: u32, memory: &mut Memory) -> Result<(), Limit> {
        memory.room(&mut self.successors, 1)?;
        self.successors.push(to);
        Ok(())
    }
}

/// All markings with their arcs.
pub(super) fn graph(
    pt: &Pt,
    limits: &Limits,
    progress: &dyn Fn(Progress),
) -> Result<(Sparse, Cursor, Arcs), Unfinished> {
    let mut search = Search::new(pt, limits).map_err(|limit| Unfinished { limit, states: 0 })?;
    let mut arcs = Arcs { fired: vec![0; pt.transitions.len().div_ceil(64)], ..Arcs::default() };
    let ended = search.run(&mut arcs, progress);
    let states = search.markings.len() as u64;
    ended.map_err(|limit| Unfinished { limit, states })?;
    arcs.starts.push(arcs.successors.len());
    Ok((search.markings, search.cursor, arcs))
}
