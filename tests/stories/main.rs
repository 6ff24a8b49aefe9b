//! Stories across the crates.

mod allocators;
