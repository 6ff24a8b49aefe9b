//! The shipped nets against the textbook: every reachable marking, every event, every small
//! mistake.
#![cfg(feature = "std")]

mod executive;
mod families;
mod golden;
mod laws;
mod matrix;
mod mutants;
mod playing;
mod registry;
mod stories;
mod textbook;
mod time;
