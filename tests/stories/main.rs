//! Stories across the crates.

mod conformance;
mod nets;
mod patrol;
mod systems;
