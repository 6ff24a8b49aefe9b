//! The common parts of the tests.
#![allow(dead_code, unreachable_pub, clippy::unwrap_used)]

use cotama_core::units::Millis;
use cotama_models::missions::faults::Faults;
use cotama_models::missions::{Mission, embedded};
use cotama_sim::options::{FaultChoice, Options};
use cotama_sim::run::Run;
use cotama_sim::setup::Simulation;

/// Turn, 100 m through two zones, turn, 100 m back; two lasers and a camera.
pub const SHUTTLE: &str = include_str!("shuttle.toml");

pub fn patrol_text() -> &'static str {
    embedded::mission("patrol").unwrap().text
}

pub fn patrol() -> Mission {
    Mission::parse("patrol", patrol_text()).unwrap()
}

pub fn shuttle() -> Mission {
    Mission::parse("shuttle.toml", SHUTTLE).unwrap_or_else(|errors| panic!("{errors}"))
}

/// Faults from the body of a `panorama-faults/1` file.
pub fn faults(mission: &Mission, body: &str) -> FaultChoice {
    let text = format!("format = \"panorama-faults/1\"\n{body}");
    let faults = Faults::parse("test", &text, mission).unwrap_or_else(|errors| panic!("{errors}"));
    FaultChoice::Given { source: "test".into(), faults }
}

pub fn under(mission: &Mission, body: &str) -> Options {
    Options { faults: faults(mission, body), ..Options::default() }
}

pub fn with_period(period_ms: u64) -> Options {
    Options { monitor_period: Some(Millis(period_ms)), ..Options::default() }
}

pub fn run(mission: &Mission, options: &Options) -> Run {
    Simulation::new(mission, options).unwrap().run(options.seed).unwrap()
}

/// Why each plan was made.
pub fn causes(mission: &Mission, run: &Run) -> Vec<String> {
    run.plans.iter().map(|plan| plan.cause.text(mission)).collect()
}

/// The labels of a plan's choices.
pub fn labels(mission: &Mission, run: &Run, plan: usize) -> Vec<String> {
    run.plans[plan].rows(mission).into_iter().map(|row| row.choice).collect()
}
