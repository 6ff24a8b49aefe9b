//! Missions under supervisors: the delivery, global supervisors made from objectives, and mission
//! files that are generated, right and broken. The messages about broken files are in
//! `tests/golden/supervised.txt`; `UPDATE_GOLDEN=1 cargo test -p cotama-models --test supervised`
//! writes them again.
#![cfg(feature = "std")]

mod broken;
mod delivery;
mod edges;
mod file;
mod nets;
