//! Runs of missions and teams: what happens, what is recorded, what is run again.

mod axed;
mod common;
mod delivery;
mod doors;
mod estimates;
mod examples;
mod measured;
mod patrol;
mod people;
mod plane;
mod properties;
mod robots;
mod signal;
mod stories;
mod teams;
mod traces;
mod ward;
