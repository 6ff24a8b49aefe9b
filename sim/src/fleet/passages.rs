//! The people that a robot meets on crowded ways, and what it learns of them.

use crate::streams::{Stream, Streams};
use cotama_models::team::scenario::{Crowd, MOST_DELAYS, RobotSpec, Scenario, Trust};

/// Draws and memory of a robot, a list for each crowded way.
#[derive(Clone, Debug)]
pub(super) struct Passages {
    /// A stream for each way: the delay of a robot's passage of a number is the same whatever was
    /// bid before it, so seeds are paired.
    draws: Vec<Stream>,
    seen: Vec<Vec<u64>>,
    learns: bool,
    /// The delays of both drives under way, each with its way.
    met: [Vec<(usize, u64)>; 2],
}

impl Passages {
    pub(super) fn new(scenario: &Scenario, spec: &RobotSpec, streams: Streams) -> Self {
        let name = |it: usize| scenario.floor.name(cotama_models::team::scenario::Place(it));
        let stream = |it: &Crowd| {
            let [one, other] = [it.between.0, it.between.1].map(name);
            streams.stream(&format!("people between {one} and {other} before {}", spec.name))
        };
        Self {
            draws: scenario.crowds.iter().map(stream).collect(),
            seen: scenario.delays_seen(),
            learns: scenario.trust == Trust::Learned,
            met: [Vec::new(), Vec::new()],
        }
    }

    /// Returns the delays that it knows of each crowded way, in ms.
    pub(super) fn seen(&self) -> &[Vec<u64>] {
        &self.seen
    }

    /// Enters these ways in each of two drives; returns how long people stand in its way there, in
    /// ms.
    pub(super) fn enter(&mut self, crowds: &[Crowd], drives: [Vec<usize>; 2]) -> [u64; 2] {
        self.met = drives.map(|ways| {
            let meets = |way: usize| {
                let (crowd, draws) = (crowds.get(way)?, self.draws.get_mut(way)?);
                let number = draws.below(crowd.delays_ms.len() as u64);
                Some((way, crowd.delays_ms.get(usize::try_from(number).ok()?).copied()?))
            };
            ways.into_iter().filter_map(meets).collect()
        });
        [0, 1].map(|it: usize| self.met[it].iter().map(|it| it.1).sum())
    }

    /// The first or the second drive is over: the robot knows what it met. The oldest of 1,000
    /// delays of a way is forgotten.
    pub(super) fn is_through(&mut self, drive: usize) {
        for (way, delay) in std::mem::take(&mut self.met[drive]) {
            if let Some(seen) = self.seen.get_mut(way).filter(|_| self.learns) {
                if seen.len() >= MOST_DELAYS {
                    seen.remove(0);
                }
                seen.push(delay);
            }
        }
    }
}
