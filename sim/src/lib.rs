//! Discrete-event simulation of robot missions: the run, its trace, its replay.
//!
//! A [`Mission`](cotama_models::missions::Mission) and [`Options`](options::Options) make a
//! [`Simulation`](setup::Simulation), which runs any number of times; every run is a
//! [`World`](world::World) that steps from event to event to its [`Run`](run::Run). With a
//! [`Recorder`](record::Recorder) it also leaves a [`Trace`](trace::Trace), from which it can be
//! drawn and [replayed](trace::replay). The same seed gives the same bytes on every machine.
#![cfg_attr(test, allow(clippy::pedantic, clippy::unwrap_used))]

pub mod body;
pub mod canonical;
pub mod estimate;
pub mod faults_text;
pub mod fleet;
pub mod kernel;
mod named;
pub mod options;
mod plan;
pub mod record;
pub mod robots;
pub mod run;
pub mod setup;
pub mod solver;
pub mod story;
pub mod trace;
pub mod world;

pub use cotama_streams as streams;
