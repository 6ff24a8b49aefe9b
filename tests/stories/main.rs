//! Stories across the crates.

mod claims;
mod conformance;
mod doc_examples;
#[path = "../../core/tests/common/effort.rs"]
#[allow(unreachable_pub)] // the core tests read it too
mod efforts;
mod first_program;
mod greedy;
mod once_wrong;
mod patrol;
mod players;
mod readers;
mod seeded_defects;
mod skips;
mod systems;
#[allow(dead_code, unreachable_pub)] // the core tests and benchmarks read it too
#[path = "../../core/tests/team/teams.rs"]
mod team_tables;
mod teams;

use cotama_tests::draw;
