//! Detections drawn from measured ones, for robots that are told what fails.

use cotama_core::units::Millis;
use cotama_models::robots::{Measurement, Robot};
use cotama_streams::Streams;
use std::sync::Arc;

/// The measured detections of a robot's failures, and the seed of what is drawn of them.
#[derive(Clone, Debug)]
pub(crate) struct Drawing {
    measurement: Arc<Measurement>,
    streams: Streams,
}

/// The run of a measurement that was drawn for a failure under way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Drawn {
    run: u64,
    /// The time until the failure is diagnosed; `None` where it never is.
    pub(crate) after: Option<Millis>,
}

impl Drawing {
    pub(crate) fn new(measurement: Arc<Measurement>, seed: u64) -> Self {
        Self { measurement, streams: Streams::new(seed) }
    }

    /// Draws a measured run for a failure that happens now; `None` where it was not measured. The
    /// failure and its time name the stream: other failures shift nothing, and two runs of a
    /// campaign draw different ones.
    pub(crate) fn draw(&self, robot: &Robot, number: usize, now: Millis) -> Option<Drawn> {
        let measured = self.measurement.rows.get(&number).filter(|it| it.runs > 0)?;
        let id = &robot.failures.get(number)?.id;
        let run = self.streams.stream(&format!("detection {id} {}", now.0)).below(measured.runs);
        Some(Drawn { run, after: measured.run(run).map(|it| it.1) })
    }

    /// Returns the rows that a failure is taken for in the run that was drawn, the worst first.
    pub(crate) fn taken(&self, number: usize, drawn: Drawn) -> &[usize] {
        let measured = self.measurement.rows.get(&number);
        measured.and_then(|it| it.run(drawn.run)).map_or(&[], |it| it.0)
    }
}
