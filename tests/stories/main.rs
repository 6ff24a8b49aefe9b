//! Stories across the crates.

mod allocators;
mod conformance;
mod nets;
mod patrol;
mod systems;
