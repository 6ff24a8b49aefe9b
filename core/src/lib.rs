//! The deterministic, allocation-free core of robot supervisors.
#![no_std]
#![cfg_attr(test, allow(clippy::pedantic))]

#[cfg(test)]
extern crate std;

pub mod hardware;
pub mod problem;
pub mod units;
