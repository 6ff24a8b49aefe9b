//! Several supervisors that work together.
//!
//! A [`System`] is plain data: nets in the order of their turns, links from outputs to events,
//! mailboxes, shared places. The same value is run, by a [`Player`](crate::player::Player), and
//! checked. [`system!`](crate::system!) makes one while compiling. A net alone is a system of one
//! component.

mod clauses;
pub(crate) mod data;
pub(crate) mod defect;
mod index;
#[allow(
    clippy::large_types_passed_by_value,
    clippy::result_large_err,
    reason = "texts and ways live while compiling"
)]
pub(crate) mod laws;
mod macros;
#[cfg(feature = "alloc")]
pub mod owned;
#[allow(clippy::large_types_passed_by_value, reason = "texts live while compiling")]
pub(crate) mod source;
#[cfg(all(test, feature = "alloc"))]
mod tests;

pub use data::{Binding, Clear, Component, DEPTH, Delivery, Link, Of, System, Target};
pub use defect::SystemError;
pub use laws::{Culprit, STATES, Step, Violation, judge};
