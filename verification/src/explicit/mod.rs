//! The explicit engine: reachable markings one by one.
//!
//! | item | what it answers |
//! | --- | --- |
//! | [`statespace`] | how many markings are reachable, and what is counted of them |
//! | [`reach`] | whether a marking with a property is reachable, and a shortest way to one |
//! | [`Graph`] | the markings and the arcs between them, to be passed through again |
//! | [`Liveness`] | liveness and reversibility, from strongly connected components |
//!
//! Markings are packed into machine words by bounds that [`bounds`](crate::bounds::bounds) proves,
//! in widths that are tried out elsewhere. A search ends with all markings, or at one of its
//! [`Limits`]; that too is an answer. Answers are the same on any number of threads, but for limits
//! of memory and time.
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

mod apart;
mod bits;
mod block;
mod boxes;
mod crew;
mod diamonds;
mod enabling;
mod engine;
mod explore;
mod goal;
mod graph;
mod growth;
mod implied;
mod kept;
mod layout;
mod liveness;
mod markings;
mod often;
mod plan;
mod reach;
mod space;
mod sparse;
mod statespace;
mod table;
mod view;
mod wide;
mod worker;

pub use bits::BitSet;
pub use engine::{Explicit, Few, Stored};
pub(crate) use engine::{certified, evidence, reached};
pub use goal::Goal;
pub use graph::Graph;
pub use growth::Growth;
pub use liveness::{Components, Liveness};
pub(crate) use markings::{Index, Look, Markings, Memory, hash};
pub(crate) use reach::most;
pub use reach::{Reached, reach};
pub use statespace::{StateSpace, statespace};

use std::time::Instant;

/// How much a search may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// The most markings. A level of the search that does not fit as a whole is not counted at all.
    pub states: u64,
    /// The most bytes for markings, tables and arcs, before they are taken.
    pub bytes: u64,
    /// When to stop.
    pub deadline: Option<Instant>,
}

impl Limits {
    /// Whether the time is over.
    pub fn is_over(&self) -> bool {
        self.deadline.is_some_and(|it| Instant::now() >= it)
    }
}

impl Default for Limits {
    /// No limit on markings and time, 4 GiB.
    fn default() -> Self {
        Self { states: u64::MAX, bytes: 4 << 30, deadline: None }
    }
}

/// Why a search ended before its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// More markings than [`Limits::states`].
    States,
    /// More memory than [`Limits::bytes`].
    Bytes,
    /// [`Limits::deadline`] has passed.
    Time,
    /// A place with more than 4,294,967,295 tokens.
    Tokens,
    /// A marking that no longer fits in 128 words, as places hold more than it seemed. Nets of
    /// which no marking fits are searched too.
    Words,
    /// The net is unbounded: it has no end.
    Unbounded,
}

impl Limit {
    const ALL: [Self; 6] =
        [Self::States, Self::Bytes, Self::Time, Self::Tokens, Self::Words, Self::Unbounded];

    fn code(self) -> u8 {
        1 + self as u8
    }

    fn of(code: u8) -> Option<Self> {
        Self::ALL.get(usize::from(code).checked_sub(1)?).copied()
    }
}

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
    /// Why.
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
