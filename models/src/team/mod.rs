//! Robots as a team: who does what, and the messages by which they agree on it.

#[cfg(feature = "std")]
pub mod protocol;
