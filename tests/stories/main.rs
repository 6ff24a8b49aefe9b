//! Stories across the crates.

mod allocators;
mod nets;
mod patrol;
mod systems;
