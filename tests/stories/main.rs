//! Stories across the crates.

mod conformance;
mod first_program;
mod once_wrong;
mod patrol;
mod players;
mod systems;
