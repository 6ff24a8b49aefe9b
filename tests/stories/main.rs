//! Stories across the crates.

mod allocators;
mod patrol;
