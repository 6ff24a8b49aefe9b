//! A system as a net that acts in rounds: it does what a player does, and COTAMA's decisional level keeps its properties in it.
#![allow(missing_docs)]

mod conformance;
mod decision;
mod mutants;
mod responses;
