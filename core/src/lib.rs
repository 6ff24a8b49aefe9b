//! The deterministic, allocation-free core of robot supervisors.
#![no_std]
#![cfg_attr(test, allow(clippy::pedantic))]

#[cfg(test)]
extern crate std;

pub mod allocation;
pub mod exact;
pub mod front;
pub mod hardware;
pub mod monitor;
pub mod panorama;
pub mod problem;
pub mod units;
