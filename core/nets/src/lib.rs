//! Supervisors as typed Petri nets: defined once, checked while compiling, played anywhere.
//!
//! | module | what it is |
//! | --- | --- |
//! | [`mod@net`] | supervisors as typed Petri nets, checked while compiling |
//! | [`mod@system`] | several nets that work together; a net alone is a system of one |
//! | [`player`] | plays a net or a system: events and time in, what fired out; snapshots |
#![no_std]
#![cfg_attr(any(test, kani), allow(clippy::pedantic))]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(test)]
extern crate std;

mod extension;
mod logged;
pub mod net;
pub mod player;
pub mod system;

/// Items that `net!` and `system!` expand to: no part of the API, and free to change.
#[doc(hidden)]
pub mod __private {
    pub use crate::net::source::Written;
    #[cfg(feature = "defmt")]
    pub use defmt;
    pub mod lower {
        pub use crate::net::lower::*;
        pub use crate::net::size::Size;
    }
    pub mod source {
        pub use crate::net::source::*;
    }
    pub mod system {
        pub use crate::system::laws::{Claim, check as check_laws};
        pub use crate::system::source::*;
    }
}
