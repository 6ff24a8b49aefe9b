//! The explicit engine: reachable markings one by one.
//!
//! | item | what it answers |
//! | --- | --- |
//! | [`statespace`] | how many markings are reachable, and what is counted of them |
//! | [`reach`] | whether a marking with a property is reachable, and a shortest path to one |
//! | [`Graph`] | the markings and the arcs between them, to be passed through again |
//! | [`Watching`] | how the graph of a net with watches follows from that of the net |
//! | [`Liveness`] | liveness and reversibility, from strongly connected components |
//!
//! Markings are packed into machine words by bounds that [`bounds`](crate::bounds::bounds) proves,
//! in widths that are tried out elsewhere. A search ends with all markings, or at one of its
//! [`Limits`]; that too is an answer. Answers are the same on any number of threads, but for limits
//! of memory and time.
//!
//! One level of the search on several threads:
//!
//! | from | in | what happens |
//! | --- | --- | --- |
//! | blocks of the level | `worker` | a thread takes its own first, then those of others |
//! | boxes | `boxes` | successors, sorted by table; a full box is emptied at once |
//! | tables | `table` | first the thread's share of them, from all boxes; then others' |
//! | blocks | `block` | new markings: the next level |
//!
//! ```
//! use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
//! use cotama_verification::explicit::{Limits, statespace};
//! use cotama_verification::pt::Pt;
//!
//! let mut lamp = OwnedNet::new("lamp", "A lamp.");
//! let off = lamp.place(OwnedPlace::new("off", 1)).unwrap();
//! let on = lamp.place(OwnedPlace::new("on", 0)).unwrap();
//! lamp.transition(OwnedTransition::new("press").take(off, 1).give(on, 1)).unwrap();
//! lamp.transition(OwnedTransition::new("release").take(on, 1).give(off, 1)).unwrap();
//! let lamp = Pt::from(&lamp.view().net());
//! let space = statespace(&lamp, &Limits::default(), 1, &|_| ());
//! assert_eq!((space.states, space.arcs, space.dead_markings, space.limit), (2, 2, 0, None));
//! ```

mod ahead;
mod bits;
mod block;
mod boxes;
mod cache_padded;
mod diamonds;
mod enabling;
mod engine;
mod explore;
mod figures;
mod goal;
mod graph;
mod growth;
mod implied;
mod index;
mod labels;
mod layout;
mod liveness;
mod look;
mod markings;
mod memory;
mod often;
mod packed;
mod packed_store;
mod plan;
mod pool;
#[cfg(kani)]
pub mod proofs;
mod reach;
mod reached;
mod restricted;
mod space;
mod sparse;
mod sparse_store;
mod statespace;
mod store;
mod table;
mod view;
mod watched;
mod watching;
mod wide;
mod worker;

pub use crate::components::Components;
pub use bits::BitSet;
pub use cotama_property::limits::{Limit, Limits};
pub use engine::{Explicit, Few, Stored};
pub(crate) use engine::{certified, evidence, reached};
pub use figures::StateSpace;
pub use goal::Goal;
pub use graph::Graph;
pub use growth::Growth;
pub(crate) use index::{Index, hash};
pub use liveness::Liveness;
pub(crate) use look::Look;
pub(crate) use markings::Markings;
pub(crate) use memory::Memory;
pub(crate) use reach::most;
pub use reach::reach;
pub use reached::Reached;
pub use statespace::statespace;
pub use watching::Watching;
pub(crate) use watching::{Of, Tokens, Watch};

/// A search that ended before its end.
///
/// ```
/// use cotama_models::nets::families::philosophers;
/// use cotama_verification::explicit::{Graph, Limit, Limits, Unfinished};
/// use cotama_verification::pt::Pt;
/// let net = philosophers(9).unwrap();
/// let limits = Limits { states: 1_000, ..Limits::default() };
/// let graph = Graph::new(&Pt::from(&net.view().net()), &limits, &|_| {});
/// assert!(matches!(graph, Err(Unfinished { limit: Limit::States, .. })));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unfinished {
    /// The limit that was reached.
    pub limit: Limit,
    /// Markings that it met.
    pub states: u64,
}

/// How far a search is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Markings so far.
    pub states: u64,
    /// Firings from the initial marking to the level that is worked on.
    pub depth: u64,
    /// Markings of this level.
    pub waiting: u64,
}
