//! Readings of each kind of device, their faults and their laws.

mod bytes;
mod cameras;
mod common;
mod faults;
mod lasers;
mod laws;
mod links;
mod people;
mod sonars;
