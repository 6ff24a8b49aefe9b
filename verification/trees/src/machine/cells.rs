//! Cells of a machine: small numbers, each with the bits that it takes.

use super::Machine;
use crate::tree::{Kind, Number, Queue, Tree};
use std::ops::Range;

/// Which cells a tree has.
#[derive(Clone, Debug)]
pub(crate) struct Layout {
    /// Bits of each cell: statuses first, then memories.
    pub(crate) widths: Vec<u8>,
    /// First cell of each node's memory.
    pub(crate) start: Vec<usize>,
    /// Cells that a node has within a tick alone.
    pub(crate) transient: Vec<(usize, usize)>,
    /// Cells of its memory that halting clears, from its first.
    pub(crate) halting: Vec<Range<usize>>,
    /// Whether anything goes off between ticks.
    pub(crate) has_timers: bool,
}

/// Returns the bits of numbers up to the largest.
pub(crate) fn bits(largest: usize) -> u8 {
    (usize::BITS - largest.leading_zeros()) as u8
}

/// Returns the bits of a counter with this limit.
fn counter(limit: &Number) -> u8 {
    match limit {
        Number::Is(it) => bits((*it).max(0) as usize),
        Number::Entry(_) => 32,
    }
}

/// Returns the cells for a limit that is read once a tick.
fn kept(limit: &Number) -> u8 {
    match limit {
        Number::Is(_) => 0,
        Number::Entry(_) => 32,
    }
}

/// Cells of one node: memory, cells of a tick, and the part of the memory that halting clears.
type Cells = (Vec<u8>, Vec<u8>, Range<usize>);

fn cells(kind: &Kind, children: usize) -> Cells {
    let place = bits(children);
    match kind {
        Kind::Sequence { yields } | Kind::Fallback { yields } => {
            (vec![place, bits(children + 1)], vec![1; *yields as usize], 0..2)
        }
        Kind::SequenceWithMemory => (vec![place, bits(children + 1)], vec![1], 0..0),
        Kind::ReactiveSequence | Kind::ReactiveFallback | Kind::NonblockingSequence => {
            (Vec::new(), vec![1], 0..0)
        }
        Kind::Parallel { success, failure } => {
            let mut memory = vec![1; children];
            memory.extend([place, place]);
            (memory, vec![place, kept(success), kept(failure)], 0..children + 2)
        }
        Kind::ParallelAll { failures } => {
            let mut memory = vec![1; children];
            memory.push(place);
            (memory, vec![place, kept(failures)], 0..children + 1)
        }
        Kind::IfThenElse => (vec![2], Vec::new(), 0..1),
        Kind::Switch { .. } => (vec![place], Vec::new(), 0..1),
        Kind::TryCatch { .. } => (vec![place, place, 1], Vec::new(), 0..3),
        Kind::PipelineSequence => (vec![place], vec![place], 0..1),
        Kind::RecoveryNode { retries } => {
            let most = match retries {
                Number::Is(it) => bits((*it).max(0) as usize + 1),
                Number::Entry(_) => 32,
            };
            (vec![1, most], vec![kept(retries)], 0..2)
        }
        Kind::RoundRobin { .. } => (vec![place, place], vec![place], 0..2),
        Kind::Repeat { cycles: limit } | Kind::RetryUntilSuccessful { attempts: limit } => {
            (vec![counter(limit)], vec![1, kept(limit)], 0..1)
        }
        // Started, armed, elapsed or child halted.
        Kind::Delay { .. } | Kind::Timeout { .. } => (vec![1, 1, 1], Vec::new(), 0..2),
        Kind::Sleep { .. } => (vec![1, 1], Vec::new(), 0..0),
        Kind::RunOnce { .. } => (vec![2], Vec::new(), 0..0),
        Kind::SkipUnlessUpdated { .. } | Kind::WaitValueUpdate { .. } => {
            (vec![1, 1], Vec::new(), 1..2)
        }
        Kind::Loop { queue: Queue::Items(items), .. } => {
            (vec![bits(items.len()), 1], Vec::new(), 0..0)
        }
        // Number of the text that is left, child runs.
        Kind::Loop { queue: Queue::Entry(..), .. } => (vec![32, 1], Vec::new(), 0..0),
        Kind::ManualSelector { .. } => (vec![place, bits(children + 3)], Vec::new(), 0..1),
        Kind::PauseResumeController => (vec![2], vec![1], 0..1),
        Kind::Precondition { .. }
        | Kind::Gate(_)
        | Kind::PathLongerOnApproach
        | Kind::SingleTrigger
        | Kind::WasEntryUpdated { .. } => (vec![1], Vec::new(), 0..0),
        Kind::Leaf(kind) => {
            use crate::kinds::LeafKind::{FirstFailure, FirstSuccess};
            let has = matches!(kind, FirstSuccess | FirstFailure);
            (vec![1; has as usize], Vec::new(), 0..0)
        }
        _ => (Vec::new(), Vec::new(), 0..0),
    }
}

impl Layout {
    pub(crate) fn of(tree: &Tree) -> Layout {
        let mut it = Layout {
            widths: vec![2; tree.nodes.len()],
            start: Vec::new(),
            transient: Vec::new(),
            halting: Vec::new(),
            has_timers: tree.nodes.iter().any(|it| {
                matches!(it.kind, Kind::Delay { .. } | Kind::Timeout { .. } | Kind::Sleep { .. })
            }),
        };
        for node in &tree.nodes {
            let (memory, transient, halting) = cells(&node.kind, node.children.len());
            it.start.push(it.widths.len());
            it.widths.extend(memory);
            let from = it.widths.len();
            it.widths.extend(transient);
            it.transient.push((from, it.widths.len()));
            it.halting.push(halting);
        }
        it
    }
}

impl Machine<'_> {
    /// Returns the n-th cell of a node's memory and of what it keeps within a tick.
    #[inline]
    pub(crate) fn get(&self, node: usize, cell: usize) -> u32 {
        self.cells[self.layout.start[node] + cell]
    }

    #[inline]
    pub(crate) fn set(&mut self, node: usize, cell: usize, value: u32) {
        let at = self.layout.start[node] + cell;
        debug_assert!(
            u64::from(value) < 1 << self.layout.widths[at],
            "{value} in a cell of {} bits of {}",
            self.layout.widths[at],
            self.tree.shown(node)
        );
        self.cells[at] = value;
    }
}
