//! Several supervisors that work together.
//!
//! A [`System`] is plain data: nets in the order of their turns, links from outputs to events,
//! mailboxes, shared places. The same value is run, by a [`Player`], and checked.
//! [`system!`](crate::system!) makes one while compiling.

mod arrays;
pub mod code;
mod data;
mod happening;
mod macros;
mod pack;
mod player;
#[allow(clippy::large_types_passed_by_value, reason = "texts live while compiling")]
pub mod source;

#[cfg(feature = "alloc")]
pub use arrays::Packed;
pub use data::{
    Binding, Clear, Component, DEPTH, Delivery, Link, Of, System, SystemDefect, Target,
};
pub use happening::{Happening, Offered, Turned, Witness};
pub use player::{CATCH_UP, Player, Program, SETTLE, event};
