//! Any net or system in play, whatever its size: events, rounds and time go in, what fired comes
//! out.
//!
//! [`Numbered`] tells everything in a system by one number each, as if it were one net; a [`Game`]
//! is a [`Player`](cotama_core::player::Player) behind these numbers.
//!
//! ```
//! use cotama_core::net;
//! use cotama_core::net::EventId;
//! use cotama_core::system::{Component, System};
//! use cotama_core::units::Millis;
//! use cotama_play::Numbered;
//!
//! net! {
//!     /// Goes out by itself.
//!     pub mod lamp {
//!         places { Dark: 1, Lit }
//!         events { press }
//!         transitions { on on press: Dark => Lit; off: Lit => Dark after 5_000 ms; }
//!     }
//! }
//! let numbered = Numbered::of(&System::alone(&[Component::alone(&lamp::NET)]));
//! let mut names = Vec::new();
//! numbered
//!     .play(Millis(0), &mut |mut game, _| {
//!         let mut fired = Vec::new();
//!         game.offer(Millis(0), EventId(0), &mut fired).unwrap();
//!         game.advance(Millis(5_000), &mut fired);
//!         names = fired.iter().map(|it| numbered.transition(it.transition).to_owned()).collect();
//!     })
//!     .unwrap();
//! assert_eq!(names, ["on", "off"]);
//! ```

#![no_std]
#![cfg_attr(kani, allow(clippy::pedantic))]

extern crate alloc;
#[cfg(test)]
extern crate std;

mod condition;
mod game;
mod needs;
mod numbered;
mod refusal;
mod session;

pub use condition::condition;
pub use game::{Fired, Game, Leaked, NotPlayed, Unused};
pub use needs::{ignored_in, not_enabled, overflowing};
pub use numbered::Numbered;
pub use refusal::{Reason, Refusal};
pub use session::{Endless, MOST_FIRINGS, Record, Saved, Session};
