//! Fault campaigns: many missions under drawn faults, each failure as the smallest file that
//! replays, and what can be said of the rest.
//!
//! A [`Space`](space::Space) says what can go wrong, a [`Strategy`](strategy::Strategy) draws
//! [`Plan`](plan::Plan)s from it, a [`Subject`](subject::Subject) runs them,
//! [`Requirement`](requirement::Requirement)s judge each run, and
//! [shrinking](shrink::shrink) makes the plans of those that fail small. Whatever is counted is a
//! function of the seed: neither threads nor [shards](run::Shard) change it.
#![cfg_attr(test, allow(clippy::pedantic, clippy::unwrap_used))]
#![allow(clippy::cast_precision_loss)] // numbers of runs need no more than 52 bits

pub mod compare;
pub mod findings;
pub mod methods;
pub mod observed;
pub mod plan;
#[cfg(feature = "proptest")]
pub mod plans;
pub mod recorded;
pub mod requirement;
pub mod requirements;
pub mod results;
pub mod run;
pub mod sampling;
pub mod shrink;
pub mod space;
pub mod statistics;
pub mod strategy;
pub mod subject;
pub mod testing;
