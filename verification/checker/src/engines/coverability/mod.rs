//! Nets with infinitely many markings: boundedness, coverability, and everything else that is
//! preserved by more tokens.
//!
//! | item | what it answers |
//! | --- | --- |
//! | [`bounded`] | whether the markings are finitely many; else a sequence that repeats for ever |
//! | [`coverable`], [`reaches`] | whether so many tokens or more can be there, and a way |
//! | [`CoverabilitySet`] | the maximal markings: bounds of places and of sums, dead transitions |
//!
//! Markings are passed through as in the tree of Karp and Miller (R. M. Karp, R. E. Miller,
//! Parallel program schemata, J. Computer and System Sciences 3, 1969): when a marking is greater
//! than one that leads to it, the sequence between them can be repeated, and ω stands in the places
//! that grow. Only the maximal ω-markings met so far are worked on (A. Valmari, H. Hansen, Old and
//! new algorithms for minimal coverability sets, Fundamenta Informaticae 131, 2014), and a sequence
//! that was once repeated is tried again on every later marking (A. Finkel, S. Haddad, I.
//! Khmelnitsky, Minimal coverability tree construction made complete and efficient, Foundations of
//! Software Science and Computation Structures, 2020). Nodes are never taken back: a marking is
//! left out only when a greater one is there. So what the maximal markings cover never shrinks, and
//! the flaw of the minimal coverability tree of 1993 (A. Finkel, G. Geeraerts, J.-F. Raskin, L. Van
//! Begin, A counter-example to the minimal coverability tree algorithm, Université libre de
//! Bruxelles, TR 535, 2005) cannot occur.
//!
//! ```
//! use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
//! use cotama_core::net::{PlaceId, TransitionId};
//! use cotama_verification::coverability::{Bounded, CoverabilitySet, Limits, bounded};
//! use cotama_verification::pt::Pt;
//!
//! let mut net = OwnedNet::new("counter", "A lamp that counts.");
//! let off = net.place(OwnedPlace::new("off", 1)).unwrap();
//! let on = net.place(OwnedPlace::new("on", 0)).unwrap();
//! let count = net.place(OwnedPlace::new("count", 0)).unwrap();
//! net.transition(OwnedTransition::new("press").take(off, 1).give(on, 1).give(count, 1)).unwrap();
//! net.transition(OwnedTransition::new("release").take(on, 1).give(off, 1)).unwrap();
//! let net = Pt::from(&net.view().net());
//!
//! let Bounded::No(growth) = bounded(&net, &Limits::default()) else { panic!("it counts on") };
//! assert_eq!(growth.stem.firings, Some(vec![]));
//! assert_eq!(growth.pump.firings, Some(vec![TransitionId(0), TransitionId(1)]));
//! assert_eq!(growth.grows, [(count, 1)]);
//!
//! let set = CoverabilitySet::new(&net, &Limits::default()).unwrap();
//! assert_eq!(format!("{:?}", set.markings().collect::<Vec<_>>()), "[[0, 1, ω], [1, 0, ω]]");
//! assert_eq!((set.bound(&[off, on]), set.bound(&[on, count])), (Some(1), None));
//! let way = set.covers(&[(on, 1), (count, 3)]).unwrap();
//! assert_eq!(way.length, 5);
//! ```

mod antichain;
mod engine;
mod growth;
mod question;
mod search;
mod set;
mod tokens;
mod word;

pub use cotama_property::limits::{Limit, Limits};
pub(crate) use engine::growth;
pub use engine::{Coverability, FewOmegas};
pub use growth::{Bounded, bounded};
pub use question::{Coverable, coverable, is_upward_closed, reaches};
pub use set::CoverabilitySet;
pub use tokens::Tokens;
pub use word::{Growth, Sequence};

use std::fmt;

/// The most firings of a sequence that is written out.
pub const FIRINGS: u64 = 1_000_000;

/// A search that did not come to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unfinished {
    /// The limit that was reached.
    pub limit: Limit,
    /// ω-markings met until then.
    pub nodes: u64,
}

impl Unfinished {
    /// The search of a net that [is not plain](cotama_property::pt::Pt::is_plain).
    pub(super) const UNSUITED: Self = Self { limit: Limit::Work, nodes: 0 };
}

impl fmt::Display for Unfinished {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { limit, nodes } = self;
        let limit = match limit {
            Limit::States => "the limit of markings",
            Limit::Bytes => "the limit of memory",
            Limit::Time => "the limit of time",
            _ => "a number of more than 63 bits",
        };
        write!(f, "ended by {limit} after {nodes} markings")
    }
}

impl std::error::Error for Unfinished {}
