//! Stories across the crates.

mod conformance;
mod doc_examples;
mod first_program;
mod once_wrong;
mod patrol;
mod players;
mod systems;
