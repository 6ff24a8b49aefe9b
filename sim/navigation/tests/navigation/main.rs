//! Navigation: ways, guidance, avoidance, an operator.

mod avoidance;
mod common;
mod guiding;
mod operator;
mod ways;
