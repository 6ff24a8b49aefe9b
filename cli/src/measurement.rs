//! Measured detections of a robot's failures: of a file, or of a robot that comes with them.

use crate::exit::Failure;
use crate::input;
use crate::kind::{self, Kind};
use cotama_models::missions::Mission;
use cotama_models::robots::{Measurement, Robot, embedded_measurement};
use cotama_sim::options::Fidelity;
use std::sync::Arc;

/// The measurement of this name: of a robot that comes with the program, or in a file.
pub(crate) fn load(name: &str, robot: &Robot) -> Result<Measurement, Failure> {
    if let Some(it) = embedded_measurement(name) {
        return Ok(Measurement::parse(name, it.text, robot)?);
    }
    let text = kind::text(name, "a measurement", input::MEASUREMENT_BYTES, &[Kind::Measurement])?;
    Ok(Measurement::parse(name, &text, robot)?)
}

/// The measurement by which failures are found in runs of a mission, where one is named.
pub(crate) fn of_run(
    name: Option<&str>,
    mission: &Mission,
    fidelity: Fidelity,
) -> Result<Option<Arc<Measurement>>, Failure> {
    let Some(name) = name else { return Ok(None) };
    if fidelity == Fidelity::Signal {
        let message = "--measured is what told robots draw detections of; by signals none is told";
        return Err(Failure::new(message).help("leave --measured out, or --fidelity signal"));
    }
    let Some(robot) = mission.robot() else {
        let message = "--measured is for robots with a file, and this mission names none";
        return Err(Failure::new(message).help("add `robot = \"p3dx-delivery\"`, or --supervised"));
    };
    load(name, robot.robot()).map(|it| Some(Arc::new(it)))
}
