//! Supervisors as typed Petri nets: defined once with [`net!`](crate::net!), checked while
//! compiling, played anywhere.
//!
//! A net is plain data ([`Net`]). A state machine is a net with one token. `net!` makes it and
//! checks its laws; a [`Player`](crate::player::Player) executes it. With the feature `alloc`, nets
//! are also made at run time (`owned`).
//!
//! ```text
//! net! { .. } -> Source -> Net -> Code (packed) -> Known (its laws hold)
//!                 names    ids     words           Player { marking, clocks } -> Outcome
//! ```

mod clauses;
pub(crate) mod data;
#[allow(clippy::large_types_passed_by_value, reason = "it lives while compiling")]
mod declarations;
pub(crate) mod defect;
#[allow(clippy::large_types_passed_by_value, reason = "it lives while compiling")]
mod guard;
#[allow(
    clippy::large_stack_arrays,
    clippy::large_types_passed_by_value,
    clippy::result_large_err,
    reason = "they live while compiling"
)]
mod laws;
#[allow(clippy::large_types_passed_by_value, reason = "it lives while compiling")]
mod lookup;
#[allow(clippy::large_types_passed_by_value, reason = "it lives while compiling")]
pub(crate) mod lower;
mod macros;
mod mistakes;
#[cfg(feature = "alloc")]
pub mod owned;
#[allow(clippy::large_types_passed_by_value, reason = "it lives while compiling")]
pub(crate) mod size;
pub(crate) mod source;
#[cfg(all(test, feature = "alloc"))]
mod tests;
pub(crate) mod text;
#[allow(clippy::large_types_passed_by_value, reason = "it lives while compiling")]
mod variant;

pub use data::{
    Arc, EventId, Ignored, Law, Net, OutputId, Place, PlaceId, Role, Signal, Transition,
    TransitionId, Within,
};
pub use defect::NetError;
pub use laws::{
    CLOCKS, Culprit, Graph, Known, Limit, MARKINGS, Step, Violation, Way, check, judge,
};
