//! Stories across the crates.

mod conformance;
mod once_wrong;
mod patrol;
mod players;
mod systems;
