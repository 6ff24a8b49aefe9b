//! Networks and data with known answers; `data/README.md` says how each was found.

#![allow(clippy::pedantic, clippy::unwrap_used, clippy::disallowed_methods)]

mod choices;
mod common;
mod formats;
mod inference;
mod learning;
mod mutants;
mod properties;
