//! Temporal logic: formulas of CTL on a stored graph, formulas of LTL while the markings are met.
//!
//! | item | what it answers |
//! | --- | --- |
//! | [`answer`] | any formula of CTL or LTL, by the engine that suits it |
//! | [`ctl`] | where a formula of CTL holds, on all or on fair runs, with a run as evidence |
//! | [`all_runs`], [`some_runs`] | formulas of LTL, with a lasso as evidence |
//!
//! Runs are maximal: they go on for ever, or end in a deadlock, whose marking lasts.

mod answer;
mod automaton;
mod bit_sets;
mod ctl;
mod emptiness;
mod engine;
mod fairness;
mod labelling;
mod ltl;
mod product;
mod source;
mod state_sets;
mod stop;
mod successors;
mod verdict;
mod witness;

pub use answer::answer;
pub(crate) use answer::branching;
pub use bit_sets::BitSets;
pub use cotama_property::run::{Rest, Run};
pub use ctl::{CtlAnswer, ctl};
pub use engine::{Branching, Runs, StoredBranching};
pub(crate) use engine::{of_runs, verdict};
pub use fairness::Fairness;
pub use labelling::Labelling;
pub(crate) use ltl::stored_runs;
pub use ltl::{all_runs, some_runs};
pub use state_sets::StateSets;
pub use successors::Successors;
pub use verdict::{Reason, Verdict};
pub use witness::Witness;
