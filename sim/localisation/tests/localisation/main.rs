//! Localisation: laws of its filter, robots that are lost and found.

mod common;
mod exact;
mod laws;
mod office;
mod parameters;
