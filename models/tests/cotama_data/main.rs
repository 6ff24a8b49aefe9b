//! COTAMA's knowledge as data, against the nets and against the rules it came from.
#![allow(missing_docs)]

mod availability;
mod decisions;
mod diagnoses;
mod fmeca;
