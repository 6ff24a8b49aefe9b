//! Missions: what is read, what is refused, what is planned.

mod axed;
mod broken;
mod examples;
mod infeasible;
mod laws;
mod measurements;
mod mutants;
mod patrol;
