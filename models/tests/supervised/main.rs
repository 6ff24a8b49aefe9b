//! Supervised missions: the delivery, the net of its supervisor and its mutants, and generated
//! mission files, right and broken. The messages of the broken ones are in
//! `tests/golden/supervised.txt`; `UPDATE_GOLDEN=1 cargo test -p cotama-models --test supervised`
//! writes them again.
#![cfg(feature = "std")]

mod broken;
mod decider;
mod delivery;
mod edges;
mod file;
mod nets;
mod pending;
mod returns;
