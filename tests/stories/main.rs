//! Stories across the crates.

mod claims;
mod conformance;
mod first_program;
mod greedy;
mod once_wrong;
mod patrol;
mod players;
mod readers;
mod robots;
mod skips;
mod systems;
#[allow(dead_code, unreachable_pub)] // the core tests and benchmarks read it too
#[path = "../../core/assignment/tests/team/teams.rs"]
mod team_tables;
mod teams;
mod tidy;

use cotama_tests::draw;
