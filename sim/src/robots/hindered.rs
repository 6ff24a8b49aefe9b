//! Events of a mission's script beside failures: obstacles, positions that were wrong, and power
//! that differs from the model.

use crate::body::Mover;
use cotama_core::units::{Millimetres, Millis, Milliwatts};
use cotama_models::missions::Mission;
use cotama_models::missions::faults::{Event, EventKind, PowerError};
use std::collections::VecDeque;

/// Hindrances of the robot, and its power beyond the model.
#[derive(Clone, Debug)]
pub(super) struct Hindered {
    waiting: VecDeque<Event>,
    power_errors: Vec<PowerError>,
    /// Until when something stands in the way.
    until: Option<Millis>,
}

impl Hindered {
    pub(super) fn new(events: &[Event], power_errors: &[PowerError]) -> Self {
        let waiting = events.iter().copied().collect();
        let power_errors = power_errors.to_vec();
        Self { waiting, power_errors, until: None }
    }

    /// The events at places that are reached happen; returns those of this period.
    pub(super) fn happen(&mut self, now: Millis, mover: &mut Mover<'_>) -> Vec<Event> {
        let x = mover.x();
        let mut happened = Vec::new();
        while let Some(event) = self.waiting.front().copied().filter(|it| it.x <= x) {
            self.waiting.pop_front();
            match event.kind {
                EventKind::Obstacle { delay } => {
                    let from = self.until.map_or(now, |it| it.max(now));
                    self.until = Some(Millis(from.0 + delay.0));
                }
                EventKind::Odometry { extra } => mover.owe(extra),
                // Faults of hardware are failures of the robot's file.
                EventKind::Fault { .. } | EventKind::Repair { .. } => continue,
            }
            happened.push(event);
        }
        if self.until.is_some_and(|it| it <= now) {
            self.until = None;
        }
        happened
    }

    /// Whether something stands in the way.
    pub(super) const fn waits(&self) -> bool {
        self.until.is_some()
    }

    /// Returns the real power for a modelled one.
    pub(super) fn real(&self, mission: &Mission, x: Millimetres, model: Milliwatts) -> Milliwatts {
        let holds = |it: &&PowerError| {
            mission.zones.get(it.zone).is_some_and(|it| it.x_start <= x && x < it.x_end)
        };
        let permille: i64 =
            { self.power_errors.iter() }.filter(holds).map(|it| i64::from(it.permille)).sum();
        let factor = u64::try_from(permille.saturating_add(1_000)).unwrap_or(0);
        Milliwatts((model.0.saturating_mul(factor) + 500) / 1_000)
    }

    /// The place of the next event.
    pub(super) fn next(&self) -> Option<Millimetres> {
        self.waiting.front().map(|it| it.x)
    }
}
